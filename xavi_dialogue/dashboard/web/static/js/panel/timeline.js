/** The ride in time: what was done, decided and asked, and the moment that is shown. */

import { eachFrame, on, partsOf, say, set, setAll } from "../dom.js";
import { clamped, clock, seconds } from "../figures.js";
import { isFinished, standing, wayBack } from "../standing.js";
import { lower } from "../words.js";
import { drawLanes, drawOverview, lanesFor } from "./lanes.js";
import { createPlayer } from "./player.js";
import { Scrubbing } from "./scrubbing.js";
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

/**
 * @param {HTMLElement} element
 * @param {import("../store.js").Store} store
 * @returns {{element: HTMLElement, view: () => object}} `view`: the stretch shown, for tests
 */
export function createTimeline(element, store) {
  const timeline = new Timeline(element, store);
  return { element, view: () => ({ ...timeline.view, playing: timeline.player.playing }) };
}

class Timeline {
  view = { start: null, length: 120, width: 0, lanes: lanesFor(600), dragged: false, stale: true, said: 0 };

  constructor(element, store) {
    this.store = store;
    this.parts = partsOf(element);
    const { play, back, track } = this.parts;
    const draw = eachFrame(() => this.render());
    const drawAnew = () => {
      this.view.stale = true;
      draw();
    };
    this.player = createPlayer(store, draw);
    this.scrubbing = new Scrubbing(this.parts, this.view, store, this.player);
    play.addEventListener("click", () => this.player.toggle());
    back.addEventListener("click", () => this.scrubbing.goLive());
    store.addEventListener("ride", () => void (this.view.start = null));
    on(store, "ride decisions events turns shown status", drawAnew);
    on(store, "moment scene", draw);
    new ResizeObserver(drawAnew).observe(track);
    draw();
  }

  render() {
    const { parts, view, store } = this;
    const [first, last] = store.span;
    const width = Math.floor(parts.track.clientWidth);
    const length = lengthFor(width, last - first + 1);
    const before = length === view.length ? view.start : null;
    const start = startFor({ ...view, start: before, length, first, last, at: store.at, live: store.live });
    if (start !== view.start || length !== view.length || width !== view.width) view.stale = true;
    Object.assign(view, { start, length, width, first, last, lasts: Math.max(last, start + length) - first });
    if (view.stale && width) this.lay();
    this.grow();
    this.place();
    this.tell();
  }

  /** Everything that does not move with the moment. */
  lay() {
    const { parts, view, store } = this;
    view.stale = false;
    view.lanes = lanesFor(view.width);
    view.turns = store.turns
      .map(({ n, text, reply }) => ({ t: reply.sim_time, n, text }))
      .filter(({ t }) => t >= view.first - 1e-6 && t <= view.last + 1)
      .sort((a, b) => a.t - b.t);
    view.bars = manoeuvres(store.events, view.last);
    const what = { ...view, events: store.events, decisions: store.decisions, shown: store.turn };
    drawLanes(parts.lanes, what);
    const { done, decided, asked, height } = view.lanes;
    parts.track.style.height = `${height}px`;
    [done, decided, asked].forEach((top, k) => (parts.names.children[k].style.top = `${top + 3}px`));
    const longer = view.last - view.first > view.length;
    parts.overviewBox.hidden = !longer;
    if (longer) drawOverview(parts.overview, { ...what, width: parts.overviewBox.clientWidth });
  }

  /** Let the bar of what is under way reach to now; only once in a while does it get other words. */
  grow() {
    const { parts, view } = this;
    const open = view.bars?.at(-1);
    if (!open?.open || !view.width) return;
    if (view.last - open.to > 1) this.lay();
    const wide = (Math.min(view.last, view.start + view.length) - Math.max(open.from, view.start)) / view.length;
    for (const part of wide > 0 ? parts.lanes.querySelectorAll(".lane-open rect") : []) {
      set(part, "width", Math.max(wide * view.width - 1 - Number(part.getAttribute("x") ?? 0), 1));
    }
  }

  /** Put the playhead and the decision in force where they belong. */
  place() {
    const { parts, view, store } = this;
    const x = (t) => ((t - view.start) / view.length) * view.width;
    parts.playhead.style.transform = `translateX(${clamped(x(store.at), 0, view.width)}px)`;
    parts.overviewAt.style.left = `${((store.at - view.first) / view.lasts) * 100}%`;
    const decision = store.decisionAt(store.at);
    parts.inForce.hidden = !decision;
    if (!decision) return;
    const next = store.decisions[store.decisions.indexOf(decision) + 1];
    const from = Math.max(x(decision.t), 0);
    const to = Math.min(x(next ? next.t : Math.max(store.at, decision.t)), view.width);
    Object.assign(parts.inForce.style, {
      transform: `translateX(${from}px)`,
      width: `${Math.max(to - from, 2)}px`,
      top: `${view.lanes.decided}px`,
      height: `${view.lanes.ends.decided - view.lanes.decided}px`,
    });
  }

  tell() {
    const { store, player, view } = this;
    const { now, words, back, play, track } = this.parts;
    const empty = !store.latest && !store.decisions.length;
    const decision = store.decisionAt(store.at);
    const running = player.playing || (store.live && !isFinished(store));
    const does = playing(store, player);
    say(now, empty ? "–:––" : clock(store.at, 1));
    say(words, empty ? "Nothing has happened yet." : sentence(store, decision));
    say(back, wayBack(store));
    back.hidden = store.live;
    play.disabled = empty;
    setAll(play, { "aria-label": does, title: does, "data-state": running ? "pause" : "play" });
    setAll(track, { "data-empty": empty && "yes", "data-live": store.live ? "yes" : "no" });
    if (store.live && performance.now() - view.said < SAID_EACH) return;
    view.said = performance.now();
    setAll(track, {
      "aria-valuemin": view.first.toFixed(1),
      "aria-valuemax": view.last.toFixed(1),
      "aria-valuenow": store.at.toFixed(1),
      "aria-valuetext": valueText(store, decision),
    });
  }
}

/** What the button does that plays and holds. */
function playing(store, player) {
  if (player.playing) return "Pause";
  if (!store.live) return "Play from here";
  return isFinished(store) ? "Play it again" : "Hold this moment";
}

function sentence(store, decision) {
  if (store.live && !GOES_ON.has(standing(store))) return latest(store);
  const ago = `${seconds(store.span[1] - store.at)} ${isFinished(store) ? "before the end" : "ago"}`;
  const when = store.live ? latest(store) : ago;
  return decision ? `${when} · ${lower(decision.words)}` : when;
}

function latest(store) {
  const stands = standing(store);
  if (stands === "gone") return `Car gone, last seen at ${clock(store.at)}`;
  if (stands === "unheard") return `Not connected, last heard at ${clock(store.at)}`;
  return LATEST[stands] ?? "";
}

function valueText(store, decision) {
  const when = `${clock(store.at, 1)}${store.live ? `, ${lower(latest(store))}` : ""}`;
  return decision ? `${when}, decision ${decision.number}: ${lower(decision.words)}` : when;
}
