import type { LayoutDocument, Violation } from '../src/document';
export class ServerDouble {
  constructor(document: LayoutDocument, options?: { refuse?: (text: string, mode: string) => string | null; violations?: (text: string) => Violation[] });
  revision: number;
  lines: string[];
  hello(): object;
  answer(text: string): object[];
}
