/** The decision in force at the moment shown, whole; fetched one at a time. */

const STALE = 3; // [s] for which the one before stands in while the next one is on its way

export class Deciding {
  detail = null;
  asked = null; // id that is on its way
  failed = null; // id that is not to be had

  /** @param {() => void} changed is called when another decision is there */
  constructor(store, changed) {
    Object.assign(this, { store, changed });
  }

  /** Another moment is shown, or there are more decisions. */
  update() {
    const wanted = this.store.decisionAt(this.store.at);
    if (!wanted) this.keep(null);
    else if (wanted.id !== this.detail?.id) {
      const age = wanted.t - (this.detail?.t ?? -Infinity);
      if (age < 0 || age > STALE) this.keep(null);
      if (this.asked === null && this.failed !== wanted.id) this.fetch(wanted.id);
    }
  }

  async fetch(id) {
    this.asked = id;
    const detail = await this.store.detail(id).catch(() => null);
    this.asked = null;
    this.failed = detail ? null : id;
    if (detail && this.store.decisionAt(this.store.at)?.id === id) this.keep(detail);
    else if (detail) this.update(); // the moment went on meanwhile
  }

  keep(detail) {
    if (this.detail === detail) return;
    this.detail = detail;
    this.changed();
  }
}
