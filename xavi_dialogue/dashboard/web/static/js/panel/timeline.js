/** The ride in time: what was done, decided and asked, and the moment that is shown. */

import { eachFrame, fill, h, say, set } from "../dom.js";
import { clock, seconds } from "../figures.js";
import { isFinished, standing, wayBack } from "../standing.js";
import { lower } from "../words.js";
import { drawLanes, drawOverview, lanesFor } from "./lanes.js";
import { createPlayer } from "./player.js";
import { createScrubbing } from "./scrubbing.js";
import { lengthFor, manoeuvres, startFor } from "./span.js";

const SAID_EACH = 1000; // [ms] at most so often a screen reader is told where live is
/** How the latest moment is called; those at which there is nothing to come have no plan beside it. */
const LATEST = {
  live: "Live",
  playing: "Latest",
  paused: "Paused",
  over: "Ride over",
  played: "Recording ended",
  coming: "Car starting",
};
const GOES_ON = new Set(["live", "playing", "paused"]);
const TICKING = ["ride", "decisions", "events", "turns", "shown", "moment", "scene", "status"];

/**
 * Fill an element with the timeline.
 * @param {HTMLElement} element
 * @param {Store} store
 * @returns {{element: HTMLElement, view: () => object}} `view`: the stretch shown, for tests
 */
export function createTimeline(element, store) {
  const parts = build();
  const view = { start: null, length: 120, width: 0, lanes: lanesFor(600), dragged: false, stale: true, said: 0 };
  const player = createPlayer(store, () => draw());
  const draw = eachFrame(() => render(parts, view, store, player));
  const scrubbing = createScrubbing(parts, view, store, player);
  parts.play.addEventListener("click", () => player.toggle());
  parts.back.addEventListener("click", () => scrubbing.goLive());
  for (const name of TICKING)
    store.addEventListener(name, () => {
      if (name !== "moment" && name !== "scene") view.stale = true;
      if (name === "ride") view.start = null;
      draw();
    });
  new ResizeObserver(() => {
    view.stale = true;
    draw();
  }).observe(parts.track);
  element.classList.add("timeline");
  fill(element, parts.bar, parts.body, parts.overviewBox);
  draw();
  return { element, view: () => ({ ...view, playing: player.playing }) };
}

function build() {
  const play = h("button", { type: "button", class: "timeline-play" });
  const back = h("button", { type: "button", class: "timeline-live", hidden: true }, "Back to live");
  const now = h("span", { class: "timeline-now" });
  const words = h("span", { class: "timeline-words" });
  const svg = h("svg", { class: "timeline-lanes", "aria-hidden": "true" });
  const inForce = h("div", { class: "timeline-in-force" });
  const playhead = h("div", { class: "timeline-playhead" }, h("span", { class: "timeline-knob" }));
  const tip = h("div", { class: "timeline-tip", "aria-hidden": "true", hidden: true });
  const track = h(
    "div",
    {
      class: "timeline-track",
      role: "slider",
      tabindex: "0",
      "aria-label": "Moment of the ride",
      "aria-orientation": "horizontal",
    },
    inForce,
    svg,
    playhead,
    tip,
  );
  const names = ["What I did", "Decisions", "Asked"].map((name) => h("span", {}, name));
  const overview = h("svg", { class: "timeline-overview", height: 20, "aria-hidden": "true" });
  const overviewAt = h("div", { class: "timeline-overview-at" });
  return {
    play,
    back,
    now,
    words,
    svg,
    inForce,
    playhead,
    tip,
    track,
    overview,
    overviewAt,
    bar: h("div", { class: "timeline-bar" }, play, now, words, back),
    body: h(
      "div",
      { class: "timeline-body" },
      h("div", { class: "timeline-names", "aria-hidden": "true" }, names),
      track,
    ),
    overviewBox: h("div", { class: "timeline-overview-box", hidden: true }, overview, overviewAt),
    names,
  };
}

function render(parts, view, store, player) {
  const [first, last] = store.span;
  const width = Math.floor(parts.track.clientWidth);
  const length = lengthFor(width, last - first + 1);
  const moved = startFor({
    ...view,
    start: length === view.length ? view.start : null,
    length,
    first,
    last,
    at: store.at,
    live: store.live,
  });
  if (moved !== view.start || length !== view.length || width !== view.width) view.stale = true;
  Object.assign(view, { start: moved, length, width, first, last, lasts: Math.max(last, moved + length) - first });
  if (view.stale && width) lay(parts, view, store);
  growing(parts, view, store);
  place(parts, view, store);
  tell(parts, view, store, player);
}

/** Everything that does not move with the moment. */
function lay(parts, view, store) {
  view.stale = false;
  view.lanes = lanesFor(view.width);
  view.turns = store.turns
    .filter((one) => one.reply.sim_time >= view.first - 1e-6 && one.reply.sim_time <= view.last + 1)
    .map((one) => ({ t: one.reply.sim_time, n: one.n, text: one.text }))
    .sort((a, b) => a.t - b.t);
  view.bars = manoeuvres(store.events, view.last);
  const what = { ...view, events: store.events, decisions: store.decisions, shown: store.turn };
  drawLanes(parts.svg, what);
  const { lanes } = view;
  parts.track.style.height = `${lanes.height}px`;
  [lanes.done, lanes.decided, lanes.asked].forEach((top, k) => (parts.names[k].style.top = `${top + 3}px`));
  const longer = view.last - view.first > view.length;
  parts.overviewBox.hidden = !longer;
  if (longer) drawOverview(parts.overview, { ...what, width: parts.overviewBox.clientWidth });
}

/** The bar of what is under way reaches to now; only once in a while does it get other words. */
function growing(parts, view, store) {
  const open = view.bars?.at(-1);
  if (!open?.open || !view.width) return;
  if (view.last - open.to > 1) lay(parts, view, store);
  const wide = (Math.min(view.last, view.start + view.length) - Math.max(open.from, view.start)) / view.length;
  for (const part of wide > 0 ? parts.svg.querySelectorAll(".lane-open rect") : []) {
    part.setAttribute("width", Math.max(wide * view.width - 1 - Number(part.getAttribute("x") ?? 0), 1));
  }
}

function place(parts, view, store) {
  const x = (t) => ((t - view.start) / view.length) * view.width;
  const at = Math.min(Math.max(x(store.at), 0), view.width);
  parts.playhead.style.transform = `translateX(${at}px)`;
  const decision = store.decisionAt(store.at);
  const next = decision ? store.decisions[store.decisions.indexOf(decision) + 1] : null;
  parts.inForce.hidden = !decision;
  if (decision) {
    const from = Math.max(x(decision.t), 0);
    const to = Math.min(x(next ? next.t : Math.max(store.at, decision.t)), view.width);
    parts.inForce.style.transform = `translateX(${from}px)`;
    parts.inForce.style.width = `${Math.max(to - from, 2)}px`;
    parts.inForce.style.top = `${view.lanes.decided}px`;
    parts.inForce.style.height = `${view.lanes.ends.decided - view.lanes.decided}px`;
  }
  parts.overviewAt.style.left = `${((store.at - view.first) / view.lasts) * 100}%`;
}

function tell(parts, view, store, player) {
  const empty = !store.latest && !store.decisions.length;
  const decision = store.decisionAt(store.at);
  const ago = store.span[1] - store.at;
  say(parts.now, empty ? "–:––" : clock(store.at, 1));
  say(parts.words, empty ? "Nothing has happened yet." : sentence(store, decision, ago));
  parts.back.hidden = store.live;
  parts.play.disabled = empty;
  set(parts.track, "data-empty", empty ? "yes" : null);
  say(parts.back, wayBack(store));
  const running = player.playing || (store.live && !isFinished(store));
  set(parts.play, "aria-label", playing(store, player));
  set(parts.play, "title", parts.play.getAttribute("aria-label"));
  set(parts.play, "data-state", running ? "pause" : "play");
  set(parts.track, "data-live", store.live ? "yes" : "no");
  const now = performance.now();
  if (store.live && now - view.said < SAID_EACH) return;
  view.said = now;
  set(parts.track, "aria-valuemin", view.first.toFixed(1));
  set(parts.track, "aria-valuemax", view.last.toFixed(1));
  set(parts.track, "aria-valuenow", store.at.toFixed(1));
  set(parts.track, "aria-valuetext", valueText(store, decision));
}

/** What the button does that plays and holds. */
function playing(store, player) {
  if (player.playing) return "Pause";
  if (!store.live) return "Play from here";
  return isFinished(store) ? "Play it again" : "Hold this moment";
}

function sentence(store, decision, ago) {
  const stands = standing(store);
  if (store.live && !GOES_ON.has(stands)) return latest(store, stands);
  const when = store.live ? latest(store, stands) : `${seconds(ago)} ${isFinished(store) ? "before the end" : "ago"}`;
  return decision ? `${when} · ${lower(decision.words)}` : when;
}

function latest(store, stands) {
  if (stands === "gone") return `Car gone, last seen at ${clock(store.at)}`;
  if (stands === "unheard") return `Not connected, last heard at ${clock(store.at)}`;
  return LATEST[stands] ?? "";
}

function valueText(store, decision) {
  const when = `${clock(store.at, 1)}${store.live ? `, ${lower(latest(store, standing(store)))}` : ""}`;
  return decision ? `${when}, decision ${decision.number}: ${lower(decision.words)}` : when;
}
