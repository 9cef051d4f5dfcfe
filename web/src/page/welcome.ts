// An empty page says how a layout is begun, and offers three that can be tried.

import coats from '../../../examples/orders/coats.json?raw';
import frames from '../../../examples/orders/frames.json?raw';
import shoes from '../../../examples/layouts/shoes.json?raw';
import { h } from '../html/elements';
import { t, type Key } from '../i18n';

const SAMPLES: readonly [Key, string][] = [
  ['sample.frames', frames],
  ['sample.coats', coats],
  ['sample.shoes', shoes],
];

export interface WelcomeEvents {
  begin(): void;
  open(): void;
  sample(file: File): void;
}

const mine = (e: Event): void => e.stopPropagation();

export function welcome(events: WelcomeEvents): HTMLElement {
  const big = (action: Key, run: () => void): HTMLButtonElement =>
    h('button', { 'data-action': action, click: run }, t(action));
  return h(
    'section',
    // The picture beneath listens to the same gestures.
    { class: 'welcome', 'aria-label': t('welcome.title'), pointerdown: mine, keydown: mine, wheel: mine },
    h('h1', {}, t('welcome.title')),
    h('p', {}, t('welcome.what')),
    h('div', { class: 'buttons' }, big('new.layout', events.begin), big('open.file', events.open)),
    h('h2', {}, t('welcome.samples')),
    h(
      'div',
      { class: 'buttons' },
      ...SAMPLES.map(([key, json]) =>
        big(key, () => events.sample(new File([json], t(key), { type: 'application/json' }))),
      ),
    ),
  );
}
