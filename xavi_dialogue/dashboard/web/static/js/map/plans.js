/** What a decision says, on the map: our path, what others may do, right of way, view, goal. */

import { ahead, beforeEnd, boundsOf, count, lastWithin, meet, pathOf, pointAt } from "./lines.js";
import { arrowHead, flag, giveWay } from "./marks.js";
import { middleOf } from "./bodies.js";
import { percent } from "../figures.js";
import { wayOf } from "./words.js";

const FEW = 4; // vehicles whose predictions are all labelled
const LIKELY = 0.05; // probability from which on a goal is labelled
const PIECES = 8; // of a path that fades along its length
const FAR = { scale: 2, pieces: 2 }; // [px/m] below which fewer are told apart
const BORDER = 28; // [px] at which paths that leave the view are labelled
const JOINED = 22; // [px] between the ends of two goals' paths below which they have one label
const SHORT = 3; // [m] below which there is no path to be seen

/**
 * Draw it.
 * @param scene {detail, t, vehicles, chosen: Set of vehicles pointed at, quiet: a turn is shown too,
 *   retold: and the plan's own line with it}
 * @param pen {context, view, colours, labels, roads}
 * @returns {{predictions: number, yields: number, kinds: Set<string>}} what was drawn
 */
export function drawDecision(scene, pen) {
  const drawn = { predictions: 0, yields: 0, kinds: new Set() };
  const { detail } = scene;
  if (!detail) return drawn;
  rightOfWay(scene, pen, drawn);
  viewRadius(scene, pen, drawn);
  predictions(scene, pen, drawn);
  if (detail.ego && !scene.retold) plan(scene, pen, drawn);
  if (detail.goal) {
    pen.view.screen(pen.context);
    flag(pen.context, pen.view, detail.goal, pen.colours);
    if (meet(pointBox(detail.goal), pen.view.bounds)) drawn.kinds.add("goal");
  }
  return drawn;
}

function pointBox([x, y]) {
  return [x, y, x, y];
}

function plan({ detail, t, quiet }, { context, view, colours }, drawn) {
  const { line, length, pieces } = ahead(detail.ego, t, 1);
  if (length < SHORT) return;
  view.world(context);
  context.lineCap = "round";
  context.lineJoin = "round";
  for (const [colour, alpha, width] of [
    ["card", 0.55, 6],
    ["accent", quiet ? 0.4 : 0.95, 3.5],
  ]) {
    context.strokeStyle = colours.get(colour, quiet && colour === "card" ? 0 : alpha);
    context.lineWidth = width / view.scale;
    context.stroke(pieces[0]);
  }
  view.screen(context);
  arrowHead(context, view, pointAt(line, count(line) - 1), colours.get("accent", quiet ? 0.4 : 1));
  drawn.kinds.add("plan");
}

function predictions(scene, pen, drawn) {
  const there = new Set(scene.vehicles.map((vehicle) => vehicle.id));
  const known = scene.detail.predictions.filter((one) => there.has(one.vehicle));
  const inView = new Set(scene.vehicles.filter((one) => meet(pointBox([one.x, one.y]), pen.view.bounds)).map(idOf));
  const several = known.filter((one) => inView.has(one.vehicle)).length > 1;
  for (const one of known) {
    const chosen = scene.chosen.has(one.vehicle);
    const labelled = inView.has(one.vehicle) && (chosen || (known.length <= FEW && !scene.quiet));
    const strength = chosen ? 1 : scene.quiet || scene.chosen.size || known.length > FEW ? 0.5 : 0.9;
    const ends = one.goals.map((goal) => goalPath(scene, pen, { goal, strength }, drawn));
    if (labelled) labelEnds(pen, one.vehicle, ends.filter(Boolean), several);
  }
  if (drawn.predictions) drawn.kinds.add("predictions");
}

function idOf({ id }) {
  return id;
}

/** Draw the ways to a goal; returns where the likeliest of them ends in view, if it is worth a label. */
function goalPath(scene, pen, { goal, strength }, drawn) {
  const lines = goal.ways.filter((way) => way.line && way.probability >= 0.01).slice(0, 3);
  const most = pen.view.scale < FAR.scale ? FAR.pieces : PIECES;
  let end = null;
  for (const way of lines) {
    const { line, length, pieces } = ahead(way.line, scene.t, most);
    if (length < SHORT) continue;
    fading(pen, pieces, strength * (0.25 + 0.75 * way.probability));
    drawn.predictions += 1;
    end ??= lastWithin(line, pen.view.within(BORDER));
  }
  if (!end || goal.probability < LIKELY) return null;
  const [x, y] = pen.view.toScreen(end.x, end.y);
  return { ...end, goal, px: x, py: y };
}

/** How likely each goal is, where its path ends; goals whose paths leave the view together share a label. */
function labelEnds({ context, view, colours, labels }, vehicle, ends, several) {
  const groups = [];
  view.screen(context);
  for (const end of ends) {
    if (end.end) arrowHead(context, view, end, colours.get("other", 0.35 + 0.65 * end.goal.probability), 7);
    const group = groups.find(([{ px, py }]) => Math.hypot(px - end.px, py - end.py) < JOINED);
    if (group) group.push(end);
    else groups.push([end]);
  }
  const look = { ink: colours.get("other"), ground: colours.get("card", 0.92), edge: colours.get("other", 0.5) };
  for (const group of groups) {
    const [{ px, py, goal }] = group;
    const words = group.map((one) => `${percent(one.goal.probability)} ${wayOf(one.goal)}`).join(" · ");
    labels.add({
      key: `goal ${vehicle} ${goal.words} ${goal.place}`,
      text: several ? `${vehicle}: ${words}` : words,
      x: px,
      y: py,
      reach: 9,
      weight: 10 + goal.probability, // after the names, which it may refer to
      wide: true,
      ...look,
    });
  }
}

/** A path that is broad and plain where it begins, thin and pale where it ends. */
function fading({ context, view, colours }, pieces, strength) {
  view.world(context);
  context.lineCap = "butt";
  context.lineJoin = "round";
  pieces.forEach((path, k) => {
    const left = 1 - k / pieces.length;
    context.strokeStyle = colours.get("other", Math.max(strength * (0.25 + 0.75 * left), 0.08));
    context.lineWidth = (1.5 + 2.5 * strength * left + strength) / view.scale;
    context.stroke(path);
  });
}

function rightOfWay({ detail, vehicles }, { context, view, colours, roads }, drawn) {
  const way = detail.right_of_way;
  const ours = roads?.links.get(way?.ego);
  if (!way || !ours || passed(roads, ours, vehicles)) return;
  const strip = (link, colour, alpha) => {
    const lines = link.via.map((id) => roads.lanes.get(id)).filter(Boolean);
    view.world(context);
    context.lineCap = "butt";
    context.strokeStyle = colours.get(colour, alpha);
    for (const lane of lines) {
      context.lineWidth = lane.width * 0.62;
      context.stroke(pathOf(lane.line));
    }
  };
  const first = way.goes_first.map((id) => roads.links.get(id)).filter(Boolean);
  for (const link of first) strip(link, "warn", 0.32);
  strip(ours, "accent", 0.4);
  drawn.yields = first.length;
  const inView = [ours, ...first].some((link) => meet(boxOf(link, roads), view.bounds));
  if (inView) drawn.kinds.add("ours");
  if (!first.length) return;
  if (inView) drawn.kinds.add("yields");
  const waiting = roads.lanes.get(ours.from_lane);
  view.screen(context);
  if (waiting && view.scale > 1.5) giveWay(context, view, beside(waiting, 13 / view.scale), colours);
}

function boxOf(link, roads) {
  return (
    boundsOf(
      link.via.map((id) => roads.lanes.get(id)?.line ?? []),
      1,
    ) ?? [Infinity, Infinity, -Infinity, -Infinity]
  );
}

/** Where a sign stands: to the right of a lane's end. */
function beside(lane, gap) {
  const { x, y, heading } = beforeEnd(lane.line, 1);
  const away = lane.width / 2 + gap;
  return { x: x + Math.sin(heading) * away, y: y - Math.cos(heading) * away };
}

/** Whether we have gone through already: the decision is up to a second old. */
function passed(roads, link, vehicles) {
  const ego = vehicles.find((vehicle) => vehicle.id === 0);
  const lane = ego && roads.laneAt(...middleOf(ego));
  return lane !== null && lane !== undefined && lane.id === link.to_lane;
}

function viewRadius({ detail, vehicles }, { context, view, colours }, drawn) {
  const ego = vehicles.find((vehicle) => vehicle.id === 0);
  if (!ego || !(detail.view_radius > 0)) return;
  view.screen(context);
  const [px, py] = view.toScreen(ego.x, ego.y);
  context.beginPath();
  const radius = detail.view_radius * view.scale;
  context.arc(px, py, radius, 0, 2 * Math.PI);
  context.strokeStyle = colours.get("accent", 0.4);
  context.lineWidth = 1;
  context.stroke();
  if (radius < Math.hypot(Math.max(px, view.width - px), Math.max(py, view.height - py))) drawn.kinds.add("view");
}
