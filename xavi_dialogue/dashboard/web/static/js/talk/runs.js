/** A table of rollouts: what the others did in each, and what came of it. */
import { fill, h } from "../dom.js";
import { counted, percent, seconds } from "../figures.js";
import { nameOf, outcomeWords } from "../words.js";

const FIRST = 10;

/**
 * @param {string} title
 * @param {{runs: any[], rollouts: number}} side
 * @param {import("./spoken.js").Spoken} spoken
 */
export function createRuns(title, side, spoken) {
  const body = h("tbody", {});
  const show = (count) =>
    fill(
      body,
      side.runs.slice(0, count).map((run) => row(run, spoken)),
    );
  const more = h("button", { type: "button", class: "quiet" }, `Show all ${side.runs.length}`);
  more.addEventListener("click", () => {
    show(side.runs.length);
    body.rows[FIRST].querySelector("th").focus(); // the button that had the focus is gone
    more.remove();
  });
  const columns = ["Rollout", "What the others did", "Outcome", "Time", "Held up by"];
  const head = h(
    "thead",
    {},
    h(
      "tr",
      {},
      columns.map((name) => h("th", { scope: "col" }, name)),
    ),
  );
  const alike = side.runs.length < side.rollouts;
  const count = counted(side.rollouts, "rollout") + (alike ? `, ${side.runs.length} of them different` : "");
  const caption = h("caption", {}, `${title}: ${count}`);
  show(FIRST);
  const table = h("table", { class: "runs" }, caption, head, body);
  return h(
    "div",
    { class: "wide", role: "region", "aria-label": `Rollouts: ${title}`, tabindex: 0 },
    table,
    side.runs.length > FIRST ? more : null,
  );
}

function row(run, spoken) {
  const named = (vehicle) => spoken.button(vehicle, String(vehicle));
  const samples = run.samples.map(([vehicle, words, probability]) =>
    h("div", {}, named(vehicle), ` ${words} `, h("span", { class: "soft" }, percent(probability))),
  );
  const held = run.held_up.map(([vehicle, how, lasts]) => h("div", {}, named(vehicle), ` ${how}, ${seconds(lasts)}`));
  const collided =
    run.collided_with === null || run.collided_with === undefined ? "" : ` with ${nameOf(run.collided_with)}`;
  return h(
    "tr",
    { dataset: { outcome: run.outcome } },
    h(
      "th",
      { scope: "row", tabindex: -1 },
      run.index,
      run.draws > 1 ? h("span", { class: "soft" }, ` ×${run.draws}`) : null,
    ),
    h("td", {}, samples.length > 0 ? samples : "–"),
    h("td", {}, `${outcomeWords(run.outcome)}${collided}`),
    h("td", { class: "number" }, run.arrival === null ? "–" : seconds(run.arrival)),
    h("td", {}, held.length > 0 ? held : "–"),
  );
}
