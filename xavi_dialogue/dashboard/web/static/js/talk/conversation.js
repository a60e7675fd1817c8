/** The conversation with the car. */
import { fill, h } from "../dom.js";
import { draw } from "../drawings.js";
import { pointingOf } from "../pointing.js";
import { capital } from "../words.js";
import { cannotAsk, createComposer } from "./composer.js";
import { Log } from "./log.js";
import { createPending } from "./pending.js";
import { Questions } from "./questions.js";
import { Spoken } from "./spoken.js";
import { createSuggested } from "./suggested.js";
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
  const questions = new Questions(connection);
  const ask = (text) => {
    const why = cannotAsk(store);
    const asked = why === null && questions.ask(text, store.live ? null : store.held);
    if (asked) log.toEnd();
    else composer.say(why ?? "Not connected at the moment.");
    return asked;
  };
  const cancel = () => {
    const latest = questions.latest();
    if (latest) questions.cancel(latest.request);
    return latest !== null;
  };
  const composer = createComposer({ store, ask, cancel });
  const empty = createEmpty();
  const pending = createPending(questions, () => {
    empty.hidden = store.turns.length > 0 || questions.open.size > 0;
    log.settle();
  });
  const log = new Log(pending, empty, createSuggested(store, connection, ask));
  fill(element, h("div", { class: "talk" }, log.element, createAbsence(store, connection), composer.element));
  const pointing = pointingOf(store);
  const spoken = new Spoken(pointing, element);
  const around = { store, pointing, spoken, ask, newest: (n) => store.turns[store.turns.length - 1]?.n === n };
  followTurns({ element, store, connection, log, around, empty, pending });
  followQuestions({ store, questions, composer, log, around });
  element.addEventListener("keydown", (event) => {
    if (event.key === "Escape" && !event.defaultPrevented && cancel()) composer.focus();
  });
  return { focus: composer.focus, ask };
}

function createEmpty() {
  const words = "It answers from its planner's own record, and says so where that does not bear an answer.";
  const head = h("p", {}, h("b", {}, "Ask the car about its driving."));
  return h("div", { class: "nothing" }, draw("talk"), head, h("p", { class: "soft" }, words));
}

/** Turns as they come, whoever asked. */
function followTurns({ element, store, connection, log, around, empty, pending }) {
  let shown = new Map(); // what each turn says, by number
  let settling = 0; // [ms] until when what comes is of before
  const render = () => {
    const early = performance.now() < settling;
    const learning = early || store.status.service !== "there";
    if (learning && store.turns.length === 0 && shown.size > 0) return; // a new dashboard is still reading up
    if (!agrees(shown, store.turns)) {
      shown = new Map();
      log.clear();
    }
    const more = store.turns.filter(({ n }) => !shown.has(n));
    const quietly = more.length > MANY || (early && pending.childElementCount === 0);
    for (const { n, text, reply } of more) shown.set(n, said(text, reply));
    for (const { text } of more) hideWaiting(pending, text);
    log.add(
      more.map((turn) => createTurn(turn, around)),
      quietly,
    );
    empty.hidden = store.turns.length > 0 || pending.childElementCount > 0;
    if (!quietly && more.length > 0) showOnMap(more[more.length - 1], around);
  };
  store.addEventListener("turns", render);
  for (const name of ["shown", "ride"]) store.addEventListener(name, () => markShown(element, store));
  const settle = () => {
    settling = performance.now() + SETTLING;
    setTimeout(render, SETTLING + 10);
  };
  connection.addEventListener("welcome", settle);
  let service = null;
  store.addEventListener("status", () => {
    if (store.status.service === "there" && service !== "there") settle(); // it remembers what was said
    service = store.status.service;
  });
}

/** Whether what is shown is the beginning of these turns. */
function agrees(shown, turns) {
  const now = new Map(turns.map(({ n, text, reply }) => [n, said(text, reply)]));
  return [...shown].every(([n, words]) => now.get(n) === words);
}

function said(text, reply) {
  return `${text}\n${reply.kind}\n${reply.text}`;
}

/** The answer is there a moment before it is known whose it is; the question is not to stand there twice. */
function hideWaiting(pending, text) {
  const row = [...pending.children].find((one) => one.dataset.text === text && !one.hidden);
  if (row) row.hidden = true;
}

/** An answer's vehicles are pointed at, and its evidence is on the map, without being asked for. */
function showOnMap(turn, { store, pointing }) {
  pointing.keep(turn.vehicles);
  store.show(turn.evidence || turn.vehicles.length > 0 ? turn.n : null);
}

function markShown(element, store) {
  for (const button of element.querySelectorAll("button.on-map")) {
    button.setAttribute("aria-pressed", String(Number(button.dataset.show) === store.turn));
  }
}

/** What becomes of this page's own questions. */
function followQuestions({ store, questions, composer, log, around }) {
  questions.addEventListener("settled", ({ detail: { question, n, reply } }) => {
    const is = (one) =>
      n === null ? one.reply.text === reply?.text && one.reply.sim_time === reply.sim_time : one.n === n;
    const turn = store.turns.findLast(is); // also where its number could not be told, as of a choice
    if (turn && store.turn !== turn.n) showOnMap(turn, around); // it came with the greeting after a break
    if (turn || !reply) return;
    if (reply.reason === "planner-unavailable") composer.giveBack(question.text);
    const passing = { n: null, text: question.text, reply: plainly(reply), vehicles: [], evidence: false };
    log.add([createTurn(passing, around)], false);
  });
  questions.addEventListener("returned", ({ detail: { question, words } }) => {
    composer.say(words);
    if (question) composer.giveBack(question.text);
  });
}

/** A terminal sets what is no answer apart by brackets; here it is a sentence. */
function plainly(reply) {
  const inner = /^\(([^()]*)\)$/.exec(reply.text)?.[1];
  return inner ? { ...reply, text: `${capital(inner)}${/[.!?]$/.test(inner) ? "" : "."}` } : reply;
}

/** Said above the input while nobody is there to answer. */
function createAbsence(store, connection) {
  const element = h("div", { class: "absence", role: "status", hidden: true });
  let shown = null;
  const follow = () => {
    const service = store.status.connected && connection.state === "open" ? store.status.service : "there";
    if (service === shown) return;
    shown = service;
    element.hidden = service === "there";
    if (service === "there") return fill(element);
    const title = service === "gone" ? "The dialogue service is gone." : "Waiting for the dialogue service.";
    const words = " Nobody can answer until it is there; what you type stays here. It is started with ";
    fill(element, draw("service"), h("p", {}, h("b", {}, title), words, h("code", {}, "xavi serve"), "."));
  };
  store.addEventListener("status", follow);
  connection.addEventListener("state", follow);
  follow();
  return element;
}
