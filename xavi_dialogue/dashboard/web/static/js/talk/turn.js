/** One turn of the conversation: a question and what came of it. */
import { copyOf, h, icon, partsOf, say } from "../dom.js";
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
 * @param {TurnShown} turn its `n` is null of what became no turn
 * @param {Around} around
 */
export function createTurn(turn, around) {
  const { n, text, reply, vehicles, evidence } = turn;
  const element = copyOf("turn");
  const { question, kind, words, meta, moment, took, map } = partsOf(element);
  const known = n !== null;
  element.ariaLabel = known ? `Question ${n + 1}` : "Question without a turn";
  Object.assign(element.dataset, { kind: reply.kind, n: n ?? "" });
  question.append(text);
  kind.hidden = reply.kind === "answer";
  if (!kind.hidden) kind.append(icon(ICONS[reply.kind]), capital(REASONS[reply.reason] ?? KINDS[reply.kind] ?? ""));
  const aloud = h("span.unseen", `${KINDS[reply.kind] ?? "Answer"}: `);
  words.append(aloud, ...around.spoken.text(reply.text, vehicles));
  if (reply.choices.length > 0) meta.before(choices(turn, around));
  if (reply.kind === "refusal" && reply.suggestions.length > 0) meta.before(instead(reply, around));
  moment.hidden = !known;
  moment.append(clock(reply.sim_time));
  moment.addEventListener("click", () => around.store.seek(reply.sim_time));
  took.hidden = typeof reply.timing_ms !== "number";
  if (!took.hidden) say(took, `in ${lasted(reply.timing_ms)}`);
  map.hidden = !known || !(evidence || vehicles.length > 0);
  map.dataset.show = n;
  map.ariaPressed = String(known && around.store.turn === n);
  map.addEventListener("click", () => toggleOnMap(turn, around));
  if (known && evidence) createEvidence(element, turn, around);
  return element;
}

/** Questions as buttons that ask them. */
export function chips(questions, ask, label) {
  const one = (text) => h("li", h("button.chip", { onclick: () => ask(text) }, text));
  return h("ul.chips", { "aria-label": label }, questions.map(one));
}

function instead({ text, suggestions }, { ask }) {
  const said = suggestions.some((one) => text.includes(one)); // the answer itself leads over to them
  return h("div.instead", !said && h("p", "You could ask"), chips(suggestions, ask, "You could ask"));
}

function choices({ n, reply }, { ask, newest }) {
  const one = (text, index) => {
    // A number means the latest choices only; those of before are asked for by their words.
    const onclick = () => ask(newest(n) ? String(index + 1) : text);
    return h("li", h("button.choice", { onclick }, h("span.pick", index + 1), h("span", text)));
  };
  return h("ol.choices", { "aria-label": "What is meant" }, reply.choices.map(one));
}

function toggleOnMap({ n, vehicles }, { store, pointing }) {
  const off = store.turn === n;
  pointing.keep(off ? [] : vehicles);
  store.show(off ? null : n);
}
