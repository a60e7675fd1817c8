/** What could be done first, side by side; looking at one shows its line on the map. */

import { copyOf, h, partsOf, pointedAt, say, set } from "../dom.js";
import { between, counted, difference, seconds } from "../figures.js";
import { drawOutcomes, outcomeBar } from "../outcomes.js";
import { capital, outcomesInWords } from "../words.js";
import { drawRange, scaleFor } from "./bars.js";
import { steady } from "./steady.js";

/**
 * @param {HTMLElement} element
 * @param {import("../store.js").Store} store
 * @returns {{update: (decision: DecisionShown) => void, clear: () => void}}
 */
export function createAlternatives(element, store) {
  const { table, scale, tried: body, barred } = partsOf(element);
  const preview = createPreview(store, (shown, kept) => {
    for (const tr of body.children) {
      set(tr, "data-shown", tr.dataset.action === shown ? "yes" : null);
      set(tr.parts.name, "aria-pressed", String(tr.dataset.action === kept));
    }
  });
  return {
    update({ alternatives }) {
      const tried = alternatives.filter((one) => one.rollouts > 0);
      const times = tried.map((one) => one.time).filter(Boolean);
      const range = scaleFor(times);
      say(scale, times.length ? `axis: ${range} s sooner to ${range} s later` : "");
      table.hidden = !tried.length;
      const make = ({ action }) => createRow(action, preview);
      steady(body, tried, (one) => one.action, make, (tr, one) => drawRow(tr, one, range));
      const reasons = untried(alternatives);
      steady(barred, reasons, ([why]) => why, () => h("li"), (li, why) => say(li, couldNot(...why)));
      barred.hidden = !reasons.length;
      preview.offer(tried);
    },
    clear: () => preview.offer([]),
  };
}

/** What could not be done or was not tried, by the reason: [reason, words of the actions]. */
function untried(alternatives) {
  const barred = alternatives.filter((one) => !one.rollouts);
  return [...Map.groupBy(barred, ({ reason }) => reason ?? "I did not try it")];
}

function couldNot(reason, actions) {
  const all = new Intl.ListFormat("en-GB", { type: "disjunction" }).format(actions.map((one) => one.words));
  return `I could not ${all}: ${reason}.`;
}

function createRow(action, preview) {
  const tr = copyOf("alternative");
  tr.dataset.action = action;
  tr.parts = partsOf(tr);
  tr.parts.outcomes = outcomeBar();
  tr.parts.verdict.before(tr.parts.outcomes);
  pointedAt(tr, tr.parts.name, () => preview.look(action), () => preview.look(null));
  tr.parts.name.addEventListener("click", () => preview.keep(action));
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
  say(bounds, one.time && (between(one.time.low, one.time.high, "s") ?? "in all samples"));
}

function timeWords(one) {
  if (one.chosen && one.arrival !== null) return `there in ${seconds(one.arrival)}`;
  if (one.time) return difference(one.time.delta, "s");
  return one.outcomes.done > 0 ? "cannot be told" : "not as far as the goal";
}

/** Which alternative is looked at: the one pointed at or focused, else the one that was kept. */
function createPreview(store, changed) {
  let [kept, looked] = [null, null]; // actions
  let offered = new Map();
  let shown = null;
  const show = () => {
    const action = looked ?? kept;
    const one = offered.get(action);
    const line = one?.line ?? null;
    changed(line ? action : null, kept);
    if (line === (shown?.line ?? null)) return;
    shown = line && { line, words: one.words };
    store.preview = shown;
    store.tell("preview");
  };
  return {
    offer(alternatives) {
      offered = new Map(alternatives.map((one) => [one.action, one]));
      show();
    },
    look(action) {
      looked = action;
      show();
    },
    keep(action) {
      kept = kept === action ? null : action;
      looked = null; // pressed once more it goes, though it is still pointed at
      show();
    },
  };
}
