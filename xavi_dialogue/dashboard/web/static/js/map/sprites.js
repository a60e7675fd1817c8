/** Vehicles that are small on the map, painted once for every way that they may point. */

const WAYS = 64; // headings in a whole turn: at this size more of them look alike
const MOST = 96; // sheets that are kept
const BORDER = 2; // [px] of the screen around each

export class Sprites {
  constructor() {
    this.sheets = new Map(); // by paint, then by size
    this.count = 0;
    this.ratio = 0;
  }

  /** Colours are others. */
  forget() {
    this.sheets.clear();
    this.count = 0;
  }

  /**
   * Draw one; the context draws in pixels of the screen.
   * @param {{x: number, y: number, heading: number}} place of its middle on the canvas [px of CSS]
   * @param {number} long [px of CSS] @param {number} broad likewise
   * @param {string} paint name of a colour
   */
  draw(context, { x, y, heading }, long, broad, paint, { colours, ratio }) {
    if (ratio !== this.ratio) this.forget();
    this.ratio = ratio;
    const { image, size } = this.sheet(long, broad, paint, colours);
    const way = ((Math.round((heading / (2 * Math.PI)) * WAYS) % WAYS) + WAYS) % WAYS;
    const [left, top] = [Math.round(x * ratio - size / 2), Math.round(y * ratio - size / 2)];
    context.drawImage(image, way * size, 0, size, size, left, top, size, size);
  }

  sheet(long, broad, paint, colours) {
    let sizes = this.sheets.get(paint);
    if (!sizes) this.sheets.set(paint, (sizes = new Map()));
    const key = long * 1024 + broad;
    let sheet = sizes.get(key);
    if (!sheet) {
      if (this.count >= MOST) {
        this.forget();
        this.sheets.set(paint, (sizes = new Map()));
      }
      sheet = painted(long, broad, colours.get("map-glass"), colours.get(paint), this.ratio);
      sizes.set(key, sheet);
      this.count += 1;
    }
    return sheet;
  }
}

function painted(long, broad, rim, paint, ratio) {
  const size = Math.ceil(Math.hypot(long + 1, broad + 1) * ratio) + 2 * BORDER;
  const bitmap = new OffscreenCanvas(size * WAYS, size);
  const context = bitmap.getContext("2d");
  for (let way = 0; way < WAYS; way += 1) {
    const heading = (way / WAYS) * 2 * Math.PI;
    const [c, s] = [Math.cos(heading) * ratio, Math.sin(heading) * ratio];
    context.setTransform(c, -s, s, c, (way + 0.5) * size, size / 2);
    context.fillStyle = rim;
    context.fillRect(-long / 2 - 0.5, -broad / 2 - 0.5, long + 1, broad + 1);
    context.fillStyle = paint;
    context.fillRect(-long / 2 + 0.5, -broad / 2 + 0.5, long - 1, broad - 1);
  }
  return { image: bitmap.transferToImageBitmap(), size };
}
