/**
 * The WebSocket to the dashboard's process, which comes back by itself.
 *
 * Events of a connection, beside what it puts into the store:
 *   state      `state` has changed: connecting, open, waiting (until it tries again) or refused
 *   welcome    it is open and greeted; also after every break
 *   message    a CustomEvent for messages that are not the store's: detail is the message
 */
import { ofTab, recall, remember } from "./remembered.js";

const FIRST_PAUSE = 0.5; // [s]
const LONGEST_PAUSE = 10;
const STEADY = 5; // [s] after which a connection counts as a good one
const SILENCE = 15; // [s] without a message while scenes should come: the other end is gone
const GREETING = 10; // [s] until the welcome has to be there
const RELOADED = "xavi-reloaded";
const PERSONAL = new Set(["answered", "trouble"]);

/** Why a server closes, by code; `again`: whether it is worth coming back, `slow`: not at once. */
const CLOSED = {
  1001: { words: "The dashboard was stopped.", again: true },
  1003: { words: "The dashboard could not read what this page said.", again: true, slow: true },
  1009: { words: "A message was too large for the dashboard.", again: true, slow: true },
  1011: { words: "Something went wrong in the dashboard.", again: true, slow: true },
  1013: { words: "The dashboard is busy.", again: true, slow: true, told: true },
  4401: { words: "The dashboard wants its token. Open the address that it printed where it was started." },
  4429: { words: "This page asked too much in too short a time.", again: true, slow: true, told: true },
};

/**
 * How long to wait before trying again.
 * @param {number} attempt tries since the last good connection, from 0
 * @param {number} random in [0, 1): spreads many pages that lost the same server
 * @returns {number} [s] from 0.5 to 10
 */
function pauseBefore(attempt, random) {
  const longest = Math.min(LONGEST_PAUSE, FIRST_PAUSE * 2 ** Math.min(attempt, 10));
  return Math.max(FIRST_PAUSE, longest * (0.6 + 0.4 * random));
}

export class Connection extends EventTarget {
  state = "connecting";
  words = null; // why it was closed
  retryAt = 0; // [ms] of performance.now()
  greeted = false; // since the last opening
  ever = false; // greeted at least once
  attempt = 0;
  socket = null;
  heard = 0; // [ms] of the last message
  timer = 0;
  unseen = []; // scenes that are not on the screen yet

  /**
   * @param {import("./store.js").Store} store
   * @param {string} address of the WebSocket
   */
  constructor(store, address) {
    super();
    Object.assign(this, { store, address });
    addEventListener("online", () => this.hurry());
    document.addEventListener("visibilitychange", () => this.awake());
    setInterval(() => this.listen(), 1000);
  }

  /** Connect now. */
  open() {
    clearTimeout(this.timer);
    const socket = new WebSocket(this.address);
    this.socket = socket;
    this.greeted = false;
    this.heard = performance.now();
    this.become("connecting");
    socket.onmessage = (event) => socket === this.socket && this.take(JSON.parse(event.data));
    socket.onclose = (event) => socket === this.socket && this.lost(event.code, event.reason);
  }

  /** @returns {boolean} whether it is on its way; not whether it arrives */
  send(message) {
    if (this.state !== "open" || this.socket.readyState !== WebSocket.OPEN) return false;
    this.socket.send(JSON.stringify(message));
    return true;
  }

  /** Try again at once, where it waits to. */
  hurry() {
    if (this.state === "waiting" || this.state === "refused") this.open();
  }

  awake() {
    this.heard = performance.now(); // a tab that slept has heard nothing, through no fault of the other end
    if (!document.hidden && this.state === "waiting") this.open();
  }

  take(message) {
    this.heard = performance.now();
    if (message.type === "welcome" && this.anotherProgram(message.version)) return;
    this.store.take(message);
    if (message.type === "welcome") this.welcomed();
    else if (message.type === "scene") this.acknowledge(message.seq);
    else if (PERSONAL.has(message.type)) this.dispatchEvent(new CustomEvent("message", { detail: message }));
  }

  welcomed() {
    this.greeted = true;
    this.ever = true;
    const socket = this.socket;
    setTimeout(() => {
      if (socket === this.socket && this.state === "open") this.attempt = 0;
    }, STEADY * 1000);
    this.words = null;
    this.become("open");
    this.send({ type: "here" });
    this.dispatchEvent(new Event("welcome"));
  }

  /** Load the page of the program that is there now, but never twice for the same one. */
  anotherProgram(version) {
    const known = this.store.welcome?.version;
    if (known === undefined || known === version || recall(RELOADED, ofTab) === version) return false;
    remember(RELOADED, version, ofTab);
    location.reload();
    return true;
  }

  /** Tell that a scene is on the screen, so that a slow page gets fewer. */
  acknowledge(seq) {
    this.unseen.push(seq);
    if (document.hidden) this.drawn(); // nothing is drawn, and there is nothing to wait for
    else if (this.unseen.length === 1) requestAnimationFrame(() => this.drawn());
  }

  drawn() {
    const seq = this.unseen.pop(); // stands for those before it
    this.unseen = [];
    if (seq !== undefined) this.send({ type: "seen", seq });
  }

  lost(code, reason) {
    const told = CLOSED[code];
    this.unseen = [];
    const before = this.attempt > 0 ? this.words : null; // what was said at first, not that it is so still
    this.words = told?.told && reason ? reason : (told?.words ?? before);
    this.store.status = { ...this.store.status, connected: false };
    if (told && !told.again) {
      this.become("refused");
    } else {
      const pause = pauseBefore(told?.slow ? Math.max(this.attempt, 3) : this.attempt, Math.random());
      this.attempt += 1;
      this.retryAt = performance.now() + pause * 1000;
      this.timer = setTimeout(() => this.open(), pause * 1000);
      this.become("waiting");
    }
    this.store.tell("status");
  }

  /** Give up a connection whose other end has vanished without a word. */
  listen() {
    if (this.socket === null || this.state === "waiting" || this.state === "refused") return;
    const quiet = (performance.now() - this.heard) / 1000;
    const { status, latest } = this.store;
    const scenesDue = status.car === "there" && latest?.state === "driving" && !document.hidden;
    if (this.greeted ? !(scenesDue && quiet > SILENCE) : quiet <= GREETING) return;
    const socket = this.socket;
    this.socket = null; // its close event may take a minute, and tells nothing new
    socket.close();
    this.lost(1006, "");
  }

  become(state) {
    this.state = state;
    this.dispatchEvent(new Event("state"));
  }
}
