/** What an answer rests on, in a fold under it: outcomes, effects, causes, rollouts. */
import { awaited, fill, h, partsOf } from "../dom.js";
import { clock, counted, percent, seconds } from "../figures.js";
import { createOutcomes } from "../outcomes.js";
import { capital, nameOf } from "../words.js";
import { createEffect } from "./effects.js";
import { createRuns } from "./runs.js";

let made = 0;

/**
 * Let a turn unfold its evidence, which is fetched then.
 * @param {HTMLElement} element of the turn
 * @param {{n: number}} turn
 * @param {import("./turn.js").Around} around
 */
export function createEvidence(element, { n }, { store, spoken }) {
  const { unfold, fold } = partsOf(element);
  made += 1;
  fold.id = `evidence-${made}`;
  unfold.setAttribute("aria-controls", fold.id);
  unfold.hidden = false;
  const load = async () => {
    fill(fold, awaited("Loading the evidence"));
    let words = null; // why there is nothing to show
    const evidence = await store.evidenceOf(n).catch((error) => void (words = error.message));
    try {
      if (evidence) fill(fold, shown(evidence, store, spoken));
    } catch (fault) {
      console.error(fault); // of ours: its words are for us
      words = "This could not be shown.";
    }
    if (words === null) fold.dataset.loaded = "yes";
    else fill(fold, h("p.soft", { role: "status" }, `${words} `, h("button.quiet", { onclick: load }, "Try again")));
  };
  unfold.addEventListener("click", () => {
    fold.hidden = !fold.hidden;
    unfold.ariaExpanded = String(!fold.hidden);
    if (!fold.hidden && !fold.dataset.loaded) load();
  });
}

function shown(evidence, store, spoken) {
  const { factual, counterfactual, effects, causes, missing } = evidence;
  const sides = [factual, counterfactual].filter(Boolean);
  const listed = (title, list, items) => items.length > 0 && [h("h3", title), h(list, items)];
  return [
    basis(evidence, store),
    missing && h("p.missing", missing),
    sides.map((side) => sideOf(side, side === factual ? "fact" : "foil")),
    listed("What that would have changed", "ul.effects", effects.map(createEffect)),
    listed("Because of", "ul.causes", causes.map((cause) => causeOf(cause, spoken))),
    sides.map((side) => side.runs.length > 0 && createRuns(capital(side.title), side, spoken)),
  ];
}

function basis({ method, rollouts, distinct, t }, store) {
  const when = h("button.moment", { title: "Go to that decision", onclick: () => store.seek(t) }, clock(t));
  const count = `${counted(rollouts, "rollout")} from ${counted(distinct, "distinct sample")}`;
  const words = rollouts > 0 ? `${capital(method)}: ${count}.` : `${capital(method)}.`;
  return h("p.basis.row", h("span", words), h("span", "Decision at", when));
}

function sideOf({ title, words, outcomes, arrival, rollouts }, kind) {
  const there = arrival !== null && [h("span.arrival", `there in ${seconds(arrival)}`), ", "];
  return h(
    `div.outcome-side.${kind}`,
    h("h3", capital(title)),
    h("p.side-words", words),
    createOutcomes(outcomes),
    h("p.soft", there, counted(rollouts, "rollout")),
  );
}

function causeOf({ vehicle, words, probability, how, checked, influence }, spoken) {
  const rest = [how, checked].filter(Boolean);
  return h(
    "li",
    h("p", spoken.button(vehicle, nameOf(vehicle)), ` ${words} `, h("b", percent(probability))),
    rest.map((one) => h("p.soft", spoken.text(one, [vehicle]))),
    influence !== null && h("span.soft", `influence on the choice ${influence.toFixed(2)} bit`),
  );
}
