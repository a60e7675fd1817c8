/** Going through time on the timeline: by pointer, finger and keyboard. */

import { lastUpTo } from "../store.js";
import { fill, h, on } from "../dom.js";
import { clamped, clock } from "../figures.js";
import { between, nearest } from "./span.js";

const STILL = 5; // [px] a pointer that moved less has clicked
const NEAR = 9; // [px] from what is meant
const STEPS = { ArrowLeft: -0.2, ArrowDown: -0.2, ArrowRight: 0.2, ArrowUp: 0.2 }; // [s]
const FARTHER = 5; // times, with Shift

export class Scrubbing {
  from = null; // [px] where the pointer was pressed

  /**
   * @param {object} parts elements of the timeline
   * @param {object} view the stretch that it shows
   * @param {import("../store.js").Store} store
   * @param {{stop: () => void}} player
   */
  constructor(parts, view, store, player) {
    Object.assign(this, { parts, view, store, player });
    const { track, overviewBox } = parts;
    track.addEventListener("pointerdown", (event) => this.press(event));
    track.addEventListener("pointermove", (event) => this.move(event));
    track.addEventListener("pointerup", (event) => this.release(event));
    track.addEventListener("pointercancel", () => this.letGo());
    track.addEventListener("keydown", (event) => this.type(event));
    track.addEventListener("focus", () => track.matches(":focus-visible") && this.tipOfMoment());
    on(track, "pointerleave blur", () => this.hideTip());
    overviewBox.addEventListener("pointerdown", (event) => overviewBox.setPointerCapture(event.pointerId));
    on(overviewBox, "pointerdown pointermove", (event) => event.buttons & 1 && this.to(this.farTime(event)));
  }

  goLive() {
    this.player.stop();
    this.view.said = 0;
    this.store.goLive();
    this.parts.track.focus({ preventScroll: true }); // its button is about to go
  }

  /** Show a moment; the latest one is live. */
  to(t) {
    this.player.stop();
    this.view.said = 0;
    if (t >= this.store.span[1] - 0.05) this.store.goLive();
    else this.store.seek(t);
  }

  press(event) {
    if (event.button !== 0 || !this.store.latest) return;
    this.parts.track.setPointerCapture(event.pointerId);
    this.from = event.clientX;
    this.view.dragged = false;
  }

  move(event) {
    if (this.from === null) return void this.tipAt(event);
    if (!this.view.dragged && Math.abs(event.clientX - this.from) < STILL) return;
    this.view.dragged = true;
    this.hideTip();
    this.to(this.timeAt(event));
  }

  release(event) {
    if (this.from === null) return;
    const clicked = !this.view.dragged;
    this.letGo();
    if (!clicked) return;
    const { t, turn } = this.meant(event);
    this.to(t);
    if (turn) this.store.show(turn.n);
  }

  letGo() {
    this.from = null;
    this.view.dragged = false;
  }

  timeAt({ clientX }) {
    const { start, length, width } = this.view;
    return start + ((clientX - this.parts.track.getBoundingClientRect().left) / Math.max(width, 1)) * length;
  }

  farTime({ clientX }) {
    const { left, width } = this.parts.overviewBox.getBoundingClientRect();
    return this.view.first + ((clientX - left) / width) * this.view.lasts;
  }

  /** What a pointer is at: {t, decision?, turn?, bar?, event?}. */
  meant(pointer) {
    const { view, store } = this;
    const { lanes, bars = [], turns = [] } = view;
    const t = this.timeAt(pointer);
    const y = pointer.clientY - this.parts.track.getBoundingClientRect().top;
    const near = (NEAR / Math.max(view.width, 1)) * view.length;
    const closest = (items) => {
      const one = items[nearest(items, t)];
      return one && Math.abs(one.t - t) <= near ? one : null;
    };
    if (y >= lanes.asked) {
      const turn = closest(turns);
      return { t: turn?.t ?? t, turn };
    }
    if (y >= lanes.decided) {
      const around = between(store.decisions, t - near, t + near);
      const decision = closest(around.filter((one) => one.changed)) ?? closest(around);
      return { t: decision?.t ?? t, decision };
    }
    if (y < lanes.done) return { t };
    const bar = bars[lastUpTo(bars, t, (one) => one.from)];
    const event = closest(store.events.filter((one) => one.kind === "gave-way"));
    return { t, event, bar: bar && t <= bar.to ? bar : null };
  }

  tipAt(event) {
    if (event.pointerType === "touch") return;
    const thing = this.meant(event);
    const words = wordsOf(thing);
    if (words) this.showTip(words, thing.t);
    else this.hideTip();
  }

  tipOfMoment() {
    const decision = this.store.decisionAt(this.store.at);
    if (decision) this.showTip(wordsOf({ decision }), this.store.at);
  }

  showTip([head, text], t) {
    const { tip } = this.parts;
    const { start, length, width } = this.view;
    fill(tip, h("strong", head), h("span", text));
    tip.hidden = false;
    const half = tip.offsetWidth / 2;
    tip.style.left = `${clamped(((t - start) / length) * width, half, Math.max(width - half, half))}px`;
  }

  hideTip() {
    this.parts.tip.hidden = true;
  }

  type(event) {
    const { store } = this;
    if (event.ctrlKey || event.altKey || event.metaKey || !store.latest) return;
    if (event.key in STEPS) this.to(store.at + STEPS[event.key] * (event.shiftKey ? FARTHER : 1));
    else if (event.key === "PageUp") this.to(changed(store, -1));
    else if (event.key === "PageDown") this.to(changed(store, 1));
    else if (event.key === "Home") this.to(store.span[0]);
    else if (event.key === "End") this.goLive();
    else return;
    event.preventDefault();
    event.stopPropagation();
    requestAnimationFrame(() => requestAnimationFrame(() => this.tipOfMoment()));
  }
}

/** Headline and text about what a pointer is at; null: there is nothing to say. */
function wordsOf({ decision, turn, bar, event }) {
  if (turn) return [`Asked at ${clock(turn.t)}`, turn.text];
  if (decision) {
    const another = decision.changed ? ", another plan" : "";
    return [`Decision ${decision.number} at ${clock(decision.t, 1)}${another}`, decision.words];
  }
  if (event) return [`At ${clock(event.t, 1)}`, event.words];
  return bar ? [`From ${clock(bar.from, 1)} ${bar.open ? "on" : `to ${clock(bar.to, 1)}`}`, bar.words] : null;
}

/** When [s] the plan changed before or after the moment shown; the latest moment after the last. */
function changed(store, way) {
  const known = store.decisions.filter((one) => one.changed);
  const index = lastUpTo(known, store.at + (way < 0 ? -1e-3 : 0));
  const one = known[way < 0 ? index : index + 1];
  return one ? one.t : store.span[way < 0 ? 0 : 1];
}
