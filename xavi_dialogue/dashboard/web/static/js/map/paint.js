/** Paths, and how a canvas fills and outlines them. */

/** Fill and outline a path; what has no colour is left out. */
export function paint(context, path, { fill, stroke, width = 1 }) {
  if (fill) {
    context.fillStyle = fill;
    context.fill(path);
  }
  if (stroke) {
    context.strokeStyle = stroke;
    context.lineWidth = width;
    context.stroke(path);
  }
}

/** A disc about a point. */
export function disc(x, y, radius) {
  const path = new Path2D();
  path.arc(x, y, radius, 0, 2 * Math.PI);
  return path;
}

/** A rectangle with round corners. */
export function rounded(x, y, long, broad, radius) {
  const path = new Path2D();
  path.roundRect(x, y, long, broad, Math.max(Math.min(radius, long / 2, broad / 2), 0));
  return path;
}
