/** What could be done first, side by side; looking at one shows its line on the map. */

import { h, say, set } from "../dom.js";
import { between, counted, difference, seconds } from "../figures.js";
import { drawOutcomes, outcomeBar } from "../outcomes.js";
import { capital, outcomesInWords } from "../words.js";
import { drawRange, rangeBar, scaleFor } from "./bars.js";
import { steady } from "./steady.js";

/**
 * @param {Store} store
 * @returns {{element: HTMLElement, update: (decision: object) => void, clear: () => void}}
 */
export function createAlternatives(store) {
  const body = h("tbody", { role: "rowgroup" });
  const scale = h("span", { class: "alternatives-scale" });
  const barred = h("ul", { class: "barred" });
  const preview = createPreview(store);
  const table = h(
    "table",
    { class: "alternatives", role: "table" },
    h("caption", { class: "unseen" }, "First actions that were tried, and what came of them"),
    h("thead", { role: "rowgroup" }, h("tr", { role: "row" }, heads(scale))),
    body,
  );
  const element = h("div", { class: "alternatives-box" }, table, barred);

  function update(decision) {
    const tried = decision.alternatives.filter((one) => one.rollouts > 0);
    const times = tried.map((one) => one.time).filter(Boolean);
    const range = scaleFor(times);
    say(scale, times.length ? `axis: ${range} s sooner to ${range} s later` : "");
    table.hidden = !tried.length;
    steady(
      body,
      tried,
      (one) => one.action,
      (one) => row(one, preview),
      (tr, one) => drawRow(tr, one, range),
    );
    steady(
      barred,
      untried(decision),
      ([reason]) => reason,
      () => h("li"),
      said,
    );
    barred.hidden = !barred.children.length;
    preview.offer(tried);
  }

  preview.changed = (action) => {
    for (const tr of body.children) {
      set(tr, "data-shown", tr.dataset.action === action ? "yes" : null);
      set(tr.querySelector("button"), "aria-pressed", String(tr.dataset.action === preview.kept));
    }
  };
  return { element, update, clear: () => preview.offer([]) };
}

function heads(scale) {
  const head = (...words) => h("th", { role: "columnheader", scope: "col" }, ...words);
  return [head("First action"), head("What comes of it"), head("Time to the goal ", scale)];
}

/** What could not be done or was not tried, by the reason: [reason, words of the actions]. */
function untried(decision) {
  const reasons = new Map();
  for (const { rollouts, reason, words } of decision.alternatives) {
    if (rollouts) continue;
    const why = reason ?? "I did not try it";
    reasons.set(why, [...(reasons.get(why) ?? []), words]);
  }
  return [...reasons];
}

function said(li, [reason, actions]) {
  const last = actions.at(-1);
  const all = actions.length > 1 ? `${actions.slice(0, -1).join(", ")} or ${last}` : last;
  say(li, `I could not ${all}: ${reason}.`);
}

function row({ action }, preview) {
  const name = h("button", { type: "button", class: "alternative-name", "aria-pressed": "false" });
  const parts = {
    name,
    mark: h("span", { class: "badge" }, "my plan"),
    count: h("span", { class: "small" }),
    outcomes: outcomeBar(),
    verdict: h("span", { class: "figure" }),
    range: rangeBar(),
    time: h("span", { class: "figure" }),
    bounds: h("span", { class: "small" }),
  };
  const tr = h(
    "tr",
    { role: "row", dataset: { action } },
    h("th", { role: "rowheader", scope: "row" }, name, parts.mark, parts.count),
    h("td", { role: "cell" }, parts.outcomes, parts.verdict),
    h("td", { role: "cell" }, parts.range, parts.time, parts.bounds),
  );
  tr.parts = parts;
  tr.addEventListener("pointerenter", (event) => event.pointerType === "mouse" && preview.look(action));
  tr.addEventListener("pointerleave", (event) => event.pointerType === "mouse" && preview.look(null));
  name.addEventListener("focus", () => name.matches(":focus-visible") && preview.look(action));
  name.addEventListener("blur", () => preview.look(null));
  name.addEventListener("click", () => preview.keep(action));
  return tr;
}

function drawRow(tr, one, scale) {
  const { name, mark, count, outcomes, verdict, range, time, bounds } = tr.parts;
  say(name, capital(one.words));
  set(name, "title", one.line ? "Show its line on the map" : "Its line is not in the record");
  set(name, "data-line", one.line ? "yes" : "no");
  mark.hidden = !one.chosen;
  set(tr, "data-chosen", one.chosen ? "yes" : null);
  say(count, `${counted(one.rollouts, "rollout")}, ${counted(one.distinct, "sample")}`);
  drawOutcomes(outcomes, one.outcomes);
  say(verdict, outcomesInWords(one.outcomes) || "not known");
  drawRange(range, one.time, scale);
  range.hidden = !one.time && !one.chosen; // of the plan, zero: what the others are measured by
  say(time, timeWords(one));
  say(bounds, one.time ? spread(one.time) : "");
}

function spread({ low, high }) {
  return between(low, high, "s") ?? "in all samples";
}

function timeWords(one) {
  if (one.chosen && one.arrival !== null) return `there in ${seconds(one.arrival)}`;
  if (one.time) return difference(one.time.delta, "s");
  return one.outcomes.done > 0 ? "cannot be told" : "not as far as the goal";
}

/** Which alternative is looked at: the one pointed at or focused, else the one that was kept. */
function createPreview(store) {
  const preview = { kept: null, looked: null, offered: new Map(), changed: () => {}, shown: null };
  const show = () => {
    const action = preview.looked ?? preview.kept;
    const one = preview.offered.get(action);
    preview.changed(one?.line ? action : null);
    if ((one?.line ?? null) === (preview.shown?.line ?? null)) return;
    preview.shown = one?.line ? { line: one.line, words: one.words } : null;
    store.preview = preview.shown;
    store.tell("preview");
  };
  preview.offer = (alternatives) => {
    preview.offered = new Map(alternatives.map((one) => [one.action, one]));
    show();
  };
  preview.look = (action) => {
    preview.looked = action;
    show();
  };
  preview.keep = (action) => {
    const again = preview.kept === action;
    preview.kept = again ? null : action;
    preview.looked = null; // pressed once more it goes, though it is still pointed at
    show();
  };
  return preview;
}
