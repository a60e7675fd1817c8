/** Outcomes with their probabilities: a bar of shares, and the same in words. */
import { h } from "../dom.js";
import { percent } from "./figures.js";

const WORDS = {
  done: "gets there",
  collision: "collides",
  termination: "not there in time",
  dead: "cannot get there any more",
};
const ORDER = Object.keys(WORDS);

/** What an outcome is called. */
export function outcomeWords(outcome) {
  return WORDS[outcome] ?? outcome;
}

/** @param {Object<string, number>} outcomes probability by outcome */
export function createOutcomes(outcomes) {
  const known = Object.entries(outcomes).filter(([, share]) => share > 0);
  if (known.length === 0) return null;
  known.sort(([a], [b]) => ORDER.indexOf(a) - ORDER.indexOf(b));
  const bar = h(
    "div",
    { class: "shares", "aria-hidden": "true" },
    known.map(([outcome, share]) => shareOf(outcome, share)),
  );
  const words = known.map(([outcome, share]) =>
    h("li", { dataset: { outcome } }, `${outcomeWords(outcome)} `, h("b", {}, percent(share))),
  );
  return h("div", { class: "ends" }, bar, h("ul", {}, words));
}

function shareOf(outcome, share) {
  const part = h("span", { dataset: { outcome } });
  part.style.flexGrow = String(share);
  return part;
}
