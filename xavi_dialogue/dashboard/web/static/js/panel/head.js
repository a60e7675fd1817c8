/** The head of the decision panel: what was decided when, in words and in steps. */

import { h, partsOf, say, set } from "../dom.js";
import { clock, counted } from "../figures.js";
import { lower } from "../words.js";
import { steady } from "./steady.js";

/**
 * @param {HTMLElement} element
 * @param {import("../store.js").Store} store
 * @returns {{show: (decision: Decision|null, whole: DecisionShown|null) => void,
 *   move: (decision: Decision|null) => void}} `move`: which decision its buttons lead away from
 */
export function createHead(element, store) {
  const parts = partsOf(element);
  parts.before.addEventListener("click", () => go(store, -1));
  parts.after.addEventListener("click", () => go(store, 1));
  return {
    show: (decision, whole) => draw(parts, decision, whole),
    move(decision) {
      const index = decision ? store.decisions.indexOf(decision) : -1;
      set(parts.before, "aria-disabled", index > 0 ? null : "true"); // disabled ones would lose the focus
      set(parts.after, "aria-disabled", store.live || index < 0 ? "true" : null);
    },
  };
}

function go(store, way) {
  const index = store.decisions.indexOf(store.decisionAt(store.at));
  const one = store.decisions[index + way];
  if (one) store.seek(one.t);
  else if (way > 0) store.goLive();
}

function draw({ title, words, steps, way, facts }, decision, whole) {
  say(title, decision ? `Decision ${decision.number}` : "Decision");
  words.hidden = !decision;
  if (decision) say(words, sentence(decision));
  const plan = (decision && whole?.plan.map(([, said], k) => [`${k} ${said}`, said])) ?? [];
  steps.hidden = plan.length < 2;
  steady(steps, plan, ([key]) => key, () => h("li"), (li, [, said]) => say(li, said));
  way.hidden = !whole?.under_way;
  say(way, `Under way, and to be finished first: ${whole?.under_way ?? ""}.`);
  facts.hidden = !whole;
  if (whole) say(facts, basis(whole));
}

function sentence({ t, words, changed }) {
  const plan = lower(words);
  return changed ? `At ${clock(t)} I decided to ${plan}.` : `At ${clock(t)} I kept to my plan: ${plan}.`;
}

function basis({ rollouts, alternatives }) {
  const chosen = alternatives.find((one) => one.chosen);
  const all = `I tried ${counted(rollouts, "rollout")} of what may happen`;
  if (!chosen?.rollouts) return `${all}.`;
  return `${all}; ${chosen.rollouts} began with this plan, in ${counted(chosen.distinct, "distinct sample")}.`;
}
