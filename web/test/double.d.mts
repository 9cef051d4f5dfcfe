import type { LayoutDocument, Violation } from '../src/document';
import type { Change } from '../src/model';
export class ServerDouble {
  constructor(
    document: LayoutDocument,
    options?: { refuse?: (text: string, mode: string) => string | null; violations?: (text: string) => Violation[] },
  );
  revision: number;
  lines: string[];
  /// Seqs that `stop` named.
  stopped: number[];
  onTheWay(fraction: number, secondsLeft: number | null, placements?: Change[]): object[];
  endLong(changes: Change[]): object[];
  hello(): object;
  answer(text: string): object[];
}
