/** Mouse, fingers and keys on the map, as what they mean: pan, zoom, hover, choose. */

import { clamped } from "../figures.js";

const TAP = 6; // [px] that a finger may move and still tap
const STEP = 60; // [px] that an arrow key pans
const WHEEL = 0.0016; // log of zoom per pixel of the wheel

/**
 * Listen to a canvas.
 * @param on {pan(dx, dy), zoom(factor, x, y), hover(x, y, touch), leave(), choose(x, y),
 *   zoomIn(), zoomOut(), fit(), follow(), next(step), escape()}; places in pixels of the canvas
 */
export function listen(canvas, on) {
  pointers(canvas, on);
  const wheel = (event) => {
    event.preventDefault();
    const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 16 : 1;
    const turned = clamped(event.deltaY * lines, -240, 240);
    on.zoom(Math.exp(-turned * WHEEL * (event.ctrlKey ? 4 : 1)), event.offsetX, event.offsetY);
  };
  canvas.addEventListener("wheel", wheel, { passive: false });
  canvas.addEventListener("dblclick", (event) => on.zoom(event.shiftKey ? 0.5 : 2, event.offsetX, event.offsetY));
  canvas.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || (event.altKey && !"[]".includes(event.key))) return;
    const meant = KEYS[event.key];
    if (!meant || meant(on) === false) return;
    event.preventDefault();
    event.stopPropagation(); // the page may use the same keys for the same thing
  });
}

const KEYS = {
  ArrowLeft: (on) => on.pan(STEP, 0),
  ArrowRight: (on) => on.pan(-STEP, 0),
  ArrowUp: (on) => on.pan(0, STEP),
  ArrowDown: (on) => on.pan(0, -STEP),
  "+": (on) => on.zoomIn(),
  "=": (on) => on.zoomIn(),
  "-": (on) => on.zoomOut(),
  0: (on) => on.fit(),
  f: (on) => on.follow(),
  F: (on) => on.follow(),
  "]": (on) => on.next(1),
  n: (on) => on.next(1),
  "[": (on) => on.next(-1),
  p: (on) => on.next(-1),
  Escape: (on) => on.escape(),
};

function pointers(canvas, on) {
  const down = new Map(); // fingers or the mouse, where they are
  let moved = false;
  const local = (event) => {
    const box = canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  };
  canvas.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    canvas.setPointerCapture(event.pointerId);
    if (down.size === 0) moved = false;
    down.set(event.pointerId, { ...local(event), from: local(event) });
  });
  canvas.addEventListener("pointermove", (event) => {
    const place = local(event);
    const known = down.get(event.pointerId);
    if (!known) return void (event.pointerType === "mouse" && on.hover(place.x, place.y));
    moved ||= Math.hypot(place.x - known.from.x, place.y - known.from.y) > TAP;
    if (!moved) return;
    drag(down, event.pointerId, place, on);
    down.set(event.pointerId, { ...place, from: known.from });
  });
  const up = (event) => {
    if (!down.delete(event.pointerId) || down.size || moved || event.type !== "pointerup") return;
    const { x, y } = local(event);
    on.choose(x, y);
  };
  canvas.addEventListener("pointerup", up);
  canvas.addEventListener("pointercancel", up);
  canvas.addEventListener("pointerleave", () => on.leave());
}

/** One pointer pans; the second zooms about the middle of both. */
function drag(down, id, place, on) {
  const before = down.get(id);
  const other = [...down].find(([name]) => name !== id)?.[1];
  if (!other) return on.pan(place.x - before.x, place.y - before.y);
  const apart = (one) => Math.max(Math.hypot(one.x - other.x, one.y - other.y), 10);
  const [x, y] = [(place.x + other.x) / 2, (place.y + other.y) / 2];
  on.pan((place.x - before.x) / 2, (place.y - before.y) / 2, true);
  return on.zoom(apart(place) / apart(before), x, y);
}
