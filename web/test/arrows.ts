// The arrows between the folders of web/src, and the search for what breaks them.

import { dirname, join, normalize } from 'node:path/posix';

/** The folders from which each folder may import; main.ts may import from all of them. */
export const ARROWS: Record<string, readonly string[]> = {
  html: [],
  i18n: [],
  layout: [],
  kernel: ['layout'],
  tasks: ['kernel', 'layout'],
  server: ['kernel', 'layout'],
  editor: ['i18n', 'kernel', 'layout', 'server', 'tasks'],
  dialogs: ['html', 'i18n', 'layout'],
  panels: ['editor', 'html', 'i18n', 'layout'],
  picture: ['editor', 'html', 'i18n', 'kernel', 'layout'],
  tools: ['editor', 'i18n', 'layout', 'picture'],
  page: ['dialogs', 'editor', 'html', 'i18n', 'kernel', 'layout', 'panels', 'picture', 'server', 'tasks', 'tools'],
};

const MOST_FILES_IN_A_FOLDER = 40;

/** Sources by their path under src, `layout/model.ts`. */
export type Sources = ReadonlyMap<string, string>;

const importsOf = (path: string, text: string): string[] =>
  [...text.matchAll(/(?:^|\n)(?:import|export)\b[^;'"]*['"](\.[^'"]+)['"]|\bimport\(['"](\.[^'"]+)['"]\)/g)].map(
    (found) => normalize(join(dirname(path), (found[1] ?? found[2])!)),
  );

/** Every file with the files of ours that it imports. */
function graphOf(sources: Sources): Map<string, string[]> {
  const fileOf = (name: string): string | undefined =>
    [name, `${name}.ts`, `${name}/index.ts`].find((file) => sources.has(file));
  return new Map(
    [...sources].map(([path, text]) => [path, importsOf(path, text).flatMap((name) => fileOf(name) ?? [])]),
  );
}

/** The first circle that a walk along the imports closes, as `a.ts -> b.ts -> a.ts`. */
function circleIn(graph: ReadonlyMap<string, readonly string[]>): string | null {
  const done = new Set<string>();
  const walk = (path: string, way: readonly string[]): string | null => {
    if (way.includes(path)) return [...way.slice(way.indexOf(path)), path].join(' -> ');
    if (done.has(path)) return null;
    for (const next of graph.get(path) ?? []) {
      const circle = walk(next, [...way, path]);
      if (circle) return circle;
    }
    done.add(path);
    return null;
  };
  for (const path of graph.keys()) {
    const circle = walk(path, []);
    if (circle) return circle;
  }
  return null;
}

const folderOf = (path: string): string => (path.includes('/') ? path.slice(0, path.indexOf('/')) : '');

/** One sentence for each rule that the sources break. */
export function troublesOf(sources: Sources): string[] {
  const graph = graphOf(sources);
  const troubles: string[] = [];
  const circle = circleIn(graph);
  if (circle) troubles.push(`these imports go round in a circle: ${circle}`);
  const counts = new Map<string, number>();
  for (const [path, imports] of graph) {
    const from = folderOf(path);
    counts.set(from, (counts.get(from) ?? 0) + 1);
    if (from !== '' && !(from in ARROWS)) troubles.push(`${path}: the folder ${from} has no arrows in test/arrows.ts`);
    for (const other of imports) {
      const to = folderOf(other);
      if (from === '' || from === to || ARROWS[from]?.includes(to)) continue;
      troubles.push(`${path} imports ${other}: there is no arrow from ${from} to ${to || 'main.ts'}`);
    }
  }
  for (const [folder, count] of counts) {
    if (count > MOST_FILES_IN_A_FOLDER)
      troubles.push(`${folder} has ${count} files, at most ${MOST_FILES_IN_A_FOLDER} may be`);
  }
  return troubles;
}
