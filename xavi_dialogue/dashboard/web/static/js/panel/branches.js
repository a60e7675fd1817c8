/** The branches of the search: how often each was tried, what it was worth, who was in the way. */

import { h, say } from "../dom.js";
import { counted, fixed, percent, seconds } from "../figures.js";
import { drawOutcomes, outcomeBar } from "../outcomes.js";
import { capital, doing, nameOf, outcomesInWords } from "../words.js";
import { steady } from "./steady.js";
import { createTree } from "./tree.js";

/** Why its figures are others than those of the alternatives. */
const COUNTS =
  "Here everything that I tried is counted, poor ways to go on as well. What I could have done, above, tells what " +
  "comes of the best way to go on after each first action, weighed by how likely each situation is.";

/** @returns {{element: HTMLElement, update: (decision: object) => void}} */
export function createBranches() {
  const tree = createTree({
    label: "Search tree",
    row: branchRow,
    draw: drawBranch,
    key: (branch) => branch.action,
    name: inWords,
    children: (branch) => branch.children,
    open: (branch) => branch.chosen,
  });
  const none = h("p", { class: "quiet" }, "There was nothing to search: no rollouts are in the record.");
  const counts = h("p", { class: "quiet" }, COUNTS);
  return {
    element: h("div", { class: "branches" }, none, counts, tree.element),
    update(decision) {
      none.hidden = decision.root.length > 0;
      tree.element.hidden = counts.hidden = !none.hidden;
      tree.update(decision.root);
    },
  };
}

function branchRow() {
  const parts = {
    words: h("span", { class: "branch-words" }),
    mark: h("span", { class: "badge" }, "my plan"),
    visits: h("span", { class: "figure branch-visits" }),
    outcomes: outcomeBar(),
    facts: h("span", { class: "small" }),
    held: h("ul", { class: "branch-held small" }),
    refused: h("p", { class: "branch-refused small" }),
  };
  const head = h(
    "div",
    { class: "branch-head" },
    h("span", { class: "branch-fold", "aria-hidden": "true" }),
    parts.words,
    parts.mark,
    parts.visits,
  );
  const row = h("div", { class: "branch" }, head, parts.outcomes, parts.facts, parts.held, parts.refused);
  row.parts = parts;
  return row;
}

function drawBranch(row, branch, open) {
  const { words, mark, visits, outcomes, facts, held, refused } = row.parts;
  say(words, capital(branch.words));
  mark.hidden = !branch.chosen;
  say(visits, visitsOf(branch));
  drawOutcomes(outcomes, branch.outcomes);
  say(facts, factsOf(branch).join(" · "));
  lines(held, branch.held_up.map(heldUp));
  const leaf = !branch.children.length;
  refused.hidden = !branch.refused.length || !(open || leaf);
  if (!refused.hidden) say(refused, notThen(branch.refused));
}

function lines(list, texts) {
  list.hidden = !texts.length;
  steady(
    list,
    texts,
    (text) => text,
    () => h("li"),
    say,
  );
}

function visitsOf({ visits, forced }) {
  return forced ? `${visits} + ${forced} forced` : counted(visits, "visit");
}

function factsOf(branch) {
  return [
    outcomesInWords(branch.outcomes),
    branch.arrival === null ? null : `there in ${seconds(branch.arrival)}`,
    branch.value === null ? null : `value ${fixed(branch.value)}`,
  ].filter(Boolean);
}

function heldUp([vehicle, how, share]) {
  return `Held up in ${percent(share)} by ${nameOf(vehicle)} ${how}`; // "... vehicle 1 going first"
}

/** "Not possible then: change left (there is no lane to the left); stop (...)" */
function notThen(refused) {
  const reasons = new Map();
  for (const [action, why] of refused) reasons.set(why, [...(reasons.get(why) ?? []), doing(action)]);
  return `Not possible then: ${[...reasons].map(([why, actions]) => `${actions.join(", ")} (${why})`).join("; ")}`;
}

function inWords(branch) {
  const chosen = branch.chosen ? ", my plan" : "";
  return [
    `${capital(branch.words)}${chosen}`,
    visitsOf(branch),
    ...factsOf(branch),
    ...branch.held_up.map(heldUp),
  ].join(", ");
}
