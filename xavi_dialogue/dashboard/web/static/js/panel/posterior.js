/** How the probabilities of a vehicle's goals moved in time: a stacked chart, labelled in words. */

import { fill, h, setAll } from "../dom.js";
import { clamped, clock, percent } from "../figures.js";
import { between } from "./span.js";

export const TINTS = 6; // in which areas are told apart

const BEFORE = 60; // [s] that are shown
const SHORTEST = 10; // [s]
const GAP = 3.5; // [s] without a word about the vehicle: it was not in view
const HEIGHT = 84; // [px]
const FOOT = 16; // [px] for times
const LABELS = 112; // [px] for words at the right
const LINE = 13; // [px] between labels
const LETTER = 6; // [px] about as wide as a letter of a label is
const LABELLED = 0.04; // probability in the end from which on a goal is named at the right
const WIDE = 0.3; // that a goal must have had to be named where it was likeliest

/** The order in which goals are stacked: as they came up, so that none changes its place. */
export class Places {
  known = new Map();

  /** Goals of a vehicle, in their order. */
  goals(vehicle) {
    if (!this.known.has(vehicle)) this.known.set(vehicle, []);
    return this.known.get(vehicle);
  }

  /** Number of a goal of a vehicle. */
  of(vehicle, words) {
    const goals = this.goals(vehicle);
    if (!goals.includes(words)) goals.push(words);
    return goals.indexOf(words);
  }
}

/** [s] When the chart begins: as soon as the vehicle was in view. */
function beginOf(stretches, at) {
  return Math.min(stretches[0]?.[0].t ?? at, at - SHORTEST);
}

/**
 * What was believed of a vehicle until a moment [s]: what came later was not believed then.
 * @returns {{t: number, shares: number[]}[][]} stretches without a gap; shares by place
 */
export function beliefsOf(decisions, vehicle, at, places) {
  const stretches = [];
  let before = -Infinity;
  for (const { t, beliefs } of between(decisions, at - BEFORE, at)) {
    const goals = beliefs.find((one) => one.vehicle === vehicle)?.goals;
    if (!goals) continue;
    const shares = [];
    for (const [words, p] of goals) {
      const place = places.of(vehicle, words);
      shares[place] = (shares[place] ?? 0) + p;
    }
    if (t - before > GAP) stretches.push([]);
    stretches.at(-1).push({ t, shares: Array.from(shares, (one) => one ?? 0) });
    before = t;
  }
  if (at - before < GAP) stretches.at(-1).push({ ...stretches.at(-1).at(-1), t: at }); // still believed
  return stretches;
}

/**
 * Draw the chart anew.
 * @param {SVGElement} svg
 * @param {{stretches: object[][], goals: string[], at: number, width: number}} what
 */
export function drawPosterior(svg, { stretches, goals, at, width }) {
  const from = beginOf(stretches, at);
  const right = Math.max(width - LABELS, 60);
  const x = (t) => ((t - from) / (at - from)) * right;
  const y = (share) => (1 - share) * (HEIGHT - FOOT);
  setAll(svg, { width, height: HEIGHT, "aria-label": inWords(stretches, goals) });
  fill(
    svg,
    h("rect.posterior-ground", { width: right, height: HEIGHT - FOOT }),
    stretches.map((points) => goals.map((_, k) => area(points, k, x, y))),
    passing(stretches, goals, x, y, right),
    labels(stretches, goals, y, right),
    h("line.posterior-now", { x1: right, x2: right, y1: 0, y2: HEIGHT - FOOT + 3 }),
    h("text", { x: 0, y: HEIGHT - 3 }, from < 0 ? "" : clock(from)),
    h("text.posterior-at", { x: right, y: HEIGHT - 3, "text-anchor": "end" }, clock(at)),
  );
}

function below(shares, k) {
  return shares.slice(0, k).reduce((sum, one) => sum + one, 0);
}

function area(points, k, x, y) {
  if (!points.some(({ shares }) => shares[k] > 0)) return null;
  const lone = points.length === 1 ? [points[0], { ...points[0], t: points[0].t + 1 }] : points;
  const edge = (i) => lone.map(({ t, shares }) => `${x(t).toFixed(1)},${y(below(shares, i)).toFixed(1)}`);
  const outline = [...edge(k + 1), ...edge(k).reverse()].join("L");
  return h("path.posterior-area", { dataset: { tint: k % TINTS }, d: `M${outline}Z` });
}

/** Words at the right of each goal that is held likely in the end; apart from each other. */
function labels(stretches, goals, y, right) {
  const last = stretches.at(-1)?.at(-1);
  if (!last) return [];
  const named = goals
    .map((words, k) => ({ words, k, share: last.shares[k] ?? 0 }))
    .filter(({ share }) => share >= LABELLED)
    .map((one) => ({ ...one, y: y(below(last.shares, one.k) + one.share / 2) }));
  let lowest = HEIGHT - FOOT + LINE / 2;
  for (const one of named) lowest = one.at = Math.min(Math.max(one.y, 6), lowest - LINE);
  const over = Math.min(0, (named.at(-1)?.at ?? 6) - 6); // pushed out above: all down again
  return named.map((one) => [
    h("line.posterior-leader", { x1: right + 1, x2: right + 7, y1: one.y, y2: one.at - over }),
    h("text.posterior-label", { x: right + 10, y: one.at - over + 4 }, short(one.words)),
  ]);
}

/** Words within the area of each goal that was likely for a while, and is not in the end. */
function passing(stretches, goals, x, y, right) {
  const points = stretches.flat();
  const last = points.at(-1)?.shares ?? [];
  const gone = goals.map((words, k) => ({ words: short(words), k })).filter(({ k }) => !((last[k] ?? 0) >= LABELLED));
  const placed = [];
  const apart = (a, b) => Math.abs(a.x - b.x) > a.half + b.half + 4 || Math.abs(a.y - b.y) >= LINE;
  for (const one of gone.map((goal) => atPeak(goal, points, x, y, right))) {
    if (one && placed.every((other) => apart(other, one))) placed.push(one);
  }
  const middle = { "text-anchor": "middle" };
  return placed.map((one) => h("text.posterior-passing", { ...middle, x: one.x, y: one.y + 4 }, one.words));
}

/** Where a goal was likeliest, and how much room its words take. */
function atPeak({ words, k }, points, x, y, right) {
  const share = (one) => one.shares[k] ?? 0;
  const peak = points.reduce((best, one) => (share(one) > share(best) ? one : best), points[0]);
  if (!peak || share(peak) < WIDE) return null;
  const half = (words.length * LETTER) / 2;
  const at = clamped(x(peak.t), x(points[0].t) + half + 2, right - half - 2);
  return { words, half, x: at, y: y(below(peak.shares, k) + share(peak) / 2) };
}

function short(words) {
  const bare = words.replace(/^heads for (the )?/, "to ");
  return bare.length > 17 ? `${bare.slice(0, 16).trimEnd()}…` : bare;
}

function inWords(stretches, goals) {
  const first = stretches[0]?.[0];
  const last = stretches.at(-1)?.at(-1);
  if (!first) return "Nothing was believed of it in this time.";
  const moved = goals
    .map((words, k) => [words, first.shares[k] ?? 0, last.shares[k] ?? 0])
    .filter(([, ...shares]) => Math.max(...shares) > 0.01)
    .map(([words, a, b]) => `${words}: from ${percent(a)} to ${percent(b)}`);
  return `From ${clock(first.t)} to ${clock(last.t)}: ${moved.join("; ")}`;
}
