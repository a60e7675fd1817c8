/** What could be asked about the moment that is shown. */
import { fill, h } from "../dom.js";
import { chips } from "./turn.js";

const PAUSE = 300; // [ms] for which the moment rests before it is asked about
const MOST = 4; // are shown, which takes two rows or three
const SAME = 1; // [s] between a moment and the one that suggestions are about

/**
 * @param {import("../store.js").Store} store
 * @param {import("../connection.js").Connection} connection
 * @param {(text: string) => void} ask
 * @returns {HTMLElement}
 */
export function createSuggested(store, connection, ask) {
  const element = h("div", { class: "suggested", hidden: true });
  let shown = "";
  const show = () => {
    const { t } = store.suggestions;
    const questions = store.suggestions.questions.slice(0, MOST);
    if (!store.live && Math.abs(t - store.held) > SAME) return; // about now, or where the reader was
    const key = JSON.stringify(questions);
    if (key === shown || (element.contains(document.activeElement) && questions.length === 0)) return;
    shown = key;
    keepingFocus(element, () => fill(element, chips(questions, ask, "Suggested questions")));
    element.hidden = questions.length === 0;
  };
  store.addEventListener("suggestions", show);
  store.addEventListener("ride", () => ((store.suggestions = { t: 0, questions: [] }), show()));
  wanting(store, connection);
  show();
  return element;
}

/** Ask for suggestions about another moment, once it rests; and about now, back there. */
function wanting(store, connection) {
  let timer = null;
  let wasLive = true;
  let asked = null;
  store.addEventListener("moment", () => {
    const same = store.live ? wasLive : asked === store.held && !wasLive;
    wasLive = store.live;
    if (same) return;
    asked = store.live ? null : store.held;
    clearTimeout(timer);
    timer = setTimeout(() => connection.send({ type: "suggest", at: store.at }), PAUSE);
  });
}

/** Fill anew, and leave the focus at the place where it was. */
function keepingFocus(element, change) {
  const index = [...element.querySelectorAll("button")].indexOf(document.activeElement);
  change();
  const buttons = element.querySelectorAll("button");
  if (index >= 0) buttons[Math.min(index, buttons.length - 1)]?.focus();
}
