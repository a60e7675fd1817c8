/** How things stand with the ride at its latest moment, in the same words all over the page. */

/** @typedef {"none"|"unheard"|"coming"|"over"|"played"|"gone"|"paused"|"playing"|"live"} Standing */

const FINISHED = new Set(["over", "played", "gone", "unheard"]);

/**
 * @param {import("./store.js").Store} store
 * @returns {Standing} over: the ride has ended; played: the recording has; unheard: the dashboard
 *   or the hub is not there; coming: the car is started again; playing: a recording is under way
 */
export function standing(store) {
  const { latest, status, welcome } = store;
  if (!latest) return "none";
  if (!status.connected || status.hub === "gone") return "unheard";
  if (status.car === "coming") return "coming";
  if (atEndOfTape(store)) return "played";
  if (latest.state === "ended") return "over"; // also once the car has gone home after it
  if (status.car === "gone") return "gone";
  if (latest.state === "paused") return "paused";
  return welcome?.recording ? "playing" : "live";
}

/** Whether nothing more is to come as things stand, so that the latest moment is the end. */
export function isFinished(store) {
  return FINISHED.has(standing(store));
}

/** What the button says that leads to the latest moment. */
export function wayBack(store) {
  if (isFinished(store)) return "Back to the end";
  return ["playing", "coming"].includes(standing(store)) ? "Back to the latest" : "Back to live";
}

/** A recording stands still before its beginning, and at its end: also at one that broke off. */
function atEndOfTape({ welcome, latest, span }) {
  if (!welcome?.recording) return false;
  return latest.state === "ended" || (latest.state === "paused" && latest.t > span[0]);
}
