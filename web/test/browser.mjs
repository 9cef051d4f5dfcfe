// The built page (dist) in Debian's Chromium against the stand-in.

import { readFileSync } from 'node:fs';
import { extname, join } from 'node:path';
import { chromium } from 'playwright-core';

const dist = new URL('../dist/', import.meta.url).pathname;
const types = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.wasm': 'application/wasm' };

export async function openPage(double, options = {}) {
  const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: ['--no-sandbox', '--disable-gpu'] });
  const page = await browser.newPage({ viewport: { width: 1440, height: 860 }, ...options });
  page.on('pageerror', (error) => console.error('page:', error.message));
  await page.route('http://editor.test/**', (route) => {
    const { pathname } = new URL(route.request().url());
    if (pathname === '/api/layouts') return route.fulfill({ json: { layouts: [{ id: 1, name: double.document.name, revision: 1, placements: 0, changed: '' }] } });
    if (pathname.endsWith('/history')) return route.fulfill({ json: { entries: [] } });
    try {
      const path = pathname === '/' ? 'index.html' : pathname.slice(1);
      return route.fulfill({ body: readFileSync(join(dist, path)), contentType: types[extname(path)] ?? 'application/octet-stream' });
    } catch {
      return route.fulfill({ status: 404, json: { error: 'not found' } });
    }
  });
  await page.routeWebSocket(/\/ws/, (socket) => {
    socket.onMessage((text) => {
      for (const m of double.answer(text)) socket.send(JSON.stringify(m));
    });
    socket.send(JSON.stringify(double.hello()));
  });
  await page.goto('http://editor.test/');
  await page.waitForSelector('.tray li');
  await page.waitForTimeout(150);
  return { browser, page };
}
