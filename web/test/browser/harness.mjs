// The real `lekalo serve` on a free port with a store of its own, and Debian's Chromium on its page. Nothing goes
// beyond this machine. LEKALO names the program, CHROMIUM the browser; LEKALO_PAGE a folder (`npm run build`: dist)
// whose files stand for those in the program, for work on the page alone.

import { spawn, spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { createInterface } from 'node:readline';
import { chromium } from 'playwright-core';

export const root = new URL('../../../', import.meta.url).pathname;
export const lekalo = process.env.LEKALO ?? join(root, 'build/release/lekalo');
const pageFolder = process.env.LEKALO_PAGE;
const browserPath = process.env.CHROMIUM ?? '/usr/bin/chromium';

/** Runs lekalo to its end. */
export function run(...args) {
  const done = spawnSync(lekalo, args, { encoding: 'utf8' });
  if (done.error) throw done.error;
  return done;
}

/** `lekalo serve` on a file or a document; `folder` is its own and goes with it. */
export async function serve(layout) {
  const folder = mkdtempSync(join(tmpdir(), 'lekalo-browser-'));
  const file = typeof layout === 'string' ? layout : join(folder, 'layout.json');
  if (typeof layout !== 'string') writeFileSync(file, JSON.stringify(layout));
  let child;
  let ended;
  const server = {
    folder,
    url: '',
    page: '',
    /** Starts it, the second time on the same store and port. */
    async start() {
      const port = server.url ? new URL(server.url).port : '0';
      child = spawn(lekalo, ['serve', file, '--store', join(folder, 'store.sqlite'), '--port', port], {
        stdio: ['ignore', 'pipe', 'pipe'],
      });
      let complaints = '';
      child.stderr.on('data', (text) => (complaints += text));
      ended = new Promise((resolve) => child.once('exit', resolve));
      const lines = createInterface({ input: child.stdout })[Symbol.asyncIterator]();
      const said = async (word) => {
        const { value } = await lines.next();
        if (!value?.startsWith(`${word} `)) throw new Error(`lekalo serve said "${value}"; ${complaints}`);
        return value.slice(word.length + 1);
      };
      server.url = await said('listening');
      server.page = await said('layout');
    },
    /** Kills it as it may happen at any time: every acknowledged change is on the disk. */
    async kill() {
      child.kill('SIGKILL');
      await ended;
    },
    async stop() {
      await server.kill();
      rmSync(folder, { recursive: true, force: true });
    },
  };
  await server.start();
  return server;
}

export async function startBrowser(more = []) {
  if (!existsSync(browserPath))
    throw new Error(`${browserPath} is not there: run tools/setup.sh, or name a Chromium in CHROMIUM.`);
  return chromium.launch({
    executablePath: browserPath,
    args: [
      '--no-sandbox',
      '--disable-gpu',
      '--disable-backgrounding-occluded-windows',
      '--disable-renderer-backgrounding',
      '--disable-features=LocalNetworkAccessChecks',
      '--force-color-profile=srgb',
      '--font-render-hinting=none',
      ...more,
    ],
  });
}

/** A tab; what its page complains about is kept in `problems`. */
export async function newTab(browser, options = {}) {
  const context = await browser.newContext({
    viewport: { width: 1440, height: 860 },
    locale: 'en-GB',
    colorScheme: 'light',
    acceptDownloads: true,
    ...options,
  });
  if (pageFolder) {
    await context.route(
      (url) => existsSync(join(pageFolder, url.pathname)),
      (route) => {
        const { pathname } = new URL(route.request().url());
        return route.fulfill({ path: join(pageFolder, pathname === '/' ? 'index.html' : pathname) });
      },
    );
  }
  return tabOf(context);
}
export async function tabOf(context) {
  const page = await context.newPage();
  page.problems = [];
  page.on('pageerror', (error) => page.problems.push(error.message));
  page.on('console', (line) => {
    if (line.type() === 'error') page.problems.push(line.text());
  });
  return page;
}
/** The editor in a tab. */
export async function open(page, url) {
  await page.goto(url);
  await ready(page);
}
export const ready = (page) => page.waitForSelector('.tray li');
