// A small picture of an outline with its holes.

type Loop = readonly (readonly [number, number])[];

/** @param colour none: the one of style.css */
export function thumbnail(outline: { outer: Loop; holes?: readonly Loop[] }, colour = ''): SVGSVGElement {
  const ns = 'http://www.w3.org/2000/svg';
  const svg = document.createElementNS(ns, 'svg');
  const { outer, holes = [] } = outline;
  let [left, bottom, right, top] = [Infinity, Infinity, -Infinity, -Infinity];
  for (const [x, y] of outer) {
    [left, right] = [Math.min(left, x), Math.max(right, x)];
    [bottom, top] = [Math.min(bottom, y), Math.max(top, y)];
  }
  const size = Math.max(right - left, top - bottom);
  const m = size * 0.06;
  svg.setAttribute(
    'viewBox',
    `${(left + right - size) / 2 - m} ${-(top + bottom + size) / 2 - m} ${size + 2 * m} ${size + 2 * m}`,
  );
  svg.setAttribute('class', 'thumbnail');
  svg.setAttribute('aria-hidden', 'true');
  const path = document.createElementNS(ns, 'path');
  path.setAttribute('d', [outer, ...holes].map((l) => `M${l.map(([x, y]) => `${x} ${-y}`).join('L')}Z`).join(''));
  if (colour) path.setAttribute('fill', colour);
  path.setAttribute('fill-rule', 'evenodd');
  path.setAttribute('stroke', 'currentColor');
  path.setAttribute('stroke-width', String(size * 0.012));
  svg.append(path);
  return svg;
}
