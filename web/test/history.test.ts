import { describe, expect, it } from 'vitest';
import { setLanguage } from '../src/i18n';
import { wordsOf } from '../src/layout/commands';
import { inWords, type Entry, type Touched } from '../src/panels/history_words';

const names = ['side_panel', 'lid', 'shelf', 'back', 'foot'];
const touched = (part: number, first: number, changed: number): Touched => ({
  part,
  first,
  placed: 0,
  changed,
  removed: 0,
});
const said = (text: string, parts: Touched[] = [], kind: Entry['kind'] = 'command', damaged = false): string =>
  inWords({ revision: 1, at: '', author: '', text, kind, undone: false, damaged, parts }, (which) =>
    typeof which === 'string' ? which : names[which]!,
  );

describe('the history in words', () => {
  it('names one part by its number, several by how many', () => {
    expect(said('move 13 by 4.5 0', [touched(0, 13, 1)])).toBe('moved side_panel 13');
    expect(said('nest for 5 seed 1', [touched(1, 2, 4)])).toBe('nested 4 of lid');
    expect(said('rotate 3,4 15', [touched(0, 3, 1), touched(1, 4, 1)])).toBe('turned side_panel 3, lid 4');
    const all = names.map((_, i) => touched(i, i + 1, 2));
    expect(said('compact towards -1 0', all)).toBe('compacted 2 of side_panel, 2 of lid, 2 of shelf and 4 more');
  });
  it('counts what was placed and taken away as well', () => {
    const placed = { ...touched(1, 7, 0), placed: 3 };
    expect(said('nest for 5', [placed])).toBe('nested 3 of lid');
    expect(said('remove 7,8', [{ ...touched(1, 7, 0), removed: 2 }])).toBe('took off 2 of lid');
  });
  it('says of undo, redo, a restore, damage and a stop what they are', () => {
    expect(said('move 13 by 4.5 0', [touched(0, 13, 1)], 'undo')).toBe('undone: moved side_panel 13');
    expect(said('move 13 by 4.5 0', [touched(0, 13, 1)], 'redo')).toBe('done again: moved side_panel 13');
    expect(said('restore 12', [touched(0, 13, 1)], 'restore')).toBe('went back to 12');
    expect(said('(damaged)', [], 'restore', true)).toMatch(/damaged/);
    expect(said('nest for 5 # stopped early', [touched(1, 2, 4)])).toBe('nested 4 of lid (stopped early)');
  });
  it('names defects and zones, whatever their names are', () => {
    expect(said('add-defect "two words" "a \\"knot\\"" 1 outline 0 0 1 0 0 1')).toBe('drew defect a "knot"');
    expect(said('remove-zone hide back')).toBe('removed zone back');
    expect(wordsOf('place "a\\\\b\\nc" 3')).toEqual(['place', 'a\\b\nc', '3']);
  });
  it('says what became of the job, with the pieces that went', () => {
    expect(said('quantity "side_panel" 6')).toBe('side_panel: 6 wanted');
    expect(said('mirror lid no')).toBe('lid may not be turned over');
    expect(said('add lid "two words" 3000x1500')).toBe('added lid, two words, 3000x1500');
    expect(said('gap 4')).toBe('gap 4 mm');
    const gone = { part: 'lid', first: 3, placed: 0, changed: 0, removed: 2 };
    expect(said('remove-part lid', [gone])).toBe('removed part lid, with 2 of lid');
    expect(said('remove-stock sheet', [{ ...touched(0, 3, 0), removed: 1 }], 'undo')).toBe(
      'undone: removed sheet, with side_panel 3',
    );
  });
  it('is Ukrainian, too', () => {
    setLanguage('uk');
    expect(said('move 13 by 4.5 0', [touched(0, 13, 1)])).toBe('пересунуто side_panel 13');
    expect(said('nest for 5', [touched(1, 2, 4)], 'undo')).toBe('скасовано: розкладено 4 × lid');
    expect(said('grade-defect hide knot 3')).toBe('оцінено ваду knot');
    setLanguage('en');
  });
  it('shows a verb that it does not know as it was written', () => {
    expect(said('bend 3 by 90')).toBe('bend 3 by 90');
  });
});
