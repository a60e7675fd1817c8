/** What does not move, drawn once into a bitmap that is larger than the view. */

import { clamped } from "../figures.js";

const MARGIN = 0.35; // of the view, on each side
const MOST = 12e6; // pixels
const SETTLE = 140; // [ms] for which a bitmap of another scale stands in while zooming
const STRETCH = 1.6; // by which it may be enlarged meanwhile

export class Backdrop {
  bitmap = document.createElement("canvas");
  context = this.bitmap.getContext("2d", { alpha: false });
  made = null; // {k, ratio, left, top}: of the bitmap, in pixels from the world's origin
  since = null; // [ms] since when the scale is another one

  /** What it holds is no longer true. */
  spoil() {
    this.made = null;
  }

  /**
   * Copy the part in view.
   * @param {(context, bounds) => void} draw draws in metres what is within bounds
   * @returns {boolean} whether it has to be drawn again soon, at the proper scale
   */
  show(context, view, now, draw) {
    const settling = this.settling(view, now);
    if (!settling && !this.covers(view)) this.make(view, draw);
    const { k, left, top } = this.made;
    const grown = view.k / k;
    const [wide, high] = [view.width * view.ratio, view.height * view.ratio];
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.imageSmoothingEnabled = grown !== 1;
    if (grown === 1) context.drawImage(this.bitmap, -left - view.ox, -top - view.oy, wide, high, 0, 0, wide, high);
    else {
      context.fillStyle = this.ground;
      context.fillRect(0, 0, wide, high);
      const [x, y] = [left * grown + view.ox, top * grown + view.oy];
      context.drawImage(this.bitmap, x, y, this.bitmap.width * grown, this.bitmap.height * grown);
    }
    return settling;
  }

  settling(view, now) {
    if (!this.made || this.made.k === view.k || this.made.ratio !== view.ratio) {
      this.since = null;
      return false;
    }
    const grown = view.k / this.made.k;
    if (grown > STRETCH || grown < 1 / STRETCH) return false;
    if (this.scale !== view.k) this.since = now;
    this.scale = view.k;
    return now - this.since < SETTLE;
  }

  covers(view) {
    if (this.made?.k !== view.k || this.made.ratio !== view.ratio) return false;
    const [x, y] = [-view.ox - this.made.left, -view.oy - this.made.top];
    const [wide, high] = [view.width * view.ratio, view.height * view.ratio];
    return x >= 0 && y >= 0 && x + wide <= this.bitmap.width && y + high <= this.bitmap.height;
  }

  make(view, draw) {
    const [wide, high] = [Math.round(view.width * view.ratio), Math.round(view.height * view.ratio)];
    const room = Math.sqrt(MOST / Math.max(wide * high, 1)) - 1;
    const margin = clamped(room / 2, 0, MARGIN);
    const [mx, my] = [Math.round(wide * margin), Math.round(high * margin)];
    if (this.bitmap.width !== wide + 2 * mx || this.bitmap.height !== high + 2 * my) {
      this.bitmap.width = wide + 2 * mx;
      this.bitmap.height = high + 2 * my;
    }
    const [left, top, k] = [-view.ox - mx, -view.oy - my, view.k];
    this.made = { k, ratio: view.ratio, left, top };
    this.context.setTransform(1, 0, 0, 1, 0, 0);
    this.context.fillStyle = this.ground;
    this.context.fillRect(0, 0, this.bitmap.width, this.bitmap.height);
    this.context.setTransform(k, 0, 0, -k, -left, -top);
    draw(this.context, [left / k, -(top + this.bitmap.height) / k, (left + this.bitmap.width) / k, -top / k]);
  }
}
