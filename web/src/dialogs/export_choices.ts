// The choices of the forms of export that have any: the options of `lekalo export`, by their names.

import type { Model, Sheet } from '../layout/model';

export type ChosenForm = 'dxf' | 'hpgl' | 'gcode';
export interface Field {
  name: string;
  /** The values of a list, of which the first stands as a rule; absent: the field takes a number. */
  of?: readonly string[];
  /** The number that stands in the field at first. */
  value?: number;
  /** The server refuses without it, and says so. */
  required?: boolean;
  /** The processes for which the field is asked; absent: all. */
  when?: readonly string[];
}
/** The values by the names of their fields. An empty one is left out of the request: the server decides. */
export type Values = Record<string, string>;

const ROUTER = ['router'];
const BEAM = ['laser', 'plasma', 'waterjet'];
const ENGRAVER = ['laser', 'router'];
const UNIT: Field = { name: 'unit', of: ['mm', 'inch'] };
/** The empty value stands for all layers. */
const ONLY: Field = { name: 'only', of: ['', 'CUT'] };
export const CHOICES: Record<ChosenForm, { name: string; sheetEach: boolean; fields: readonly Field[] }> = {
  dxf: { name: 'DXF', sheetEach: false, fields: [UNIT, ONLY] },
  hpgl: { name: 'HPGL', sheetEach: true, fields: [ONLY] },
  gcode: {
    name: 'G-code',
    sheetEach: true,
    fields: [
      { name: 'process', of: ['laser', 'plasma', 'waterjet', 'router'] },
      { name: 'post', of: ['linuxcnc', 'grbl', 'fanuc', 'haas'] },
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
      { name: 'engrave-feed', when: ENGRAVER },
      { name: 'engrave-speed', when: ENGRAVER },
      { name: 'engrave-depth', when: ROUTER },
    ],
  },
};

export const isAsked = (field: Field, values: Values): boolean =>
  !field.when || field.when.includes(values.process ?? '');

/** The sheets that parts lie on as STOCK#COPY, copies counted from 1. */
export function sheetsInUse(model: Model): string[] {
  const used = new Set<Sheet>();
  for (const p of model.placements.values()) {
    const sheet = model.sheet(p.stock, p.copy);
    if (sheet) used.add(sheet);
  }
  return model.sheets.filter((sheet) => used.has(sheet)).map((sheet) => `${sheet.stock.id}#${sheet.copy + 1}`);
}

/** The fields of the request: those that are asked and have a value. */
export function request(form: ChosenForm, sheet: string, values: Values): URLSearchParams {
  const fields = new URLSearchParams({ form });
  if (sheet) fields.set('sheet', sheet);
  for (const field of CHOICES[form].fields) {
    const value = (values[field.name] ?? '').trim();
    if (value && isAsked(field, values)) fields.set(field.name, value);
  }
  return fields;
}
