/** Plays what is past at the pace of life: only the page's own moment moves, never the car. */

import { isFinished } from "../standing.js";

const EACH = 45; // [ms] between moments: what is drawn interpolates anyway

/**
 * @param {Store} store
 * @param {() => void} changed is told when playing begins or ends
 * @returns {{playing: boolean, toggle: () => void, stop: () => void}}
 */
export function createPlayer(store, changed) {
  let handle = 0;
  let held = 0; // [s] what was set last: whoever sets another moment ends the playing
  let before = 0;

  function stop() {
    if (!handle) return;
    cancelAnimationFrame(handle);
    handle = 0;
    changed();
  }

  function step(now) {
    if (store.live || Math.abs(store.held - held) > 1e-3) return stop();
    handle = requestAnimationFrame(step);
    if (now - before < EACH) return undefined;
    const t = held + Math.min(now - before, 1000) / 1000;
    before = now;
    if (t >= store.span[1]) {
      store.goLive();
      return stop();
    }
    held = t;
    return store.seek(t);
  }

  function toggle() {
    if (handle) return stop();
    if (store.live && !isFinished(store)) return store.seek(store.at); // to hold it is to pause
    if (store.live) store.seek(store.span[0]); // it is over: once more from its beginning
    held = store.held;
    before = performance.now();
    handle = requestAnimationFrame(step);
    return changed();
  }

  return {
    get playing() {
      return handle !== 0;
    },
    toggle,
    stop,
  };
}
