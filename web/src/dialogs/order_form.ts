// An order as the server takes it: the words of `lekalo nest`, the drawings, and the parts as a table.

/** What is offered of the angles that a part may have, as the column `rotations` of a table has them. */
export const ROTATIONS = ['any', '0', '0,180', '0,90,180,270'] as const;

export interface OrderedFile {
  file: File;
  quantity: string;
  rotations: string;
  mirror: boolean;
}

export type StockKind = 'sheet' | 'strip' | 'drawing';

export interface Stock {
  kind: StockKind;
  width: string;
  height: string;
  /** Empty: as many as needed. */
  count: string;
  file: File | null;
}

export interface OrderTerms {
  stocks: Stock[];
  gap: string;
  border: string;
  kerf: string;
}

export const firstTerms = (): OrderTerms => ({
  stocks: [{ kind: 'sheet', width: '2500', height: '1250', count: '', file: null }],
  gap: '4',
  border: '10',
  kerf: '0',
});

/** A comma is what half of Europe writes; the server reads points. */
export const length = (typed: string): string => typed.trim().replace(',', '.');
const cell = (text: string): string => `"${text.replaceAll('"', '""')}"`;

function stockWord(stock: Stock): [string, string] {
  const count = stock.count.trim() === '' ? '' : `=${stock.count.trim()}`;
  if (stock.kind === 'strip') return ['strip', length(stock.height)];
  if (stock.kind === 'drawing') return ['sheet', `${stock.file?.name ?? ''}${count}`];
  return ['sheet', `${length(stock.width)}x${length(stock.height)}${count}`];
}

/** Files of one name are told apart by a number, as the rows of the table name them. */
export function namesOf(files: readonly File[]): string[] {
  const taken = new Set<string>();
  return files.map(({ name }) => {
    let free = name;
    for (let n = 2; taken.has(free); ++n) free = name.replace(/(\.[^.]*)?$/, (ending) => `-${n}${ending}`);
    taken.add(free);
    return free;
  });
}

/** What is added to a layout that is there. */
export function additionsOf(files: readonly OrderedFile[], stocks: readonly Stock[]): FormData {
  const form = new FormData();
  const names = namesOf(files.map(({ file }) => file));
  const rows = files.map(({ quantity, rotations, mirror }, i) =>
    [cell(names[i]!), cell(quantity.trim()), cell(rotations), mirror ? 'yes' : 'no'].join(','),
  );
  if (rows.length > 0) form.append('table', ['file,quantity,rotations,mirror', ...rows, ''].join('\n'));
  for (const stock of stocks) form.append(...stockWord(stock));
  files.forEach(({ file }, i) => form.append('file', file, names[i]));
  for (const { kind, file } of stocks) if (kind === 'drawing' && file) form.append('file', file, file.name);
  return form;
}

export function formOf(files: readonly OrderedFile[], terms: OrderTerms): FormData {
  const form = additionsOf(files, terms.stocks);
  for (const key of ['gap', 'border', 'kerf'] as const) form.append(key, length(terms[key]));
  return form;
}
