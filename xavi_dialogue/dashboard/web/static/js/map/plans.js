/** What a decision says, on the map: our path, what others may do, right of way, view, goal. */

import { ahead, beforeEnd, boundsOf, count, lastWithin, meet, pathOf, pointAt } from "./lines.js";
import { arrowHead, flag, giveWay } from "./marks.js";
import { middleOf } from "./bodies.js";
import { disc, paint } from "./paint.js";
import { percent } from "../figures.js";
import { wayOf } from "./words.js";

const FEW = 4; // vehicles whose predictions are all labelled
const LIKELY = 0.05; // probability from which on a goal is labelled
const PIECES = 8; // of a path that fades along its length
const FAR = { scale: 2, pieces: 2 }; // [px/m] below which fewer are told apart
const BORDER = 28; // [px] at which paths that leave the view are labelled
const JOINED = 22; // [px] between the ends of two goals' paths below which they have one label
const SHORT = 3; // [m] below which there is no path to be seen
const SIGN = 1.5; // [px/m] from which on there is room for a sign

/**
 * Draw it.
 * @param scene {detail, t, vehicles, ego, chosen: Set of vehicles pointed at, quiet: a turn is shown too,
 *   retold: and the plan's own line with it}
 * @param pen {context, view, colours, labels, roads}
 * @returns {{predictions: number, yields: number, kinds: Set<string>}} what was drawn
 */
export function drawDecision(scene, pen) {
  const drawn = { predictions: 0, yields: 0, kinds: new Set() };
  const { detail } = scene;
  if (!detail) return drawn;
  rightOfWay(scene, pen, drawn);
  if (scene.ego && detail.view_radius > 0) viewRadius(scene, pen, drawn);
  predictions(scene, pen, drawn);
  if (detail.ego && !scene.retold) plan(scene, pen, drawn);
  if (detail.goal) {
    flag(pen.context, pen.view, detail.goal, pen.colours);
    if (isIn(pen.view, ...detail.goal)) drawn.kinds.add("goal");
  }
  return drawn;
}

function isIn(view, x, y) {
  return meet([x, y, x, y], view.bounds);
}

function plan({ detail, t, quiet }, { context, view, colours }, drawn) {
  const { line, length, pieces } = ahead(detail.ego, t, 1);
  if (length < SHORT) return;
  view.world(context);
  Object.assign(context, { lineCap: "round", lineJoin: "round" });
  if (!quiet) paint(context, pieces[0], { stroke: colours.get("card", 0.55), width: 6 / view.scale });
  paint(context, pieces[0], { stroke: colours.get("accent", quiet ? 0.4 : 0.95), width: 3.5 / view.scale });
  arrowHead(context, view, pointAt(line, count(line) - 1), colours.get("accent", quiet ? 0.4 : 1));
  drawn.kinds.add("plan");
}

function predictions(scene, pen, drawn) {
  const { vehicles, detail, chosen, quiet } = scene;
  const there = new Map(vehicles.map((one) => [one.id, isIn(pen.view, one.x, one.y)]));
  const known = detail.predictions.filter((one) => there.has(one.vehicle));
  const several = known.filter((one) => there.get(one.vehicle)).length > 1;
  const many = known.length > FEW;
  for (const { vehicle, goals } of known) {
    const spokenOf = chosen.has(vehicle);
    const strength = spokenOf ? 1 : quiet || chosen.size || many ? 0.5 : 0.9;
    const ends = goals.map((goal) => goalPath(scene.t, pen, goal, strength, drawn));
    if (!there.get(vehicle) || !(spokenOf || (!many && !quiet))) continue;
    labelEnds(pen, vehicle, ends.filter(Boolean), several);
  }
  if (drawn.predictions) drawn.kinds.add("predictions");
}

/** Draw the ways to a goal; returns where the likeliest of them ends in view, if it is worth a label. */
function goalPath(t, pen, goal, strength, drawn) {
  const { view } = pen;
  const ways = goal.ways.filter((way) => way.line && way.probability >= 0.01).slice(0, 3);
  let end = null;
  for (const { line: drive, probability } of ways) {
    const { line, length, pieces } = ahead(drive, t, view.scale < FAR.scale ? FAR.pieces : PIECES);
    if (length < SHORT) continue;
    fading(pen, pieces, strength * (0.25 + 0.75 * probability));
    drawn.predictions += 1;
    end ??= lastWithin(line, view.within(BORDER));
  }
  if (!end || goal.probability < LIKELY) return null;
  const [px, py] = view.toScreen(end.x, end.y);
  return { ...end, goal, px, py };
}

/** How likely each goal is, where its path ends; goals whose paths leave the view together share a label. */
function labelEnds({ context, view, colours, labels }, vehicle, ends, several) {
  const groups = [];
  for (const end of ends) {
    if (end.end) arrowHead(context, view, end, colours.get("other", 0.35 + 0.65 * end.goal.probability), 7);
    const group = groups.find(([{ px, py }]) => Math.hypot(px - end.px, py - end.py) < JOINED);
    if (group) group.push(end);
    else groups.push([end]);
  }
  const look = { ink: colours.get("other"), ground: colours.get("card", 0.92), edge: colours.get("other", 0.5) };
  for (const group of groups) {
    const [{ px: x, py: y, goal }] = group;
    const words = group.map((one) => `${percent(one.goal.probability)} ${wayOf(one.goal)}`).join(" · ");
    const text = several ? `${vehicle}: ${words}` : words;
    const weight = 10 + goal.probability; // after the names, which it may refer to
    const key = `goal ${vehicle} ${goal.words} ${goal.place}`;
    labels.add({ key, text, x, y, reach: 9, weight, wide: true, ...look });
  }
}

/** A path that is broad and plain where it begins, thin and pale where it ends. */
function fading({ context, view, colours }, pieces, strength) {
  view.world(context);
  Object.assign(context, { lineCap: "butt", lineJoin: "round" });
  pieces.forEach((path, k) => {
    const left = 1 - k / pieces.length;
    const stroke = colours.get("other", Math.max(strength * (0.25 + 0.75 * left), 0.08));
    paint(context, path, { stroke, width: (1.5 + 2.5 * strength * left + strength) / view.scale });
  });
}

function rightOfWay({ detail, ego }, { context, view, colours, roads }, drawn) {
  const way = detail.right_of_way;
  const ours = roads?.links.get(way?.ego);
  if (!ours) return;
  if (ego && roads.laneAt(...middleOf(ego))?.id === ours.to_lane) return; // gone through: it is up to a second old
  const lanesOf = (link) => link.via.map((id) => roads.lanes.get(id)).filter(Boolean);
  const strip = (link, stroke) => {
    for (const lane of lanesOf(link)) paint(context, pathOf(lane.line), { stroke, width: lane.width * 0.62 });
  };
  const first = way.goes_first.map((id) => roads.links.get(id)).filter(Boolean);
  view.world(context);
  context.lineCap = "butt";
  for (const link of first) strip(link, colours.get("warn", 0.32));
  strip(ours, colours.get("accent", 0.4));
  drawn.yields = first.length;
  const boxes = [ours, ...first].map((link) => boundsOf(lanesOf(link).map((lane) => lane.line), 1));
  const inView = boxes.some((box) => box && meet(box, view.bounds));
  if (inView) drawn.kinds.add("ours");
  if (inView && first.length) drawn.kinds.add("yields");
  const waiting = roads.lanes.get(ours.from_lane);
  if (first.length && waiting && view.scale > SIGN) giveWay(context, view, beside(waiting, 13 / view.scale), colours);
}

/** Where a sign stands: to the right of a lane's end. */
function beside(lane, gap) {
  const { x, y, heading } = beforeEnd(lane.line, 1);
  const away = lane.width / 2 + gap;
  return { x: x + Math.sin(heading) * away, y: y - Math.cos(heading) * away };
}

function viewRadius({ detail, ego }, { context, view, colours }, drawn) {
  const [px, py] = view.toScreen(ego.x, ego.y);
  const radius = detail.view_radius * view.scale;
  view.screen(context);
  paint(context, disc(px, py, radius), { stroke: colours.get("accent", 0.4) });
  if (radius < Math.hypot(Math.max(px, view.width - px), Math.max(py, view.height - py))) drawn.kinds.add("view");
}
