/** What could be asked about the moment that is shown. */
import { fill } from "../dom.js";
import { chips } from "./turn.js";

const PAUSE = 300; // [ms] for which the moment rests before it is asked about
const MOST = 4; // are shown, which takes two rows or three
const SAME = 1; // [s] between a moment and the one that suggestions are about

/**
 * @param {HTMLElement} element
 * @param {import("../store.js").Store} store
 * @param {import("../connection.js").Connection} connection
 * @param {(text: string) => void} ask
 */
export function followSuggestions(element, store, connection, ask) {
  let shown = "";
  const show = () => {
    const { t, questions } = store.suggestions;
    if (!store.live && Math.abs(t - store.held) > SAME) return; // about now, or where the reader was
    const few = questions.slice(0, MOST);
    const key = JSON.stringify(few);
    if (key === shown || (element.contains(document.activeElement) && few.length === 0)) return;
    shown = key;
    keepingFocus(element, () => fill(element, chips(few, ask, "Suggested questions")));
    element.hidden = few.length === 0;
  };
  store.addEventListener("suggestions", show);
  store.addEventListener("ride", () => {
    store.suggestions = { t: 0, questions: [] };
    show();
  });
  askForThem(store, connection);
  show();
}

/** Ask for suggestions about another moment, once it rests; and about now, back there. */
function askForThem(store, connection) {
  let timer = 0;
  let asked = null; // the moment [s] that they are about; null: now
  store.addEventListener("moment", () => {
    const wanted = store.live ? null : store.held;
    if (wanted === asked) return;
    asked = wanted;
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
