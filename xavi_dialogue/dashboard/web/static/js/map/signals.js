/** Traffic lights: what each shows, where its lane ends; told apart by shape as well as by colour. */

import { meet } from "./lines.js";

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

/** What a light shows, in words. */
export function lightInWords(state) {
  return WORDS[state] ?? state;
}

/** Where lights stand: [{x, y, heading, lamps: [{signal, ways}], small}], by lane or end of a crossing. */
export function placesOfSignals(roads, lanes) {
  const places = new Map();
  for (const link of roads.links) {
    const line = link.signal ? lanes.get(link.from_lane)?.line : null;
    if (!line) continue;
    if (!places.has(link.from_lane)) places.set(link.from_lane, { ...endOf(line), lane: link.from_lane, lamps: [], small: false });
    const { lamps } = places.get(link.from_lane);
    const known = lamps.find((lamp) => lamp.signal === link.signal);
    if (known) known.ways.add(link.direction);
    else lamps.push({ signal: link.signal, ways: new Set([link.direction]) });
  }
  const kerbs = (roads.crossings ?? []).filter((one) => one.signal).flatMap(kerbsOf);
  return [...places.values(), ...kerbs];
}

function kerbsOf({ line, signal }) {
  const back = [];
  for (let i = line.length - 2; i >= 0; i -= 2) back.push(line[i], line[i + 1]);
  return [line, back].map((way) => ({ ...endOf(way), lamps: [{ signal, ways: new Set() }], small: true }));
}

function endOf(line) {
  const [ax, ay, x, y] = line.slice(-4);
  return { x, y, heading: Math.atan2(y - ay, x - ax) };
}

/** Draw the lights in view; returns how many lamps. */
export function drawSignals(places, lights, { context, view, colours, labels }) {
  const shown = new Map(lights);
  let drawn = 0;
  view.screen(context);
  for (const place of places) {
    const states = place.lamps.filter((lamp) => Object.hasOwn(LOOKS, shown.get(lamp.signal) ?? ""));
    if (!states.length || (place.small && view.scale < CLOSE)) continue;
    if (!meet([place.x, place.y, place.x, place.y], view.bounds)) continue;
    drawn += lampsOf(place, alike(states, shown), { context, view, colours, labels });
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

function lampsOf(place, lamps, { context, view, colours, labels }) {
  const [c, s] = [Math.cos(place.heading), Math.sin(place.heading)];
  const [x, y] = view.toScreen(place.x + c * BEYOND, place.y + s * BEYOND);
  lamps.forEach(({ state, ways }, k) => {
    const aside = (k - (lamps.length - 1) / 2) * BESIDE;
    const turn = ways.size === 1 ? (TURNS[[...ways][0]] ?? 0) : 0;
    const at = { x: x + s * aside, y: y + c * aside, heading: place.heading + turn };
    const radius = radiusAt(view.scale, place.small);
    lamp({ context, colours }, at, LOOKS[state], radius);
    if (labels.placing) labels.occupy([at.x - radius, at.y - radius, at.x + radius, at.y + radius]);
  });
  return lamps.length;
}

function radiusAt(scale, small) {
  return (scale < FAR ? RADIUS / 2 : RADIUS) * (small ? 0.7 : 1);
}

function lamp({ context, colours }, { x, y, heading }, [upper, lower, sign], radius) {
  disc(context, x, y, radius + 2, colours.get("card"));
  disc(context, x, y, radius + 1, colours.get("map-glass"));
  disc(context, x, y, radius, colours.get(lower));
  if (upper !== lower) {
    context.beginPath();
    context.arc(x, y, radius, Math.PI, 2 * Math.PI);
    context.fillStyle = colours.get(upper);
    context.fill();
  }
  if (!sign || radius < RADIUS / 2) return;
  context.strokeStyle = colours.get("map-lamp-sign");
  context.lineWidth = Math.max(radius / 3, 1.2);
  context.lineCap = "butt";
  context.lineJoin = "miter";
  context.beginPath();
  if (sign === "bar") {
    context.moveTo(x - radius * 0.65, y);
    context.lineTo(x + radius * 0.65, y);
  } else arrow(context, x, y, heading, radius);
  context.stroke();
}

function arrow(context, x, y, heading, radius) {
  const [c, s] = [Math.cos(heading) * radius, -Math.sin(heading) * radius];
  context.moveTo(x - 0.7 * c, y - 0.7 * s);
  context.lineTo(x + 0.6 * c, y + 0.6 * s);
  context.moveTo(x - 0.1 * c - 0.5 * s, y - 0.1 * s + 0.5 * c);
  context.lineTo(x + 0.65 * c, y + 0.65 * s);
  context.lineTo(x - 0.1 * c + 0.5 * s, y - 0.1 * s - 0.5 * c);
}

function disc(context, x, y, radius, colour) {
  context.beginPath();
  context.arc(x, y, radius, 0, 2 * Math.PI);
  context.fillStyle = colour;
  context.fill();
}
