/** Vehicles that the turn shown speaks of. */

/**
 * @param store see store.js
 * @returns {{causes: Set<number>, about: Set<number>}} those that are blamed, and others but ours
 */
export function toldOf({ evidence, turns, turn }) {
  const causes = new Set((evidence?.causes ?? []).map((cause) => cause.vehicle));
  const named = turns.find((one) => one.n === turn)?.vehicles ?? [];
  return { causes, about: new Set(named.filter((id) => id !== 0 && !causes.has(id))) };
}
