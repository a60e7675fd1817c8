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
  const { detail, evidence } = scene;
  const ego = scene.vehicles.find(({ id }) => id === 0);
  const chosen = new Set([...scene.pointed, ...scene.causes]);
  if (scene.chosen !== null) chosen.add(scene.chosen);
  const quiet = Boolean(evidence || scene.preview);
  const retold = evidence?.decision === detail?.id && Boolean(evidence?.factual?.lines.length);
  const hidden = drawHidden(scene.hidden, pen);
  const decision = drawDecision({ ...scene, ego, chosen, quiet, retold }, pen);
  const compared = evidence
    ? drawEvidence(evidence, scene.t, scene.elapsed, pen, ego ?? OURS)
    : { fact: 0, ghost: 0, kinds: [] };
  const preview = drawPreview(scene.preview, pen);
  const lights = pen.roads ? drawSignals(pen.roads.signals, scene.lights ?? [], pen) : 0;
  const imagined = drawImagined(detail, pen);
  const vehicles = traffic(scene, pen).map(({ id }) => id);
  const cause = vehicles.some((id) => scene.causes.has(id));
  const pointed = vehicles.some((id) => scene.pointed.has(id));
  const besides = Object.entries({ cause, pointed, preview, hidden, imagined, lights }).filter(([, is]) => is);
  const kinds = new Set([...decision.kinds, ...compared.kinds, ...besides.map(([kind]) => kind)]);
  const labels = pen.labels.draw(pen.context);
  return { vehicles, labels, lights, hidden, imagined, preview, ...decision, ...compared, kinds };
}

/** Draw the vehicles in view, ours on top; returns them. */
function traffic(scene, pen) {
  const { view, labels } = pen;
  const [left, bottom, right, top] = view.bounds;
  const inView = ({ x, y, length }) => {
    const reach = 1.5 * length + 12 / view.scale;
    return x + reach >= left && x - reach <= right && y + reach >= bottom && y - reach <= top;
  };
  const seen = scene.vehicles.filter(inView).sort((a, b) => (a.id === 0) - (b.id === 0));
  const long = view.scale >= LONG_NAMES && seen.length < CROWD;
  drawVehicles(seen, scene.t, pen);
  for (const vehicle of seen) {
    rings(vehicle, scene, pen);
    if (labels.placing) name(vehicle, scene, pen, long);
    else labels.move(vehicle.id, ...view.toScreen(...middleOf(vehicle)));
  }
  return seen;
}

function rings(vehicle, { causes, pointed, chosen }, { context, view, colours }) {
  const { id } = vehicle;
  const blamed = causes.has(id);
  const gap = blamed ? 9 : 4;
  if (blamed) drawRing(context, view, vehicle, colours.get("cause"), 4, 3);
  if (pointed.has(id)) drawRing(context, view, vehicle, colours.get("ink"), gap, 2);
  else if (chosen === id) drawRing(context, view, vehicle, colours.get("focus"), gap, 2);
}

function name(vehicle, { causes, pointed, chosen }, { view, colours, labels }, long) {
  const { id } = vehicle;
  const [x, y] = view.toScreen(...middleOf(vehicle));
  const [across, down] = extent(vehicle, view.scale);
  labels.occupy([x - across, y - down, x + across, y + down]);
  const [ours, blamed] = [id === 0, causes.has(id)];
  const ringed = blamed + pointed.has(id);
  const strong = { ink: colours.get(ours ? "accent-ink" : "card"), ground: colours.get(blamed ? "cause" : "accent") };
  const plain = { ink: colours.get("ink"), ground: colours.get("card", 0.9), edge: colours.get("edge") };
  const look = ours || blamed ? { ...strong, strong: true } : plain;
  const weight = ours ? 80 : ringed || chosen === id ? 70 : 20 - id / 1e6;
  const text = ours ? "us" : long || ringed ? calledOf(vehicle) : String(id);
  const reach = radiusOf(vehicle, view.scale) + 2 + (ringed ? 4 + 4 * ringed : 0);
  labels.add({ key: id, text, x, y, reach, weight, ...look });
}

/** [px] Half the width and height of the box around a vehicle. */
function extent(vehicle, scale) {
  const [c, s] = [Math.abs(Math.cos(vehicle.heading)), Math.abs(Math.sin(vehicle.heading))];
  const [long, broad] = sizeOf(vehicle, scale);
  return [(c * long + s * broad) / 2, (s * long + c * broad) / 2];
}
