/** Vehicles named in a text become buttons that point at them on the map. */
import { h } from "../dom.js";

const NAMED = /\b(vehicle\s+)(\d+)\b|\b(vehicles\s+)(\d+(?:(?:,\s*(?:and\s+|or\s+)?|\s+(?:and|or)\s+)\d+)*)\b/gi;

/**
 * Cut a text where it names vehicles.
 * @param {string} text
 * @param {Set<number>} vehicles that may be meant
 * @returns {Array<string|{vehicle: number, words: string}>}
 */
export function cut(text, vehicles) {
  const parts = [];
  let done = 0;
  const name = (from, to, number) => {
    if (!vehicles.has(Number(number))) return;
    parts.push(text.slice(done, from), { vehicle: Number(number), words: text.slice(from, to) });
    done = to;
  };
  for (const match of text.matchAll(NAMED)) {
    if (match[2] !== undefined) {
      name(match.index, match.index + match[0].length, match[2]);
      continue;
    }
    const start = match.index + match[3].length;
    for (const one of match[4].matchAll(/\d+/g)) name(start + one.index, start + one.index + one[0].length, one[0]);
  }
  parts.push(text.slice(done));
  return parts.filter((part) => part !== "");
}

/** What is pointed at: what the pointer or the focus is on, and what a press keeps. */
export class Pointing {
  /**
   * @param {import("../store.js").Store} store
   * @param {HTMLElement} root of all buttons
   */
  constructor(store, root) {
    this.store = store;
    this.root = root;
    this.kept = new Set();
    store.addEventListener("pointed", () => this.follow());
    store.addEventListener("ride", () => this.keep([]));
  }

  /** The text with its vehicles as buttons. */
  spoken(text, vehicles) {
    const known = new Set(vehicles);
    return cut(text, known).map((part) => (typeof part === "string" ? part : this.button(part.vehicle, part.words)));
  }

  button(vehicle, words) {
    const near = () => this.store.point([...this.kept, vehicle]);
    const away = () => this.store.point(this.kept);
    return h(
      "button",
      {
        type: "button",
        class: "named",
        dataset: { vehicle },
        "aria-label": /^\d+$/.test(words) ? `vehicle ${words}` : null,
        "aria-pressed": String(this.kept.has(vehicle)),
        title: "Show it on the map",
        onpointerenter: near,
        onpointerleave: away,
        onfocus: near,
        onblur: away,
        onclick: () => this.toggle(vehicle),
      },
      words,
    );
  }

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
    for (const button of this.root.querySelectorAll("button.named")) {
      button.setAttribute("aria-pressed", String(this.kept.has(Number(button.dataset.vehicle))));
    }
  }
}
