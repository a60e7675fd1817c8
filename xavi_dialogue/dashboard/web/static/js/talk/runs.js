/** A table of rollouts: what the others did in each, and what came of it. */
import { copyOf, fill, h, partsOf, say } from "../dom.js";
import { counted, percent, seconds } from "../figures.js";
import { nameOf, outcomeWords } from "../words.js";

const FIRST = 10;

/**
 * @param {string} title
 * @param {Side} side
 * @param {import("./spoken.js").Spoken} spoken
 */
export function createRuns(title, { runs, rollouts }, spoken) {
  const table = copyOf("runs");
  const { caption, body, more } = partsOf(table);
  const show = (count) => fill(body, runs.slice(0, count).map((run) => row(run, spoken)));
  const different = runs.length < rollouts ? `, ${runs.length} of them different` : "";
  table.ariaLabel = `Rollouts: ${title}`;
  say(caption, `${title}: ${counted(rollouts, "rollout")}${different}`);
  say(more, `Show all ${runs.length}`);
  more.hidden = runs.length <= FIRST;
  more.addEventListener("click", () => {
    show(runs.length);
    body.rows[FIRST].querySelector("th").focus(); // the button that had the focus is gone
    more.remove();
  });
  show(FIRST);
  return table;
}

function row({ index, draws, outcome, arrival, samples, held_up: held, collided_with: other = null }, spoken) {
  const line = (vehicle, ...words) => h("div", spoken.button(vehicle, String(vehicle)), ...words);
  const did = samples.map(([vehicle, words, chance]) => line(vehicle, ` ${words} `, h("span.soft", percent(chance))));
  const by = held.map(([vehicle, how, lasts]) => line(vehicle, ` ${how}, ${seconds(lasts)}`));
  return h(
    "tr",
    { dataset: { outcome } },
    h("th", { scope: "row", tabindex: -1 }, index, draws > 1 && h("span.soft", ` ×${draws}`)),
    h("td", did.length > 0 ? did : "–"),
    h("td", `${outcomeWords(outcome)}${other === null ? "" : ` with ${nameOf(other)}`}`),
    h("td.number", arrival === null ? "–" : seconds(arrival)),
    h("td", by.length > 0 ? by : "–"),
  );
}
