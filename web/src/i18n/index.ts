// The words of the page. A plural is an object by the categories of Intl.PluralRules.

import en from './en.json';
import uk from './uk.json';

export type Key = keyof typeof en;
export type Language = 'en' | 'uk';
type Entry = string | Record<string, string>;
export const dictionaries: Record<Language, Record<string, Entry>> = { en, uk };

export const isKey = (text: string): text is Key => text in en;

let language: Language = 'en';
let plurals = new Intl.PluralRules('en');

export function setLanguage(to: Language): void {
  language = to;
  plurals = new Intl.PluralRules(to);
  if (typeof document !== 'undefined') document.documentElement.lang = to;
}
export const currentLanguage = (): Language => language;

export function t(key: Key, values: Record<string, string | number> = {}): string {
  const entry = dictionaries[language][key] ?? dictionaries.en[key] ?? key;
  const text = typeof entry === 'string' ? entry : (entry[plurals.select(Number(values.n ?? 0))] ?? entry.other ?? key);
  return text.replace(/\{(\w+)\}/g, (whole, name: string) => String(values[name] ?? whole));
}
