/** Questions that wait for an answer, each with its progress. */
import { copyOf, partsOf, say } from "../dom.js";

const QUIET = 200; // [ms] in which most answers come; nothing flickers for them
const LONG = 2000; // [ms] after which it can only be planning

/**
 * @param {HTMLElement} list
 * @param {import("./questions.js").Questions} questions
 * @param {() => void} changed the list has another height
 */
export function followPending(list, questions, changed) {
  const rows = new Map(); // by request
  const follow = () => {
    for (const [request, row] of rows) {
      if (questions.open.has(request)) continue;
      row.end();
      rows.delete(request);
    }
    for (const question of questions.open.values()) {
      if (!rows.has(question.request)) rows.set(question.request, createRow(question, questions, list, changed));
      rows.get(question.request).show();
    }
    changed();
  };
  questions.addEventListener("change", follow);
}

function createRow(question, questions, list, changed) {
  const row = copyOf("waiting");
  const { text, progress, words, cancel } = partsOf(row);
  row.dataset.text = question.text;
  text.append(question.text);
  cancel.addEventListener("click", () => questions.cancel(question.request));
  const show = () => {
    const waited = performance.now() - question.since;
    progress.hidden = waited < QUIET && question.sent;
    const thinking = waited < LONG ? "Thinking …" : "Planning this again …";
    if (!progress.hidden) say(words, question.sent ? thinking : "The connection is lost; it is asked again …");
  };
  const later = () => {
    show();
    changed();
  };
  const timers = [QUIET, LONG].map((after) => setTimeout(later, after + 5));
  list.append(row);
  const end = () => {
    timers.forEach(clearTimeout);
    row.remove();
  };
  return { show, end };
}
