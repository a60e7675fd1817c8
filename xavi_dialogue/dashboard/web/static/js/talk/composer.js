/** Where questions are typed. */
import { on, partsOf, say, set } from "../dom.js";
import { clock, counted } from "../figures.js";
import { ofTab, recall, remember } from "../remembered.js";
import { wayBack } from "../standing.js";

const LINES = 4;
const DRAFT = "xavi-draft";
const DEFAULT_MAX = 4096;
const STEPS = { ArrowUp: 1, ArrowDown: -1 }; // through earlier questions
const NEAR = 0.9; // of what is allowed, from where it is counted

export class Composer {
  back = 0; // how many questions ago the text was asked; 0: it is typed now

  /**
   * @param {HTMLFormElement} form
   * @param {import("../store.js").Store} store
   * @param {(text: string) => boolean} ask false: it could not be asked; its text stays
   * @param {() => boolean} cancel the latest question; false: there is none
   */
  constructor(form, store, ask, cancel) {
    Object.assign(this, { store, ask, cancel, ...partsOf(form) });
    const { input } = this;
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      this.submit();
    });
    input.addEventListener("input", () => {
      this.back = 0;
      this.say("");
      this.changed();
    });
    input.addEventListener("keydown", (event) => this.type(event));
    addEventListener("pagehide", () => remember(DRAFT, input.value || null, ofTab));
    this.showLive.addEventListener("click", () => store.goLive());
    this.followMoment();
    this.followService();
    this.write(recall(DRAFT, ofTab) ?? "");
  }

  focus() {
    this.input.focus();
  }

  /** Say something above the question. */
  say(text) {
    say(this.words, text);
  }

  /** Put a text back, where nothing else has been typed meanwhile. */
  giveBack(text) {
    if (this.input.value.trim() === "") this.write(text);
  }

  write(text) {
    this.input.value = text;
    this.changed();
  }

  /** Characters that a question may have. */
  get longest() {
    return this.store.welcome?.max_text ?? DEFAULT_MAX;
  }

  changed() {
    grow(this.input);
    const left = this.longest - [...this.input.value].length; // characters, not halves of them
    const over = left < 0;
    const words = over ? `${counted(-left, "character")} too many` : `${counted(left, "character")} left`;
    say(this.count, left < this.longest * (1 - NEAR) ? words : "");
    this.count.classList.toggle("over", over);
  }

  submit() {
    const text = this.input.value.trim();
    if (text === "") return;
    const most = this.longest;
    if ([...text].length > most) return void this.say(`That is too long: ${counted(most, "character")} at most.`);
    this.say("");
    if (this.ask(text)) {
      this.back = 0;
      this.write("");
    } else this.say(`${cannotAsk(this.store) ?? "Not connected at the moment."} Your question stays here.`);
  }

  type(event) {
    if (event.isComposing) return; // an input method takes Enter and arrows for itself
    const { key, shiftKey } = event;
    if (key === "Enter" && !shiftKey) {
      this.submit();
      event.preventDefault();
    } else if (key === "Escape" ? this.cancel() : key in STEPS && this.recall(STEPS[key])) event.preventDefault();
  }

  /** Go through earlier questions, as long as none of them is edited; false: there is none that way. */
  recall(by) {
    const edited = this.input.value !== "" && this.back === 0;
    const questions = [...new Set(this.store.turns.map((turn) => turn.text).reverse())];
    const next = this.back + by;
    if (edited || next < 0 || next > questions.length) return false;
    this.back = next;
    this.write(next === 0 ? "" : questions[next - 1]);
    this.input.setSelectionRange(this.input.value.length, this.input.value.length);
    return true;
  }

  /** "Asking about 0:12", and the way back to now. */
  followMoment() {
    const { store, about, moment, showLive } = this;
    const follow = () => {
      if (about.hidden !== store.live) about.hidden = store.live;
      if (store.live) return;
      say(moment, clock(store.held));
      say(showLive, wayBack(store));
    };
    on(store, "moment ride status", follow);
    follow();
  }

  /** The button says why it does nothing; pressed all the same, so does the line above the question. */
  followService() {
    let before = null;
    const follow = () => {
      const why = cannotAsk(this.store);
      if (before !== null && why === null) this.say(""); // what was said of it is so no longer
      before = why;
      set(this.button, "aria-disabled", why && "true");
      set(this.button, "title", why);
    };
    this.store.addEventListener("status", follow);
    follow();
  }
}

/** Why nobody can be asked at all; null: somebody can. A service that was lost is waited for. */
export function cannotAsk({ status }) {
  if (!status.connected) return "Not connected at the moment.";
  return status.service === "awaited" ? "There is no dialogue service to ask yet." : null;
}

/** As high as its text, up to four lines. */
function grow(input) {
  input.style.height = "auto";
  const style = getComputedStyle(input);
  const border = input.offsetHeight - input.clientHeight;
  const padding = parseFloat(style.paddingTop) + parseFloat(style.paddingBottom);
  const most = LINES * (parseFloat(style.lineHeight) || 20) + padding + border;
  const wanted = input.scrollHeight + border;
  input.style.height = `${Math.min(wanted, most)}px`;
  input.style.overflowY = wanted > most ? "auto" : "hidden";
}
