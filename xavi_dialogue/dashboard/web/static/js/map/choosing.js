/** Vehicles that are hovered, tapped or gone through by keys: their card, and who else is told. */

import { middleOf, radiusOf } from "./bodies.js";
import { createCard } from "./card.js";

const NEAR = 16; // [px] around a vehicle that still mean it

/**
 * Vehicles that the turn shown speaks of.
 * @param {import("../store.js").Store} store
 * @returns {{causes: Set<number>, about: Set<number>}} those that are blamed, and others but ours
 */
export function toldOf({ evidence, turns, turn }) {
  const causes = new Set((evidence?.causes ?? []).map((cause) => cause.vehicle));
  const named = turns.find((one) => one.n === turn)?.vehicles ?? [];
  return { causes, about: new Set(named.filter((id) => id !== 0 && !causes.has(id))) };
}

export class Choosing {
  vehicles = []; // of the scene that is drawn
  hovered = null; // vehicle under the mouse
  chosen = null; // vehicle whose card stays

  /**
   * @param {HTMLElement} card
   * @param {{say: (vehicle, goals) => void}} summary announces the vehicle that is chosen
   * @param {() => void} changed is called when another one is
   */
  constructor(card, store, view, summary, changed) {
    Object.assign(this, { store, view, summary, changed, card: createCard(card) });
  }

  /** The vehicle that a card is shown of, or null. */
  get id() {
    return this.hovered ?? this.chosen;
  }

  find(id) {
    return this.vehicles.find((vehicle) => vehicle.id === id) ?? null;
  }

  /** The vehicle at a place [px] of the map, or null. */
  at(px, py) {
    let best = { id: null, away: Infinity };
    for (const vehicle of this.vehicles) {
      const [x, y] = this.view.toScreen(...middleOf(vehicle));
      const away = Math.hypot(x - px, y - py);
      const near = away < Math.max(radiusOf(vehicle, this.view.scale), NEAR);
      if (near && away < best.away) best = { id: vehicle.id, away };
    }
    return best.id;
  }

  /** Choose a vehicle, or none: null. Other parts of the page point at it too. */
  choose(id) {
    const { pointed } = this.store;
    const ours = this.chosen !== null && pointed.size === 1 && pointed.has(this.chosen);
    this.chosen = id;
    if (id) this.store.point([id]);
    else if (ours) this.store.point([]);
    const vehicle = this.find(id);
    this.summary.say(vehicle, vehicle && this.goalsOf(id));
    this.changed();
  }

  /** Choose the next or previous one of those in view. */
  next(step, inView) {
    const ids = [...inView].sort((a, b) => a - b);
    if (!ids.length) return;
    const at = ids.indexOf(this.chosen);
    const start = step > 0 ? -1 : 0;
    this.choose(ids[((at < 0 ? start : at) + step + ids.length) % ids.length]);
  }

  /** What a vehicle is expected to do: [[words, probability], ...], likeliest first. */
  goalsOf(id) {
    const beliefs = this.store.decisionAt(this.store.at)?.beliefs ?? [];
    const goals = beliefs.find((one) => one.vehicle === id)?.goals ?? [];
    return [...goals].sort((a, b) => b[1] - a[1]);
  }

  /** Let the card stand beside its vehicle. */
  place() {
    const vehicle = this.find(this.id);
    const { width, height, scale } = this.view;
    const [x, y] = vehicle ? this.view.toScreen(...middleOf(vehicle)) : [-1, -1];
    if (x < 0 || y < 0 || x > width || y > height) this.card.hide();
    else this.card.show(vehicle, this.goalsOf(vehicle.id), { x, y, reach: radiusOf(vehicle, scale), width, height });
  }
}
