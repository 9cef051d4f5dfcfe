// Pictures are compared as a person at arm's length would compare them: averaged over cells of 10 pixels, so that another font
// or another rasteriser does not matter and a part that is missing, moved or of another colour does.

import assert from 'node:assert/strict';
import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';

const folder = new URL('./pictures/', import.meta.url).pathname;
/** LEKALO_PICTURES=FOLDER keeps every picture, whole and as a reference. */
const kept = process.env.LEKALO_PICTURES;
const CELL = 10;
/** A cell may be off by so much of 255, and this share of cells by more. */
const OFF = 28;
const SHARE = 0.004;

/** The drawing, and nothing around it, averaged: a PNG of a pixel a cell. */
async function coarse(page) {
  const shot = await page.locator('.picture').screenshot();
  const url = await page.evaluate(
    async ({ png, cell }) => {
      const image = await createImageBitmap(new Blob([Uint8Array.from(atob(png), (c) => c.charCodeAt(0))]));
      const canvas = new OffscreenCanvas(Math.ceil(image.width / cell), Math.ceil(image.height / cell));
      const context = canvas.getContext('2d');
      context.imageSmoothingQuality = 'high';
      context.drawImage(image, 0, 0, canvas.width, canvas.height);
      const blob = new Uint8Array(await (await canvas.convertToBlob()).arrayBuffer());
      return btoa(String.fromCharCode(...blob));
    },
    { png: shot.toString('base64'), cell: CELL },
  );
  return { shot, small: Buffer.from(url, 'base64') };
}

/** The share of pixels of two PNGs that differ by more than OFF in some colour. */
function differing(page, a, b) {
  return page.evaluate(
    async ({ pngs, off }) => {
      const [p, q] = await Promise.all(
        pngs.map(async (png) => {
          const image = await createImageBitmap(new Blob([Uint8Array.from(atob(png), (c) => c.charCodeAt(0))]));
          const canvas = new OffscreenCanvas(image.width, image.height);
          const context = canvas.getContext('2d');
          context.drawImage(image, 0, 0);
          return context.getImageData(0, 0, image.width, image.height);
        }),
      );
      if (p.width !== q.width || p.height !== q.height) return 1;
      let count = 0;
      for (let i = 0; i < p.data.length; i += 4) {
        if ([0, 1, 2].some((k) => Math.abs(p.data[i + k] - q.data[i + k]) > off)) ++count;
      }
      return (4 * count) / p.data.length;
    },
    { pngs: [a.toString('base64'), b.toString('base64')], off: OFF },
  );
}

/** @returns how much differs from the picture of that name, as a share of its cells */
export async function differenceFrom(page, name, keep) {
  const { shot, small } = await coarse(page);
  if (kept && keep) {
    mkdirSync(kept, { recursive: true });
    writeFileSync(`${kept}/${name}.png`, shot);
    writeFileSync(`${kept}/${name}.small.png`, small);
  }
  const reference = `${folder}${name}.png`;
  assert.ok(
    existsSync(reference),
    `${reference} is missing: run with LEKALO_PICTURES=FOLDER, look at ${name}.png there, and copy ${name}.small.png to it`,
  );
  return differing(page, small, readFileSync(reference));
}

export async function comparePicture(page, name) {
  const share = await differenceFrom(page, name, true);
  assert.ok(
    share <= SHARE,
    `picture "${name}": ${(100 * share).toFixed(2)} % of its cells differ, ${100 * SHARE} % may`,
  );
}
/** Shows that the comparison sees a change: a comparison that cannot fail would say nothing. */
export async function assertPictureDiffers(page, name) {
  const share = await differenceFrom(page, name, false);
  assert.ok(
    share > 3 * SHARE,
    `picture "${name}": only ${(100 * share).toFixed(2)} % of its cells differ after a visible change`,
  );
}
