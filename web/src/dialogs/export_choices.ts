// What can be chosen of the forms of export that have choices: the options of `lekalo export`, by their names.

import type { Model, Sheet } from '../layout/model';

export type ChosenForm = 'dxf' | 'hpgl' | 'gcode';
export interface Field {
  name: string;
  /// The values of a list, the first as a rule; absent: a number.
  of?: readonly string[];
  /// Stands in the field at first.
  value?: number;
  /// The server refuses without it, and says so.
  required?: boolean;
  /// Is asked of these processes alone.
  when?: readonly string[];
}
/// By the names of fields; '' is left out of the request, and the server takes what it does as a rule.
export type Values = Record<string, string>;

const ROUTER = ['router'];
const BEAM = ['laser', 'plasma'];
const UNIT: Field = { name: 'unit', of: ['mm', 'inch'] };
/// '': all layers.
const ONLY: Field = { name: 'only', of: ['', 'CUT'] };
export const CHOICES: Record<ChosenForm, { name: string; sheetEach: boolean; fields: readonly Field[] }> = {
  dxf: { name: 'DXF', sheetEach: false, fields: [UNIT, ONLY] },
  hpgl: { name: 'HPGL', sheetEach: true, fields: [ONLY] },
  gcode: {
    name: 'G-code',
    sheetEach: true,
    fields: [
      { name: 'process', of: ['laser', 'plasma', 'router'] },
      { name: 'post', of: ['linuxcnc', 'grbl', 'fanuc'] },
      UNIT,
      { name: 'kerf', required: true },
      { name: 'feed', required: true },
      { name: 'lead-in', value: 0 },
      { name: 'lead', of: ['line', 'arc'] },
      { name: 'speed' },
      { name: 'pierce', when: BEAM },
      { name: 'depth', required: true, when: ROUTER },
      { name: 'pass', when: ROUTER },
      { name: 'plunge', required: true, when: ROUTER },
      { name: 'safe-height', when: ROUTER },
    ],
  },
};

export const isAsked = (field: Field, values: Values): boolean =>
  !field.when || field.when.includes(values.process ?? '');

/// STOCK#COPY of the sheets that parts lie on; copies from 1.
export function sheetsInUse(model: Model): string[] {
  const used = new Set<Sheet>();
  for (const p of model.placements.values()) {
    const sheet = model.sheet(p.stock, p.copy);
    if (sheet) used.add(sheet);
  }
  return model.sheets.filter((sheet) => used.has(sheet)).map((sheet) => `${sheet.stock.id}#${sheet.copy + 1}`);
}

/// The fields of the request, those alone that are asked.
export function request(form: ChosenForm, sheet: string, values: Values): URLSearchParams {
  const fields = new URLSearchParams({ form });
  if (sheet) fields.set('sheet', sheet);
  for (const field of CHOICES[form].fields) {
    const value = (values[field.name] ?? '').trim();
    if (value && isAsked(field, values)) fields.set(field.name, value);
  }
  return fields;
}
