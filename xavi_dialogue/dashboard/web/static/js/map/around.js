/** What stands over and around the canvas: buttons, badge, legend, scale bar, and all of it in words. */

import { createLegend, showBadge, showScale } from "./controls.js";
import { boundsOfEvidence } from "./ghosts.js";
import { createSummary } from "./summary.js";

export class Around {
  taken = null; // rectangles under controls; null: to be measured

  /**
   * @param {object} parts of the map's element
   * @param store @param view see store.js, view.js
   * @param {Object<string, () => void>} does what the buttons do, by their names
   * @param {() => void} moved is called when something takes another place over the canvas
   */
  constructor(parts, store, view, does, moved) {
    Object.assign(this, { parts, store, view });
    const forgetting = () => {
      this.forget();
      moved();
    };
    this.legend = createLegend(parts, forgetting);
    this.summary = createSummary(parts);
    this.over = [parts.badge, parts.legend, parts.scale, parts.controls];
    for (const [name, act] of Object.entries(does)) parts[name].addEventListener("click", act);
  }

  /** What is over the canvas has to be measured anew. */
  forget() {
    this.taken = null;
  }

  updateBadge() {
    showBadge(this.parts, this.store);
  }

  /** Whether the map follows our car. */
  following(is) {
    this.parts.follow.ariaPressed = String(is);
  }

  /**
   * Bring it up to date.
   * @param {HTMLElement} element of the map
   * @param drawn what is on the map: see `drawPicture`
   * @param {number|null} spacing [m] of the grid that stands in for roads
   */
  update(element, { scene, drawn, spacing }) {
    const { store, view, parts } = this;
    element.dataset.car = store.latest?.state === "ended" ? "there" : store.status.car; // it may go home after its ride
    element.dataset.empty = String(!scene);
    this.updateBadge();
    this.legend.update(drawn.kinds, spacing);
    showScale(parts, view.scale);
    const compared = drawn.fact + drawn.ghost > 0 && boundsOfEvidence(store.evidence);
    parts.both.hidden = !compared || view.holds(compared);
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
