/** What the other vehicles are expected to do, those that matter first. */

import { h, say, set } from "../dom.js";
import { percent } from "../figures.js";
import { pointingOf } from "../pointing.js";
import { capital, nameOf } from "../words.js";
import { drawShare, shareBar } from "./bars.js";
import { beliefsOf, drawPosterior, Places, stretchFor } from "./posterior.js";
import { steady } from "./steady.js";

const FIRST = 6; // vehicles that are shown at once

/**
 * @param {Store} store
 * @returns {{element: HTMLElement, update: (predictions: object[], near: number[]) => void,
 *   move: () => void, forget: () => void}}
 *   `update`: others are expected to do other things; `move`: another moment, or others pointed at
 */
export function createPredictions(store) {
  const list = h("ul", { class: "others" });
  const more = h("button", { type: "button", class: "show-all", hidden: true });
  const none = h("p", { class: "quiet" }, "Nobody else was in view.");
  const here = { store, list, more, none, all: false, predictions: [], near: [], places: new Places(), order: [] };
  more.addEventListener("click", () => {
    here.all = !here.all;
    render(here);
  });
  new ResizeObserver(() => charts(here)).observe(list);
  return {
    element: h("div", { class: "predictions" }, none, list, more),
    update(predictions, near) {
      Object.assign(here, { predictions, near });
      render(here);
    },
    move: () => render(here),
    forget: () => (here.places = new Places()),
  };
}

function render(here) {
  const { list, more, none, predictions } = here;
  const sorted = ranked(here);
  const shown = here.all ? sorted : sorted.slice(0, FIRST);
  none.hidden = sorted.length > 0;
  steady(
    list,
    shown,
    (one) => one.vehicle,
    (one) => card(here, one.vehicle),
    (li, one) => drawCard(here, li, one),
  );
  more.hidden = predictions.length <= FIRST;
  say(more, here.all ? `Show the ${FIRST} that matter most` : `Show all ${predictions.length}`);
  set(more, "aria-expanded", String(here.all));
  charts(here);
}

/** Causes of the turn shown first, then who is pointed at, then who was in our way. */
function ranked({ store, predictions, near, list }) {
  const causes = new Set((store.evidence?.causes ?? []).map((one) => one.vehicle));
  const still = list.matches(":hover") || list.contains(document.activeElement); // none moves away then
  const before = still ? [...list.children].map((li) => Number(li.dataset.vehicle)) : [];
  const rank = ({ vehicle }) => {
    if (before.includes(vehicle)) return before.indexOf(vehicle) - 1000;
    if (causes.has(vehicle)) return 0;
    if (store.pointed.has(vehicle)) return 1;
    return near.includes(vehicle) ? 2 + near.indexOf(vehicle) : 1000;
  };
  return [...predictions].sort((a, b) => rank(a) - rank(b) || a.vehicle - b.vehicle);
}

function card({ store }, vehicle) {
  const name = h("button", { type: "button", class: "other-name", "aria-pressed": "false" }, capital(nameOf(vehicle)));
  const li = h(
    "li",
    { class: "other", dataset: { vehicle } },
    h("div", { class: "other-head" }, name, h("span", { class: "badge badge-cause", hidden: true }, "a cause")),
    h("ul", { class: "goals" }),
    h("svg", { class: "posterior", role: "img" }),
  );
  const pointing = pointingOf(store);
  const [enter, leave] = [() => pointing.near(vehicle), () => pointing.away()];
  li.addEventListener("pointerenter", (event) => event.pointerType === "mouse" && enter());
  li.addEventListener("pointerleave", (event) => event.pointerType === "mouse" && leave());
  name.addEventListener("focus", () => name.matches(":focus-visible") && enter());
  name.addEventListener("blur", leave);
  name.addEventListener("click", () => pointing.toggle(vehicle));
  return li;
}

function drawCard({ store, places }, li, { vehicle, goals }) {
  const [head, list] = li.children;
  const cause = (store.evidence?.causes ?? []).some((one) => one.vehicle === vehicle);
  head.lastElementChild.hidden = !cause;
  set(li, "data-pointed", store.pointed.has(vehicle) ? "yes" : null);
  set(head.firstElementChild, "aria-pressed", String(pointingOf(store).kept.has(vehicle)));
  const alike = ({ words }) => goals.filter((goal) => goal.words === words).length > 1;
  const named = goals.map((goal) => ({
    ...goal,
    full: alike(goal) && goal.place ? `${goal.words}: ${goal.place}` : goal.words,
  }));
  steady(
    list,
    named,
    (goal) => `${goal.kind} ${goal.place}`,
    goalRow,
    (row, goal) => {
      const [words, bar, share] = row.children;
      say(words, goal.full);
      set(words, "title", goal.place || null);
      set(row, "data-long", goal.full.length > 22 ? "yes" : null);
      drawShare(bar, goal.probability, places.of(vehicle, goal.words) % 6);
      say(share, percent(goal.probability));
    },
  );
}

function goalRow() {
  return h(
    "li",
    { class: "goal" },
    h("span", { class: "goal-words" }),
    shareBar("goal-bar"),
    h("span", { class: "figure" }),
  );
}

function charts({ store, list, places }) {
  const width = Math.floor(list.firstElementChild?.querySelector(".goals").clientWidth ?? 0);
  if (!width) return;
  const span = stretchFor(store.at);
  for (const li of list.children) {
    const vehicle = Number(li.dataset.vehicle);
    const stretches = beliefsOf(store.decisions, vehicle, span, places);
    drawPosterior(li.lastElementChild, { stretches, goals: places.goals(vehicle), at: store.at, width });
  }
}
