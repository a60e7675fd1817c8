/** Who is pointed at from lists and texts: what the pointer or the focus is on, and what a press keeps. */

const known = new WeakMap(); // by store: all parts of a page keep the same ones

/** What is pointed at on the page of a store. @returns {Pointing} */
export function pointingOf(store) {
  if (!known.has(store)) known.set(store, new Pointing(store));
  return known.get(store);
}

/** Events: `change`, others are kept. */
class Pointing extends EventTarget {
  kept = new Set();

  /** @param {import("./store.js").Store} store */
  constructor(store) {
    super();
    this.store = store;
    store.addEventListener("pointed", () => this.follow());
    store.addEventListener("ride", () => this.keep([]));
  }

  /** The pointer or the focus is on what stands for a vehicle. */
  near(vehicle) {
    this.store.point([...this.kept, vehicle]);
  }

  /** It has left. */
  away() {
    this.store.point(this.kept);
  }

  /** A press keeps it, and another one lets it go. */
  toggle(vehicle) {
    if (!this.kept.delete(vehicle)) this.kept.add(vehicle);
    this.store.point(this.kept);
  }

  /** Point at these until something else is pointed at. */
  keep(vehicles) {
    this.kept = new Set(vehicles);
    this.store.point(this.kept);
  }

  follow() {
    for (const vehicle of [...this.kept]) {
      if (!this.store.pointed.has(vehicle)) this.kept.delete(vehicle); // somebody else points elsewhere
    }
    this.dispatchEvent(new Event("change"));
  }
}
