/** One frame: everything that moves, drawn over the backdrop. */

import { drawRing, drawVehicles, middleOf, radiusOf, sizeOf } from "./bodies.js";
import { drawHidden, drawImagined } from "./hidden.js";
import { drawSignals } from "./signals.js";
import { drawEvidence, drawPreview } from "./ghosts.js";
import { drawDecision } from "./plans.js";
import { calledOf } from "../words.js";

const LONG_NAMES = 2.2; // [px/m] from which on vehicles are called by their whole name
const CROWD = 40; // vehicles in view from which on they are not
const OURS = { length: 4.8, width: 1.8 }; // [m] where our car is not in the scene

/**
 * Draw a frame.
 * @param scene {t, vehicles, lights, hidden, detail, evidence, preview, elapsed [s] of the loop or null,
 *   causes, pointed: Sets of vehicles, chosen: the one whose card is shown, or null}
 * @param pen {context, view, colours, labels, sprites, roads}
 * @returns what was drawn: see `shown` of createMap, and `kinds` for the legend
 */
export function drawPicture(scene, pen) {
  const ego = scene.vehicles.find((vehicle) => vehicle.id === 0);
  const chosen = new Set([...scene.pointed, ...scene.causes]);
  if (scene.chosen !== null) chosen.add(scene.chosen);
  const quiet = Boolean(scene.evidence || scene.preview);
  const retold = scene.evidence?.decision === scene.detail?.id && Boolean(scene.evidence?.factual?.lines.length);
  const hidden = drawHidden(scene.hidden, pen);
  const decision = drawDecision({ ...scene, chosen, quiet, retold }, pen);
  const evidence = scene.evidence
    ? drawEvidence(scene.evidence, scene.t, scene.elapsed, pen, ego ?? OURS)
    : { fact: 0, ghost: 0, kinds: new Set() };
  const preview = drawPreview(scene.preview, pen);
  const lights = pen.roads ? drawSignals(pen.roads.signals, scene.lights ?? [], pen) : 0;
  const imagined = drawImagined(scene.detail, pen);
  const seen = traffic(scene, pen);
  const kinds = new Set([...decision.kinds, ...evidence.kinds, ...ringKinds(scene, seen)]);
  if (preview) kinds.add("preview");
  if (hidden) kinds.add("hidden");
  if (imagined) kinds.add("imagined");
  if (lights) kinds.add("lights");
  return {
    vehicles: seen.map((vehicle) => vehicle.id),
    labels: pen.labels.draw(pen.context),
    ghost: evidence.ghost,
    fact: evidence.fact,
    predictions: decision.predictions,
    yields: decision.yields,
    lights,
    hidden,
    imagined,
    preview,
    kinds,
  };
}

/** Draw the vehicles in view, ours on top; returns them. */
function traffic(scene, pen) {
  const { view, labels } = pen;
  const [left, bottom, right, top] = view.bounds;
  const seen = [];
  let ours = null;
  for (const vehicle of scene.vehicles) {
    const reach = 1.5 * vehicle.length + 12 / view.scale;
    const { x, y } = vehicle;
    if (x + reach < left || x - reach > right || y + reach < bottom || y - reach > top) continue;
    if (vehicle.id === 0) ours = vehicle;
    else seen.push(vehicle);
  }
  if (ours) seen.push(ours);
  drawVehicles(seen, scene.t, pen);
  const long = view.scale >= LONG_NAMES && seen.length < CROWD;
  for (const vehicle of seen) {
    const told = scene.causes.has(vehicle.id) || scene.pointed.has(vehicle.id) || scene.chosen === vehicle.id;
    if (told) rings(vehicle, scene, pen);
    if (labels.placing) name(vehicle, scene, pen, long);
    else labels.move(vehicle.id, ...view.toScreen(...middleOf(vehicle)));
  }
  return seen;
}

function rings(vehicle, scene, { context, view, colours }) {
  let gap = 4;
  const ring = (colour, width) => {
    drawRing(context, view, vehicle, colour, gap, width);
    gap += width + 2;
  };
  if (scene.causes.has(vehicle.id)) ring(colours.get("cause"), 3);
  if (scene.pointed.has(vehicle.id)) ring(colours.get("ink"), 2);
  else if (scene.chosen === vehicle.id) ring(colours.get("focus"), 2);
}

function name(vehicle, scene, { view, colours, labels }, long) {
  const [x, y] = view.toScreen(...middleOf(vehicle));
  const ringed = scene.causes.has(vehicle.id) + scene.pointed.has(vehicle.id);
  const reach = radiusOf(vehicle, view.scale) + 2;
  const [across, down] = extent(vehicle, view.scale);
  labels.occupy([x - across, y - down, x + across, y + down]);
  const ours = vehicle.id === 0;
  const blamed = scene.causes.has(vehicle.id);
  const ground = blamed ? "cause" : "accent";
  const look =
    ours || blamed
      ? { ink: colours.get(ours ? "accent-ink" : "card"), ground: colours.get(ground), strong: true }
      : { ink: colours.get("ink"), ground: colours.get("card", 0.9), edge: colours.get("edge") };
  const weight = ours ? 80 : ringed || scene.chosen === vehicle.id ? 70 : 20 - vehicle.id / 1e6;
  const text = ours ? "us" : long || ringed ? calledOf(vehicle) : String(vehicle.id);
  labels.add({
    key: vehicle.id,
    text,
    x,
    y,
    reach: reach + (ringed ? 4 + 4 * ringed : 0),
    weight,
    ...look,
  });
}

/** [px] Half the width and height of the box around a vehicle. */
function extent(vehicle, scale) {
  const [c, s] = [Math.abs(Math.cos(vehicle.heading)), Math.abs(Math.sin(vehicle.heading))];
  const [long, broad] = sizeOf(vehicle, scale);
  return [(c * long + s * broad) / 2, (s * long + c * broad) / 2];
}

function ringKinds(scene, seen) {
  const kinds = [];
  if (seen.some((vehicle) => scene.causes.has(vehicle.id))) kinds.push("cause");
  if (seen.some((vehicle) => scene.pointed.has(vehicle.id))) kinds.push("pointed");
  return kinds;
}
