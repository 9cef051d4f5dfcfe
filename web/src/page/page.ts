// The page: its parts, and which of them is shown anew when something changes.

import { helpDialog } from '../dialogs/help_dialog';
import { Editor, type Topic } from '../editor/editor';
import { h, showDialog } from '../html/elements';
import { currentLanguage, setLanguage, t, type Language } from '../i18n';
import { loadWasmKernel } from '../kernel/wasm_kernel';
import { showSidePanel, type Side } from '../panels/sides';
import { tray } from '../panels/tray';
import { printed } from '../picture/print';
import { DARK, LIGHT, type Theme } from '../picture/scene';
import { ServerKernel } from '../server/server_kernel';
import { photoBeneath } from '../tools/features';
import { dragFromTray } from '../tools/from_tray';
import { SHORTCUTS } from '../tools/keys';
import { showBar, showWords } from './bar';
import { offerBenchmark } from './benchmark';
import { chooseAndSave, saveAs } from './exports';
import { listenToKeys } from './keyboard';
import { Layouts } from './layouts';
import { LongBar } from './long_bar';
import { PicturePane } from './picture_pane';
import { store, stored } from './settings';
import { StatusLine } from './status_line';
import { welcome } from './welcome';

const firstTheme = (): Theme =>
  (stored('theme') ?? (matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light')) === 'dark'
    ? DARK
    : LIGHT;

export class Page {
  private readonly editor: Editor = new Editor(new ServerKernel(() => this.editor.client));
  private readonly bar = h('header', { class: 'bar' });
  private readonly tools = h('nav', { class: 'tools' });
  private readonly left = h('aside', { class: 'left' });
  private readonly right = h('aside', { class: 'right' });
  private readonly paper = h('div', { class: 'paper' });
  private readonly pane: PicturePane = new PicturePane(
    this.editor,
    () => this.theme,
    () => this.status.show(),
  );
  private readonly status = new StatusLine(this.editor, this.pane.pointer.overlay);
  private readonly longBar = new LongBar(this.editor, () => this.pane.focus());
  private readonly layouts = new Layouts(this.editor, {
    listed: () => this.showBar(),
    opening: () => {
      this.welcome.remove();
      this.pane.begin();
      this.showBar();
      this.changed('layout');
    },
    left: () => this.pane.focus(),
    resized: () => this.pane.fitAll(),
    empty: () => this.showWelcome(),
  });
  /** The width below which style.css puts the panels beneath the picture. */
  private readonly narrow = matchMedia('(max-width: 860px)');
  private welcome: HTMLElement = h('section');
  private theme = firstTheme();
  private side: Side = 'violations';
  private panelsDue = false;

  constructor(into: HTMLElement) {
    const { element } = this.pane;
    setLanguage((stored('language') ?? (navigator.language.startsWith('uk') ? 'uk' : 'en')) as Language);
    into.append(this.bar, this.left, this.tools, element, this.longBar.element, this.right, this.status.element);
    document.body.append(this.paper);
    this.editor.on((topic) => this.changed(topic));
    element.addEventListener('pointermove', (e) => this.status.showPlace(this.pane.worldAt(e)));
    listenToKeys(this.editor, this.pane, { find: () => this.find(), help: () => this.showHelp() });
    this.listenToDrops();
    this.narrow.addEventListener('change', () => this.showBar());
    window.addEventListener('resize', () => showWords(this.bar));
    window.addEventListener('beforeunload', (e) => {
      if (this.editor.isAtWork) e.preventDefault();
    });
    window.addEventListener('beforeprint', () => this.paper.replaceChildren(...printed(this.editor)));
    window.addEventListener('afterprint', () => this.paper.replaceChildren());
    offerBenchmark(this.pane.bench);
  }

  async start(): Promise<void> {
    this.showAll();
    try {
      this.editor.kernel = (await loadWasmKernel()) ?? this.editor.kernel;
    } catch (error) {
      this.editor.say(error instanceof Error ? error.message : String(error));
    }
    await this.layouts.openFirst();
  }

  /** Shows anew what a change of the editor's state concerns. */
  private changed(topic: Topic): void {
    const { editor, pane } = this;
    if (topic === 'layout' && !editor.loading) {
      pane.take();
      this.layouts.changed();
    }
    const { dataset } = pane.element;
    const wasMoving = dataset.moving === 'true';
    const isMoving = editor.moving.size > 0;
    dataset.moving = String(isMoving);
    dataset.level = editor.live?.level ?? '';
    dataset.loading = editor.loading ? t('loading') : '';
    if (topic === 'long' || topic === 'check' || topic === 'transfer' || topic === 'layout') this.longBar.show();
    if (topic === 'check' || topic === 'transfer') return;
    if (topic === 'long' || (topic === 'moving' && wasMoving === isMoving)) pane.later('top');
    else if (topic !== 'message' && topic !== 'connection') pane.later('all');
    if (topic === 'mode' || (topic === 'photo' && this.offersPhotoTool())) this.showBar();
    if (topic === 'layout' || topic === 'selection' || (topic === 'photo' && this.listsPhotosAtRest())) {
      this.showPanelsLater(topic);
    }
    this.status.show();
  }
  /** Says whether the tool that pulls photographs is to come or to go. */
  private offersPhotoTool(): boolean {
    return this.editor.photos.size > 0 !== (this.tools.querySelector('[data-action="tool.photo"]') !== null);
  }
  private listsPhotosAtRest(): boolean {
    return this.side === 'sheets' && ![...this.editor.photos].some((photo) => photo.pulled);
  }
  private showPanelsLater(topic: Topic): void {
    if (this.panelsDue) return;
    this.panelsDue = true;
    setTimeout(() => {
      this.panelsDue = false;
      if (topic === 'layout') this.showTray();
      this.showSide();
    });
  }

  private showAll(): void {
    document.documentElement.dataset.theme = this.theme === DARK ? 'dark' : 'light';
    this.pane.showWords();
    this.showBar();
    this.longBar.show();
    this.pane.later('all');
    requestAnimationFrame(() => {
      this.showTray();
      this.showSide();
    });
    this.status.show();
    if (this.welcome.isConnected) this.showWelcome();
  }
  private showBar(): void {
    const { editor, layouts, pane } = this;
    const shown = { layouts: layouts.known, folded: this.narrow.matches };
    showBar(this.bar, this.tools, editor, shown, {
      openLayout: (id) => layouts.open(id),
      takeFiles: (files) => void layouts.takeFiles(files),
      newLayout: () => layouts.begin([]),
      job: () => layouts.editJob(),
      copyLayout: () => void layouts.copy(),
      nameLayout: () => layouts.name(),
      save: (form) => void saveAs(editor, form),
      choose: (form) => chooseAndSave(editor, form),
      print: () => window.print(),
      fit: () => pane.fitAll(),
      photo: (file) => void photoBeneath(editor, pane.view, file).catch((error: unknown) => editor.say(String(error))),
      theme: () => this.changeTheme(),
      language: () => this.changeLanguage(),
      help: () => this.showHelp(),
    });
  }
  private showWelcome(): void {
    const isThere = this.welcome.isConnected;
    this.welcome.remove();
    this.welcome = welcome({
      begin: () => this.layouts.begin([]),
      open: () => this.bar.querySelector<HTMLInputElement>('input[type="file"]')?.click(),
      // How a sample was read tells nothing to who tries it, but why it was not does.
      sample: (file) =>
        void this.layouts.takeFiles([file]).then(() => this.editor.message.isNote && this.editor.note('')),
    });
    this.pane.element.append(this.welcome);
    if (!isThere) this.welcome.querySelector('button')?.focus();
  }
  private showTray(): void {
    const { editor, pane } = this;
    const parts = tray(
      editor,
      (part) => pane.drawing.colour(part, this.theme),
      (button, part, mirrored) => dragFromTray(button, pane.element, editor, pane.view, part, mirrored),
    );
    const job = h(
      'button',
      { class: 'small', 'data-action': 'tray.job', click: () => this.layouts.editJob() },
      t('job'),
    );
    job.disabled = editor.layoutId === 0;
    this.left.replaceChildren(h('h2', {}, t('tray')), job, parts);
  }
  private showSide(): void {
    const { editor, pane, right } = this;
    const word = right.querySelector('input')?.value ?? '';
    showSidePanel(right, editor, this.side, word, {
      choose: (side) => {
        this.side = side;
        this.showSide();
      },
      violation: (v) => pane.reveal(v),
      part: (id) => {
        editor.select([id]);
        pane.revealPart(id);
      },
      sheet: (sheet) => pane.showSheet(sheet),
    });
  }

  private changeTheme(): void {
    this.theme = this.theme === DARK ? LIGHT : DARK;
    store('theme', this.theme === DARK ? 'dark' : 'light');
    this.showAll();
  }
  private changeLanguage(): void {
    setLanguage(currentLanguage() === 'en' ? 'uk' : 'en');
    store('language', currentLanguage());
    this.showAll();
  }
  private find(): void {
    this.side = 'parts';
    this.showSide();
    this.right.querySelector('input')?.focus();
  }
  private showHelp(): void {
    showDialog(helpDialog(SHORTCUTS));
  }

  /** Files may be dropped anywhere. */
  private listenToDrops(): void {
    for (const type of ['dragover', 'dragleave', 'drop'] as const) {
      document.addEventListener(type, (e) => {
        e.preventDefault();
        this.pane.element.classList.toggle('dropping', type === 'dragover');
        if (type === 'drop') void this.layouts.takeFiles(e.dataTransfer?.files ?? null);
      });
    }
  }
}
