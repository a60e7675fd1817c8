/** What a turn speaks of: what was done, and, as a ghost beside it, what was asked about. */

import { count, boundsOf, headingAt, pathOf, pointAt } from "./lines.js";
import { arrowHead, crash } from "./marks.js";
import { drawGhost } from "./bodies.js";
import { clock } from "../figures.js";

const BUTTONS = 80; // [px] on the right, where labels have no room
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
    short: (side) => side.brief,
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
  return boundsOf(
    [...fact.slice(0, 1), ...ghost.slice(0, 1)].map((line) => line.path),
    8,
  );
}

/**
 * Draw the lines of a turn, and ghost cars on them.
 * @param evidence see documents.py: EvidenceShown
 * @param {number} t [s] the moment shown: lines of another one are pale, and say when they were
 * @param {number|null} elapsed [s] since the loop began; null: nothing is to move
 * @param pen {context, view, colours, labels}
 * @param size {length, width} [m] of our car
 * @returns {{fact: number, ghost: number, kinds: Set<string>}}
 */
export function drawEvidence(evidence, t, elapsed, pen, size) {
  const lines = linesOf(evidence);
  const away = Math.abs(t - evidence.t) > AWAY;
  const strength = away ? PALE : 1;
  const when = away ? ` at ${clock(evidence.t)}` : "";
  const kinds = new Set();
  const longest = Math.max(0, ...[lines.fact[0], lines.ghost[0]].filter(Boolean).map(duration));
  const since = elapsed === null ? null : elapsed % (longest + REST);
  for (const name of ["fact", "ghost"]) {
    const own = lines[name];
    own
      .slice()
      .reverse()
      .forEach((line, i) => {
        const main = i === own.length - 1;
        drawLine(line, SIDES[name], pen, strength * (main ? 1 : 0.3 * line.probability + 0.1), main);
      });
    if (!own.length) continue;
    kinds.add(name);
    ghostCars(own[0], SIDES[name], { since, strength, along: name === "ghost" }, pen, size);
  }
  label("fact", evidence.factual, lines, pen, when);
  label("ghost", evidence.counterfactual, lines, pen, when);
  return { fact: lines.fact.length, ghost: lines.ghost.length, kinds };
}

/** Draw a line that somebody looks at: {line: Drive, words}; returns whether there was one. */
export function drawPreview(preview, pen) {
  if (!preview?.line || count(preview.line.path) < 2) return false;
  drawLine(preview.line, SIDES.preview, pen, 0.9, true);
  label("preview", preview, { preview: [preview.line], fact: [] }, pen);
  return true;
}

function duration(line) {
  return (count(line.path) - 1) * line.dt;
}

function drawLine(line, side, { context, view, colours }, alpha, main) {
  view.world(context);
  context.lineCap = "round";
  context.lineJoin = "round";
  const path = pathOf(line.path);
  if (main && side.halo) {
    context.strokeStyle = colours.get("card", 0.6 * alpha);
    context.lineWidth = side.halo / view.scale;
    context.stroke(path);
  }
  context.setLineDash(side.dash.map((length) => length / view.scale));
  context.strokeStyle = colours.get(side.colour, alpha);
  context.lineWidth = (main ? side.width : 2) / view.scale;
  context.stroke(path);
  context.setLineDash([]);
  if (!main) return;
  view.screen(context);
  const end = pointAt(line.path, count(line.path) - 1);
  if (line.outcome === "collision") crash(context, view, end, colours);
  else arrowHead(context, view, end, colours.get(side.colour, alpha), 6 + side.width);
}

/** Where the car would be every other second, and where it is in the loop. */
function ghostCars(line, side, { since, strength, along }, { context, view, colours }, size) {
  const at = (seconds) => {
    const index = Math.min(line.dt > 0 ? seconds / line.dt : 0, count(line.path) - 1);
    const { x, y } = pointAt(line.path, index);
    return { ...size, x, y, heading: headingAt(line.path, Math.floor(index)) };
  };
  let last = null;
  for (let second = EACH; along && second <= duration(line); second += EACH) {
    const car = at(second);
    if (last && Math.hypot(car.x - last.x, car.y - last.y) * view.scale < Math.max(size.length * view.scale, 11) * 1.15)
      continue;
    drawGhost(context, view, car, colours, { colour: side.colour, fill: 0.06, line: 0.3 * strength });
    last = car;
  }
  if (since !== null)
    drawGhost(context, view, at(since), colours, { colour: side.colour, fill: 0.55 * strength, line: strength });
}

/** Say which line it is, at a point in view that is as far from the other line as can be. */
function label(name, side, lines, { view, colours, labels }, when = "") {
  const line = lines[name]?.[0];
  if (!line) return;
  const other = name === "fact" ? lines.ghost[0] : lines.fact[0];
  const last = count(line.path) - 1;
  let best = null;
  for (const part of [1, 0.85, 0.7, 0.55, 0.4, 0.25, 0.1, 0]) {
    const point = pointAt(line.path, part * last);
    const [x, y] = view.toScreen(point.x, point.y);
    if (x < 30 || y < 30 || x > view.width - BUTTONS || y > view.height - 30) continue;
    const away = other ? apart(point, other.path) * view.scale : 0;
    if (!best || Math.min(away, 60) > Math.min(best.away, 60) + 4) best = { x, y, away, point };
  }
  if (!best) return;
  const { colour, words, short } = SIDES[name];
  const look = { ink: colours.get("card"), ground: colours.get(colour), strong: true };
  labels.add({
    key: name,
    text: words(side, when),
    short: short?.(side),
    x: best.x,
    y: best.y,
    reach: 18,
    weight: 90,
    wide: true,
    below: other ? under(best.point, other.path) : name !== "fact",
    ...look,
  });
}

/** Whether a point lies south of a line, where its label does not cover it. */
function under(point, path) {
  let [least, below] = [Infinity, false];
  for (let i = 0; i < path.length; i += 2) {
    const away = Math.hypot(path[i] - point.x, path[i + 1] - point.y);
    if (away < least) [least, below] = [away, path[i + 1] > point.y + 0.2];
  }
  return below;
}

function apart(point, path) {
  let least = Infinity;
  for (let i = 0; i < path.length; i += 2)
    least = Math.min(least, Math.hypot(path[i] - point.x, path[i + 1] - point.y));
  return least;
}
