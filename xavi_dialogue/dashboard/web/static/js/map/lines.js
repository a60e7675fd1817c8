/** Polylines as the server sends them: x, y, x, y, ... in metres. */

/** Number of points of a line. */
export function count(line) {
  return line.length >> 1;
}

/** The line moved sideways by a distance [m], to the left where it is positive. */
export function offset(line, distance) {
  const n = count(line);
  const moved = new Array(line.length);
  for (let i = 0; i < n; i += 1) {
    const before = direction(line, Math.max(i - 1, 0));
    const after = direction(line, Math.min(i, n - 2));
    let nx = -before[1] - after[1];
    let ny = before[0] + after[0];
    const size = Math.hypot(nx, ny) || 1;
    nx /= size;
    ny /= size;
    // Outside a bend the corner is farther away; sharp corners are cut off.
    const stretch = 1 / Math.max(nx * -after[1] + ny * after[0], 0.5);
    moved[2 * i] = line[2 * i] + nx * distance * stretch;
    moved[2 * i + 1] = line[2 * i + 1] + ny * distance * stretch;
  }
  return moved;
}

/** Unit vector of the segment that begins at a point. */
function direction(line, i) {
  const x = line[2 * i + 2] - line[2 * i];
  const y = line[2 * i + 3] - line[2 * i + 1];
  const size = Math.hypot(x, y) || 1;
  return [x / size, y / size];
}

/** Where a line is at a place between its points: {x, y, heading}; `index` may be fractional. */
export function pointAt(line, index) {
  const last = count(line) - 1;
  const i = Math.min(Math.max(Math.floor(index), 0), Math.max(last - 1, 0));
  const part = Math.min(Math.max(index - i, 0), 1);
  const next = Math.min(i + 1, last);
  return {
    x: line[2 * i] + (line[2 * next] - line[2 * i]) * part,
    y: line[2 * i + 1] + (line[2 * next + 1] - line[2 * i + 1]) * part,
    heading: headingAt(line, i),
  };
}

/** [rad] Heading of a line near a point, over stretches in which it stands still. */
export function headingAt(line, i) {
  const last = count(line) - 1;
  for (const [from, to, step] of [
    [i, last, 1],
    [i, 0, -1],
  ]) {
    for (let k = from + step; step > 0 ? k <= to : k >= to; k += step) {
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
  const last = count(line) - 1;
  if (index >= last) return [];
  const start = pointAt(line, index);
  return [start.x, start.y, ...line.slice(2 * Math.floor(index) + 2)];
}

const AHEAD = new WeakMap(); // what is left of a Drive, as it was cut last
const NEAR = 0.8; // [m]
const CUT = 0.1; // [s] of driving after which it is cut anew: less than a car's length

/**
 * What is left of a Drive (see documents.py) at a moment [s], which frame after frame asks for.
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
  for (let i = 1; i <= last; i += 1) {
    const away = Math.hypot(line[2 * i] - kept.at(-2), line[2 * i + 1] - kept.at(-1));
    if (away >= NEAR || i === last) kept.push(line[2 * i], line[2 * i + 1]);
  }
  return kept;
}

function cutUp(line, most) {
  const last = Math.max(count(line) - 1, 0);
  const pieces = Math.min(most, last);
  return Array.from({ length: pieces }, (_, k) => {
    const [a, b] = [Math.round((k * last) / pieces), Math.round(((k + 1) * last) / pieces)];
    return pathOf(line.slice(2 * a, 2 * b + 2));
  });
}

/** [m] Length of a line. */
export function lengthOf(line) {
  let sum = 0;
  for (let i = 2; i < line.length; i += 2) sum += Math.hypot(line[i] - line[i - 2], line[i + 1] - line[i - 1]);
  return sum;
}

/** The part of a line between two distances [m] from its begin. */
export function partOf(line, begin, end) {
  const found = [];
  let gone = 0;
  for (let i = 0; i + 1 < count(line); i += 1) {
    const size = Math.hypot(line[2 * i + 2] - line[2 * i], line[2 * i + 3] - line[2 * i + 1]);
    const [low, high] = [Math.max(begin - gone, 0), Math.min(end - gone, size)];
    gone += size;
    if (!(low < high)) continue;
    const [a, b] = [pointAt(line, i + low / size), pointAt(line, i + Math.min(high / size, 1 - 1e-9))];
    if (!found.length) found.push(a.x, a.y);
    found.push(b.x, b.y);
  }
  return found;
}

/** The point at a distance [m] before the end: {x, y, heading}. */
export function beforeEnd(line, distance) {
  let left = distance;
  for (let i = count(line) - 1; i > 0; i -= 1) {
    const size = Math.hypot(line[2 * i] - line[2 * i - 2], line[2 * i + 1] - line[2 * i - 1]);
    if (size >= left && size > 0) return { ...pointAt(line, i - left / size), heading: headingAt(line, i - 1) };
    left -= size;
  }
  return pointAt(line, 0);
}

/** The last point of a line within bounds, the line's own end if it is there; null: none is. */
export function lastWithin(line, [left, bottom, right, top]) {
  for (let i = count(line) - 1; i >= 0; i -= 1) {
    const [x, y] = [line[2 * i], line[2 * i + 1]];
    if (x >= left && x <= right && y >= bottom && y <= top)
      return { x, y, heading: headingAt(line, i), end: i === count(line) - 1 };
  }
  return null;
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
