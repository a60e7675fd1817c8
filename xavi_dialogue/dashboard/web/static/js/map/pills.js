/** Painted labels, each kept as a small bitmap: text and round ends take long to draw anew. */

export const HEIGHT = 18; // [px]
const MOST = 600; // that are kept
const BORDER = 1; // [px] around each

export class Pills {
  constructor() {
    this.kept = new Map();
  }

  /** The bitmap of a label {text, ink, ground, edge} of a width [px]. */
  of(label, font, ratio, width) {
    const key = `${label.text}|${label.ink}|${label.ground}|${label.edge}|${font}|${ratio}`;
    let bitmap = this.kept.get(key);
    if (!bitmap) {
      if (this.kept.size >= MOST) this.kept.clear();
      bitmap = painted(label, font, ratio, width);
      this.kept.set(key, bitmap);
    }
    return bitmap;
  }
}

/** Draw one at a place [px of CSS]; the context draws in pixels of the screen: whole ones, for sharp text. */
export function drawPill(context, bitmap, ratio, left, top) {
  context.drawImage(bitmap, Math.round((left - BORDER) * ratio), Math.round((top - BORDER) * ratio));
}

function painted(label, font, ratio, width) {
  const bitmap = new OffscreenCanvas(Math.ceil((width + 2 * BORDER) * ratio), Math.ceil((HEIGHT + 2 * BORDER) * ratio));
  const context = bitmap.getContext("2d");
  context.scale(ratio, ratio);
  context.beginPath();
  context.roundRect(BORDER, BORDER, width, HEIGHT, HEIGHT / 2);
  context.fillStyle = label.ground;
  context.fill();
  if (label.edge) {
    context.strokeStyle = label.edge;
    context.stroke();
  }
  context.textBaseline = "middle";
  context.textAlign = "center";
  context.fillStyle = label.ink;
  context.font = font;
  context.fillText(label.text, BORDER + width / 2, BORDER + HEIGHT / 2 + 0.5);
  return bitmap.transferToImageBitmap();
}
