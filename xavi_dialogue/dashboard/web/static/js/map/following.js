/** Keeps our car in view: it stays where it is on the map, and the world moves by. */

const AHEAD = 0.16; // of the map that is seen more in front than behind
const SETTLE = 260; // [ms] in which a new lead is taken on, for the most part

export class Following {
  on = true;
  lead = null; // [m] from the car to the centre of the view; null: none taken yet
  then = 0; // [ms] of the frame before
  settled = true;

  constructor(view) {
    this.view = view;
  }

  /** Switch it on or off; switched on, the view moves over to the car smoothly. */
  set(on, ego) {
    if (on && !this.on && ego) this.lead = [this.view.x - ego.x, this.view.y - ego.y];
    this.on = on;
    this.settled = false;
  }

  /** Forget where the car was. */
  reset() {
    this.lead = null;
  }

  /** The scale changes by a factor: the car keeps its place on the canvas. */
  zoomed(factor) {
    if (this.lead) this.lead = [this.lead[0] / factor, this.lead[1] / factor];
  }

  /** [px] How far before the car the centre of the view is, to the east and to the north. */
  leadFor({ heading }) {
    const { width, height } = this.view;
    return [AHEAD * width * Math.cos(heading), AHEAD * height * Math.sin(heading)];
  }

  /** Move the view with the car. */
  step(ego, now) {
    const passed = Math.min(now - this.then, 100);
    this.then = now;
    if (!this.on || !ego) return void (this.settled = true);
    const { view } = this;
    const aim = this.leadFor(ego).map((pixels) => pixels / view.scale);
    const part = this.lead && !view.still.matches ? 1 - Math.exp(-passed / SETTLE) : 1;
    this.lead ??= aim;
    this.lead = this.lead.map((from, i) => from + (aim[i] - from) * part);
    this.settled = Math.hypot(aim[0] - this.lead[0], aim[1] - this.lead[1]) * view.scale < 0.5;
    [view.x, view.y] = [ego.x + this.lead[0], ego.y + this.lead[1]];
  }
}
