// The photographs of a layout's stocks, as the server keeps them: there after a reload, and in every tab.

import { t } from '../i18n';
import { Photo, type PhotoScale } from './photo';
import { sentenceOf, type Answer } from '../tasks/transfer';

/** The types that the server takes; an image of another type or size is written anew. */
const TYPES = ['image/png', 'image/jpeg'];
const MOST_BYTES = 16 * 2 ** 20;
const MOST_PIXELS = 6000;

interface Listed extends PhotoScale {
  stock: string;
}

/** The editor, as photographs need it. */
export interface PhotoOwner {
  readonly layoutId: number;
  tell(topic: 'photo'): void;
  say(text: string): void;
  transfer(kind: 'photo', name: string, method: string, address: string, body?: Blob): Promise<Answer | null>;
}

export class Photos {
  private readonly of = new Map<string, Photo>();
  private reading: Promise<void> = Promise.resolve();
  /** Counts the changes: a picture that was painted before the last one is old. */
  count = 0;

  constructor(private readonly editor: PhotoOwner) {}

  get(stock: string): Photo | undefined {
    return this.of.get(stock);
  }
  get size(): number {
    return this.of.size;
  }
  [Symbol.iterator](): IterableIterator<Photo> {
    return this.of.values();
  }

  /** Forgets them all: another layout is going to be opened. */
  clear(): void {
    if (this.of.size > 0) this.changed();
    this.of.clear();
  }
  /**
   * Reads them from the server, which has others than before, or said so while this page did not hear it.
   *
   * @param stale the stock whose image is another one now, or all of them, or none
   */
  read(stale: { stock: string } | 'all' | 'none'): Promise<void> {
    const { layoutId } = this.editor;
    // They are read one after the other, so that the last word is the newest.
    this.reading = this.reading
      .then(() => this.readNow(layoutId, stale))
      .catch((error: unknown) => this.editor.say(String(error)));
    return this.reading;
  }
  private async readNow(layoutId: number, stale: { stock: string } | 'all' | 'none'): Promise<void> {
    const answer = await fetch(`/api/layouts/${layoutId}/photos`);
    if (!answer.ok) return;
    const { photos } = (await answer.json()) as { photos: Listed[] };
    const there = new Map<string, Photo>();
    for (const one of photos) {
      const known =
        stale === 'all' || (stale !== 'none' && stale.stock === one.stock) ? undefined : this.of.get(one.stock);
      const photo = known ?? (await this.fetched(layoutId, one.stock));
      if (!photo) continue;
      if (!photo.pulled) photo.scale = one; // the hand decides about a photograph that it holds
      there.set(one.stock, photo);
    }
    if (this.editor.layoutId !== layoutId) return;
    this.of.clear();
    for (const [stock, photo] of there) this.of.set(stock, photo);
    this.changed();
  }
  private async fetched(layoutId: number, stock: string): Promise<Photo | null> {
    const answer = await fetch(`/api/layouts/${layoutId}/photo?stock=${encodeURIComponent(stock)}`);
    if (!answer.ok) return null; // it was taken away meanwhile
    return new Photo(stock, await createImageBitmap(await answer.blob()));
  }

  /** Gives a stock a photograph, which at first lies over all of it. */
  async add(stock: string, box: Parameters<Photo['cover']>[0], file: Blob): Promise<void> {
    const image = await createImageBitmap(file);
    const photo = new Photo(stock, image).cover(box);
    const taken = TYPES.includes(file.type) && file.size <= MOST_BYTES;
    // The scale counts pixels of the image that is sent, which may be smaller.
    const sent = taken ? { body: file, shrunk: 1 } : await rewritten(image);
    const { pixels, mm } = photo.scale;
    const scale = { pixels: pixels.map((v) => v * sent.shrunk) as PhotoScale['pixels'], mm };
    await this.said(this.editor.transfer('photo', t('transfer.photo'), 'PUT', this.address(stock, scale), sent.body));
  }
  /** Keeps the place where a photograph lies now. */
  keep(photo: Photo): Promise<void> {
    this.changed();
    return this.said(
      this.editor.transfer('photo', t('transfer.photo'), 'PATCH', this.address(photo.stock, photo.scale)),
    );
  }
  remove(stock: string): Promise<void> {
    return this.said(this.editor.transfer('photo', t('transfer.photo'), 'DELETE', this.address(stock)));
  }
  changed(): void {
    this.count += 1;
    this.editor.tell('photo');
  }

  private address(stock: string, scale?: PhotoScale): string {
    const fields = new URLSearchParams({
      stock,
      ...(scale ? { pixels: scale.pixels.join(), mm: scale.mm.join() } : {}),
    });
    return `/api/layouts/${this.editor.layoutId}/photo?${fields}`;
  }
  /**
   * Waits for the answer. The server itself tells every page what has changed; where it refuses, all is read as it is.
   */
  private async said(answer: Promise<Answer | null>): Promise<void> {
    try {
      const said = await answer;
      if (said && said.status === 200) return;
      if (said) this.editor.say(await sentenceOf(said));
    } catch (error) {
      this.editor.say(error instanceof Error ? error.message : String(error));
    }
    await this.read('none');
  }
}

async function rewritten(image: ImageBitmap): Promise<{ body: Blob; shrunk: number }> {
  const shrunk = Math.min(1, MOST_PIXELS / Math.max(image.width, image.height));
  const canvas = new OffscreenCanvas(Math.round(image.width * shrunk), Math.round(image.height * shrunk));
  canvas.getContext('2d')!.drawImage(image, 0, 0, canvas.width, canvas.height);
  return { body: await canvas.convertToBlob({ type: 'image/jpeg', quality: 0.92 }), shrunk };
}
