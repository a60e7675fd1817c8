/** The lanes of the timeline, drawn as SVG for the stretch shown: only what is in it. */

import { fill, h, setAll } from "../dom.js";
import { clamped, clock } from "../figures.js";
import { doing } from "../words.js";
import { between, tickFor } from "./span.js";

const LETTER = 6.6; // [px] about as wide as a letter of a bar is
const MARKS = {
  "gave-way": "M-6,-5 H6 L0,6 Z",
  arrived: "M-1,7 V-7 H8 L5,-3 L8,1 H1 V7 Z",
  collided: "M-6,-6 L6,6 M6,-6 L-6,6",
  ended: "M-4,-5 H5 V5 H-4 Z",
};

/** Where the lanes begin and end [px], by how much room there is. */
export function lanesFor(width) {
  const [ruler, done, decided, asked] = width < 520 ? [16, 24, 22, 14] : [18, 28, 26, 16];
  const top = { ruler: 0, done: ruler, decided: ruler + done + 2, asked: ruler + done + decided + 4 };
  return { ...top, ends: { done: top.done + done, decided: top.decided + decided }, height: top.asked + asked };
}

/**
 * Draw all lanes anew.
 * @param {SVGElement} svg
 * @param {{width: number, start: number, length: number, lanes: object, bars: object[],
 *   events: object[], decisions: object[], turns: {t: number, n: number}[], shown: number|null}} what
 */
export function drawLanes(svg, what) {
  const x = (t) => ((t - what.start) / what.length) * what.width;
  const end = what.start + what.length;
  setAll(svg, { width: what.width, height: what.lanes.height });
  const within = (items) => between(items, what.start, end);
  fill(
    svg,
    ruler(what, x, end),
    what.bars.filter((one) => one.to >= what.start && one.from <= end).map((one) => bar(one, x, what)),
    within(what.events).map((one) => mark(one, x, what.lanes)),
    within(what.decisions).map((one) => tick(one, x, what.lanes)),
    within(what.turns).map((one) => asked(one, x, what)),
  );
}

function ruler({ start, length, width, lanes }, x, end) {
  const each = tickFor(length, width);
  const marks = [];
  for (let t = Math.ceil(start / each) * each; t <= end; t += each) {
    const at = x(t);
    marks.push(h("line.lane-second", { x1: at, x2: at, y1: lanes.done - 4, y2: lanes.height }));
    if (at < width - 30) marks.push(h("text", { x: at + 3, y: lanes.done - 5 }, clock(t)));
  }
  return h("g.lane-ruler", marks);
}

/** One macro action: pale as long as it was only meant, full from where it could not be taken back. */
function bar(one, x, { lanes, width }) {
  const from = Math.max(x(one.from), 0);
  const to = clamped(x(one.to), from + 2, width);
  const height = lanes.ends.done - lanes.done - 4;
  const length = Math.max(to - from - 1, 1);
  const calm = one.action === "continue";
  const meant = calm ? length : clamped(x(one.committed ?? one.to) - from, 0, length);
  const [at, room, where] = meant > length / 2 ? [0, meant, "on-meant"] : [meant, length - meant, "on-done"];
  const words = clipped(doing(one.action), room - 12);
  const done = one.committed !== null && meant < length;
  return h(
    `g.lane-bar${calm ? ".lane-calm" : ""}${one.open ? ".lane-open" : ""}`,
    { transform: `translate(${from} ${lanes.done + 2})` },
    h("rect.lane-meant", { width: length, height, rx: 4 }),
    done && h("rect.lane-done", { x: meant, width: length - meant, height, rx: 4 }),
    words && h(`text.${where}`, { x: at + 6, y: height / 2 + 4 }, words),
  );
}

function clipped(words, room) {
  const letters = Math.floor(room / LETTER);
  if (letters >= words.length) return words;
  return letters < 4 ? "" : `${words.slice(0, letters - 1).trimEnd()}…`;
}

function mark(event, x, lanes) {
  const path = MARKS[event.kind];
  if (!path) return null;
  const middle = (lanes.done + lanes.ends.done) / 2;
  return h(`path.lane-mark.lane-${event.kind}`, { d: path, transform: `translate(${x(event.t)} ${middle})` });
}

function tick(decision, x, lanes) {
  const at = x(decision.t);
  const bottom = lanes.ends.decided - 3;
  if (!decision.changed) return h("line.lane-tick", { x1: at, x2: at, y1: bottom - 8, y2: bottom });
  return h(
    "g.lane-tick.lane-changed",
    { dataset: { decision: decision.id } },
    h("line", { x1: at, x2: at, y1: lanes.decided + 6, y2: bottom }),
    h("circle", { cx: at, cy: lanes.decided + 7, r: 4 }),
  );
}

function asked(turn, x, { lanes, shown }) {
  const middle = (lanes.asked + lanes.height) / 2;
  const path = "M-5,-5 H5 V3 H0 L-3,6 V3 H-5 Z"; // a speech bubble
  const kind = `path.lane-asked${turn.n === shown ? ".lane-shown" : ""}`;
  return h(kind, { d: path, transform: `translate(${x(turn.t)} ${middle})`, dataset: { turn: turn.n } });
}

/** The whole ride in a thin strip: where the plan changed, and the stretch that is shown above. */
export function drawOverview(svg, { width, first, lasts, start, length, decisions, bars }) {
  const x = (t) => ((t - first) / lasts) * width;
  const changed = decisions.filter((one) => one.changed).map((one) => Math.round(x(one.t)));
  const lines = [...new Set(changed)].map((at) => `M${at},2 V18`); // one a pixel: an hour has thousands
  const box = (from, to, least) => ({ x: from, width: Math.max(to - from, least) });
  setAll(svg, { width });
  fill(
    svg,
    bars
      .filter((one) => one.action !== "continue")
      .map((one) => h("rect.timeline-overview-bar", { ...box(x(one.from), x(one.to), 1), y: 4, height: 12 })),
    lines.length > 0 && h("path.timeline-overview-changed", { d: lines.join(" ") }),
    h("rect.timeline-overview-window", { ...box(x(start) + 1, x(start + length) - 1, 4), y: 1, height: 18, rx: 4 }),
  );
}
