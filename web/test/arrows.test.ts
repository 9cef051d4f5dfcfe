import { readdirSync, readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { ARROWS, troublesOf } from './arrows';

const src = new URL('../src/', import.meta.url).pathname;
const sources = new Map(
  readdirSync(src, { recursive: true, encoding: 'utf8' })
    .filter((path) => /\.(ts|json)$/.test(path))
    .map((path) => [path, readFileSync(src + path, 'utf8')]),
);
const planted = (path: string, text: string): string[] => troublesOf(new Map([...sources, [path, text]]));

describe('imports between the sources of the page', () => {
  it('follow the arrows and go round in no circle', () => {
    expect(troublesOf(sources)).toEqual([]);
  });
  it('are noticed where they go against an arrow', () => {
    expect(planted('layout/planted.ts', "import { Editor } from '../editor/editor';")).toEqual([
      'layout/planted.ts imports editor/editor.ts: there is no arrow from layout to editor',
    ]);
    expect(planted('html/planted.ts', "export * from '../main';")).toHaveLength(1);
    expect(planted('kernel/planted.ts', "const late = () => import('../picture/view');")).toHaveLength(1);
  });
  it('are noticed where they close a circle, also one of types alone', () => {
    const closed = new Map([...sources]);
    closed
      .set('layout/one.ts', "import type { Two } from './two';")
      .set('layout/two.ts', "import {\n  one,\n} from './one';");
    expect(troublesOf(closed)).toEqual([
      'these imports go round in a circle: layout/one.ts -> layout/two.ts -> layout/one.ts',
    ]);
  });
  it('are stated for every folder, and a folder that is new or too full is noticed', () => {
    expect(planted('drawer/planted.ts', '')).toEqual([
      'drawer/planted.ts: the folder drawer has no arrows in test/arrows.ts',
    ]);
    const full = new Map(Array.from({ length: 41 }, (_, i) => [`html/file_${i}.ts`, '']));
    expect(troublesOf(full)).toEqual(['html has 41 files, at most 40 may be']);
  });
  it('have arrows that go round in no circle between folders', () => {
    const asFiles = new Map(
      Object.entries(ARROWS).map(([folder, to]) => [`${folder}.ts`, to.map((one) => `import './${one}';`).join('\n')]),
    );
    expect(troublesOf(asFiles)).toEqual([]);
  });
});
