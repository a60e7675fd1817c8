/** The head of the decision panel: what was decided when, in words and in steps. */

import { h, say, set } from "../dom.js";
import { clock, counted } from "../figures.js";
import { lower } from "../words.js";
import { steady } from "./steady.js";

/**
 * @param {Store} store
 * @returns {{element: HTMLElement, show: (decision: object|null, whole: object|null) => void,
 *   move: (decision: object|null) => void}} `move`: which decision its buttons lead away from
 */
export function createHead(store) {
  const parts = {
    before: button("decision-before", "Previous decision"),
    after: button("decision-after", "Next decision"),
    title: h("h2", { class: "decision-title" }, "Decision"),
    words: h("p", { class: "decision-words" }),
    steps: h("ol", { class: "steps", "aria-label": "Plan" }),
    way: h("p", { class: "small" }),
    facts: h("p", { class: "small" }),
  };
  const nav = h("div", { class: "decision-nav" }, parts.before, parts.title, parts.after);
  parts.before.addEventListener("click", () => go(store, -1));
  parts.after.addEventListener("click", () => go(store, 1));
  return {
    element: h("div", { class: "decision-head" }, nav, parts.words, parts.steps, parts.way, parts.facts),
    show: (decision, whole) => draw(parts, decision, whole),
    move(decision) {
      const index = decision ? store.decisions.indexOf(decision) : -1;
      set(parts.before, "aria-disabled", index > 0 ? null : "true"); // disabled ones would lose the focus
      set(parts.after, "aria-disabled", store.live || index < 0 ? "true" : null);
    },
  };
}

function button(name, label) {
  return h("button", { type: "button", class: `decision-step ${name}`, "aria-label": label, title: label });
}

function go(store, way) {
  const index = store.decisions.indexOf(store.decisionAt(store.at));
  const one = store.decisions[index + way];
  if (one) store.seek(one.t);
  else if (way > 0) store.goLive();
}

function draw(parts, decision, whole) {
  const { title, words, steps, way, facts } = parts;
  say(title, decision ? `Decision ${decision.number}` : "Decision");
  words.hidden = !decision;
  if (decision) say(words, sentence(decision));
  const plan = decision ? (whole?.plan.map(([, said]) => said) ?? []) : [];
  steps.hidden = plan.length < 2;
  const items = plan.map((said, k) => [`${k} ${said}`, said]);
  steady(
    steps,
    items,
    ([key]) => key,
    () => h("li"),
    (li, [, said]) => say(li, said),
  );
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
