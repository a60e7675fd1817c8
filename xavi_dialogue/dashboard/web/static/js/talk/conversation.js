/** The conversation with the car. */
import { copyOf, drawing, on, partsOf, say } from "../dom.js";
import { pointingOf } from "../pointing.js";
import { capital } from "../words.js";
import { cannotAsk, Composer } from "./composer.js";
import { Log } from "./log.js";
import { followPending } from "./pending.js";
import { Questions } from "./questions.js";
import { Spoken } from "./spoken.js";
import { followSuggestions } from "./suggested.js";
import { createTurn } from "./turn.js";

const SETTLING = 2500; // [ms] after a welcome, and once the service is there, in which the conversation so far comes
const MANY = 4; // turns at once: somebody's history, and no news

/**
 * @param {HTMLElement} element
 * @param {import("../store.js").Store} store
 * @param {import("../connection.js").Connection} connection
 * @returns {{focus: () => void, ask: (text: string) => boolean}}
 */
export function createConversation(element, store, connection) {
  element.append(copyOf("conversation"));
  const conversation = new Conversation(element, store, connection);
  return { focus: () => conversation.composer.focus(), ask: (text) => conversation.ask(text) };
}

class Conversation {
  shown = new Map(); // what each turn says, by number
  settling = 0; // [ms] until when what comes is of before

  constructor(element, store, connection) {
    Object.assign(this, { element, store, connection, parts: partsOf(element) });
    const { absence, empty, pending, suggested, composer } = this.parts;
    const ask = (text) => this.ask(text);
    empty.prepend(drawing("talk"));
    absence.prepend(drawing("service"));
    this.pointing = pointingOf(store);
    this.spoken = new Spoken(this.pointing, element);
    const newest = (n) => store.turns.at(-1)?.n === n;
    this.around = { store, pointing: this.pointing, spoken: this.spoken, ask, newest };
    this.log = new Log(this.parts);
    this.questions = new Questions(connection);
    this.composer = new Composer(composer, store, ask, () => this.cancel());
    followPending(pending, this.questions, () => {
      empty.hidden = store.turns.length > 0 || this.questions.open.size > 0;
      this.log.settle();
    });
    followSuggestions(suggested, store, connection, ask);
    followAbsence(this.parts, store, connection);
    this.followTurns();
    this.questions.addEventListener("settled", ({ detail }) => this.settled(detail));
    this.questions.addEventListener("returned", ({ detail: { question, words } }) => {
      this.composer.say(words);
      if (question) this.composer.giveBack(question.text);
    });
    element.addEventListener("keydown", (event) => {
      if (event.key === "Escape" && !event.defaultPrevented && this.cancel()) this.composer.focus();
    });
  }

  ask(text) {
    const { store } = this;
    const why = cannotAsk(store);
    const asked = why === null && this.questions.ask(text, store.live ? null : store.held);
    if (asked) this.log.toEnd();
    else this.composer.say(why ?? "Not connected at the moment.");
    return asked;
  }

  /** Give up the latest question; false: there is none. */
  cancel() {
    const latest = this.questions.latest();
    if (latest) this.questions.cancel(latest.request);
    return latest !== null;
  }

  followTurns() {
    const { store } = this;
    const settle = () => {
      this.settling = performance.now() + SETTLING;
      setTimeout(() => this.render(), SETTLING + 10);
    };
    let service = null;
    store.addEventListener("turns", () => this.render());
    on(store, "shown ride", () => this.markShown());
    this.connection.addEventListener("welcome", settle);
    store.addEventListener("status", () => {
      if (store.status.service === "there" && service !== "there") settle(); // it remembers what was said
      service = store.status.service;
    });
  }

  /** Show turns as they come, whoever asked. */
  render() {
    const { store, log } = this;
    const { empty, pending } = this.parts;
    const early = performance.now() < this.settling;
    const learning = early || store.status.service !== "there";
    if (learning && store.turns.length === 0 && this.shown.size > 0) return; // a new dashboard is still reading up
    if (!agrees(this.shown, store.turns)) {
      this.shown.clear();
      log.clear();
    }
    const more = store.turns.filter(({ n }) => !this.shown.has(n));
    const quietly = more.length > MANY || (early && pending.childElementCount === 0);
    for (const turn of more) {
      this.shown.set(turn.n, said(turn));
      hideWaiting(pending, turn.text);
    }
    log.add(more.map((turn) => createTurn(turn, this.around)), quietly);
    empty.hidden = store.turns.length > 0 || pending.childElementCount > 0;
    if (!quietly && more.length > 0) this.showOnMap(more.at(-1));
  }

  /** An answer's vehicles are pointed at, and its evidence is on the map, without being asked for. */
  showOnMap({ n, evidence, vehicles }) {
    this.pointing.keep(vehicles);
    this.store.show(evidence || vehicles.length > 0 ? n : null);
  }

  markShown() {
    for (const button of this.element.querySelectorAll("button.on-map")) {
      button.ariaPressed = String(Number(button.dataset.show) === this.store.turn);
    }
  }

  /** A question of this page was answered. */
  settled({ question, n, reply }) {
    const { turns, turn: onMap } = this.store;
    const same = (one) => one.reply.text === reply?.text && one.reply.sim_time === reply.sim_time;
    const turn = turns.findLast((one) => (n === null ? same(one) : one.n === n)); // as of a choice, without a number
    if (turn && onMap !== turn.n) this.showOnMap(turn); // it came with the greeting after a break
    if (turn || !reply) return;
    if (reply.reason === "planner-unavailable") this.composer.giveBack(question.text);
    const passing = { n: null, text: question.text, reply: plainly(reply), vehicles: [], evidence: false };
    this.log.add([createTurn(passing, this.around)], false);
  }
}

/** Whether what is shown is the beginning of these turns. */
function agrees(shown, turns) {
  const now = new Map(turns.map((turn) => [turn.n, said(turn)]));
  return [...shown].every(([n, words]) => now.get(n) === words);
}

function said({ text, reply }) {
  return `${text}\n${reply.kind}\n${reply.text}`;
}

/** The answer is there a moment before it is known whose it is; the question is not to stand there twice. */
function hideWaiting(pending, text) {
  const row = [...pending.children].find((one) => one.dataset.text === text && !one.hidden);
  if (row) row.hidden = true;
}

/** A terminal sets what is no answer apart by brackets; here it is a sentence. */
function plainly(reply) {
  const inner = /^\(([^()]*)\)$/.exec(reply.text)?.[1];
  return inner ? { ...reply, text: `${capital(inner)}${/[.!?]$/.test(inner) ? "" : "."}` } : reply;
}

/** Said above the input while nobody is there to answer. */
function followAbsence({ absence, absenceWords }, store, connection) {
  const follow = () => {
    const service = store.status.connected && connection.state === "open" ? store.status.service : "there";
    absence.hidden = service === "there";
    say(absenceWords, service === "gone" ? "The dialogue service is gone." : "Waiting for the dialogue service.");
  };
  store.addEventListener("status", follow);
  connection.addEventListener("state", follow);
  follow();
}
