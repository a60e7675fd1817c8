/** Traffic lights: what each shows, where its lane ends; told apart by shape as well as by colour. */

import { meet } from "./lines.js";
import { disc, paint } from "./paint.js";

const FAR = 2; // [px/m] below which a light is a dot
const CLOSE = 3.5; // [px/m] from which on there is room for those of people on foot
const RADIUS = 6; // [px]
const BESIDE = 13; // [px] between the lights of one lane
const BEYOND = 1.2; // [m] from the end of the lane: vehicles stand before it
const TURNS = { left: Math.PI / 2, right: -Math.PI / 2, turnaround: Math.PI };
/** Upper and lower half of a lamp, and the sign on it. */
const LOOKS = {
  red: ["map-red", "map-red", "bar"],
  red_amber: ["map-red", "map-amber", null],
  amber: ["map-amber", "map-amber", null],
  green: ["map-green", "map-green", "arrow"],
  green_yield: ["map-green", "map-green", "arrow"],
  stop_first: ["map-red", "map-green", "arrow"],
  flashing: ["map-glass", "map-amber", null],
  off: ["map-glass", "map-glass", null],
};
const WORDS = { red_amber: "red and amber", green_yield: "green", stop_first: "red with a green arrow" };
const UPPER_HALF = new Path2D("M-1 0A1 1 0 0 1 1 0z"); // of a lamp of radius 1
const SIGNS = {
  bar: new Path2D("M-.65 0H.65"),
  arrow: new Path2D("M-.7 0H.6M-.1 .5 .65 0-.1-.5"), // ahead is to the right
};

/** What a light shows, in words. */
export function lightInWords(state) {
  return WORDS[state] ?? state;
}

/** Where lights stand: [{x, y, heading, lane, lamps: [{signal, ways}], small}], by lane or end of a crossing. */
export function placesOfSignals(roads, lanes) {
  const places = new Map();
  for (const { signal, from_lane: lane, direction } of roads.links) {
    const line = signal ? lanes.get(lane)?.line : null;
    if (!line) continue;
    if (!places.has(lane)) places.set(lane, { ...endOf(line), lane, lamps: [], small: false });
    const { lamps } = places.get(lane);
    const known = lamps.find((lamp) => lamp.signal === signal);
    if (known) known.ways.add(direction);
    else lamps.push({ signal, ways: new Set([direction]) });
  }
  const kerbs = (roads.crossings ?? []).filter((one) => one.signal).flatMap(kerbsOf);
  return [...places.values(), ...kerbs];
}

function kerbsOf({ line, signal }) {
  const lamps = [{ signal, ways: new Set() }];
  const back = [line[2], line[3], line[0], line[1]];
  return [line, back].map((way) => ({ ...endOf(way), lamps, small: true }));
}

function endOf(line) {
  const [ax, ay, x, y] = line.slice(-4);
  return { x, y, heading: Math.atan2(y - ay, x - ax) };
}

/** Draw the lights in view; returns how many lamps. */
export function drawSignals(places, lights, pen) {
  const { view } = pen;
  const shown = new Map(lights);
  let drawn = 0;
  for (const place of places) {
    const known = place.lamps.filter((lamp) => Object.hasOwn(LOOKS, shown.get(lamp.signal) ?? ""));
    if (!known.length || (place.small && view.scale < CLOSE)) continue;
    if (!meet([place.x, place.y, place.x, place.y], view.bounds)) continue;
    const lamps = alike(known, shown);
    drawLamps(place, lamps, pen);
    drawn += lamps.length;
  }
  return drawn;
}

/** [{state, ways}]: signals of a lane that look the same are one lamp. */
function alike(lamps, shown) {
  const found = new Map();
  for (const { signal, ways } of lamps) {
    const state = shown.get(signal);
    const words = lightInWords(state);
    found.set(words, { state, ways: new Set([...(found.get(words)?.ways ?? []), ...ways]) });
  }
  return [...found.values()];
}

function drawLamps({ x, y, heading, small }, lamps, pen) {
  const { view, labels } = pen;
  const [c, s] = [Math.cos(heading), Math.sin(heading)];
  const [px, py] = view.toScreen(x + c * BEYOND, y + s * BEYOND);
  const radius = (view.scale < FAR ? RADIUS / 2 : RADIUS) * (small ? 0.7 : 1);
  lamps.forEach(({ state, ways }, k) => {
    const aside = (k - (lamps.length - 1) / 2) * BESIDE;
    const [way] = ways;
    const turn = ways.size === 1 ? (TURNS[way] ?? 0) : 0;
    const [left, top] = [px + s * aside, py + c * aside];
    drawLamp(pen, [left, top], heading + turn, LOOKS[state], radius);
    if (labels.placing) labels.occupy([left - radius, top - radius, left + radius, top + radius]);
  });
}

function drawLamp({ context, view, colours }, place, heading, [upper, lower, sign], radius) {
  view.place(context, place);
  paint(context, disc(0, 0, radius + 2), { fill: colours.get("card") });
  paint(context, disc(0, 0, radius + 1), { fill: colours.get("map-glass") });
  paint(context, disc(0, 0, radius), { fill: colours.get(lower) });
  view.place(context, place, 0, radius);
  if (upper !== lower) paint(context, UPPER_HALF, { fill: colours.get(upper) });
  if (!sign || radius < RADIUS / 2) return;
  if (sign === "arrow") view.place(context, place, heading, radius);
  Object.assign(context, { lineCap: "butt", lineJoin: "miter" });
  paint(context, SIGNS[sign], { stroke: colours.get("map-lamp-sign"), width: Math.max(1 / 3, 1.2 / radius) });
}
