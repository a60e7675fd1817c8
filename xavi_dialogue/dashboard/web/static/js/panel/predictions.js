/** What the other vehicles are expected to do, those that matter first. */

import { copyOf, partsOf, pointedAt, say, set } from "../dom.js";
import { percent } from "../figures.js";
import { widthOf } from "../outcomes.js";
import { pointingOf } from "../pointing.js";
import { capital, nameOf } from "../words.js";
import { beliefsOf, drawPosterior, Places, TINTS } from "./posterior.js";
import { steady } from "./steady.js";

const FIRST = 6; // vehicles that are shown at once
const LONG = 22; // letters of a goal from which on it has a line of its own

/**
 * @param {HTMLElement} element
 * @param {import("../store.js").Store} store
 * @returns {{update: (predictions: Predicted[], near: number[]) => void, move: () => void, forget: () => void}}
 *   `update`: others are expected to do other things; `move`: another moment, or others pointed at
 */
export function createPredictions(element, store) {
  const others = new Others(element, store);
  return {
    update(predictions, near) {
      Object.assign(others, { predictions, near });
      others.render();
    },
    move: () => others.render(),
    forget: () => void (others.places = new Places()),
  };
}

class Others {
  all = false; // whether more than the first are shown
  predictions = [];
  near = []; // vehicles that are in our way
  places = new Places();

  constructor(element, store) {
    Object.assign(this, { store, pointing: pointingOf(store), ...partsOf(element) });
    this.more.addEventListener("click", () => {
      this.all = !this.all;
      this.render();
    });
    new ResizeObserver(() => this.charts()).observe(this.list);
  }

  render() {
    const { list, more, none, predictions, all } = this;
    const shown = this.ranked().slice(0, all ? undefined : FIRST);
    none.hidden = predictions.length > 0;
    const make = ({ vehicle }) => this.card(vehicle);
    steady(list, shown, (one) => one.vehicle, make, (li, one) => this.draw(li, one));
    more.hidden = predictions.length <= FIRST;
    say(more, all ? `Show the ${FIRST} that matter most` : `Show all ${predictions.length}`);
    set(more, "aria-expanded", String(all));
    this.charts();
  }

  /** Causes of the turn shown first, then who is pointed at, then who was in our way. */
  ranked() {
    const { store, predictions, near, list } = this;
    const still = list.matches(":hover") || list.contains(document.activeElement); // none moves away then
    const before = still ? [...list.children].map((li) => Number(li.dataset.vehicle)) : [];
    const rank = ({ vehicle }) => {
      if (before.includes(vehicle)) return before.indexOf(vehicle) - 1000;
      if (this.isCause(vehicle)) return 0;
      if (store.pointed.has(vehicle)) return 1;
      return near.includes(vehicle) ? 2 + near.indexOf(vehicle) : 1000;
    };
    return [...predictions].sort((a, b) => rank(a) - rank(b) || a.vehicle - b.vehicle);
  }

  isCause(vehicle) {
    return (this.store.evidence?.causes ?? []).some((one) => one.vehicle === vehicle);
  }

  card(vehicle) {
    const li = copyOf("other");
    const { pointing } = this;
    li.parts = partsOf(li);
    li.dataset.vehicle = vehicle;
    const { name } = li.parts;
    say(name, capital(nameOf(vehicle)));
    pointedAt(li, name, () => pointing.near(vehicle), () => pointing.away());
    name.addEventListener("click", () => pointing.toggle(vehicle));
    return li;
  }

  draw(li, { vehicle, goals }) {
    const { name, cause, goals: list } = li.parts;
    cause.hidden = !this.isCause(vehicle);
    set(li, "data-pointed", this.store.pointed.has(vehicle) ? "yes" : null);
    set(name, "aria-pressed", String(this.pointing.kept.has(vehicle)));
    const alike = ({ words }) => goals.filter((goal) => goal.words === words).length > 1;
    steady(list, goals, ({ kind, place }) => `${kind} ${place}`, () => copyOf("goal"), (row, goal) => {
      const { words, probability, place } = goal;
      const full = place && alike(goal) ? `${words}: ${place}` : words;
      const [said, bar, share] = row.children;
      say(said, full);
      set(said, "title", place || null);
      set(row, "data-long", full.length > LONG ? "yes" : null);
      bar.firstElementChild.style.width = widthOf(probability);
      bar.firstElementChild.dataset.tint = this.places.of(vehicle, words) % TINTS;
      say(share, percent(probability));
    });
  }

  charts() {
    const { store, list, places } = this;
    const width = Math.floor(list.firstElementChild?.parts.goals.clientWidth ?? 0);
    if (!width) return;
    for (const { dataset, parts } of list.children) {
      const vehicle = Number(dataset.vehicle);
      const stretches = beliefsOf(store.decisions, vehicle, store.at, places);
      drawPosterior(parts.chart, { stretches, goals: places.goals(vehicle), at: store.at, width });
    }
  }
}
