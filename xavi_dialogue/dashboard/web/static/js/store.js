/**
 * What the page knows, in one place: parts of the page read it, and are told when it changes.
 *
 * Messages come in through `take`; `page.d.ts` says what is in them. The moment shown is either
 * live (the latest scene) or held at an earlier time.
 *
 * Changes, each a plain Event of this name on the store:
 *   ride         another ride: all that follows is empty again
 *   roads        `roads` has come
 *   scene        a live scene has come
 *   decisions    there are more of them
 *   events       there are more of them
 *   turns        there are more of them, or another conversation
 *   status       who is there; also when the connection to the dashboard's process is lost
 *   suggestions  what could be asked
 *   moment       another moment is shown (also with every live scene while live)
 *   shown        another turn is shown on the map, or none; or its evidence has come
 *   pointed      other vehicles are pointed at
 *   preview      `preview`: a line to be looked at beside the ego's own, {line: Drive, words} such
 *                as an alternative of the decision in force has; or null. Set by whoever shows it
 */

import { clamped } from "./figures.js";

const MAX_SCENES = 18_000; // an hour at 5 Hz
const SPACING = 0.19; // [s] between scenes that are kept
const HOLE = 0.5; // [s] between scenes above which those between them are fetched, to go back
const MAX_FETCHED = 40; // decisions that are kept whole, and evidences: up to 200 kB each

/** Index of the last item whose time is at most `t`; -1: none. */
export function lastUpTo(items, t, time = (item) => item.t) {
  let low = 0;
  let high = items.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (time(items[middle]) <= t + 1e-6) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

/** A vehicle of a scene, from the array that it is on the wire. */
function vehicleOf([id, x, y, heading, speed, length, width, kind, colour, signals]) {
  return { id, x, y, heading, speed, length, width, kind, colour, signals };
}

export class Store extends EventTarget {
  /** @type {Welcome|null} */
  welcome = null;
  status = { connected: false, hub: "awaited", car: "awaited", service: "awaited", dropped: 0, browsers: 0 };
  /** @type {TurnShown[]} */
  turns = [];
  suggestions = { t: 0, questions: [] };
  pointed = new Set(); // vehicles

  /** @param {(path: string) => Promise<any>} fetchJson gets what a path of this server holds */
  constructor(fetchJson) {
    super();
    this.fetchJson = fetchJson;
    this.begin(null);
  }

  /** Forget one ride for another: {ride, scenario, seed, roads} or null. */
  begin(ride) {
    Object.assign(this, {
      ride,
      roads: null,
      live: true,
      held: 0, // [s] the moment shown where it is not live
      latest: null, // scene: {t, state, speed, plan, vehicles, lights, hidden, wall, seq}
      holes: false, // whether scenes have been missed, as when the ride goes faster than they come
      past: [], // scenes {t, vehicles, lights, hidden}, in order
      decisions: [],
      events: [],
      details: new Map(), // promises of decisions, by id
      evidences: new Map(), // promises of evidence, by number of turn
      turn: null, // number of the turn that is shown on the map
      evidence: null, // its evidence, once it is there
      preview: null, // {line, words}
    });
  }

  /** [s] The moment that is shown. */
  get at() {
    return this.live ? (this.latest?.t ?? 0) : this.held;
  }

  /** [s] from when to when there is anything to show. */
  get span() {
    const first = this.past[0]?.t ?? this.latest?.t ?? 0;
    return [Math.min(first, this.decisions[0]?.t ?? first), this.latest?.t ?? first];
  }

  /** Take in a message of the server. */
  take(message) {
    TAKERS[message.type]?.(this, message);
  }

  /** Show an earlier moment, and stay there. */
  seek(t) {
    const [first, last] = this.span;
    this.live = false;
    this.held = clamped(t, first, last);
    if (this.holes) fetchPast(this, this.ride?.ride).catch(() => (this.holes = true));
    this.tell("moment");
  }

  /** Show what goes on now. */
  goLive() {
    this.live = true;
    this.tell("moment");
  }

  /** The scene at a moment [s], or the last one before. */
  sceneAt(t) {
    if (this.latest && t >= this.latest.t - 1e-6) return this.latest;
    const index = lastUpTo(this.past, t);
    return this.past[Math.max(index, 0)] ?? this.latest;
  }

  /** The decision in force at a moment [s]; null: there is none. */
  decisionAt(t) {
    return this.decisions[lastUpTo(this.decisions, t)] ?? null;
  }

  /** A decision, whole. @returns {Promise<DecisionShown>} */
  detail(id) {
    return this.fetched(this.details, id, `/api/decisions/${encodeURIComponent(id)}`);
  }

  /** What a turn rests on. @returns {Promise<EvidenceShown>} */
  evidenceOf(n) {
    return this.fetched(this.evidences, n, `/api/turns/${n}/evidence`);
  }

  /** Show on the map what a turn speaks of; null: nothing. */
  async show(n) {
    this.turn = n;
    this.evidence = null;
    this.tell("shown");
    const turn = this.turns.find((one) => one.n === n);
    if (!turn?.evidence) return;
    const evidence = await this.evidenceOf(n).catch(() => null);
    if (this.turn === n && evidence) {
      this.evidence = evidence;
      this.tell("shown");
    }
  }

  /** Point at vehicles, on the map and wherever else they stand. */
  point(vehicles) {
    this.pointed = new Set(vehicles);
    this.tell("pointed");
  }

  fetched(kept, key, path) {
    if (!kept.has(key)) {
      const promise = this.fetchJson(path);
      promise.catch(() => kept.delete(key));
      kept.set(key, promise);
      if (kept.size > MAX_FETCHED) kept.delete(kept.keys().next().value); // the oldest
    }
    return kept.get(key);
  }

  tell(name) {
    this.dispatchEvent(new Event(name));
  }

  /** Add scenes of before those that are known, and of the gaps between them. */
  remember(scenes) {
    const missed = scenes.filter(([t]) => {
      const index = lastUpTo(this.past, t);
      const near = [this.past[index], this.past[index + 1]];
      return !near.some((one) => one && Math.abs(one.t - t) < SPACING / 2);
    });
    const more = missed.map(([t, vehicles, lights, hidden]) => {
      return { t, vehicles: vehicles.map(vehicleOf), lights: lights ?? [], hidden: hidden ?? [] };
    });
    this.past = [...more, ...this.past].sort((a, b) => a.t - b.t);
    this.tell("moment");
  }

  keep(scene) {
    const last = this.past.at(-1);
    if (last && scene.t < last.t) this.past.splice(lastUpTo(this.past, scene.t) + 1); // gone back
    else if (last && scene.t - last.t < SPACING) return;
    else if (last && scene.t - last.t > HOLE) this.holes = true;
    this.past.push(scene);
    if (this.past.length > MAX_SCENES) this.past.splice(0, 1000);
  }
}

/** Put items in order, each once. */
function merged(known, more, key, order = (item) => item.t) {
  const all = new Map(known.map((item) => [key(item), item]));
  for (const item of more) all.set(key(item), item);
  return [...all.values()].sort((a, b) => order(a) - order(b));
}

/** Whether turns are the same conversation, as when one has connected anew. */
function goesOn(known, turns) {
  const texts = new Map(turns.map((one) => [one.n, one.text]));
  return known.every((one) => texts.get(one.n) === one.text);
}

/** What belongs to numbers of turns, which may be those of others now. */
function forgetTurns(store) {
  store.evidences.clear();
  store.turn = store.evidence = null;
  store.tell("shown");
}

async function fetchRoads(store, hash) {
  const roads = await store.fetchJson(`/api/roads/${encodeURIComponent(hash)}`);
  if (store.ride?.roads !== hash) return;
  store.roads = roads;
  store.tell("roads");
}

async function fetchPast(store, ride) {
  store.holes = false;
  const past = await store.fetchJson("/api/past");
  if (store.ride?.ride === ride && past.ride === ride) store.remember(past.scenes);
}

const TAKERS = {
  welcome(store, message) {
    store.welcome = message;
  },
  ride(store, message) {
    const same = store.ride?.ride === message.ride;
    const known = same && store.ride.roads === message.roads; // connected anew
    if (same) store.ride = message;
    else store.begin(message);
    if (!known) store.tell(same ? "status" : "ride");
    if (message.roads && !store.roads) fetchRoads(store, message.roads).catch(() => {});
    if (!same || known) fetchPast(store, message.ride).catch(() => {});
  },
  scene(store, message) {
    store.latest = { ...message, vehicles: message.vehicles.map(vehicleOf) };
    store.keep(store.latest);
    store.tell("scene");
    if (store.live) store.tell("moment");
  },
  decisions(store, { decisions }) {
    store.decisions = merged(store.decisions, decisions, (one) => one.id);
    store.tell("decisions");
  },
  events(store, { events }) {
    store.events = merged(store.events, events, (one) => `${one.t} ${one.kind} ${one.action} ${one.vehicle}`);
    store.tell("events");
  },
  turns(store, { turns, reset }) {
    const number = (one) => one.n;
    if (reset && !goesOn(store.turns, turns)) forgetTurns(store);
    store.turns = reset ? turns : merged(store.turns, turns, number, number);
    store.tell("turns");
  },
  status(store, message) {
    store.status = { ...message, connected: true };
    store.tell("status");
  },
  suggestions(store, message) {
    store.suggestions = message;
    store.tell("suggestions");
  },
};
