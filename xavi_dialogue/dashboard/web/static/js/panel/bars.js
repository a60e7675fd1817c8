/** A bar to either side of zero, with a whisker; the figure always stands beside it in words. */

import { clamped } from "../figures.js";

const SCALES = [1, 2, 5, 10, 20, 30, 60, 120]; // [s]

/**
 * @param {HTMLElement} bar holds the zero, the bar and its whisker
 * @param {TimeRange|null} time [s]
 * @param {number} scale [s] at either end
 */
export function drawRange(bar, time, scale) {
  const [, delta, whisker] = bar.children;
  delta.hidden = whisker.hidden = !time;
  if (!time) return;
  const x = (t) => 50 + 50 * clamped(t / scale, -1, 1);
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
