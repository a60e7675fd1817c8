/** Labels that neither overlap each other nor leave the view; who has no room goes without. */

import { drawPill, HEIGHT, Pills } from "./pills.js";

const EACH = 190; // [ms] from one placing to the next
const PAD = 6; // [px] left and right of the text
const CELL = 64; // [px] of the grid by which neighbours are found
const LONGEST = 64; // characters

/** Places of a label around what it names, the best first: x, y from -1 to 1; halves overlap it. */
const SIDES = [
  [0, -1],
  [1, 0],
  [-1, 0],
  [0, 1],
  [1, -1],
  [-1, -1],
  [1, 1],
  [-1, 1],
];
const WIDE = [
  [0, -1],
  [0.5, -1],
  [-0.5, -1],
  [1, -1],
  [-1, -1],
  [0, 1],
  [0.5, 1],
  [-0.5, 1],
  [1, 1],
  [-1, 1],
];

/**
 * Finding room takes long, and labels that hop about cannot be read: they are placed a few times a
 * second, and go along with what they name in between.
 */
export class Labels {
  constructor() {
    this.widths = new Map();
    this.pills = new Pills();
    this.sides = new Map(); // where each label was, so that it does not hop about
    this.places = new Map(); // by key: bitmap, left and top [px] from what it names, and where that is
    this.texts = []; // of those that are placed
    this.placing = false; // whether wishes are heard in this frame
    this.stale = true; // whether what is placed may not fit any more
    this.since = -Infinity; // [ms] when they were placed last
    this.font = "";
  }

  /** Place them in the next frame, whenever the last time was. */
  spoil() {
    this.since = -Infinity;
    this.stale = true;
  }

  /** Begin a frame; `taken` are rectangles [left, top, right, bottom] of the canvas to be left free. */
  begin(view, font, taken, now) {
    if (font !== this.font) this.widths.clear();
    this.placing = now - this.since >= EACH;
    this.stale = !this.placing;
    Object.assign(this, { view, font });
    if (!this.placing) return;
    Object.assign(this, { since: now, wanted: [], cells: new Map() });
    for (const box of taken) this.occupy(box);
  }

  /** Keep labels of lesser weight off a rectangle. */
  occupy(box) {
    this.each(box, (cell) => cell.push(box));
  }

  /**
   * Wish for a label.
   * @param {{key: string|number, text: string, x: number, y: number, reach: number, weight: number,
   *   ink: string, ground: string, edge?: string, strong?: boolean, short?: string, wide?: boolean,
   *   below?: boolean}} label x, y [px] of what is named, `reach` [px] to be kept from it; the
   *   heaviest are placed first; `short` is said where there is no room for the text
   */
  add(label) {
    if (!this.placing) return void this.move(label.key, label.x, label.y);
    const { width, height } = this.view;
    if (label.x < -40 || label.y < -40 || label.x > width + 40 || label.y > height + 40) return;
    const text = label.text.length > LONGEST ? `${label.text.slice(0, LONGEST - 1)}…` : label.text;
    this.wanted.push({ ...label, text });
  }

  /** What a label names is elsewhere: enough between two placings. */
  move(key, x, y) {
    const place = this.places.get(key);
    if (!place) return;
    [place.x, place.y, place.there] = [x, y, true];
  }

  /** Draw all that found room; returns their texts. */
  draw(context) {
    if (this.placing) this.place(context);
    const { ratio } = this.view;
    context.setTransform(1, 0, 0, 1, 0, 0);
    for (const place of this.places.values()) {
      if (place.there) drawPill(context, place.bitmap, ratio, place.x + place.dx, place.y + place.dy);
      place.there = false;
    }
    return this.texts;
  }

  place(context) {
    this.view.screen(context);
    this.wanted.sort((a, b) => b.weight - a.weight || (a.key < b.key ? -1 : 1));
    const placed = [];
    for (const label of this.wanted) {
      const found = this.placed(context, label);
      if (found) placed.push(found);
    }
    this.places.clear();
    for (const [label, [left, top, right]] of placed) {
      const { key, x, y } = label;
      const bitmap = this.pills.of(label, this.fontOf(label), this.view.ratio, right - left);
      this.places.set(key, { bitmap, x, y, dx: left - x, dy: top - y, there: true });
    }
    this.texts = placed.map(([label]) => label.text);
    const kept = new Set(this.wanted.map((label) => label.key));
    for (const key of this.sides.keys()) if (!kept.has(key)) this.sides.delete(key);
  }

  placed(context, label) {
    return this.fitted(context, label) ?? (label.short ? this.placed(context, shorter(label)) : null);
  }

  fitted(context, label) {
    const width = this.widthOf(context, label) + 2 * PAD;
    const before = this.sides.get(label.key);
    const sides = label.wide ? WIDE : SIDES;
    for (const side of [before ?? 0, ...sides.keys()]) {
      const [dx, dy] = sides[side];
      const box = this.boxAt(label, width, [dx, label.below ? -dy : dy]);
      if (!this.free(box)) continue;
      this.sides.set(label.key, side);
      this.occupy(box);
      return [label, box];
    }
    return null;
  }

  boxAt(label, width, [dx, dy]) {
    const across = Math.abs(dx) === 1 ? label.reach * (dy ? 0.75 : 1) : 0;
    const down = dy ? label.reach * (dx ? 0.75 : 1) : 0;
    const x = label.x + dx * (across + width / 2) - width / 2;
    const y = label.y + dy * (down + HEIGHT / 2) - HEIGHT / 2;
    return [x, y, x + width, y + HEIGHT];
  }

  free(box) {
    if (box[0] < 2 || box[1] < 2 || box[2] > this.view.width - 2 || box[3] > this.view.height - 2) return false;
    let free = true;
    this.each(box, (cell) => {
      if (free) free = !cell.some((one) => one[0] < box[2] && one[2] > box[0] && one[1] < box[3] && one[3] > box[1]);
    });
    return free;
  }

  each([left, top, right, bottom], visit) {
    const [across, down] = [cellOf(right, this.view.width), cellOf(bottom, this.view.height)];
    for (let i = cellOf(left, this.view.width); i <= across; i += 1) {
      for (let j = cellOf(top, this.view.height); j <= down; j += 1) {
        const key = i * 4096 + j;
        if (!this.cells.has(key)) this.cells.set(key, []);
        visit(this.cells.get(key));
      }
    }
  }

  fontOf(label) {
    return `${label.strong ? 600 : 500} 12px ${this.font}`;
  }

  widthOf(context, label) {
    const key = `${label.strong ? "!" : ""}${label.text}`;
    let width = this.widths.get(key);
    if (width === undefined) {
      if (this.widths.size > 2000) this.widths.clear();
      context.font = this.fontOf(label);
      width = context.measureText(label.text).width;
      this.widths.set(key, width);
    }
    return width;
  }
}

/** Beyond the view there is nothing to keep free, however large a vehicle is said to be. */
function cellOf(pixels, size) {
  return Math.floor(Math.min(Math.max(pixels, 0), size) / CELL);
}

function shorter({ short, ...label }) {
  return { ...label, text: short };
}
