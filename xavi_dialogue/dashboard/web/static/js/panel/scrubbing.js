/** Going through time on the timeline: by pointer, finger and keyboard. */

import { lastUpTo } from "../store.js";
import { fill, h } from "../dom.js";
import { clock } from "../figures.js";
import { between, nearest } from "./span.js";

const STILL = 5; // [px] a pointer that moved less has clicked
const NEAR = 9; // [px] from what is meant
const STEPS = { ArrowLeft: -0.2, ArrowDown: -0.2, ArrowRight: 0.2, ArrowUp: 0.2 }; // [s]
const FARTHER = 5; // times, with Shift

/**
 * @param {object} parts elements of the timeline
 * @param {object} view the stretch that it shows
 * @param {Store} store
 * @param {{stop: () => void}} player
 */
export function createScrubbing(parts, view, store, player) {
  const here = { parts, view, store, player, from: null };
  const { track, overviewBox } = parts;
  track.addEventListener("pointerdown", (event) => pressed(here, event));
  track.addEventListener("pointermove", (event) => moved(here, event));
  track.addEventListener("pointerup", (event) => released(here, event));
  track.addEventListener("pointercancel", () => letGo(here));
  track.addEventListener("pointerleave", () => hideTip(here));
  track.addEventListener("keydown", (event) => typed(here, event));
  track.addEventListener("focus", () => track.matches(":focus-visible") && tipOfMoment(here));
  track.addEventListener("blur", () => hideTip(here));
  const far = (event) => event.buttons & 1 && to(here, ofOverview(here, event));
  overviewBox.addEventListener("pointerdown", (event) => {
    overviewBox.setPointerCapture(event.pointerId);
    far(event);
  });
  overviewBox.addEventListener("pointermove", far);
  return { goLive: () => live(here) };
}

function live({ store, player, parts, view }) {
  player.stop();
  view.said = 0;
  store.goLive();
  parts.track.focus({ preventScroll: true }); // its button is about to go
}

/** Show a moment; the latest one is live. */
function to(here, t) {
  here.player.stop();
  here.view.said = 0;
  if (t >= here.store.span[1] - 0.05) here.store.goLive();
  else here.store.seek(t);
}

function pressed(here, event) {
  if (event.button !== 0 || !here.store.latest) return;
  here.parts.track.setPointerCapture(event.pointerId);
  here.from = event.clientX;
  here.view.dragged = false;
}

function moved(here, event) {
  if (here.from === null) return tipAt(here, event);
  if (!here.view.dragged && Math.abs(event.clientX - here.from) < STILL) return undefined;
  here.view.dragged = true;
  hideTip(here);
  return to(here, timeAt(here, event));
}

function released(here, event) {
  if (here.from === null) return;
  const clicked = !here.view.dragged;
  letGo(here);
  if (clicked) go(here, meant(here, event));
}

function letGo(here) {
  here.from = null;
  here.view.dragged = false;
}

function go(here, thing) {
  to(here, thing.t);
  if (thing.turn) here.store.show(thing.turn.n);
}

function timeAt({ parts, view }, event) {
  const box = parts.track.getBoundingClientRect();
  return view.start + ((event.clientX - box.left) / Math.max(view.width, 1)) * view.length;
}

function ofOverview({ parts, view }, event) {
  const box = parts.overviewBox.getBoundingClientRect();
  return view.first + ((event.clientX - box.left) / box.width) * view.lasts;
}

/** What a pointer is at: {t, decision?, turn?, bar?, event?}. */
function meant(here, event) {
  const { view, store } = here;
  const t = timeAt(here, event);
  const y = event.clientY - here.parts.track.getBoundingClientRect().top;
  const near = (NEAR / Math.max(view.width, 1)) * view.length;
  if (y >= view.lanes.asked) {
    const turn = closest(view.turns ?? [], t, near);
    if (turn) return { t: turn.t, turn };
  } else if (y >= view.lanes.decided) {
    const around = between(store.decisions, t - near, t + near);
    const decision =
      closest(
        around.filter((one) => one.changed),
        t,
        near,
      ) ?? closest(around, t, near);
    if (decision) return { t: decision.t, decision };
  } else if (y >= view.lanes.done) {
    const event = closest(
      store.events.filter((one) => one.kind === "gave-way"),
      t,
      near,
    );
    const bar = view.bars?.[lastUpTo(view.bars, t, (one) => one.from)];
    return { t, event, bar: bar && t <= bar.to ? bar : null };
  }
  return { t };
}

function closest(items, t, near) {
  const one = items[nearest(items, t)];
  return one && Math.abs(one.t - t) <= near ? one : null;
}

function tipAt(here, event) {
  if (event.pointerType === "touch") return;
  const thing = meant(here, event);
  const words = wordsOf(thing);
  if (words.length) showTip(here, words, thing.t);
  else hideTip(here);
}

function wordsOf({ decision, turn, bar, event }) {
  if (turn) return [`Asked at ${clock(turn.t)}`, turn.text];
  if (decision)
    return [
      `Decision ${decision.number} at ${clock(decision.t, 1)}${decision.changed ? ", another plan" : ""}`,
      decision.words,
    ];
  if (event) return [`At ${clock(event.t, 1)}`, event.words];
  if (bar) return [`From ${clock(bar.from, 1)} ${bar.open ? "on" : `to ${clock(bar.to, 1)}`}`, bar.words];
  return [];
}

function tipOfMoment(here) {
  const decision = here.store.decisionAt(here.store.at);
  if (decision) showTip(here, wordsOf({ decision }), here.store.at);
}

function showTip({ parts, view }, [head, text], t) {
  fill(parts.tip, h("strong", {}, head), h("span", {}, text));
  parts.tip.hidden = false;
  const x = ((t - view.start) / view.length) * view.width;
  const half = parts.tip.offsetWidth / 2;
  parts.tip.style.left = `${Math.min(Math.max(x, half), Math.max(view.width - half, half))}px`;
}

function hideTip({ parts }) {
  parts.tip.hidden = true;
}

function typed(here, event) {
  if (event.ctrlKey || event.altKey || event.metaKey || !here.store.latest) return;
  const { store } = here;
  if (event.key in STEPS) to(here, store.at + STEPS[event.key] * (event.shiftKey ? FARTHER : 1));
  else if (event.key === "PageUp") to(here, changed(store, -1));
  else if (event.key === "PageDown") to(here, changed(store, 1));
  else if (event.key === "Home") to(here, store.span[0]);
  else if (event.key === "End") live(here);
  else return;
  event.preventDefault();
  event.stopPropagation();
  requestAnimationFrame(() => requestAnimationFrame(() => tipOfMoment(here)));
}

/** When [s] the plan changed before or after the moment shown; the latest moment after the last. */
function changed(store, way) {
  const known = store.decisions.filter((one) => one.changed);
  const index = lastUpTo(known, store.at + (way < 0 ? -1e-3 : 0));
  const one = known[way < 0 ? index : index + 1];
  return one ? one.t : store.span[way < 0 ? 0 : 1];
}
