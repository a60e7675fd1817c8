/** How well the map keeps up: figures of the frames drawn, for benches. */

const SPAN = 2000; // [ms] that rates are taken over

export class Pace {
  count = 0;
  recent = []; // [ms] when frames were drawn
  draw = 0; // [ms] of a frame, smoothed
  worst = 0; // [ms] the longest frame so far
  latest = null; // {seq, wall, drawn}
  reached = null; // {seq, wall, drawn}

  /** A frame was drawn. */
  frame(began, ended) {
    this.count += 1;
    this.recent.push(began);
    while (this.recent.length && this.recent[0] < began - SPAN) this.recent.shift();
    const took = ended - began;
    this.draw = this.count === 1 ? took : this.draw + 0.1 * (took - this.draw);
    this.worst = Math.max(this.worst, took);
  }

  /** A frame was drawn on the way to the latest live scene, from one that it has come up to. */
  painted(latest, reached) {
    const drawn = performance.timeOrigin + performance.now();
    if (this.latest?.seq !== latest.seq) this.latest = { seq: latest.seq, wall: latest.wall, drawn };
    if (this.reached?.seq !== reached.seq) this.reached = { seq: reached.seq, wall: reached.wall, drawn };
  }

  /** Frames a second of late. */
  rate(now) {
    const frames = this.recent.filter((at) => at >= now - SPAN);
    const span = frames.length > 1 ? frames.at(-1) - frames[0] : 0;
    return span > 0 ? ((frames.length - 1) * 1000) / span : 0;
  }

  /** See `createMap`. */
  figures(now) {
    return {
      count: this.count,
      fps: this.rate(now),
      worst_ms: this.worst,
      draw_ms: this.draw,
      latest_scene: this.latest && { ...this.latest },
      reached_scene: this.reached && { ...this.reached },
    };
  }
}
