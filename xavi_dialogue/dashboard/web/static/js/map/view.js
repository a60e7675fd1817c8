/** Which part of the world the map shows: centre [m], scale [px/m], and how it gets there. */

import { clamped } from "../figures.js";

const LEAST = 0.15; // [px/m]
const MOST = 40; // [px/m]
const FAR = 1e7; // [m] from the origin that the centre may be
const GLIDE = 220; // [ms] of a change that buttons or keys make
const ACROSS = 110; // [m] that the shorter side shows at first

export class View {
  width = 0; // [px] as CSS counts them
  height = 0;
  ratio = 1; // pixels of the screen to one of CSS
  scale = 5; // [px/m]
  glide = null; // a change under way: {from, to, since, lasts}
  still = matchMedia("(prefers-reduced-motion: reduce)");
  #x = 0;
  #y = 0;

  /** Take on the size of the canvas; true where it is another one. */
  resize(width, height, ratio) {
    if (width === this.width && height === this.height && ratio === this.ratio) return false;
    Object.assign(this, { width, height, ratio });
    return true;
  }

  /** [m] The centre, to the east; whatever is said, the view stays where numbers are fine enough. */
  get x() {
    return this.#x;
  }

  set x(value) {
    this.#x = onEarth(value, this.#x);
  }

  /** [m] The centre, to the north. */
  get y() {
    return this.#y;
  }

  set y(value) {
    this.#y = onEarth(value, this.#y);
  }

  /** [px/m] Good for a first look at the traffic around us. */
  get usual() {
    return clamped(Math.min(this.width, this.height) / ACROSS, 2.5, 8);
  }

  /** Pixels of the screen to a metre. */
  get k() {
    return this.scale * this.ratio;
  }

  // Whole pixels, so that what is copied from a bitmap and what is drawn anew fit each other.
  get ox() {
    return Math.round((this.width * this.ratio) / 2 - this.x * this.k);
  }

  get oy() {
    return Math.round((this.height * this.ratio) / 2 + this.y * this.k);
  }

  /** Let a context draw in metres, y to the north. */
  world(context) {
    context.setTransform(this.k, 0, 0, -this.k, this.ox, this.oy);
  }

  /** Let a context draw in pixels of CSS. */
  screen(context) {
    context.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
  }

  /** Let a context draw at a place of the canvas, x along a heading and y to its right, in units of `size` [px]. */
  place(context, [px, py], heading = 0, size = 1) {
    const unit = size * this.ratio;
    const [c, s] = [Math.cos(heading) * unit, Math.sin(heading) * unit];
    context.setTransform(c, -s, s, c, px * this.ratio, py * this.ratio);
  }

  /** [px] Where a point of the world is on the canvas. */
  toScreen(x, y) {
    return [(x * this.k + this.ox) / this.ratio, (this.oy - y * this.k) / this.ratio];
  }

  /** [m] What is at a place of the canvas. */
  toWorld(px, py) {
    return [(px * this.ratio - this.ox) / this.k, (this.oy - py * this.ratio) / this.k];
  }

  /** What is to be seen: [left, bottom, right, top] in metres. */
  get bounds() {
    return this.within(0);
  }

  /** What is to be seen without a border [px]. */
  within(border) {
    const [left, top] = this.toWorld(border, border);
    const [right, bottom] = this.toWorld(this.width - border, this.height - border);
    return [left, bottom, right, top];
  }

  /** Whether bounds are within what is to be seen. */
  holds([left, bottom, right, top]) {
    const seen = this.bounds;
    return left >= seen[0] && bottom >= seen[1] && right <= seen[2] && top <= seen[3];
  }

  /** Zoom about a place of the canvas [px]; what is there stays there. */
  zoomAt(factor, px, py) {
    const [x, y] = this.toWorld(px, py);
    this.jump({ scale: this.scale * factor });
    this.x = x - (px - this.width / 2) / this.scale;
    this.y = y + (py - this.height / 2) / this.scale;
  }

  /** Move by pixels of CSS. */
  pan(dx, dy) {
    this.glide = null;
    this.x -= dx / this.scale;
    this.y += dy / this.scale;
  }

  /** Go to a centre and scale; what is not told stays as it is, so that following goes on. */
  glideTo({ x, y, scale }, now, lasts = GLIDE) {
    const to = { x, y, scale: limited(scale) };
    if (this.still.matches) this.jump(to);
    else this.glide = { from: { x: this.x, y: this.y, scale: this.scale }, to, since: now, lasts };
  }

  /** Show bounds, whole. */
  fit([left, bottom, right, top], now) {
    const wide = Math.max(right - left, 20);
    const high = Math.max(top - bottom, 20);
    const scale = Math.min((this.width - 48) / wide, (this.height - 64) / high, 12);
    this.glideTo({ x: (left + right) / 2, y: (bottom + top) / 2, scale: Math.max(scale, LEAST) }, now);
  }

  /** Be there at once. */
  jump({ x = this.x, y = this.y, scale }) {
    this.glide = null;
    Object.assign(this, { x, y, scale: limited(scale) });
  }

  /** Go on with a change under way. */
  step(now) {
    if (!this.glide) return;
    const { from, to, since, lasts } = this.glide;
    const part = clamped((now - since) / lasts, 0, 1);
    if (part === 1) return void this.jump(to);
    const eased = part * part * (3 - 2 * part);
    for (const axis of ["x", "y"]) {
      if (to[axis] !== undefined) this[axis] = from[axis] + (to[axis] - from[axis]) * eased;
    }
    this.scale = from.scale * (to.scale / from.scale) ** eased;
  }

  /** [px/m] The scale that a change under way ends at. */
  get aim() {
    return this.glide?.to.scale ?? this.scale;
  }
}

function onEarth(value, before) {
  return Number.isNaN(value) ? before : clamped(value, -FAR, FAR);
}

function limited(scale) {
  return clamped(scale || LEAST, LEAST, MOST); // and where it is no number, all there is
}
