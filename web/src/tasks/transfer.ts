// A request that may take a while. It tells how far it is, and can be given up.

import { TimeLeft } from './time_left';

export interface Answer {
  status: number;
  body: Blob;
  header(name: string): string | null;
}

export class Transfer {
  /** The share that is sent; null: all of it, and the server at work does not say how far it is. */
  fraction: number | null = null;
  secondsLeft: number | null = null;
  private readonly request = new XMLHttpRequest();
  private readonly begun = performance.now();

  constructor(
    readonly kind: 'open' | 'export' | 'photo',
    readonly name: string,
    private readonly changed: () => void,
  ) {}

  /** Whole seconds since it began. */
  get since(): number {
    return Math.floor((performance.now() - this.begun) / 1000);
  }
  /**
   * Sends the request. Throws where there is no answer.
   *
   * @returns null: it was given up
   */
  send(method: string, address: string, body?: Blob | FormData): Promise<Answer | null> {
    const { request } = this;
    const time = new TimeLeft();
    request.open(method, address);
    request.responseType = 'blob';
    request.upload.onprogress = (e) => {
      if (e.lengthComputable && e.total > 0 && e.loaded < e.total) {
        this.fraction = e.loaded / e.total;
        time.take(performance.now() / 1000, this.fraction);
        this.secondsLeft = time.seconds;
      } else [this.fraction, this.secondsLeft] = [null, null];
      this.changed();
    };
    const clock = setInterval(this.changed, 1000);
    return new Promise<Answer | null>((resolve, reject) => {
      request.onload = () =>
        resolve({
          status: request.status,
          body: request.response as Blob,
          header: (name) => request.getResponseHeader(name),
        });
      request.onabort = () => resolve(null);
      request.onerror = () => reject(new Error(`${method} ${address}`));
      request.send(body);
    }).finally(() => clearInterval(clock));
  }
  abort(): void {
    this.request.abort();
  }
}

/** The server's sentence against a request, or the number of its answer. */
export async function sentenceOf(answer: Answer): Promise<string> {
  try {
    return (JSON.parse(await answer.body.text()) as { error?: string }).error ?? String(answer.status);
  } catch {
    return String(answer.status);
  }
}
