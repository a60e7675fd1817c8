/** What stands over and around the canvas: buttons, badge, legend, scale bar, and all of it in words. */

import { createBadge, createControls } from "./controls.js";
import { boundsOfEvidence } from "./ghosts.js";
import { createLegend } from "./legend.js";
import { createSummary } from "./summary.js";

export class Around {
  /**
   * @param store @param view see store.js, view.js
   * @param on what the buttons do: see `createControls`
   * @param {() => void} moved is called when something takes another place over the canvas
   */
  constructor(store, view, on, moved) {
    Object.assign(this, { store, view });
    this.taken = null; // rectangles under controls; null: to be measured
    this.controls = createControls(on);
    this.legend = createLegend(() => (this.forget(), moved()), matchMedia("(max-width: 700px)").matches);
    this.badge = createBadge();
    this.summary = createSummary("map-in-words");
    this.over = [this.badge.element, this.legend.element, this.controls.bar, this.controls.element];
    this.elements = [...this.over, this.summary.element, this.summary.said];
  }

  /** What is over the canvas has to be measured anew. */
  forget() {
    this.taken = null;
  }

  /**
   * Bring it up to date.
   * @param {HTMLElement} element of the map
   * @param drawn what is on the map: see `drawPicture`
   * @param {number|null} spacing [m] of the grid that stands in for roads
   */
  update(element, { scene, drawn, spacing }) {
    const { store, view } = this;
    element.dataset.car = store.latest?.state === "ended" ? "there" : store.status.car; // it may go home after its ride
    element.dataset.empty = String(!scene);
    this.badge.update(store);
    this.legend.update(drawn.kinds, spacing);
    this.controls.scale(view.scale);
    const compared = drawn.fact + drawn.ghost > 0 && boundsOfEvidence(store.evidence);
    this.controls.comparing(Boolean(compared) && !view.holds(compared));
  }

  /** Tell in words what is on the map, where that is due. */
  tell(scene, roads, now) {
    if (!this.summary.due(now)) return;
    const { live, latest, status, at } = this.store;
    const words = this.store.decisionAt(at)?.words ?? "";
    const gone = status.car === "gone" || status.car === "coming";
    this.summary.update({ ...scene, live, state: latest.state, gone, roads, words }, now);
  }

  /** Rectangles [left, top, right, bottom] of the canvas that something stands over. */
  rectangles(element) {
    this.taken ??= this.measured(element.getBoundingClientRect());
    return this.taken;
  }

  measured({ left, top }) {
    const boxes = this.over.filter((one) => one.offsetWidth > 0).map((one) => one.getBoundingClientRect());
    return boxes.map((box) => [box.left - left, box.top - top, box.right - left, box.bottom - top]);
  }
}
