/**
 * Questions of this page that are on their way.
 *
 * Events:
 *   change     there are others, or something is known of one
 *   settled    a CustomEvent: {question, n, reply}, as in AnsweredHere
 *   returned   a CustomEvent: {question, words}: it got no answer, and why
 */

const NAMED = 25; // [s] for which the service knows a request by its name, and does not take it for another
const PATIENCE = 45; // [s] the service itself answers or gives up within far less

/** @typedef {{request: string, text: string, at: number|null, since: number, sent: boolean}} Question */

export class Questions extends EventTarget {
  /** @type {Map<string, Question>} by request */
  open = new Map();

  /** @param {import("../connection.js").Connection} connection */
  constructor(connection) {
    super();
    this.connection = connection;
    connection.addEventListener("message", ({ detail }) => TAKERS[detail.type]?.(this, detail));
    connection.addEventListener("welcome", () => this.askAgain());
    connection.addEventListener("state", () => this.interrupted());
    setInterval(() => this.giveUp(), 1000);
  }

  /**
   * Ask.
   * @param {string} text
   * @param {number|null} at the moment it is about [s]; null: now
   * @returns {boolean} false: nobody could be asked
   */
  ask(text, at) {
    const question = { request: newName(), text, at, since: performance.now(), sent: true };
    if (!this.send(question)) return false;
    this.open.set(question.request, question);
    this.changed();
    return true;
  }

  send({ request, text, at }) {
    return this.connection.send({ type: "ask", request, text, at });
  }

  /** The answer is not wanted any more. */
  cancel(request) {
    this.connection.send({ type: "cancel", request });
    this.returned(request, "");
  }

  /** The latest question that waits; null: none does. */
  latest() {
    return [...this.open.values()].at(-1) ?? null;
  }

  askAgain() {
    for (const question of this.open.values()) {
      const known = performance.now() - question.since < NAMED * 1000;
      if (known) question.sent = this.send(question);
      else this.returned(question.request, "The connection was lost for too long. Ask it again?");
    }
    this.changed();
  }

  interrupted() {
    if (this.connection.state === "open") return;
    for (const question of this.open.values()) {
      if (this.connection.state === "refused") this.returned(question.request, this.connection.words);
      question.sent = false;
    }
    this.changed();
  }

  giveUp() {
    for (const { request, since } of this.open.values()) {
      if (performance.now() - since > PATIENCE * 1000) this.returned(request, "No answer came. Ask it again?");
    }
  }

  returned(request, words) {
    const question = this.taken(request);
    if (question) this.dispatchEvent(new CustomEvent("returned", { detail: { question, words } }));
  }

  taken(request) {
    const question = this.open.get(request) ?? null;
    this.open.delete(request);
    if (question) this.changed();
    return question;
  }

  changed() {
    this.dispatchEvent(new Event("change"));
  }
}

const TAKERS = {
  answered(questions, { request, n, reply }) {
    const question = questions.taken(request);
    if (question) questions.dispatchEvent(new CustomEvent("settled", { detail: { question, n, reply } }));
  },
  trouble(questions, { request, text }) {
    if (request !== null && questions.open.has(request)) questions.returned(request, text);
    else questions.dispatchEvent(new CustomEvent("returned", { detail: { question: null, words: text } }));
  },
};

// crypto.randomUUID is there on secure addresses only, which one in the house's network is not.
function newName() {
  const bytes = crypto.getRandomValues(new Uint8Array(16));
  return [...bytes].map((byte) => byte.toString(16).padStart(2, "0")).join("");
}
