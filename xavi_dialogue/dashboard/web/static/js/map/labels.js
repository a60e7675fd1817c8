/** Labels that neither overlap each other nor leave the view; who has no room goes without. */

import { clamped } from "../figures.js";
import { drawPill, HEIGHT, Pills } from "./bitmaps.js";

const EACH = 190; // [ms] from one placing to the next
const PAD = 6; // [px] left and right of the text
const CELL = 64; // [px] of the grid by which neighbours are found
const LONGEST = 64; // characters
const WIDTHS = 2000; // of texts that are kept
const BEYOND = 40; // [px] outside the view, in which what is named may be

/** Places of a label around what it names, the best first: x, y from -1 to 1; halves overlap it. */
const SIDES = ["0 -1", "1 0", "-1 0", "0 1", "1 -1", "-1 -1", "1 1", "-1 1"].map(numbers);
const WIDE = ["0 -1", ".5 -1", "-.5 -1", "1 -1", "-1 -1", "0 1", ".5 1", "-.5 1", "1 1", "-1 1"].map(numbers);

function numbers(text) {
  return text.split(" ").map(Number);
}

/**
 * Finding room takes long, and labels that hop about cannot be read: they are placed a few times a
 * second, and go along with what they name in between.
 */
export class Labels {
  widths = new Map(); // [px] by text
  pills = new Pills();
  sides = new Map(); // where each label was, so that it does not hop about
  places = new Map(); // by key: bitmap, left and top [px] from what it names, and where that is
  texts = []; // of those that are placed
  placing = false; // whether wishes are heard in this frame
  stale = true; // whether what is placed may not fit any more
  since = -Infinity; // [ms] when they were placed last
  font = "";

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
    for (const cell of this.cellsOf(box)) cell.push(box);
  }

  /**
   * Wish for a label.
   * @param {{key: string|number, text: string, x: number, y: number, reach: number, weight: number,
   *   ink: string, ground: string, edge?: string, strong?: boolean, short?: string, wide?: boolean,
   *   below?: boolean}} label x, y [px] of what is named, `reach` [px] to be kept from it; the
   *   heaviest are placed first; `short` is said where there is no room for the text
   */
  add(label) {
    const { key, text, x, y } = label;
    if (!this.placing) return void this.move(key, x, y);
    const { width, height } = this.view;
    if (x < -BEYOND || y < -BEYOND || x > width + BEYOND || y > height + BEYOND) return;
    this.wanted.push({ ...label, text: text.length > LONGEST ? `${text.slice(0, LONGEST - 1)}…` : text });
  }

  /** What a label names is elsewhere: enough between two placings. */
  move(key, x, y) {
    const place = this.places.get(key);
    if (place) Object.assign(place, { x, y, there: true });
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
    const placed = this.wanted.map((label) => this.placed(context, label)).filter(Boolean);
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

  /** The label, or its short form, and its rectangle; null: there is no room. */
  placed(context, { short, ...label }) {
    const width = this.widthOf(context, label) + 2 * PAD;
    const sides = label.wide ? WIDE : SIDES;
    for (const side of [this.sides.get(label.key) ?? 0, ...sides.keys()]) {
      const [dx, dy] = sides[side];
      const box = boxAt(label, width, dx, label.below ? -dy : dy);
      if (!this.free(box)) continue;
      this.sides.set(label.key, side);
      this.occupy(box);
      return [label, box];
    }
    return short ? this.placed(context, { ...label, text: short }) : null;
  }

  free([left, top, right, bottom]) {
    if (left < 2 || top < 2 || right > this.view.width - 2 || bottom > this.view.height - 2) return false;
    const meets = (one) => one[0] < right && one[2] > left && one[1] < bottom && one[3] > top;
    return !this.cellsOf([left, top, right, bottom]).some((cell) => cell.some(meets));
  }

  /** Cells of the grid that a rectangle lies in; beyond the view there are none, however large it is. */
  cellsOf([left, top, right, bottom]) {
    const { width, height } = this.view;
    const found = [];
    const [across, down] = [cellAt(right, width), cellAt(bottom, height)];
    for (let i = cellAt(left, width); i <= across; i += 1) {
      for (let j = cellAt(top, height); j <= down; j += 1) {
        const key = i * 4096 + j;
        if (!this.cells.has(key)) this.cells.set(key, []);
        found.push(this.cells.get(key));
      }
    }
    return found;
  }

  fontOf(label) {
    return `${label.strong ? 600 : 500} 12px ${this.font}`;
  }

  widthOf(context, label) {
    const key = `${label.strong ? "!" : ""}${label.text}`;
    if (!this.widths.has(key)) {
      if (this.widths.size > WIDTHS) this.widths.clear();
      context.font = this.fontOf(label);
      this.widths.set(key, context.measureText(label.text).width);
    }
    return this.widths.get(key);
  }
}

function boxAt(label, width, dx, dy) {
  const across = Math.abs(dx) === 1 ? label.reach * (dy ? 0.75 : 1) : 0;
  const down = dy ? label.reach * (dx ? 0.75 : 1) : 0;
  const x = label.x + dx * (across + width / 2) - width / 2;
  const y = label.y + dy * (down + HEIGHT / 2) - HEIGHT / 2;
  return [x, y, x + width, y + HEIGHT];
}

function cellAt(pixels, size) {
  return Math.floor(clamped(pixels, 0, size) / CELL);
}
