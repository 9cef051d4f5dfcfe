// The signs of the buttons are drawn, as no font has all of them: 20 x 20, strokes in the colour of the text.

const PATHS: Record<string, string> = {
  'open.file': 'M3 16V4h5l2 2h7v10zM10 9v5M7.5 11.5h5',
  job: 'M3 4h4v4H3zM3 12h4v4H3zM10 5h7M10 7.500h4M10 13h7M10 15.500h4',
  'copy.layout': 'M7 7h9v10H7zM4 13V3h9',
  undo: 'M8 4 4 8l4 4M4 8h7a5 5 0 0 1 0 9H8',
  'name.layout': 'M4 16h3L16 7l-3-3-9 9zM11 6l3 3',
  redo: 'm12 4 4 4-4 4M16 8H9a5 5 0 0 0 0 9h3',
  'tool.select': 'M5 3v13l3.5-3.5 2 4.5 2-1-2-4.200h4.500z',
  'tool.slide': 'M3 10h10M9.500 6l4 4-4 4M17 3v14',
  'tool.push': 'M2 10h5M5 7.500 7.500 10 5 12.500M9 5h4v10H9zM14.500 10H18M16 8l2 2-2 2',
  'tool.nearest': 'M10 2v4M10 14v4M2 10h4M14 10h4M10 6a4 4 0 1 0 .01 0M10 9.500v1',
  'tool.measure': 'M2 13 13 2l5 5L7 18zM6 9l2 2M9 6l2 2M12 3l2 2',
  'tool.pan': 'M10 2v16M2 10h16M8 4l2-2 2 2M8 16l2 2 2-2M4 8l-2 2 2 2M16 8l2 2-2 2',
  'tool.defect': 'M4 14c-2-5 2-10 7-10s7 5 5 9-4 2-6 3-5 1-6-2zM7 12l5-5M10 13l4-4',
  'tool.zone': 'M3 6h14v9H3zM3 10h3M9 10h3M15 10h2',
  'tool.photo': 'M3 5h14v11H3zM3 13l4-4 4 4 2-2 4 3M13.500 8.200h.01',
  'rotate.left': 'M4 4v4h4M4.500 8a6.500 6.500 0 1 1-.5 4',
  'rotate.right': 'M16 4v4h-4M15.500 8a6.500 6.500 0 1 0 .5 4',
  flip: 'M10 2v16M8 5 3 15h5zM12 5l5 10h-5z',
  'slide.left': 'M3 3v14M17 10H6M10 6l-4 4 4 4',
  'slide.right': 'M17 3v14M3 10h11M10 6l4 4-4 4',
  'slide.up': 'M3 3h14M10 17V6M6 10l4-4 4 4',
  'slide.down': 'M3 17h14M10 3v11M6 10l4 4 4-4',
  settle: 'M3 3v14h14M16 4 7 13M7 8v5h5',
  snap: 'M6 3v14M10 5h7v10h-7M10 5v10',
  nest: 'M3 3h14v14H3zM3 9l5-6M8 3l4 8h5M12 11l-3 6M3 12h5l1 5',
  compact: 'M3 3v14M7 4h4v5H7zM7 11h7v5H7zM18 10h-5M15 8l-2 2 2 2',
  lock: 'M5 9h10v8H5zM7 9V6.500a3 3 0 0 1 6 0V9',
  swap: 'M3 7h13M13 4l3 3-3 3M17 13H4M7 10l-3 3 3 3',
  copy: 'M7 7h10v10H7zM13 7V3H3v10h4',
  remove: 'M4 6h12M8 6V3.500h4V6M5.500 6l1 11h7l1-11',
  fit: 'M3 7V3h4M13 3h4v4M17 13v4h-4M7 17H3v-4',
  print: 'M5 8V3h10v5M5 14H3V8h14v6h-2M5 12h10v5H5z',
  theme: 'M10 3a7 7 0 1 0 .01 0M10 3v14M10 6h4M10 10h7M10 14h4',
  help: 'M7 7.500a3 3 0 1 1 4.500 2.600c-1 .6-1.500 1.200-1.500 2.400M10 15.500v.6',
};

export function icon(name: string): SVGSVGElement {
  const ns = 'http://www.w3.org/2000/svg';
  const svg = document.createElementNS(ns, 'svg');
  svg.setAttribute('viewBox', '0 0 20 20');
  svg.setAttribute('aria-hidden', 'true');
  const path = document.createElementNS(ns, 'path');
  path.setAttribute('d', PATHS[name] ?? '');
  svg.append(path);
  return svg;
}
