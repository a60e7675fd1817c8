/** The stretch of the ride that the timeline shows: pure arithmetic, in seconds. */

import { lastUpTo } from "../store.js";

const LENGTHS = [20, 30, 60, 120]; // [s]
const ROOM = 6; // [px] that a second should have
const STEP = 6; // steps in which it moves on while the ride goes on
const MARGIN = 0.02; // share that stays free before the next step

/** How much time fits a width [px]: at most two minutes. */
export function lengthFor(width, lasts) {
  const fitting = LENGTHS.filter((one) => one * ROOM <= Math.max(width, LENGTHS[0] * ROOM));
  return fitting.find((one) => one >= lasts) ?? fitting[fitting.length - 1];
}

/**
 * Where the stretch begins so that the moment shown is in it. It stays where it is while that is
 * so: live it moves on in steps, dragged only as far as it must, else the moment is put in the middle.
 * @param {number|null} start where it began so far
 */
export function startFor({ start, length, first, last, at, live, dragged }) {
  const latest = Math.max(first, last - length * (1 - 1 / STEP));
  const fits = start !== null && start >= first - 1e-6 && at >= start && at <= start + length;
  if (live) {
    const near = fits && at <= start + length * (1 - MARGIN) && start + length - at <= (1.5 * length) / STEP;
    if (near || (fits && start <= first)) return Math.min(start, latest);
    return steps(at, length, first);
  }
  if (fits) return start;
  if (dragged && start !== null) return Math.max(first, at < start ? at : at - length);
  return Math.max(first, Math.min(at - length / 2, latest));
}

function steps(at, length, first) {
  const step = length / STEP;
  const end = Math.ceil((at - first + MARGIN * length) / step) * step;
  return first + Math.max(0, end - length);
}

/** Seconds between the marks of the ruler that names times: no nearer than `apart` [px]. */
export function tickFor(length, width, apart = 64) {
  const wanted = (length * apart) / Math.max(width, 1);
  return [1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 900].find((one) => one >= wanted) ?? 1800;
}

/** Items between two moments, of those in order of time. */
export function between(items, from, to) {
  return items.slice(lastUpTo(items, from - 1e-5) + 1, lastUpTo(items, to) + 1);
}

/**
 * What the car did, as bars: each macro action from when it began to when it ended, or the next
 * one began, or to now.
 * @returns {{from: number, to: number, action: string, committed: number|null, words: string, open: boolean}[]}
 */
export function manoeuvres(events, now) {
  const bars = [];
  let open = null;
  const close = (t) => {
    if (open) Object.assign(open, { to: Math.max(t, open.from), open: false });
    open = null;
  };
  for (const event of events) {
    if (event.kind === "action-started") {
      close(event.t);
      open = { from: event.t, to: event.t, action: event.action, committed: null, words: event.words, open: true };
      bars.push(open);
    } else if (event.kind === "action-committed" && open?.action === event.action) {
      Object.assign(open, { committed: event.t, words: event.words });
    } else if (["action-ended", "arrived", "collided", "ended"].includes(event.kind)) close(event.t);
  }
  if (open) open.to = Math.max(open.from, now);
  return bars;
}

/** Index of the nearest item in time, of those in order; -1: there is none. */
export function nearest(items, t, time = (item) => item.t) {
  const before = lastUpTo(items, t, time);
  if (before < 0) return items.length ? 0 : -1;
  const after = items[before + 1];
  return after !== undefined && time(after) - t < t - time(items[before]) ? before + 1 : before;
}
