/**
 * The canvas, and how many pixels of the screen it has to one of CSS.
 *
 * On a dense screen and a slow machine all of them would be drawn too seldom: while the picture
 * moves there are fewer then, and all again once it rests.
 */

const PARTS = [1, 0.75, 0.5]; // of the screen's density, one after the other
const SLOW = 27; // frames a second below which there are fewer pixels
const TRIAL = 2500; // [ms] for which each is tried
const REST = 400; // [ms] without motion after which it rests

export class Surface {
  part = 0;
  since = 0; // [ms] since when there are so many
  resting = 0; // a timer

  /**
   * @param view see view.js @param {HTMLCanvasElement} canvas
   * @param {() => void} denser is called when it rests, and may have all its pixels
   */
  constructor(view, canvas, denser) {
    Object.assign(this, { view, canvas, denser, context: canvas.getContext("2d", { alpha: false }) });
  }

  /** Take on the size of an element; true: it is another one, and the canvas is empty. */
  fit({ clientWidth, clientHeight }) {
    const screen = window.devicePixelRatio || 1;
    const ratio = screen > 1 ? Math.max(screen * PARTS[this.part], 1) : screen;
    if (!clientWidth || !clientHeight || !this.view.resize(clientWidth, clientHeight, ratio)) return false;
    this.canvas.width = Math.round(clientWidth * ratio);
    this.canvas.height = Math.round(clientHeight * ratio);
    return true;
  }

  /**
   * A frame was drawn.
   * @param {boolean} moving whether another one follows by itself
   * @param {() => number} rate frames a second of late
   * @returns {boolean} whether the canvas is to have fewer pixels from now on: see `fit`
   */
  drawn(moving, rate, now) {
    clearTimeout(this.resting);
    if (!moving) {
      if (this.part > 0) this.resting = setTimeout(() => this.rest(), REST);
      this.since = now;
      return false;
    }
    const fewer = this.view.ratio > 1 && this.part < PARTS.length - 1;
    if (!fewer || now - this.since < TRIAL || rate() >= SLOW) return false;
    this.part += 1;
    this.since = now;
    return true;
  }

  rest() {
    this.part = 0;
    this.denser();
  }
}
