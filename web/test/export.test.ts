import { describe, expect, it } from 'vitest';
import { CHOICES, request, sheetsInUse } from '../src/dialogs/export_choices';
import { dictionaries } from '../src/i18n';
import { Model } from '../src/layout/model';

describe('the choices of an export', () => {
  it('are sent where they are asked and given, and by the names of the command line', () => {
    const values = {
      process: 'laser',
      post: 'grbl',
      unit: 'inch',
      kerf: ' 0.2 ',
      feed: '2000',
      'lead-in': '',
      depth: '12',
      pierce: '0.5',
    };
    expect(String(request('gcode', 'big sheet#2', values))).toBe(
      'form=gcode&sheet=big+sheet%232&process=laser&post=grbl&unit=inch&kerf=0.2&feed=2000&pierce=0.5',
    );
    expect(request('gcode', '', { ...values, process: 'router' }).get('depth')).toBe('12');
    expect(request('gcode', '', { ...values, process: 'router' }).has('pierce')).toBe(false);
    expect(String(request('dxf', '', { unit: 'inch', only: '', kerf: '1' }))).toBe('form=dxf&unit=inch');
  });
  it('have words for every field and value', () => {
    for (const { fields } of Object.values(CHOICES))
      for (const { name } of fields) expect(dictionaries.en[`export.${name}`], name).toBeTruthy();
    for (const name of ['process', 'lead']) {
      for (const value of CHOICES.gcode.fields.find((f) => f.name === name)!.of!)
        expect(dictionaries.en[`export.${name}.${value}`], value).toBeTruthy();
    }
  });
  it('name the sheets in use, copies from 1', () => {
    const outline = {
      polygon: {
        outer: [
          [0, 0],
          [10, 0],
          [10, 10],
        ] as [number, number][],
      },
    };
    const model = new Model({
      format: 'lekalo-layout/1',
      units: 'mm',
      stocks: [
        { id: 'a', kind: 'sheet', count: 3, outline },
        { id: 'b', kind: 'sheet', outline },
      ],
      parts: [{ id: 'p', outline }],
      placements: [1, 2].map((id) => ({ id, part: 'p', stock: 'a', copy: id - 1, c: 1, s: 0, x: 0, y: 0 })),
    });
    expect(sheetsInUse(model)).toEqual(['a#1', 'a#2']);
  });
});
