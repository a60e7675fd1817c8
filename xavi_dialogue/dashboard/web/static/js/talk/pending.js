/** Questions that wait for an answer, each with its progress. */
import { h, say } from "../dom.js";
import { question as bubble } from "./turn.js";

const QUIET = 200; // [ms] in which most answers come; nothing flickers for them
const LONG = 2000; // [ms] after which it can only be planning

/**
 * @param {import("./questions.js").Questions} questions
 * @param {() => void} changed the list has another height
 * @returns {HTMLElement}
 */
export function createPending(questions, changed) {
  const element = h("div", { class: "pending" });
  const rows = new Map(); // by request
  const follow = () => {
    for (const [request, row] of rows) {
      if (questions.open.has(request)) continue;
      row.end();
      rows.delete(request);
    }
    for (const question of questions.open.values()) {
      if (!rows.has(question.request)) rows.set(question.request, createRow(question, questions, element, changed));
      rows.get(question.request).show();
    }
    changed();
  };
  questions.addEventListener("change", follow);
  return element;
}

function createRow(question, questions, list, changed) {
  const words = h("span", { role: "status" });
  const cancel = h(
    "button",
    { type: "button", class: "quiet", onclick: () => questions.cancel(question.request) },
    "Cancel",
  );
  const dots = h(
    "span",
    { class: "dots", "aria-hidden": "true" },
    [1, 2, 3].map(() => h("i")),
  );
  const progress = h("div", { class: "progress", hidden: true }, dots, words, cancel);
  const row = h("div", { class: "turn waiting", dataset: { text: question.text } }, bubble(question.text), progress);
  const show = () => {
    const waited = performance.now() - question.since;
    progress.hidden = waited < QUIET && question.sent;
    const text = !question.sent
      ? "The connection is lost; it is asked again …"
      : waited < LONG
        ? "Thinking …"
        : "Planning this again …";
    if (!progress.hidden) say(words, text);
  };
  const timers = [QUIET, LONG].map((after) => setTimeout(() => (show(), changed()), after + 5));
  list.append(row);
  const end = () => {
    timers.forEach(clearTimeout);
    row.remove();
  };
  return { show, end };
}
