/** Where questions are typed. */
import { fill, h, say, set } from "../dom.js";
import { clock, counted } from "../figures.js";
import { ofTab, recall, remember } from "../remembered.js";
import { wayBack } from "../standing.js";

const LINES = 4;
const DRAFT = "xavi-draft";
const DEFAULT_MAX = 4096;
const NEAR = 0.9; // of what is allowed, from where it is counted

/**
 * @param {object} around
 * @param {import("../store.js").Store} around.store
 * @param {(text: string) => boolean} around.ask false: it could not be asked; its text stays
 * @param {() => boolean} around.cancel the latest question; false: there is none
 * @returns {{element: HTMLElement, focus: () => void, say: (words: string) => void, giveBack: (text: string) => void}}
 */
export function createComposer({ store, ask, cancel }) {
  const input = h("textarea", {
    id: "question",
    rows: 1,
    autocomplete: "off",
    autocapitalize: "sentences",
    enterkeyhint: "send",
    "aria-describedby": "question-words question-count",
    placeholder: "Why did you …?",
  });
  const words = h("p", { class: "trouble", id: "question-words", role: "status" });
  const count = h("p", { class: "count", id: "question-count" });
  const about = h("div", { class: "about", hidden: true });
  const button = h("button", { type: "submit", class: "main" }, "Ask");
  const label = h("label", { for: "question", class: "unseen" }, "Your question to the car");
  const form = h("form", { class: "composer" }, about, words, h("div", { class: "line" }, label, input, button), count);
  const earlier = createEarlier(store, input);
  const longest = () => store.welcome?.max_text ?? DEFAULT_MAX;
  const tell = (text) => fill(words, text);
  const changed = () => {
    grow(input);
    const left = longest() - [...input.value].length; // characters, not halves of them
    const near = left < longest() * (1 - NEAR);
    fill(
      count,
      near ? (left < 0 ? `${counted(-left, "character")} too many` : `${counted(left, "character")} left`) : null,
    );
    count.classList.toggle("over", left < 0);
  };
  const write = (text) => {
    input.value = text;
    changed();
  };
  const submit = () => {
    const text = input.value.trim();
    if (text === "") return;
    if ([...text].length > longest()) return tell(`That is too long: ${counted(longest(), "character")} at most.`);
    tell("");
    if (!ask(text)) return tell(`${cannotAsk(store) ?? "Not connected at the moment."} Your question stays here.`);
    earlier.reset();
    write("");
  };
  form.addEventListener("submit", (event) => (event.preventDefault(), submit()));
  input.addEventListener("input", () => (earlier.reset(), tell(""), changed()));
  input.addEventListener("keydown", (event) => typed(event, { submit, cancel, earlier, write }));
  addEventListener("pagehide", () => remember(DRAFT, input.value || null, ofTab));
  followMoment(store, about);
  followService(store, button, () => tell(""));
  write(recall(DRAFT, ofTab) ?? "");
  return {
    element: form,
    focus: () => input.focus(),
    say: tell,
    giveBack: (text) => input.value.trim() === "" && write(text),
  };
}

function typed(event, { submit, cancel, earlier, write }) {
  if (event.isComposing) return; // an input method takes Enter and arrows for itself
  const does = {
    Enter: () => !event.shiftKey && (submit(), true),
    Escape: () => cancel(),
    ArrowUp: () => earlier.step(1, write),
    ArrowDown: () => earlier.step(-1, write),
  }[event.key];
  if (does?.()) event.preventDefault();
}

/** Earlier questions, one by one, as long as none of them is edited. */
function createEarlier(store, input) {
  let back = 0; // 0: what is typed now
  return {
    reset: () => (back = 0),
    step(by, write) {
      const fresh = input.value !== "" && back === 0;
      const questions = [...new Set(store.turns.map((turn) => turn.text).reverse())];
      const next = back + by;
      if (fresh || next < 0 || next > questions.length) return false;
      back = next;
      write(back === 0 ? "" : questions[back - 1]);
      input.setSelectionRange(input.value.length, input.value.length);
      return true;
    },
  };
}

/** Why nobody can be asked at all; null: somebody can. A service that was lost is waited for. */
export function cannotAsk({ status }) {
  if (!status.connected) return "Not connected at the moment.";
  return status.service === "awaited" ? "There is no dialogue service to ask yet." : null;
}

/** The button says why it does nothing; pressed all the same, so does the line above the question. */
function followService(store, button, settled) {
  let before = null;
  const follow = () => {
    const why = cannotAsk(store);
    if (before !== null && why === null) settled(); // what was said of it is so no longer
    before = why;
    set(button, "aria-disabled", why && "true");
    set(button, "title", why);
  };
  store.addEventListener("status", follow);
  follow();
}

/** As high as its text, up to four lines. */
function grow(input) {
  input.style.height = "auto";
  const style = getComputedStyle(input);
  const line = parseFloat(style.lineHeight) || 20;
  const around =
    input.offsetHeight - input.clientHeight + parseFloat(style.paddingTop) + parseFloat(style.paddingBottom);
  const wanted = input.scrollHeight + input.offsetHeight - input.clientHeight;
  input.style.height = `${Math.min(wanted, LINES * line + around)}px`;
  input.style.overflowY = wanted > LINES * line + around ? "auto" : "hidden";
}

/** "Asking about 0:12", and the way back to now. */
function followMoment(store, about) {
  const time = h("b", {});
  const back = h("button", { type: "button", class: "quiet", onclick: () => store.goLive() });
  fill(about, h("span", {}, "Asking about ", time), back);
  const follow = () => {
    if (about.hidden !== store.live) about.hidden = store.live;
    if (store.live) return;
    say(time, clock(store.held));
    say(back, wayBack(store));
  };
  for (const name of ["moment", "ride", "status"]) store.addEventListener(name, follow);
  follow();
}
