/** Small pictures that are painted once and copied often: labels, and vehicles that are small on the map. */

import { paint, rounded } from "./paint.js";

export const HEIGHT = 18; // [px] of a label
const BORDER = 1; // [px] around each label
const LABELS = 600; // that are kept
const WAYS = 64; // headings in a whole turn: at this size more of them look alike
const SHEETS = 96; // of vehicles that are kept
const RIM = 2; // [px] of the screen around each vehicle

/** Pictures by name; when there are too many, all are painted anew. */
class Kept {
  pictures = new Map();

  constructor(most) {
    this.most = most;
  }

  get(key, painted) {
    let picture = this.pictures.get(key);
    if (!picture) {
      if (this.pictures.size >= this.most) this.forget();
      this.pictures.set(key, (picture = painted()));
    }
    return picture;
  }

  forget() {
    this.pictures.clear();
  }
}

/** Labels: a text in a pill. */
export class Pills extends Kept {
  constructor() {
    super(LABELS);
  }

  /** The bitmap of a label {text, ink, ground, edge} of a width [px]. */
  of(label, font, ratio, width) {
    const key = [label.text, label.ink, label.ground, label.edge, font, ratio].join("|");
    return this.get(key, () => pill(label, font, ratio, width));
  }
}

/** Draw a pill at a place [px of CSS]; the context draws in pixels of the screen: whole ones, for sharp text. */
export function drawPill(context, bitmap, ratio, left, top) {
  context.drawImage(bitmap, Math.round((left - BORDER) * ratio), Math.round((top - BORDER) * ratio));
}

function pill({ text, ink, ground, edge }, font, ratio, width) {
  const bitmap = new OffscreenCanvas(Math.ceil((width + 2 * BORDER) * ratio), Math.ceil((HEIGHT + 2 * BORDER) * ratio));
  const context = bitmap.getContext("2d");
  context.scale(ratio, ratio);
  paint(context, rounded(BORDER, BORDER, width, HEIGHT, HEIGHT / 2), { fill: ground, stroke: edge });
  Object.assign(context, { textBaseline: "middle", textAlign: "center", fillStyle: ink, font });
  context.fillText(text, BORDER + width / 2, BORDER + HEIGHT / 2 + 0.5);
  return bitmap.transferToImageBitmap();
}

/** Small vehicles, on sheets that show each from every side. */
export class Sprites extends Kept {
  constructor() {
    super(SHEETS);
  }

  /**
   * Draw one; the context draws in pixels of the screen.
   * @param {{x: number, y: number, heading: number}} place of its middle on the canvas [px of CSS]
   * @param {[number, number]} measures length and width [px of CSS]
   * @param {string} colour
   */
  draw(context, { x, y, heading }, [long, broad], colour, { colours, ratio }) {
    const painted = () => sheet(long, broad, colours.get("map-glass"), colours.get(colour), ratio);
    const { image, size } = this.get(`${long} ${broad} ${colour} ${ratio}`, painted);
    const way = ((Math.round((heading / (2 * Math.PI)) * WAYS) % WAYS) + WAYS) % WAYS;
    const [left, top] = [Math.round(x * ratio - size / 2), Math.round(y * ratio - size / 2)];
    context.drawImage(image, way * size, 0, size, size, left, top, size, size);
  }
}

function sheet(long, broad, rim, fill, ratio) {
  const size = Math.ceil(Math.hypot(long + 1, broad + 1) * ratio) + 2 * RIM;
  const bitmap = new OffscreenCanvas(size * WAYS, size);
  const context = bitmap.getContext("2d");
  for (let way = 0; way < WAYS; way += 1) {
    const heading = (way / WAYS) * 2 * Math.PI;
    const [c, s] = [Math.cos(heading) * ratio, Math.sin(heading) * ratio];
    context.setTransform(c, -s, s, c, (way + 0.5) * size, size / 2);
    context.fillStyle = rim;
    context.fillRect(-long / 2 - 0.5, -broad / 2 - 0.5, long + 1, broad + 1);
    context.fillStyle = fill;
    context.fillRect(-long / 2 + 0.5, -broad / 2 + 0.5, long - 1, broad - 1);
  }
  return { image: bitmap.transferToImageBitmap(), size };
}
