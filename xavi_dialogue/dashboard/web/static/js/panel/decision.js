/** The decision in force at the moment shown: its plan, what else there was, and why. */

import { awaited, copyOf, eachFrame, fill, h, on, partsOf, say, set } from "../dom.js";
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
 * @param {HTMLElement} element
 * @param {import("../store.js").Store} store
 * @returns {{element: HTMLElement, shown: () => object}} `shown`: {state, id}, for tests
 */
export function createDecision(element, store) {
  const panel = new Panel(element, store);
  return { element, shown: () => ({ state: panel.state, id: panel.shown }) };
}

class Panel {
  state = "none";
  shown = null; // id of the decision
  full = false; // whether all of it is shown
  asked = null; // id
  busy = false;
  at = 0; // [ms] when one was shown
  moved = 0; // [ms] when the charts were
  timer = 0;

  constructor(element, store) {
    Object.assign(this, { element, store });
    const named = [...element.children].map((one) => [one.dataset.section, one]);
    const { head, notice, ...sections } = Object.fromEntries(named);
    Object.assign(this, { notice, sections });
    this.head = createHead(head, store);
    this.alternatives = createAlternatives(sections.alternatives, store);
    this.predictions = createPredictions(sections.predictions, store);
    this.branches = createBranches(sections.branches);
    this.again = h("button", { onclick: () => this.retry() }, "Try again");
    this.show("none");
    const follow = () => this.follow();
    on(store, "moment decisions", follow);
    on(store, "moment shown pointed decisions", eachFrame(() => this.moveCharts()));
    store.addEventListener("ride", () => this.forget());
    store.addEventListener("status", () => this.state === "failed" && store.status.connected && this.retry());
    new ResizeObserver(follow).observe(element); // it may have been behind a tab
    follow();
  }

  /** Another ride. */
  forget() {
    Object.assign(this, { shown: null, asked: null, full: false });
    this.predictions.forget();
    this.alternatives.clear();
    this.follow();
  }

  retry() {
    this.asked = null;
    this.follow();
  }

  /** Another decision may be in force: show it when its turn comes, one at a time. */
  follow() {
    const { store } = this;
    const decision = store.decisionAt(store.at);
    this.head.move(decision);
    if (!decision) {
      this.shown = this.asked = null;
      if (this.state === "none") this.notify();
      else this.show("none");
      return;
    }
    if (decision.id === this.asked || this.busy || this.timer || this.isHidden) return;
    const wait = this.at + (store.live ? LIVE_EACH : HELD_EACH) - performance.now();
    if (wait <= 0 || this.shown === null) return void this.load(decision);
    this.timer = setTimeout(() => {
      this.timer = 0;
      this.follow();
    }, wait);
  }

  async load(decision) {
    this.busy = true;
    this.asked = decision.id;
    const { ride } = this.store;
    const slow = setTimeout(() => this.show("loading", decision), this.shown ? PATIENCE : 0);
    try {
      const whole = await this.store.detail(decision.id);
      if (this.store.ride === ride) this.show(whole ? "shown" : "gone", decision, whole);
    } catch (error) {
      const gone = error?.status === 404 || error?.status === 410;
      if (this.store.ride === ride) this.show(gone ? "gone" : "failed", decision);
    } finally {
      clearTimeout(slow);
      this.busy = false;
      this.at = performance.now();
      this.follow();
    }
  }

  /** Whether it is behind a tab: nothing is fetched or drawn for nobody. */
  get isHidden() {
    return this.element.offsetParent === null;
  }

  show(state, decision = null, whole = null) {
    staying(this.element, () => this.draw(state, decision, whole));
  }

  draw(state, decision, whole) {
    this.state = state;
    const loading = state === "loading";
    const known = state === "shown" || (loading && this.full);
    set(this.element, "data-state", state);
    set(this.element, "aria-busy", loading ? "true" : null);
    if (!loading || !known) this.head.show(decision, whole);
    const { alternatives, predictions, branches } = this.sections;
    alternatives.hidden = branches.hidden = !known;
    predictions.hidden = !known && !decision;
    this.notify();
    if (state === "none" || loading) return;
    this.shown = decision.id;
    this.full = whole !== null;
    if (whole) {
      this.alternatives.update(whole);
      this.branches.update(whole);
      this.predictions.update(whole.predictions, inTheWay(whole));
    } else {
      this.alternatives.clear();
      this.predictions.update(fromBeliefs(decision), []);
    }
  }

  /** Say why nothing is shown, where that is so. */
  notify() {
    const first = this.shown === null;
    const key = `${this.state} ${first} ${this.store.latest !== null}`;
    if (this.noticed === key) return;
    this.noticed = key;
    fill(this.notice, this.words(first));
    this.notice.hidden = !this.notice.childNodes.length;
  }

  words(first) {
    if (this.state === "loading" && first) return awaited("Fetching the decision", 6);
    if (this.state === "failed") return [h("p", "The record of this decision could not be fetched."), this.again];
    if (this.state === "gone") return copyOf("decision-gone");
    if (this.state !== "none") return null;
    const none = copyOf("no-decision");
    const why = this.store.latest
      ? "I have not decided anything yet. My first decision will be here in a moment."
      : "As soon as the car drives, what it decides and why will be here.";
    say(partsOf(none).why, why);
    return none;
  }

  moveCharts() {
    const now = performance.now();
    if (this.state === "none" || this.isHidden) return;
    if (this.store.live && now - this.moved < MOVE_EACH) return;
    this.moved = now;
    staying(this.element, () => this.predictions.move());
  }
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
  for (const branch of root) {
    for (const [vehicle, , share] of branch.held_up) {
      shares.set(vehicle, (shares.get(vehicle) ?? 0) + share * (branch.visits + branch.forced));
    }
  }
  const holding = [...shares].sort((a, b) => b[1] - a[1]).map(([vehicle]) => vehicle);
  return [...new Set([...(right?.vehicles ?? []), ...holding])];
}
