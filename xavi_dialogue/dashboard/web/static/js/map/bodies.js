/** Vehicles as they look from above. */

import { disc, paint, rounded } from "./paint.js";

const LONG = 11; // [px] no vehicle is drawn shorter, however far away
const BROAD = 5; // [px] nor narrower
const DETAIL = 20; // [px] of length from which on windows and lights are drawn
const SLIGHT = 14; // [px] length of two-wheelers and people at least: they are told apart by their shape
const SMALL = 14; // [px] of length below which bodies are plain sprites: hundreds of them are in view
const BLINK = 0.8; // [s] period of indicators

const ON_FOOT = new Set(["pedestrian", "wheelchair", "scooter"]);
const TWO_WHEELED = new Set(["bicycle", "motorcycle"]);
const CLOSE = 1.5; // [px/m] from which on they are drawn so

/** [px] Length and width of a vehicle; on a far view it is drawn larger than it is. */
export function sizeOf({ kind, length, width }, scale) {
  if (ON_FOOT.has(kind)) return Array(2).fill(Math.max(0.7 * scale, SLIGHT * 0.8));
  const [long, broad] = TWO_WHEELED.has(kind) ? [SLIGHT, SLIGHT / 2] : [LONG, BROAD];
  return [Math.max(length * scale, long), Math.max(width * scale, broad)];
}

/** The middle of a vehicle; its position is that of its front bumper. */
export function middleOf({ x, y, heading, length }) {
  return [x - (Math.cos(heading) * length) / 2, y - (Math.sin(heading) * length) / 2];
}

/** [px] The radius around the middle that a vehicle takes up. */
export function radiusOf(vehicle, scale) {
  return Math.hypot(...sizeOf(vehicle, scale)) / 2;
}

/** Let a context draw along a vehicle: x ahead from the middle, y to the right, in pixels of CSS. */
function placeAt(context, view, vehicle) {
  view.place(context, view.toScreen(...middleOf(vehicle)), vehicle.heading);
}

/**
 * Draw vehicles, all of them: small ones from sprites, which leave little to be done.
 * @param vehicles those in view, ours last
 * @param {number} t [s] by which indicators blink
 * @param pen {context, view, colours, sprites}
 */
export function drawVehicles(vehicles, t, { context, view, colours, sprites }) {
  context.setLineDash([]);
  context.imageSmoothingEnabled = false;
  for (const vehicle of vehicles) {
    const [long, broad] = sizeOf(vehicle, view.scale);
    const colour = colours.paintOf(vehicle);
    if (long >= SMALL || (ON_FOOT.has(vehicle.kind) && view.scale >= CLOSE)) {
      const look = Object.hasOwn(LOOKS, vehicle.kind) ? LOOKS[vehicle.kind] : LOOKS.car; // a stranger tells the kind
      const pen = { context, colours, colour, long, broad, fine: long >= DETAIL && broad >= 8 };
      placeAt(context, view, vehicle);
      look(pen);
      if (long >= 16) lights(pen, vehicle.signals, t);
    } else {
      const [x, y] = view.toScreen(...middleOf(vehicle));
      const size = [Math.round(long), Math.round(broad)];
      context.setTransform(1, 0, 0, 1, 0, 0);
      sprites.draw(context, { x, y, heading: vehicle.heading }, size, colour, { colours, ratio: view.ratio });
    }
  }
}

/** Draw where a vehicle would be: its outline, hardly there. */
export function drawGhost(context, view, vehicle, colours, { colour, fill, line }) {
  placeAt(context, view, vehicle);
  const [long, broad] = sizeOf(vehicle, view.scale);
  const outline = rounded(-long / 2, -broad / 2, long, broad, broad * 0.35);
  paint(context, outline, { fill: colours.get(colour, fill), stroke: colours.get(colour, line), width: 1.2 });
}

const LOOKS = {
  car(pen) {
    body(pen, -0.5, 1, 0.34);
    if (!pen.fine) return;
    glass(pen, 0.06, 0.4, 0.14, 0.33);
    glass(pen, -0.4, 0.34, 0.09, 0.38);
  },
  truck(pen) {
    const { long, broad } = pen;
    const cab = Math.min(0.28, (1.1 * broad) / long);
    body(pen, -0.5, 1 - cab - 1 / long, Math.min(0.12, 3 / broad));
    body(pen, 0.5 - cab, cab, 0.22);
    if (pen.fine) glass(pen, 0.5 - cab * 0.42, 0.4, cab * 0.26, 0.36);
  },
  bus(pen) {
    const { context, colours, long, broad } = pen;
    body(pen, -0.5, 1, 0.16);
    if (!pen.fine) return;
    glass(pen, 0.5 - (0.3 * broad) / long, 0.42, (0.2 * broad) / long, 0.42);
    context.fillStyle = colours.get("map-glass", 0.35);
    context.fillRect(-long * 0.44, -broad * 0.2, long * 0.72, broad * 0.4);
  },
  motorcycle(pen) {
    body({ ...pen, broad: pen.broad * 0.44 }, -0.5, 1, 0.5);
    head(pen, -pen.long * 0.08, pen.broad * 0.42);
  },
  bicycle(pen) {
    const { context, colours, long, broad } = pen;
    context.fillStyle = colours.get("ink");
    for (const x of [-long / 2, long * 0.2]) context.fillRect(x, -1.2, long * 0.3, 2.4); // wheels
    context.fillRect(long * 0.18, -broad / 2, 1.6, broad); // handlebars
    shoulders(pen, -long * 0.08, broad * 0.3, broad * 0.46, pen.colour);
    head(pen, -long * 0.05, broad * 0.22);
  },
  pedestrian: walker,
  scooter: walker,
  wheelchair(pen) {
    const { context, colours, broad } = pen;
    context.strokeStyle = colours.get("ink");
    context.lineWidth = 1.5;
    context.strokeRect(-broad * 0.4, -broad * 0.5, broad * 0.8, broad);
    walker(pen);
  },
  tram: (pen) => LOOKS.bus(pen),
};

/** Somebody on foot, from above: shoulders across the way and a head, with a pale rim. */
function walker(pen) {
  const { context, colours, broad } = pen;
  paint(context, disc(0, 0, broad * 0.58), { fill: colours.get("card", 0.85) });
  shoulders(pen, 0, broad * 0.24, broad * 0.5, "ink");
  paint(context, disc(broad * 0.04, 0, broad * 0.24), { fill: colours.get("map-person") });
}

function shoulders({ context, colours }, x, deep, half, colour) {
  const path = new Path2D();
  path.ellipse(x, 0, deep, half, 0, 0, 2 * Math.PI);
  paint(context, path, { fill: colours.get(colour), stroke: colours.get("map-glass", 0.75) });
}

/** Bodywork: where it begins and how long it is in lengths, and the radius of its corners in widths. */
function body({ context, colours, colour, long, broad }, x, length, radius) {
  const path = rounded(x * long, -broad / 2, length * long, broad, radius * broad);
  paint(context, path, { fill: colours.get(colour), stroke: colours.get("map-glass", 0.75) });
}

/** A pane across the vehicle: its rear and length in lengths, its half widths in front and behind in widths. */
function glass({ context, colours, long, broad }, x, front, length, rear) {
  const [from, to] = [x * long, (x + length) * long];
  const [a, b] = [front * broad, rear * broad];
  const path = new Path2D(`M${to} ${-a}V${a}L${from} ${b}V${-b}z`);
  paint(context, path, { fill: colours.get("map-glass", 0.72) });
}

/** The head of who rides. */
function head({ context, colours }, x, radius) {
  paint(context, disc(x, 0, radius), { fill: colours.get("map-glass", 0.85) });
}

function lights({ context, colours, long, broad }, signals, t) {
  const size = Math.max(broad * 0.24, 2.2);
  const sides = { left: -1, right: 1 };
  if (signals.includes("brake")) {
    context.fillStyle = colours.get("map-brake");
    for (const side of Object.values(sides)) {
      context.fillRect(-long / 2 - 0.5, side * (broad / 2 - size * 0.6) - size / 2, size * 0.8, size);
    }
  }
  if (t % BLINK > BLINK * 0.65) return;
  for (const [signal, side] of Object.entries(sides)) {
    if (!signals.includes(signal)) continue;
    for (const x of [-long / 2 + size * 0.3, long / 2 - size * 0.6]) {
      paint(context, disc(x, (side * broad) / 2, size * 0.62), { fill: colours.get("map-indicator") });
    }
  }
}

/** Draw a ring around a vehicle; `gap` [px] keeps several apart. */
export function drawRing(context, view, vehicle, colour, gap, width) {
  placeAt(context, view, vehicle);
  paint(context, disc(0, 0, radiusOf(vehicle, view.scale) + gap), { stroke: colour, width });
}
