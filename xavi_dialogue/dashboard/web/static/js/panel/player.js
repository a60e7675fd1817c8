/** Plays what is past at the pace of life: only the page's own moment moves, never the car. */

import { isFinished } from "../standing.js";

const EACH = 45; // [ms] between moments: what is drawn interpolates anyway

/**
 * @param {import("../store.js").Store} store
 * @param {() => void} changed is told when playing begins or ends
 * @returns {{playing: boolean, toggle: () => void, stop: () => void}}
 */
export function createPlayer(store, changed) {
  let frame = 0;
  let held = 0; // [s] what was set last: whoever sets another moment ends the playing
  let before = 0; // [ms]

  function stop() {
    if (!frame) return;
    cancelAnimationFrame(frame);
    frame = 0;
    changed();
  }

  function step(now) {
    if (store.live || Math.abs(store.held - held) > 1e-3) return void stop();
    frame = requestAnimationFrame(step);
    if (now - before < EACH) return;
    held += Math.min(now - before, 1000) / 1000;
    before = now;
    if (held < store.span[1]) return void store.seek(held);
    store.goLive();
    stop();
  }

  function toggle() {
    if (frame) return void stop();
    if (store.live && !isFinished(store)) return void store.seek(store.at); // to hold it is to pause
    if (store.live) store.seek(store.span[0]); // it is over: once more from its beginning
    held = store.held;
    before = performance.now();
    frame = requestAnimationFrame(step);
    changed();
  }

  return {
    get playing() {
      return frame !== 0;
    },
    toggle,
    stop,
  };
}
