/** What we cannot see: hidden parts of the road, and who may come from there. */

import { drawGhost, middleOf } from "./bodies.js";
import { boundsOf, meet, partOf, trace } from "./lines.js";
import { percent } from "../figures.js";

const HATCH = 8; // [px] between two lines of the hatching
const CAR = { length: 4.8, width: 1.8 }; // [m] of who is imagined
const PATHS = new WeakMap(); // by the list of hidden stretches: what is to be drawn
let hatching = { key: "", pattern: null };

/** Draw the hidden stretches; returns whether any is in view. */
export function drawHidden(hidden, { context, view, colours, roads }) {
  if (!hidden?.length || !roads) return false;
  const { box, byWidth } = pathsOf(hidden, roads);
  if (!box || !meet(box, view.bounds)) return false;
  view.world(context);
  context.setLineDash([]);
  context.lineCap = "butt";
  for (const colour of [colours.get("map-hidden", 0.32), patternOf(context, view, colours)]) {
    context.strokeStyle = colour;
    for (const [width, path] of byWidth) {
      context.lineWidth = width;
      context.stroke(path);
    }
  }
  return true;
}

/** One path for all lanes of a width: where they overlap, they are no darker. */
function pathsOf(hidden, roads) {
  let found = PATHS.get(hidden);
  if (found?.roads === roads) return found;
  const [byWidth, lines] = [new Map(), []];
  for (const [id, begin, end] of hidden) {
    const lane = roads.lanes.get(id) ?? roads.others.get(id);
    const line = lane ? partOf(lane.line, begin, end) : [];
    if (line.length < 4) continue;
    if (!byWidth.has(lane.width)) byWidth.set(lane.width, new Path2D());
    trace(byWidth.get(lane.width), line);
    lines.push(line);
  }
  found = { roads, byWidth, box: boundsOf(lines, 2) };
  PATHS.set(hidden, found);
  return found;
}

/** Slanting lines that stay where they are in the world. */
function patternOf(context, view, colours) {
  const key = `${view.ratio} ${colours.get("map-hidden")}`;
  if (hatching.key !== key) {
    const size = Math.round(HATCH * view.ratio);
    const bitmap = new OffscreenCanvas(size, size);
    const pen = bitmap.getContext("2d");
    Object.assign(pen, { strokeStyle: colours.get("map-hidden", 0.9), lineWidth: 1.3 * view.ratio });
    for (const shift of [-size, 0, size]) {
      pen.moveTo(shift - size / 2, -size / 2);
      pen.lineTo(shift + 1.5 * size, 1.5 * size);
    }
    pen.stroke();
    hatching = { key, pattern: context.createPattern(bitmap, "repeat") };
  }
  hatching.pattern.setTransform(new DOMMatrix().scale(1 / view.k, 1 / view.k));
  return hatching.pattern;
}

/** Draw who may come out of what is hidden; returns how many are in view. */
export function drawImagined(detail, { context, view, colours, labels }) {
  const cars = (detail?.imagined ?? []).map(({ position: [x, y], ...one }) => ({ ...one, ...CAR, x, y }));
  const inView = cars.filter(({ x, y }) => meet([x, y, x, y], view.bounds));
  const look = { ink: colours.get("warn"), ground: colours.get("card", 0.92), edge: colours.get("warn", 0.6) };
  for (const car of inView) {
    drawGhost(context, view, car, colours, { colour: "warn", fill: 0.25, line: 1 });
    const [x, y] = view.toScreen(...middleOf(car));
    const chance = percent(car.probability);
    const texts = { key: `imagined ${cars.indexOf(car)}`, text: `unseen: ${chance}`, short: `? ${chance}` };
    labels.add({ ...texts, x, y, reach: 12, weight: 25, wide: true, ...look });
  }
  return inView.length;
}
