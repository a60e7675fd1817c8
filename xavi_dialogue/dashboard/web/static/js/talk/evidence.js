/** What an answer rests on, in a fold under it: outcomes, effects, causes, rollouts. */
import { createAwaited } from "../awaited.js";
import { fill, h } from "../dom.js";
import { clock, counted, percent, seconds } from "../figures.js";
import { createOutcomes } from "../outcomes.js";
import { capital, nameOf } from "../words.js";
import { createEffect } from "./effects.js";
import { createRuns } from "./runs.js";

let made = 0;

/**
 * @param {{n: number}} turn
 * @param {import("../store.js").Store} store
 * @param {import("./spoken.js").Spoken} spoken
 * @returns {{button: HTMLElement, fold: HTMLElement}}
 */
export function createEvidence(turn, store, spoken) {
  made += 1;
  const fold = h("div", {
    class: "evidence",
    id: `evidence-${made}`,
    role: "region",
    "aria-label": "Evidence",
    hidden: true,
  });
  const button = h(
    "button",
    { type: "button", class: "quiet", "aria-expanded": "false", "aria-controls": fold.id },
    "Evidence",
  );
  const load = async () => {
    fill(fold, createAwaited("Loading the evidence"));
    let words = null; // why there is nothing to show
    const evidence = await store.evidenceOf(turn.n).catch((error) => void (words = error.message));
    try {
      if (evidence) fill(fold, shown(evidence, store, spoken));
    } catch (fault) {
      console.error(fault); // of ours: its words are for us
      words = "This could not be shown.";
    }
    if (words === null) fold.dataset.loaded = "yes";
    else fill(fold, h("p", { class: "soft", role: "status" }, `${words} `, retry(load)));
  };
  button.addEventListener("click", () => {
    fold.hidden = !fold.hidden;
    button.setAttribute("aria-expanded", String(!fold.hidden));
    if (!fold.hidden && !fold.dataset.loaded) load();
  });
  return { button, fold };
}

function retry(load) {
  return h("button", { type: "button", class: "quiet", onclick: load }, "Try again");
}

function shown(evidence, store, spoken) {
  const { factual, counterfactual, effects, causes } = evidence;
  const sides = [
    factual ? [capital(factual.title), "fact", factual] : null,
    counterfactual ? [capital(counterfactual.title), "foil", counterfactual] : null,
  ].filter(Boolean);
  return [
    basis(evidence, store),
    evidence.missing ? h("p", { class: "missing" }, evidence.missing) : null,
    sides.map(([title, kind, side]) => sideOf(title, kind, side)),
    effects.length > 0
      ? [h("h3", {}, "What that would have changed"), h("ul", { class: "effects" }, effects.map(createEffect))]
      : null,
    causes.length > 0
      ? [
          h("h3", {}, "Because of"),
          h(
            "ul",
            { class: "causes" },
            causes.map((cause) => causeOf(cause, spoken)),
          ),
        ]
      : null,
    sides.map(([title, , side]) => (side.runs.length > 0 ? createRuns(title, side, spoken) : null)),
  ];
}

function basis({ method, rollouts, distinct, t }, store) {
  const attributes = { type: "button", class: "moment", title: "Go to that decision", onclick: () => store.seek(t) };
  const when = h("button", attributes, clock(t));
  const count = `${counted(rollouts, "rollout")} from ${counted(distinct, "distinct sample")}`;
  const words = rollouts > 0 ? `${capital(method)}: ${count}.` : `${capital(method)}.`;
  return h("p", { class: "basis" }, h("span", {}, words), h("span", {}, "Decision at", when));
}

function sideOf(title, kind, side) {
  const arrival = side.arrival === null ? null : h("span", { class: "arrival" }, `there in ${seconds(side.arrival)}`);
  return h(
    "div",
    { class: `outcome-side ${kind}` },
    h("h3", {}, title),
    h("p", { class: "side-words" }, side.words),
    createOutcomes(side.outcomes),
    h("p", { class: "soft" }, arrival, arrival ? ", " : "", counted(side.rollouts, "rollout")),
  );
}

function causeOf(cause, spoken) {
  const rest = [cause.how, cause.checked].filter(Boolean);
  const influence =
    cause.influence === null
      ? null
      : h("span", { class: "soft" }, `influence on the choice ${cause.influence.toFixed(2)} bit`);
  return h(
    "li",
    {},
    h(
      "p",
      {},
      spoken.button(cause.vehicle, nameOf(cause.vehicle)),
      ` ${cause.words} `,
      h("b", {}, percent(cause.probability)),
    ),
    rest.map((words) => h("p", { class: "soft" }, spoken.text(words, [cause.vehicle]))),
    influence,
  );
}
