/** What rollouts come to, as a bar of shares; each outcome has a pattern as well as a colour. */
import { h } from "./dom.js";
import { clamped, percent } from "./figures.js";
import { OUTCOMES, outcomeWords, sharesOf } from "./words.js";

const LEAST = 1.5; // [%] of a bar: what is there can be seen

/** The width of a share in its bar. */
export function widthOf(share) {
  return share > 0 ? `${clamped(share * 100, LEAST, 100)}%` : "0";
}

/** An empty bar: bring it up to date with `drawOutcomes`. */
export function outcomeBar() {
  const pieces = Object.keys(OUTCOMES).map((outcome) => h("span", { dataset: { outcome } }));
  return h("div.outcome-bar", { "aria-hidden": "true" }, pieces);
}

/** @param {Object<string, number>} outcomes probability of each */
export function drawOutcomes(bar, outcomes) {
  for (const piece of bar.children) {
    const share = outcomes[piece.dataset.outcome] ?? 0;
    piece.hidden = share <= 0;
    piece.style.width = widthOf(share);
  }
}

/** A bar, and under it the same in words; null where nothing is known. */
export function createOutcomes(outcomes) {
  const known = sharesOf(outcomes);
  if (known.length === 0) return null;
  const bar = outcomeBar();
  drawOutcomes(bar, outcomes);
  const words = known.map(([outcome, share]) => h("li", `${outcomeWords(outcome)} `, h("b", percent(share))));
  return h("div.outcome-box", bar, h("ul", words));
}
