/** One turn of the conversation: a question and what came of it. */
import { h } from "../dom.js";
import { clock, lasted } from "../figures.js";
import { capital } from "../words.js";
import { createEvidence } from "./evidence.js";

/** Why there is no answer, in a few words. */
const REASONS = {
  "not-understood": "not understood",
  ambiguous: "more than one thing could be meant",
  "out-of-scope": "not about the driving",
  "not-an-action": "nothing that a car does",
  "unknown-vehicle": "no such vehicle",
  "did-not-happen": "that did not happen",
  "not-applicable": "that was not possible",
  "no-influence": "that made no difference",
  "too-little-evidence": "too little evidence",
  "effect-too-small": "too small a difference",
  "outside-record": "not in the record",
  "trace-gap": "a gap in the record",
  "planner-unavailable": "no planner to ask",
  "timed-out": "took too long",
  busy: "busy",
  "planner-failed": "the planner failed",
};
const KINDS = { answer: "Answer", refusal: "No answer", clarification: "Question back" };
const ICONS = {
  refusal: "M12 3a9 9 0 1 0 0 18 9 9 0 0 0 0-18zM6 6l12 12",
  clarification: "M12 3a9 9 0 1 0 0 18 9 9 0 0 0 0-18zM9.5 9.5a2.5 2.5 0 1 1 3.5 2.3c-1 .5-1 1-1 1.7m0 3v.2",
};

/**
 * @typedef {object} Around what a turn can do to what is around it
 * @property {import("../store.js").Store} store
 * @property {import("../pointing.js").Pointing} pointing
 * @property {import("./spoken.js").Spoken} spoken
 * @property {(text: string) => void} ask
 * @property {(n: number) => boolean} newest whether a turn is the latest one
 */

/**
 * @param {{n: number|null, text: string, reply: any, vehicles: number[], evidence: boolean}} turn
 *   n is null of what became no turn
 * @param {Around} around
 */
export function createTurn(turn, around) {
  const { n, reply } = turn;
  const label = n === null ? "Question without a turn" : `Question ${n + 1}`;
  return h(
    "article",
    { class: "turn", "aria-label": label, dataset: { kind: reply.kind, n: n ?? "" } },
    question(turn.text),
    h(
      "div",
      { class: "reply" },
      reply.kind === "answer" ? null : kindOf(reply),
      h("p", { class: "words", dir: "auto" }, kindAloud(reply), around.spoken.text(reply.text, turn.vehicles)),
      reply.choices.length > 0 ? choices(turn, around) : null,
      reply.kind === "refusal" && reply.suggestions.length > 0 ? instead(reply, around) : null,
      meta(turn, around),
    ),
  );
}

/** The bubble of a question. */
export function question(text) {
  return h("p", { class: "question", dir: "auto" }, h("span", { class: "unseen" }, "You asked: "), text);
}

/** Questions as buttons that ask them. */
export function chips(questions, ask, label) {
  const one = (text) => h("li", {}, h("button", { type: "button", class: "chip", onclick: () => ask(text) }, text));
  return h("ul", { class: "chips", "aria-label": label }, questions.map(one));
}

function kindAloud(reply) {
  return h("span", { class: "unseen" }, `${KINDS[reply.kind] ?? "Answer"}: `);
}

function kindOf(reply) {
  const icon = h("svg", { viewBox: "0 0 24 24", "aria-hidden": "true" }, h("path", { d: ICONS[reply.kind] }));
  return h("p", { class: "kind" }, icon, capital(REASONS[reply.reason] ?? KINDS[reply.kind] ?? ""));
}

function instead({ text, suggestions }, { ask }) {
  const said = suggestions.some((one) => text.includes(one)); // the answer itself leads over to them
  return h(
    "div",
    { class: "instead" },
    said ? null : h("p", {}, "You could ask"),
    chips(suggestions, ask, "You could ask"),
  );
}

function choices({ n, reply }, { ask, newest }) {
  const one = (text, index) => {
    // A number means the latest choices only; those of before are asked for by their words.
    const say = () => ask(newest(n) ? String(index + 1) : text);
    const words = [h("span", { class: "pick" }, index + 1), h("span", {}, text)];
    return h("li", {}, h("button", { type: "button", class: "choice", onclick: say }, words));
  };
  return h("ol", { class: "choices", "aria-label": "What is meant" }, reply.choices.map(one));
}

function meta(turn, { store, pointing, spoken }) {
  const { n, reply } = turn;
  const moment = n === null ? null : momentOf(reply.sim_time, store);
  const took =
    typeof reply.timing_ms === "number" ? h("span", { class: "took" }, `in ${lasted(reply.timing_ms)}`) : null;
  const map = n !== null && (turn.evidence || turn.vehicles.length > 0) ? onMap(turn, store, pointing) : null;
  const evidence = n !== null && turn.evidence ? createEvidence(turn, store, spoken) : null;
  return [h("div", { class: "meta" }, moment, took, map, evidence?.button), evidence?.fold];
}

function momentOf(t, store) {
  const title = "Go to the moment it was asked about";
  return h(
    "button",
    { type: "button", class: "moment", title, onclick: () => store.seek(t) },
    h("span", { class: "unseen" }, "Go to "),
    clock(t),
  );
}

function onMap(turn, store, pointing) {
  const toggle = () => {
    const off = store.turn === turn.n;
    pointing.keep(off ? [] : turn.vehicles);
    store.show(off ? null : turn.n);
  };
  const pressed = String(store.turn === turn.n);
  return h(
    "button",
    { type: "button", class: "quiet on-map", "aria-pressed": pressed, dataset: { show: turn.n }, onclick: toggle },
    "Show on the map",
  );
}
