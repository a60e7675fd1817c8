/** Polylines as the server sends them: x, y, x, y, ... in metres. */

import { clamped } from "../figures.js";

/** Number of points of a line. */
export function count(line) {
  return line.length >> 1;
}

/** The points of a line: [[x, y], ...]. */
export function pointsOf(line) {
  return Array.from({ length: count(line) }, (_, i) => [line[2 * i], line[2 * i + 1]]);
}

/** [m] Length of the segment that ends at a point. */
function stretchTo(line, i) {
  return Math.hypot(line[2 * i] - line[2 * i - 2], line[2 * i + 1] - line[2 * i - 1]);
}

/** The line moved sideways by a distance [m], to the left where it is positive. */
export function offset(line, distance) {
  const last = count(line) - 1;
  return pointsOf(line).flatMap(([x, y], i) => {
    const before = direction(line, Math.max(i - 1, 0));
    const after = direction(line, Math.min(i, last - 1));
    const [nx, ny] = unit(-before[1] - after[1], before[0] + after[0]);
    // Outside a bend the corner is farther away; sharp corners are cut off.
    const stretch = distance / Math.max(nx * -after[1] + ny * after[0], 0.5);
    return [x + nx * stretch, y + ny * stretch];
  });
}

/** Unit vector of the segment that begins at a point. */
function direction(line, i) {
  return unit(line[2 * i + 2] - line[2 * i], line[2 * i + 3] - line[2 * i + 1]);
}

function unit(x, y) {
  const size = Math.hypot(x, y) || 1;
  return [x / size, y / size];
}

/** Where a line is at a place between its points: {x, y, heading}; `index` may be fractional. */
export function pointAt(line, index) {
  const last = count(line) - 1;
  const i = clamped(Math.floor(index), 0, Math.max(last - 1, 0));
  const part = clamped(index - i, 0, 1);
  const next = Math.min(i + 1, last);
  return {
    x: line[2 * i] + (line[2 * next] - line[2 * i]) * part,
    y: line[2 * i + 1] + (line[2 * next + 1] - line[2 * i + 1]) * part,
    heading: headingAt(line, i),
  };
}

/** [rad] Heading of a line near a point, over stretches in which it stands still. */
export function headingAt(line, i) {
  for (const step of [1, -1]) {
    for (let k = i + step; k >= 0 && k < count(line); k += step) {
      const x = (line[2 * k] - line[2 * i]) * step;
      const y = (line[2 * k + 1] - line[2 * i + 1]) * step;
      if (x * x + y * y > 0.04) return Math.atan2(y, x);
    }
  }
  return 0;
}

/** What is left of a line from a fractional index on. */
function from(line, index) {
  if (index <= 0) return line;
  if (index >= count(line) - 1) return [];
  const start = pointAt(line, index);
  return [start.x, start.y, ...line.slice(2 * Math.floor(index) + 2)];
}

const AHEAD = new WeakMap(); // what is left of a Drive, as it was cut last
const NEAR = 0.8; // [m]
const CUT = 0.1; // [s] of driving after which it is cut anew: less than a car's length

/**
 * What is left of a Drive at a moment [s], which frame after frame asks for.
 * @param {number} pieces that it falls into at most, each a Path2D
 * @returns {{line: number[], length: number, pieces: Path2D[]}} length [m]
 */
export function ahead(drive, t, pieces) {
  const known = AHEAD.get(drive);
  if (known?.most === pieces && Math.abs(known.t - t) < CUT) return known;
  const line = from(drive.path, drive.dt > 0 ? (t - drive.t) / drive.dt : 0);
  const left = { t, most: pieces, line, length: lengthOf(line), pieces: cutUp(coarser(line), pieces) };
  AHEAD.set(drive, left);
  return left;
}

/** Without the points that are near the one before: standing and slow cars have hundreds of them. */
function coarser(line) {
  const last = count(line) - 1;
  const kept = line.slice(0, 2);
  pointsOf(line).forEach(([x, y], i) => {
    const away = Math.hypot(x - kept.at(-2), y - kept.at(-1));
    if (i > 0 && (away >= NEAR || i === last)) kept.push(x, y);
  });
  return kept;
}

function cutUp(line, most) {
  const last = Math.max(count(line) - 1, 0);
  const pieces = Math.min(most, last);
  const at = (k) => Math.round((k * last) / pieces);
  return Array.from({ length: pieces }, (_, k) => pathOf(line.slice(2 * at(k), 2 * at(k + 1) + 2)));
}

/** [m] Length of a line. */
export function lengthOf(line) {
  let sum = 0;
  for (let i = 1; i < count(line); i += 1) sum += stretchTo(line, i);
  return sum;
}

/** The part of a line between two distances [m] from its begin. */
export function partOf(line, begin, end) {
  const found = [];
  let gone = 0;
  for (let i = 1; i < count(line); i += 1) {
    const size = stretchTo(line, i);
    const [low, high] = [Math.max(begin - gone, 0), Math.min(end - gone, size)];
    gone += size;
    if (!(low < high)) continue;
    const [a, b] = [pointAt(line, i - 1 + low / size), pointAt(line, i - 1 + Math.min(high / size, 1 - 1e-9))];
    if (!found.length) found.push(a.x, a.y);
    found.push(b.x, b.y);
  }
  return found;
}

/** The point at a distance [m] before the end: {x, y, heading}. */
export function beforeEnd(line, distance) {
  let left = distance;
  for (let i = count(line) - 1; i > 0; i -= 1) {
    const size = stretchTo(line, i);
    if (size >= left && size > 0) return { ...pointAt(line, i - left / size), heading: headingAt(line, i - 1) };
    left -= size;
  }
  return pointAt(line, 0);
}

/** The last point of a line within bounds, the line's own end if it is there; null: none is. */
export function lastWithin(line, [left, bottom, right, top]) {
  const points = pointsOf(line);
  const i = points.findLastIndex(([x, y]) => x >= left && x <= right && y >= bottom && y <= top);
  if (i < 0) return null;
  const [x, y] = points[i];
  return { x, y, heading: headingAt(line, i), end: i === points.length - 1 };
}

/** [m] How far a point is from the nearest one of a line, and whether that lies north of it. */
export function nearestOf(line, { x, y }) {
  let nearest = { away: Infinity, north: false };
  for (let i = 0; i < line.length; i += 2) {
    const away = Math.hypot(line[i] - x, line[i + 1] - y);
    if (away < nearest.away) nearest = { away, north: line[i + 1] > y + 0.2 };
  }
  return nearest;
}

/** Bounds of lines: [left, bottom, right, top] in metres; null where there is no point. */
export function boundsOf(lines, margin = 0) {
  let [left, bottom, right, top] = [Infinity, Infinity, -Infinity, -Infinity];
  for (const line of lines) {
    for (let i = 0; i < line.length; i += 2) {
      left = Math.min(left, line[i]);
      right = Math.max(right, line[i]);
      bottom = Math.min(bottom, line[i + 1]);
      top = Math.max(top, line[i + 1]);
    }
  }
  return left > right ? null : [left - margin, bottom - margin, right + margin, top + margin];
}

/** Whether two bounds have anything in common. */
export function meet(a, b) {
  return a[0] <= b[2] && a[2] >= b[0] && a[1] <= b[3] && a[3] >= b[1];
}

/** A Path2D of a line, or of several. */
export function pathOf(...lines) {
  const path = new Path2D();
  for (const line of lines) trace(path, line);
  return path;
}

/** Add a line to a path or context. */
export function trace(path, line, closed = false) {
  if (line.length < 4) return;
  path.moveTo(line[0], line[1]);
  for (let i = 2; i < line.length; i += 2) path.lineTo(line[i], line[i + 1]);
  if (closed) path.closePath();
}
