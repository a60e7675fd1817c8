/** How well the map keeps up: figures of the frames drawn, for benches. */

const SPAN = 2000; // [ms] that rates are taken over

export class Pace {
  constructor() {
    this.count = 0;
    this.recent = []; // [ms] when frames were drawn
    this.draw = 0; // [ms] of a frame, smoothed
    this.worst = 0; // [ms] the longest frame so far
    this.scene = null; // {seq, wall, drawn, reached}
  }

  /** A frame was drawn. */
  frame(began, ended) {
    this.count += 1;
    this.recent.push(began);
    while (this.recent.length && this.recent[0] < began - SPAN) this.recent.shift();
    const took = ended - began;
    this.draw = this.count === 1 ? took : this.draw + 0.1 * (took - this.draw);
    this.worst = Math.max(this.worst, took);
  }

  /** A live scene took part in a frame; `whole`: it was drawn where it says, not on the way there. */
  painted(scene, whole) {
    const now = performance.timeOrigin + performance.now();
    if (this.scene?.seq !== scene.seq) this.scene = { seq: scene.seq, wall: scene.wall, drawn: now, reached: null };
    if (whole && this.scene.reached === null) this.scene.reached = now;
  }

  /** See `createMap`. */
  figures(now) {
    const frames = this.recent.filter((at) => at >= now - SPAN);
    const span = frames.length > 1 ? frames.at(-1) - frames[0] : 0;
    return {
      count: this.count,
      fps: span > 0 ? ((frames.length - 1) * 1000) / span : 0,
      worst_ms: this.worst,
      draw_ms: this.draw,
      latest_scene: this.scene && { ...this.scene },
    };
  }
}
