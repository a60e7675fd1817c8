/** Vehicles as they look from above. */

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
export function sizeOf(vehicle, scale) {
  if (ON_FOOT.has(vehicle.kind)) return Array(2).fill(Math.max(0.7 * scale, SLIGHT * 0.8));
  if (TWO_WHEELED.has(vehicle.kind)) {
    return [Math.max(vehicle.length * scale, SLIGHT), Math.max(vehicle.width * scale, SLIGHT / 2)];
  }
  return [Math.max(vehicle.length * scale, LONG), Math.max(vehicle.width * scale, BROAD)];
}

/** The middle of a vehicle; its position is that of its front bumper. */
export function middleOf(vehicle) {
  const half = vehicle.length / 2;
  return [vehicle.x - Math.cos(vehicle.heading) * half, vehicle.y - Math.sin(vehicle.heading) * half];
}

/** [px] The radius around the middle that a vehicle takes up. */
export function radiusOf(vehicle, scale) {
  const [long, broad] = sizeOf(vehicle, scale);
  return Math.hypot(long, broad) / 2;
}

/** Let a context draw along a vehicle: x ahead from the middle, y to the right, in pixels of CSS. */
function place(context, view, vehicle) {
  const [px, py] = view.toScreen(...middleOf(vehicle));
  const [c, s] = [Math.cos(vehicle.heading) * view.ratio, Math.sin(vehicle.heading) * view.ratio];
  context.setTransform(c, -s, s, c, px * view.ratio, py * view.ratio);
}

/**
 * Draw vehicles, all of them: small ones from sprites, which leave little to be done.
 * @param vehicles those in view, ours last
 * @param {number} t [s] by which indicators blink
 * @param pen {context, view, colours, sprites}
 */
export function drawVehicles(vehicles, t, { context, view, colours, sprites }) {
  context.setLineDash([]);
  context.setTransform(1, 0, 0, 1, 0, 0);
  context.imageSmoothingEnabled = false;
  const pen = { colours, ratio: view.ratio };
  let placed = false; // whether the context is turned along a vehicle
  for (const vehicle of vehicles) {
    const [long, broad] = sizeOf(vehicle, view.scale);
    if (long >= SMALL || (ON_FOOT.has(vehicle.kind) && view.scale >= CLOSE)) {
      drawVehicle(context, view, vehicle, colours, t);
      placed = true;
      continue;
    }
    if (placed) context.setTransform(1, 0, 0, 1, 0, 0);
    placed = false;
    const [x, y] = view.toScreen(...middleOf(vehicle));
    const paint = colours.paintOf(vehicle);
    sprites.draw(context, { x, y, heading: vehicle.heading }, Math.round(long), Math.round(broad), paint, pen);
  }
}

function drawVehicle(context, view, vehicle, colours, t) {
  place(context, view, vehicle);
  const [long, broad] = sizeOf(vehicle, view.scale);
  const paint = colours.paintOf(vehicle);
  const look = Object.hasOwn(LOOKS, vehicle.kind) ? LOOKS[vehicle.kind] : LOOKS.car; // the kind is told by a stranger
  look({ context, colours, long, broad, paint, fine: long >= DETAIL && broad >= 8 });
  if (long >= 16) lights({ context, colours, long, broad }, vehicle.signals, t);
}

/** Draw where a vehicle would be: its outline, hardly there. */
export function drawGhost(context, view, vehicle, colours, { colour, fill, line }) {
  place(context, view, vehicle);
  const [long, broad] = sizeOf(vehicle, view.scale);
  rounded(context, -long / 2, -broad / 2, long, broad, broad * 0.35);
  context.fillStyle = colours.get(colour, fill);
  context.fill();
  context.strokeStyle = colours.get(colour, line);
  context.lineWidth = 1.2;
  context.stroke();
}

const LOOKS = {
  car(pen) {
    const { long, broad } = pen;
    body(pen, -long / 2, -broad / 2, long, broad, broad * 0.34);
    if (!pen.fine) return;
    glass(pen, long * 0.06, broad * 0.4, long * 0.14, broad * 0.33);
    glass(pen, -long * 0.4, broad * 0.34, long * 0.09, broad * 0.38);
  },
  truck(pen) {
    const { long, broad } = pen;
    const cab = Math.min(long * 0.28, broad * 1.1);
    body(pen, -long / 2, -broad / 2, long - cab - 1, broad, Math.min(broad * 0.12, 3));
    body(pen, long / 2 - cab, -broad / 2, cab, broad, broad * 0.22);
    if (pen.fine) glass(pen, long / 2 - cab * 0.42, broad * 0.4, cab * 0.26, broad * 0.36);
  },
  bus(pen) {
    const { long, broad } = pen;
    body(pen, -long / 2, -broad / 2, long, broad, broad * 0.16);
    if (!pen.fine) return;
    glass(pen, long / 2 - broad * 0.3, broad * 0.42, broad * 0.2, broad * 0.42);
    const { context, colours } = pen;
    context.fillStyle = colours.get("map-glass", 0.35);
    context.fillRect(-long * 0.44, -broad * 0.2, long * 0.72, broad * 0.4);
  },
  motorcycle(pen) {
    const { long, broad } = pen;
    body(pen, -long / 2, -broad * 0.22, long, broad * 0.44, broad * 0.22);
    rider(pen, -long * 0.08, broad * 0.42);
  },
  bicycle(pen) {
    const { context, colours, long, broad } = pen;
    context.fillStyle = colours.get("ink");
    for (const x of [-long / 2, long * 0.2]) context.fillRect(x, -1.2, long * 0.3, 2.4); // wheels
    context.fillRect(long * 0.18, -broad / 2, 1.6, broad); // handlebars
    shoulders(pen, -long * 0.08, broad * 0.3, broad * 0.46, pen.paint);
    rider(pen, -long * 0.05, broad * 0.22);
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
  context.beginPath();
  context.arc(0, 0, broad * 0.58, 0, 2 * Math.PI);
  context.fillStyle = colours.get("card", 0.85);
  context.fill();
  shoulders(pen, 0, broad * 0.24, broad * 0.5, "ink");
  context.beginPath();
  context.arc(broad * 0.04, 0, broad * 0.24, 0, 2 * Math.PI);
  context.fillStyle = colours.get("map-person");
  context.fill();
}

function shoulders({ context, colours }, x, deep, half, paint) {
  context.beginPath();
  context.ellipse(x, 0, deep, half, 0, 0, 2 * Math.PI);
  context.fillStyle = colours.get(paint);
  context.fill();
  context.strokeStyle = colours.get("map-glass", 0.75);
  context.lineWidth = 1;
  context.stroke();
}

function body({ context, colours, paint }, x, y, long, broad, radius) {
  rounded(context, x, y, long, broad, radius);
  context.fillStyle = colours.get(paint);
  context.fill();
  context.strokeStyle = colours.get("map-glass", 0.75);
  context.lineWidth = 1;
  context.stroke();
}

/** A pane across the vehicle, broader at the front. */
function glass({ context, colours }, x, front, long, rear) {
  context.beginPath();
  context.moveTo(x + long, -front);
  context.lineTo(x + long, front);
  context.lineTo(x, rear);
  context.lineTo(x, -rear);
  context.closePath();
  context.fillStyle = colours.get("map-glass", 0.72);
  context.fill();
}

function rider({ context, colours }, x, radius) {
  context.beginPath();
  context.arc(x, 0, radius, 0, 2 * Math.PI);
  context.fillStyle = colours.get("map-glass", 0.85);
  context.fill();
}

function lights({ context, colours, long, broad }, signals, t) {
  const size = Math.max(broad * 0.24, 2.2);
  if (signals.includes("brake")) {
    context.fillStyle = colours.get("map-brake");
    for (const side of [-1, 1])
      context.fillRect(-long / 2 - 0.5, side * (broad / 2 - size * 0.6) - size / 2, size * 0.8, size);
  }
  if (t % BLINK > BLINK * 0.65) return;
  context.fillStyle = colours.get("map-indicator");
  for (const [signal, side] of [
    ["left", -1],
    ["right", 1],
  ]) {
    if (!signals.includes(signal)) continue;
    for (const x of [-long / 2 + size * 0.3, long / 2 - size * 0.6]) {
      context.beginPath();
      context.arc(x, side * (broad / 2), size * 0.62, 0, 2 * Math.PI);
      context.fill();
    }
  }
}

/** Draw a ring around a vehicle; `gap` [px] keeps several apart. */
export function drawRing(context, view, vehicle, colour, gap = 5, width = 2.5) {
  view.screen(context);
  const [px, py] = view.toScreen(...middleOf(vehicle));
  context.beginPath();
  context.arc(px, py, radiusOf(vehicle, view.scale) + gap, 0, 2 * Math.PI);
  context.strokeStyle = colour;
  context.lineWidth = width;
  context.stroke();
}

function rounded(context, x, y, long, broad, radius) {
  context.beginPath();
  context.roundRect(x, y, long, broad, Math.max(Math.min(radius, long / 2, broad / 2), 0));
}
