/** The branches of the search: how often each was tried, what it was worth, who was in the way. */

import { copyOf, h, partsOf, say } from "../dom.js";
import { counted, fixed, percent, seconds } from "../figures.js";
import { drawOutcomes, outcomeBar } from "../outcomes.js";
import { capital, doing, nameOf, outcomesInWords } from "../words.js";
import { steady } from "./steady.js";
import { createTree } from "./tree.js";

/**
 * @param {HTMLElement} element
 * @returns {{update: (decision: DecisionShown) => void}}
 */
export function createBranches(element) {
  const { none, counts, tree: list } = partsOf(element);
  const tree = createTree(list, {
    row: createRow,
    draw: drawBranch,
    key: (branch) => branch.action,
    name: inWords,
    children: (branch) => branch.children,
    open: (branch) => branch.chosen,
  });
  return {
    update({ root }) {
      none.hidden = root.length > 0;
      list.hidden = counts.hidden = !none.hidden;
      tree.update(root);
    },
  };
}

function createRow() {
  const row = copyOf("branch");
  row.parts = { ...partsOf(row), outcomes: outcomeBar() };
  row.parts.facts.before(row.parts.outcomes);
  return row;
}

function drawBranch(row, branch, open) {
  const { words, mark, visits, outcomes, facts, held, refused } = row.parts;
  say(words, capital(branch.words));
  mark.hidden = !branch.chosen;
  say(visits, visitsOf(branch));
  drawOutcomes(outcomes, branch.outcomes);
  say(facts, factsOf(branch).join(" · "));
  held.hidden = !branch.held_up.length;
  steady(held, branch.held_up.map(heldUp), (text) => text, () => h("li"), say);
  refused.hidden = !branch.refused.length || !(open || !branch.children.length);
  if (!refused.hidden) say(refused, notThen(branch.refused));
}

function visitsOf({ visits, forced }) {
  return forced ? `${visits} + ${forced} forced` : counted(visits, "visit");
}

function factsOf({ outcomes, arrival, value }) {
  return [
    outcomesInWords(outcomes),
    arrival !== null && `there in ${seconds(arrival)}`,
    value !== null && `value ${fixed(value)}`,
  ].filter(Boolean);
}

function heldUp([vehicle, how, share]) {
  return `Held up in ${percent(share)} by ${nameOf(vehicle)} ${how}`; // "... vehicle 1 going first"
}

/** "Not possible then: change left (there is no lane to the left); stop (...)" */
function notThen(refused) {
  const reasons = [...Map.groupBy(refused, ([, why]) => why)];
  const said = reasons.map(([why, those]) => `${those.map(([action]) => doing(action)).join(", ")} (${why})`);
  return `Not possible then: ${said.join("; ")}`;
}

function inWords(branch) {
  const name = `${capital(branch.words)}${branch.chosen ? ", my plan" : ""}`;
  return [name, visitsOf(branch), ...factsOf(branch), ...branch.held_up.map(heldUp)].join(", ");
}
