/** What people do with the view: move it, zoom, follow our car, show everything. */

const STEP = 1.5; // of the scale, by buttons and keys

export class Steering {
  /**
   * @param following see following.js
   * @param framing see framing.js: who zooms has chosen a scale
   * @param {() => object|undefined} ego our car as it is drawn
   * @param {(following: boolean) => void} changed is called after each change
   */
  constructor(view, following, framing, ego, changed) {
    Object.assign(this, { view, following, framing, ego, changed });
  }

  /** Whether the view moves with our car now. */
  get carried() {
    return this.following.on && this.ego() !== undefined;
  }

  /** Let the map follow our car; without an argument, switch to and fro. */
  follow(on = !this.following.on) {
    if (on && !(this.following.on && this.framing.on)) this.framing.reset(false);
    this.following.set(on, this.ego());
    this.changed(on);
  }

  /** Show bounds [left, bottom, right, top] in metres, whole; null: there are none. */
  fit(bounds) {
    if (!bounds) return;
    this.follow(false);
    this.view.fit(bounds, performance.now());
  }

  /** Move by pixels; two fingers that zoom do not leave our car for it. */
  pan(dx, dy, pinching) {
    if (pinching && this.following.on) return;
    this.follow(false);
    this.view.pan(dx, dy);
  }

  zoomIn() {
    this.zoom(STEP);
  }

  zoomOut() {
    this.zoom(1 / STEP);
  }

  /** Zoom by a factor about the middle, or our car where it is followed. */
  zoom(factor) {
    this.framing.leave();
    const { x, y, aim } = this.view;
    const centre = this.carried ? {} : { x, y };
    this.view.glideTo({ ...centre, scale: aim * factor }, performance.now());
    this.changed(this.following.on);
  }

  /** Zoom about a place of the canvas [px], or our car where it is followed. */
  zoomAt(factor, px, py) {
    this.framing.leave();
    const before = this.view.scale;
    if (this.carried) this.view.jump({ scale: before * factor });
    else this.view.zoomAt(factor, px, py);
    this.following.zoomed(this.view.scale / before);
    this.changed(this.following.on);
  }
}
