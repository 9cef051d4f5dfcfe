import { describe, expect, it } from 'vitest';
import { Photo, type PhotoScale } from '../src/editor/photo';

const image = { width: 400, height: 300 } as ImageBitmap;
/** The place of a pixel. */
const at = ({ a, b, x, y }: Photo, u: number, v: number): [number, number] => [x + a * u + b * v, y + b * u - a * v];
const near = (p: readonly number[], q: readonly number[]) => p.forEach((v, i) => expect(v).toBeCloseTo(q[i]!, 9));

describe('a photograph', () => {
  it('covers a sheet from its upper left corner', () => {
    const photo = new Photo('s', image).cover({ left: 10, bottom: 0, right: 210, top: 400 });
    near(at(photo, 0, 0), [10, 400]);
    near(at(photo, 400, 300), [210, 250]);
  });
  it('lies where two of its points are said to lie, and says two that lay it there again', () => {
    const said: PhotoScale = { pixels: [100, 50, 300, 250], mm: [20, 30, -40, 90] };
    const photo = new Photo('s', image);
    photo.scale = said;
    near(at(photo, 100, 50), [20, 30]);
    near(at(photo, 300, 250), [-40, 90]);
    const again = new Photo('s', image);
    again.scale = photo.scale;
    near(at(again, 123, 45), at(photo, 123, 45));
  });
  it('is moved by the first pull, turned and scaled about that point by the next, moved again when unpinned', () => {
    const photo = new Photo('s', image).cover({ left: 0, bottom: 0, right: 400, top: 300 });
    const under = ([x, y]: [number, number]): [number, number] => {
      const d = photo.a ** 2 + photo.b ** 2;
      const [dx, dy] = [x - photo.x, y - photo.y];
      return [(photo.a * dx + photo.b * dy) / d, (photo.b * dx - photo.a * dy) / d];
    };
    const first = under([50, 60]);
    photo.pull([50, 60], [70, 80]);
    expect(photo.pulled).toBe(true);
    expect(photo.pin()).toBe(true);
    near(at(photo, ...first), [70, 80]);
    const second = under([170, 80]);
    photo.pull([170, 80], [100, 100]); // on the way
    photo.pull([170, 80], [70, 280]); // a quarter turn, twice as large
    photo.pin();
    near(at(photo, ...first), [70, 80]);
    near(at(photo, ...second), [70, 280]);
    photo.unpin();
    photo.pull([0, 0], [5, 6]);
    photo.pin();
    near(at(photo, ...first), [75, 86]);
    expect(photo.pin()).toBe(false);
  });
});
