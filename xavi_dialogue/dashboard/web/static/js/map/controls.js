/** What stands over the canvas: the badge that tells which moment is shown, the scale bar, the legend. */

import { say, set } from "../dom.js";
import { clock } from "../figures.js";
import { isFinished, standing } from "../standing.js";

const STILL = { over: "ride over", played: "recording ended", paused: "paused" };
const GONE = { unheard: "not connected", coming: "car starting", gone: "car gone" };
const LENGTHS = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000]; // [m]
const BAR = 96; // [px] the longest scale bar

/** Let the scale bar be as long as a round number of metres. */
export function showScale({ scale, scaleLength, scaleBar }, pixelsPerMetre) {
  const metres = LENGTHS.filter((one) => one * pixelsPerMetre <= BAR).at(-1) ?? LENGTHS[0];
  scaleBar.style.width = `${Math.round(metres * pixelsPerMetre)}px`;
  const words = metres < 1000 ? `${metres} m` : `${metres / 1000} km`;
  say(scaleLength, words);
  set(scale, "aria-label", `Scale: the bar is ${words} long`);
}

/** Let the badge tell the moment that is shown. */
export function showBadge({ badge, badgeWhat, badgeWhen }, store) {
  badge.hidden = !store.latest;
  if (!store.latest) return;
  const [what, when, state] = moment(store);
  set(badge, "data-state", state);
  say(badgeWhat, what);
  say(badgeWhen, when);
}

function moment(store) {
  const { latest } = store;
  if (!store.live) {
    const ago = latest.t - store.at;
    const far = `${ago < 10 ? ago.toFixed(1) : Math.round(ago)} s ${isFinished(store) ? "before the end" : "ago"}`;
    return [clock(store.at, 1), ago < 0.05 ? "the latest moment" : far, "held"];
  }
  const stands = standing(store);
  const at = clock(latest.t, 1);
  if (stands in STILL) return [STILL[stands], at, "still"];
  if (stands in GONE) return [GONE[stands], `last seen at ${at}`, "gone"];
  const speed = latest.speed > 0 ? `${Number(latest.speed.toFixed(latest.speed < 1 ? 2 : 1))}×` : "as fast as can be";
  return [stands === "playing" ? "recording" : "live", `${at} · ${speed}`, "live"];
}

/** The legend tells what is on the map now; to be folded. `changed`: it has another size. */
export function createLegend({ legend, fold, entries, grid }, changed) {
  let shown = "";
  const show = (open) => {
    entries.hidden = !open;
    fold.ariaExpanded = String(open);
  };
  show(!matchMedia("(max-width: 700px)").matches);
  fold.addEventListener("click", () => {
    show(entries.hidden);
    changed();
  });
  return {
    /** @param {Set<string>} kinds that are drawn @param {number|null} spacing [m] of a grid instead of roads */
    update(kinds, spacing) {
      const key = `${[...kinds].sort()} ${spacing}`;
      if (key === shown) return;
      shown = key;
      legend.hidden = kinds.size === 0 && !spacing;
      for (const entry of entries.children) entry.hidden = !kinds.has(entry.dataset.kind);
      grid.hidden = !spacing;
      say(grid, `roads not known: a grid of ${spacing} m`);
      changed();
    },
  };
}
