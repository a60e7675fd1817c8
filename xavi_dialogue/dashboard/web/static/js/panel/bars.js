/** Small bars beside figures; the figure always stands beside them in words. */

import { h } from "../dom.js";

const SCALES = [1, 2, 5, 10, 20, 30, 60, 120]; // [s]

/** A bar of one share: update with `drawShare`. */
export function shareBar(name = "") {
  return h("div", { class: `share ${name}`, "aria-hidden": "true" }, h("div", { class: "share-full" }));
}

/** @param {number} share 0 to 1; `tint`: which of the six tints, none by default */
export function drawShare(bar, share, tint = null) {
  const full = bar.firstElementChild;
  full.style.width = `${wide(share)}%`;
  if (tint !== null) full.dataset.tint = tint;
}

function wide(share) {
  return share > 0 ? Math.min(Math.max(share * 100, 1.5), 100) : 0; // what is there can be seen
}

/** A bar to either side of zero, with a whisker: update with `drawRange`. */
export function rangeBar() {
  const parts = ["range-zero", "range-delta", "range-whisker"].map((name) => h("div", { class: name }));
  return h("div", { class: "range", "aria-hidden": "true" }, parts);
}

/**
 * @param {{delta: number, low: number, high: number}|null} time [s]
 * @param {number} scale [s] at either end
 */
export function drawRange(bar, time, scale) {
  const [, delta, whisker] = bar.children;
  delta.hidden = whisker.hidden = !time;
  if (!time) return;
  const x = (t) => 50 + (Math.min(Math.max(t / scale, -1), 1) * 100) / 2;
  stretch(delta, x(Math.min(time.delta, 0)), x(Math.max(time.delta, 0)));
  stretch(whisker, x(time.low), x(time.high));
  delta.dataset.way = time.delta < 0 ? "earlier" : "later";
}

function stretch(element, from, to) {
  element.style.left = `${from}%`;
  element.style.width = `${Math.max(to - from, 0.5)}%`;
}

/** A round number of seconds [s] that all ranges fit in. */
export function scaleFor(times) {
  const most = Math.max(0, ...times.flatMap(({ delta, low, high }) => [delta, low, high].map(Math.abs)));
  return SCALES.find((one) => one >= most) ?? Math.ceil(most / 60) * 60;
}
