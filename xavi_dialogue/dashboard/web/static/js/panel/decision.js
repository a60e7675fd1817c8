/** The decision in force at the moment shown: its plan, what else there was, and why. */

import { eachFrame, fill, h, set } from "../dom.js";
import { createAwaited } from "../awaited.js";
import { createAlternatives } from "./alternatives.js";
import { createBranches } from "./branches.js";
import { createHead } from "./head.js";
import { createPredictions } from "./predictions.js";
import { staying } from "./staying.js";

const LIVE_EACH = 950; // [ms] between decisions while they come by themselves
const HELD_EACH = 120; // [ms] while the reader goes through time
const MOVE_EACH = 250; // [ms] between movements of the line in the charts
const PATIENCE = 300; // [ms] before it is said that something is being fetched

/**
 * Fill an element with the decision panel.
 * @param {HTMLElement} element
 * @param {Store} store
 * @returns {{element: HTMLElement, shown: () => object}} `shown`: {state, id}, for tests
 */
export function createDecision(element, store) {
  const panel = assemble(element, store);
  const follow = () => wanted(panel, store);
  const move = eachFrame(() => moveCharts(panel, store));
  for (const name of ["moment", "decisions"]) store.addEventListener(name, follow);
  for (const name of ["moment", "shown", "pointed", "decisions"]) store.addEventListener(name, move);
  store.addEventListener("ride", () => {
    Object.assign(panel, { shown: null, asked: null, full: false });
    panel.predictions.forget();
    panel.alternatives.clear();
    follow();
  });
  store.addEventListener("status", () => panel.state === "failed" && store.status.connected && retry(panel, store));
  new ResizeObserver(follow).observe(element); // it may have been behind a tab
  follow();
  return { element, shown: () => ({ state: panel.state, id: panel.shown }) };
}

function assemble(element, store) {
  const panel = {
    element,
    head: createHead(store),
    alternatives: createAlternatives(store),
    predictions: createPredictions(store),
    branches: createBranches(),
    notice: h("div", { class: "decision-notice", role: "status" }),
    again: h("button", { type: "button" }, "Try again"),
    state: "none",
    shown: null,
    full: false,
    asked: null,
    busy: false,
    at: 0,
    moved: 0,
    timer: 0,
  };
  panel.sections = {
    alternatives: section("What else I could have done", panel.alternatives.element),
    predictions: section("What I expect the others to do", panel.predictions.element),
    branches: section("How I searched", panel.branches.element),
  };
  panel.again.addEventListener("click", () => retry(panel, store));
  element.classList.add("decision");
  fill(element, panel.head.element, panel.notice, Object.values(panel.sections));
  show(panel, "none", store);
  return panel;
}

function retry(panel, store) {
  panel.asked = null;
  wanted(panel, store);
}

function section(title, content) {
  return h("details", { class: "decision-part", open: true }, h("summary", {}, h("h3", {}, title)), content);
}

/** Another decision may be in force: show it when its turn comes, one at a time. */
function wanted(panel, store) {
  const decision = store.decisionAt(store.at);
  panel.head.move(decision);
  if (!decision) {
    panel.shown = panel.asked = null;
    if (panel.state !== "none") show(panel, "none", store);
    else notice(panel, "none", store);
    return;
  }
  if (decision.id === panel.asked || panel.busy || panel.timer || isHidden(panel)) return;
  const wait = panel.at + (store.live ? LIVE_EACH : HELD_EACH) - performance.now();
  if (wait <= 0 || panel.shown === null) return void load(panel, store, decision);
  panel.timer = setTimeout(() => {
    panel.timer = 0;
    wanted(panel, store);
  }, wait);
}

async function load(panel, store, decision) {
  panel.busy = true;
  panel.asked = decision.id;
  const ride = store.ride;
  const slow = setTimeout(() => show(panel, "loading", store, decision), panel.shown ? PATIENCE : 0);
  try {
    const whole = await store.detail(decision.id);
    if (store.ride === ride) show(panel, whole ? "shown" : "gone", store, decision, whole);
  } catch (error) {
    if (store.ride === ride) show(panel, isGone(error) ? "gone" : "failed", store, decision);
  } finally {
    clearTimeout(slow);
    panel.busy = false;
    panel.at = performance.now();
    wanted(panel, store);
  }
}

/** Whether it is behind a tab: nothing is fetched or drawn for nobody. */
function isHidden(panel) {
  return panel.element.offsetParent === null;
}

function isGone(error) {
  return error?.status === 404 || error?.status === 410;
}

function show(panel, ...what) {
  staying(panel.element, () => draw(panel, ...what));
}

function draw(panel, state, store, decision = null, whole = null) {
  panel.state = state;
  const known = state === "shown" || (state === "loading" && panel.full);
  set(panel.element, "data-state", state);
  set(panel.element, "aria-busy", state === "loading" ? "true" : null);
  if (state !== "loading" || !known) panel.head.show(decision, whole);
  for (const [name, part] of Object.entries(panel.sections))
    part.hidden = !known && (name !== "predictions" || !decision);
  notice(panel, state, store);
  if (state === "none" || state === "loading") return;
  panel.shown = decision.id;
  panel.full = whole !== null;
  if (whole) {
    panel.alternatives.update(whole);
    panel.branches.update(whole);
  } else panel.alternatives.clear();
  panel.predictions.update(whole ? whole.predictions : fromBeliefs(decision), whole ? inTheWay(whole) : []);
}

/** What is told of others where the decision itself is gone: what came with it in short. */
function fromBeliefs({ beliefs }) {
  const goal = ([words, probability]) => ({ kind: words, words, place: "", probability });
  return beliefs.map(({ vehicle, goals }) => ({
    vehicle,
    goals: goals.map(goal).sort((a, b) => b.probability - a.probability),
  }));
}

/** Vehicles by how much they were in our way: right of way first, then who held up rollouts. */
function inTheWay({ right_of_way: right, root }) {
  const shares = new Map();
  for (const branch of root)
    for (const [vehicle, , share] of branch.held_up)
      shares.set(vehicle, (shares.get(vehicle) ?? 0) + share * (branch.visits + branch.forced));
  const holding = [...shares].sort((a, b) => b[1] - a[1]).map(([vehicle]) => vehicle);
  return [...new Set([...(right?.vehicles ?? []), ...holding])];
}

function notice(panel, state, store) {
  const first = panel.shown === null;
  const nothing = store.latest
    ? "I have not decided anything yet. My first decision will be here in a moment."
    : "As soon as the car drives, what it decides and why will be here.";
  const said = {
    none: [fork(), h("p", { class: "decision-empty" }, "No decision yet"), h("p", { class: "quiet" }, nothing)],
    loading: first ? [createAwaited("Fetching the decision", 6)] : [],
    gone: [
      h("p", {}, "The record of this decision is not here any more."),
      h("p", { class: "quiet" }, "What it came to, and what I expected of the others, is still known."),
    ],
    failed: [h("p", {}, "The record of this decision could not be fetched."), panel.again],
  };
  if (panel.noticed === `${state} ${first} ${nothing}`) return;
  panel.noticed = `${state} ${first} ${nothing}`;
  fill(panel.notice, said[state] ?? []);
  panel.notice.hidden = !panel.notice.childNodes.length;
}

/** A way that parts in three, one of them taken. */
function fork() {
  const way = (d, name) => h("path", { class: name, d });
  const ways = [
    way("M60,70 V44 C60,30 28,34 28,12", "fork"),
    way("M60,70 V44 C60,30 92,34 92,12", "fork"),
    way("M60,70 V12", "fork fork-taken"),
  ];
  return h(
    "svg",
    { class: "decision-fork", viewBox: "0 0 120 76", width: 120, height: 76, "aria-hidden": "true" },
    ways,
  );
}

function moveCharts(panel, store) {
  const now = performance.now();
  if (panel.state === "none" || isHidden(panel)) return;
  if (store.live && now - panel.moved < MOVE_EACH) return;
  panel.moved = now;
  staying(panel.element, () => panel.predictions.move());
}
