import { describe, expect, it } from 'vitest';
import { dictionaries, setLanguage, t, type Language } from '../src/i18n';

describe('words', () => {
  it('are there in both languages, with the same places for values', () => {
    const { en, uk } = dictionaries;
    expect(Object.keys(uk).sort()).toEqual(Object.keys(en).sort());
    const holes = (text: string) => [...text.matchAll(/\{\w+\}/g)].map(String).sort();
    for (const key of Object.keys(en)) {
      const forms = (entry: string | Record<string, string>) =>
        typeof entry === 'string' ? [entry] : Object.values(entry);
      const expected = holes(forms(en[key]!)[0]!);
      for (const form of [...forms(en[key]!), ...forms(uk[key]!)]) expect(holes(form), key).toEqual(expected);
    }
  });
  it('have every plural of their language', () => {
    for (const [language, words] of Object.entries(dictionaries)) {
      const wanted = new Intl.PluralRules(language as Language).resolvedOptions().pluralCategories;
      for (const [key, entry] of Object.entries(words)) {
        if (typeof entry !== 'string')
          for (const form of wanted) expect(entry[form], `${language} ${key} ${form}`).toBeTruthy();
      }
    }
  });
  it('count in Ukrainian', () => {
    setLanguage('uk');
    expect([1, 2, 5, 11, 21, 22].map((n) => t('sheets.parts', { n }))).toEqual([
      '1 деталь',
      '2 деталі',
      '5 деталей',
      '11 деталей',
      '21 деталь',
      '22 деталі',
    ]);
    setLanguage('en');
  });
});
