/** What a turn speaks of: what was done, and, as a ghost beside it, what was asked about. */

import { count, boundsOf, headingAt, nearestOf, pathOf, pointAt } from "./lines.js";
import { arrowHead, crash } from "./marks.js";
import { drawGhost } from "./bodies.js";
import { clock } from "../figures.js";

const BUTTONS = 80; // [px] on the right, where labels have no room
const BORDER = 30; // [px] likewise, on the other sides
const ENOUGH = 60; // [px] from the other line that a label is well away
const REST = 1.2; // [s] at the end before the loop begins anew
const EACH = 2; // [s] between the ghosts that stand along a line
const AWAY = 3; // [s] from the decision from which on the moment shown is another one
const PALE = 0.45; // of what is drawn then
// What was done is a broad band, so that it is seen beneath the other one, wherever both go the same way.
const SIDES = {
  fact: { colour: "accent", dash: [], width: 8, halo: 11, words: (side, when) => `${side.title}${when}` },
  ghost: {
    colour: "foil",
    dash: [9, 6],
    width: 3.5,
    halo: 0,
    words: (side, when) => `${side.title}${when}: ${side.brief}`,
  },
  preview: { colour: "foil", dash: [3, 5], width: 3.5, halo: 7, words: (side) => side.words },
};

/** Lines of evidence that are on the map: {fact, ghost}, each a list of Drives. */
function linesOf(evidence) {
  const usable = (side) => (side?.lines ?? []).filter((line) => count(line.path) > 1);
  return { fact: usable(evidence?.factual), ghost: usable(evidence?.counterfactual) };
}

/** [left, bottom, right, top] of what is compared; null where there is nothing. */
export function boundsOfEvidence(evidence) {
  const { fact, ghost } = linesOf(evidence);
  const main = [fact[0], ghost[0]].filter(Boolean);
  return boundsOf(main.map((line) => line.path), 8);
}

/**
 * Draw the lines of a turn, and ghost cars on them.
 * @param {EvidenceShown} evidence
 * @param {number} t [s] the moment shown: lines of another one are pale, and say when they were
 * @param {number|null} elapsed [s] since the loop began; null: nothing is to move
 * @param pen {context, view, colours, labels}
 * @param size {length, width} [m] of our car
 * @returns {{fact: number, ghost: number, kinds: Set<string>}}
 */
export function drawEvidence(evidence, t, elapsed, pen, size) {
  const lines = linesOf(evidence);
  const { fact, ghost } = lines;
  const away = Math.abs(t - evidence.t) > AWAY;
  const strength = away ? PALE : 1;
  const when = away ? ` at ${clock(evidence.t)}` : "";
  const longest = Math.max(0, ...[fact[0], ghost[0]].filter(Boolean).map(duration));
  const since = elapsed === null ? null : elapsed % (longest + REST);
  const kinds = new Set(["fact", "ghost"].filter((name) => lines[name].length > 0));
  for (const name of kinds) {
    const [main, ...rest] = lines[name];
    for (const line of rest.reverse()) {
      drawLine(line, SIDES[name], pen, strength * (0.3 * line.probability + 0.1), false);
    }
    drawLine(main, SIDES[name], pen, strength, true);
    ghostCars(main, SIDES[name], { since, strength, along: name === "ghost" }, pen, size);
  }
  if (fact.length) label("fact", evidence.factual, fact[0], ghost[0], pen, when);
  if (ghost.length) label("ghost", evidence.counterfactual, ghost[0], fact[0], pen, when);
  return { fact: fact.length, ghost: ghost.length, kinds };
}

/** Draw a line that somebody looks at: {line: Drive, words}; returns whether there was one. */
export function drawPreview(preview, pen) {
  if (!preview?.line || count(preview.line.path) < 2) return false;
  drawLine(preview.line, SIDES.preview, pen, 0.9, true);
  label("preview", preview, preview.line, undefined, pen);
  return true;
}

function duration(line) {
  return (count(line.path) - 1) * line.dt;
}

function drawLine(line, side, { context, view, colours }, alpha, main) {
  view.world(context);
  Object.assign(context, { lineCap: "round", lineJoin: "round" });
  const path = pathOf(line.path);
  const stroke = (colour, width) => {
    context.strokeStyle = colour;
    context.lineWidth = width / view.scale;
    context.stroke(path);
  };
  if (main && side.halo) stroke(colours.get("card", 0.6 * alpha), side.halo);
  context.setLineDash(side.dash.map((length) => length / view.scale));
  stroke(colours.get(side.colour, alpha), main ? side.width : 2);
  context.setLineDash([]);
  if (!main) return;
  const end = pointAt(line.path, count(line.path) - 1);
  if (line.outcome === "collision") crash(context, view, end, colours);
  else arrowHead(context, view, end, colours.get(side.colour, alpha), 6 + side.width);
}

/** Where the car would be every other second, and where it is in the loop. */
function ghostCars(line, { colour }, { since, strength, along }, { context, view, colours }, size) {
  const at = (seconds) => {
    const index = Math.min(line.dt > 0 ? seconds / line.dt : 0, count(line.path) - 1);
    const { x, y } = pointAt(line.path, index);
    return { ...size, x, y, heading: headingAt(line.path, Math.floor(index)) };
  };
  const apart = 1.15 * Math.max(size.length, 11 / view.scale); // [m]
  let last = null;
  for (let second = EACH; along && second <= duration(line); second += EACH) {
    const car = at(second);
    if (last && Math.hypot(car.x - last.x, car.y - last.y) < apart) continue;
    drawGhost(context, view, car, colours, { colour, fill: 0.06, line: 0.3 * strength });
    last = car;
  }
  if (since !== null) drawGhost(context, view, at(since), colours, { colour, fill: 0.55 * strength, line: strength });
}

/** Say which line it is, at a point in view that is as far from the other line as can be. */
function label(name, side, line, other, { view, colours, labels }, when = "") {
  const last = count(line.path) - 1;
  let best = null;
  for (const part of [1, 0.85, 0.7, 0.55, 0.4, 0.25, 0.1, 0]) {
    const point = pointAt(line.path, part * last);
    const [x, y] = view.toScreen(point.x, point.y);
    if (x < BORDER || y < BORDER || x > view.width - BUTTONS || y > view.height - BORDER) continue;
    const nearest = other && nearestOf(other.path, point);
    const away = Math.min(nearest ? nearest.away * view.scale : 0, ENOUGH);
    if (!best || away > best.away + 4) best = { x, y, away, below: nearest ? nearest.north : name !== "fact" };
  }
  if (!best) return;
  const { colour, words } = SIDES[name];
  labels.add({
    key: name,
    text: words(side, when),
    short: name === "ghost" ? side.brief : undefined,
    x: best.x,
    y: best.y,
    below: best.below,
    reach: 18,
    weight: 90,
    wide: true,
    ink: colours.get("card"),
    ground: colours.get(colour),
    strong: true,
  });
}
