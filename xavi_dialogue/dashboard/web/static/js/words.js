/** Words that all parts of the page have in common: the same thing is called the same everywhere. */
import { percent } from "./figures.js";

/** What a rollout may come to, best first, as the car itself speaks of it. */
export const OUTCOMES = {
  done: "gets there",
  termination: "is not there in time",
  dead: "does not take us there",
  collision: "collides",
};

// The words of the car's own sentences, shortened: "move to the left lane", "continue to the next exit".
const DOING = {
  continue: "straight on",
  "change-left": "move left",
  "change-right": "move right",
  "exit-left": "turn left",
  "exit-right": "turn right",
  "exit-straight": "straight on",
  "continue-next-exit": "to the next exit",
  stop: "stop",
};

/** What an outcome is called. */
export function outcomeWords(outcome) {
  return OUTCOMES[outcome] ?? outcome;
}

/** Outcomes with their shares, best first: [[outcome, share], ...]; those that there are. */
export function sharesOf(outcomes) {
  return Object.keys(OUTCOMES)
    .map((outcome) => [outcome, outcomes[outcome] ?? 0])
    .filter(([, share]) => share > 0);
}

/** "gets there 91 %, collides 9 %"; empty where nothing is known. */
export function outcomesInWords(outcomes) {
  return sharesOf(outcomes)
    .map(([outcome, share]) => `${outcomeWords(outcome)} ${percent(share)}`)
    .join(", ");
}

/** A macro action in a few words, for where there is little room. */
export function doing(action) {
  return DOING[action] ?? String(action ?? "").replaceAll("-", " ");
}

/** The car says "vehicle 1" and "us". */
export function nameOf(vehicle) {
  return vehicle === 0 ? "us" : `vehicle ${vehicle}`;
}

const KINDS = new Set(["bicycle", "pedestrian", "scooter", "wheelchair"]);

/** What a road user that is seen is called: "pedestrian 9"; the kind of motor vehicles is left out. */
export function calledOf({ id, kind }) {
  return KINDS.has(kind) ? `${kind} ${id}` : nameOf(id);
}

/** The same words, as they begin a sentence. */
export function capital(words) {
  return words.slice(0, 1).toUpperCase() + words.slice(1);
}

/** "Change to the left lane" -> "change to the left lane"; other capitals stay. */
export function lower(words) {
  return words.slice(0, 1).toLowerCase() + words.slice(1);
}
