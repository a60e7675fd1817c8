/**
 * Where vehicles are at a moment, between the scenes that were told.
 *
 * Live, what is drawn trails the latest scene: it gets there a little after the next one is due, so
 * that one that is late does not stop all motion. It is smooth whatever the speed of the simulation,
 * and nothing has to be guessed.
 */

import { clamped } from "../figures.js";
import { lastUpTo } from "../store.js";

const KEPT = 6; // scenes
const TRAIL = 1.25; // pauses between scenes, in which one is reached
const KNOWN = new WeakMap(); // vehicles by id, by scene
const FAR = 3; // mean pauses between scenes; who is farther behind leaps

export class Motion {
  constructor() {
    this.reset();
  }

  /** Forget all scenes. */
  reset() {
    this.scenes = [];
    this.pause = 100; // [ms] between scenes, smoothed
    this.heard = null; // [ms] when the latest came
    this.start = 0; // [s] what was shown when it came
    this.still = true; // the latest is no other than the one before
  }

  /** A live scene came at `now` [ms]. */
  arrive(scene, now) {
    const last = this.scenes.at(-1);
    const shown = last ? this.time(now) : scene.t;
    if (last && scene.t < last.t) this.scenes = [];
    if (this.heard !== null) this.pause += 0.2 * (clamped(now - this.heard, 30, 500) - this.pause);
    this.still = last !== undefined && alike(last, scene);
    const step = last ? scene.t - last.t : 0;
    this.start = !last || scene.t <= shown || scene.t - shown > FAR * Math.max(step, 0.05) ? scene.t : shown;
    this.scenes.push(scene);
    if (this.scenes.length > KEPT) this.scenes.shift();
    this.heard = now;
  }

  /** [s] The simulation time that is drawn at `now` [ms]. */
  time(now) {
    const last = this.scenes.at(-1);
    const part = clamped((now - this.heard) / (this.pause * TRAIL), 0, 1);
    return this.start + (last.t - this.start) * part;
  }

  /** Whether the picture changes by itself. */
  moving(now) {
    return this.scenes.length > 0 && !this.still && now - this.heard < this.pause * TRAIL;
  }

  /** The last scene that what is drawn at `now` [ms] has come up to. */
  reached(now) {
    return this.scenes[Math.max(lastUpTo(this.scenes, this.time(now)), 0)];
  }

  /** What is drawn live: see `sceneAt`. */
  live(now) {
    return this.scenes.length ? sceneAt(this.scenes, this.time(now)) : null;
  }
}

/** The scene at a moment, between those of a list in order of time: {t, vehicles, lights, hidden}. */
export function sceneAt(scenes, t) {
  const index = Math.max(lastUpTo(scenes, t), 0);
  const [before, after] = [scenes[index], scenes[index + 1]];
  if (!before) return null;
  const step = after ? after.t - before.t : 0;
  if (!after || t <= before.t || step <= 0) return { ...before, t };
  const next = byId(after);
  const part = (t - before.t) / step;
  return { ...before, t, vehicles: before.vehicles.map((one) => between(one, next.get(one.id), part, step)) };
}

/** The vehicles of a scene by their id: found once for all the frames that lead up to it. */
function byId(scene) {
  let found = KNOWN.get(scene);
  if (!found) KNOWN.set(scene, (found = new Map(scene.vehicles.map((vehicle) => [vehicle.id, vehicle]))));
  return found;
}

/** A vehicle on its way from one scene to the next: a cubic that keeps its speed at both. */
function between(a, b, part, step) {
  if (!b) return a;
  const gone = Math.hypot(b.x - a.x, b.y - a.y);
  const could = Math.max(a.speed, b.speed) * step;
  if (gone > 2 * could + 8) return part < 0.5 ? a : b; // put elsewhere
  const [h00, h10, h01, h11] = hermite(part);
  // No faster than what carries it there: a stop amid a long step must not make it overshoot.
  const out = Math.min(a.speed * step, 1.5 * gone);
  const into = Math.min(b.speed * step, 1.5 * gone);
  return {
    ...b,
    x: h00 * a.x + h01 * b.x + h10 * out * Math.cos(a.heading) + h11 * into * Math.cos(b.heading),
    y: h00 * a.y + h01 * b.y + h10 * out * Math.sin(a.heading) + h11 * into * Math.sin(b.heading),
    heading: a.heading + turned(a.heading, b.heading) * part,
    speed: a.speed + (b.speed - a.speed) * part,
  };
}

function hermite(u) {
  const [u2, u3] = [u * u, u * u * u];
  return [2 * u3 - 3 * u2 + 1, u3 - 2 * u2 + u, 3 * u2 - 2 * u3, u3 - u2];
}

/** [rad] The shorter way round from one heading to another. */
function turned(from, to) {
  const turn = (to - from) % (2 * Math.PI);
  return turn > Math.PI ? turn - 2 * Math.PI : turn < -Math.PI ? turn + 2 * Math.PI : turn;
}

function alike(a, b) {
  if (a.vehicles.length !== b.vehicles.length) return false;
  if (String(a.lights) !== String(b.lights) || String(a.hidden) !== String(b.hidden)) return false;
  const near = (one, other) => ["x", "y", "heading"].every((name) => Math.abs(one[name] - other[name]) < 1e-3);
  const same = (one, other) => one.id === other.id && near(one, other) && String(one.signals) === String(other.signals);
  return a.vehicles.every((one, i) => same(one, b.vehicles[i]));
}
