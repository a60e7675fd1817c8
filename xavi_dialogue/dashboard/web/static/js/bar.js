/** The top bar: whose car this is, who is there, what time it is. */
import { fill, h, icon, on, partsOf, say, set } from "./dom.js";
import { clock, counted } from "./figures.js";
import { Slowness } from "./slowness.js";
import { standing } from "./standing.js";
import { followTheme } from "./theme.js";

const SLOW = "This page was too slow for them; nothing of the record is lost.";
const MODES = {
  none: ["", "none"],
  unheard: ["not connected", "gone"],
  coming: ["car starting", "gone"],
  over: ["over", "over"],
  played: ["over", "over"],
  gone: ["car gone", "gone"],
  paused: ["paused", "paused"],
  playing: ["recording", "live"],
  live: ["live", "live"],
};
const DISC = "M6 1.5a4.5 4.5 0 1 0 0 9 4.5 4.5 0 0 0 0-9z";
const BAR = "M2 6H10";
const CROSS = "M2 2 10 10M10 2 2 10";
/** What is said of who is there; told apart by shape as well as by colour. */
const PRESENCES = {
  there: ["there", DISC],
  left: ["left", BAR],
  gone: ["gone", CROSS],
  awaited: ["awaited", DISC],
  coming: ["starting", DISC],
  unknown: ["not known", BAR], // not connected
};

/**
 * @param {HTMLElement} bar
 * @param {import("./store.js").Store} store
 * @param {{open: () => void}} help
 */
export function createBar(bar, store, help) {
  const parts = partsOf(bar);
  const slowness = new Slowness();
  parts.help.addEventListener("click", () => help.open());
  followTheme(parts.theme);
  const moment = () => {
    say(parts.time, store.latest ? clock(store.at) : "–:––");
    const stands = standing(store);
    const [words, kind] = stands !== "none" && !store.live ? ["earlier", "held"] : MODES[stands];
    say(parts.mode, words);
    set(parts.mode, "data-kind", kind);
  };
  const slow = () => {
    const lately = slowness.worth(performance.now());
    if (lately > 0) say(parts.dropped, `${counted(lately, "scene")} dropped`);
    set(parts.dropped, "hidden", lately === 0 && "");
  };
  const status = () => {
    name(parts, store);
    slowness.told(store.status.dropped, performance.now());
    showPresence(parts.presence, store);
    slow();
    moment();
  };
  parts.dropped.title = SLOW;
  on(store, "ride status", status);
  on(store, "scene moment", moment);
  store.addEventListener("scene", () => slowness.came(performance.now()));
  setInterval(slow, 1000); // what was told of lately is not for ever
  status();
}

function name(parts, { welcome, ride }) {
  const vehicle = welcome?.vehicle;
  const scenario = ride?.scenario?.split("/").filter(Boolean).pop(); // of a folder, its own name
  const seed = ride?.seed ?? null;
  say(parts.name, vehicle ?? "XAVI Dialogue");
  say(parts.scenario, [scenario, seed !== null && `seed ${seed}`].filter(Boolean).join(", "));
  const title = [vehicle, scenario, "XAVI Dialogue"].filter(Boolean).join(" · ");
  if (document.title !== title) document.title = title;
}

function showPresence(list, { status, latest }) {
  const { connected, car, service, dropped } = status;
  const left = car === "gone" && latest?.state === "ended";
  list.title = dropped > 0 ? `${counted(dropped, "scene")} dropped since this page connected. ${SLOW}` : "";
  const key = JSON.stringify([connected, car, service, left]);
  if (list.dataset.key === key) return;
  list.dataset.key = key;
  const item = (who, there) => presenceOf(who, connected ? there : "unknown");
  fill(list, item("car", left ? "left" : car), item("service", service));
}

function presenceOf(who, there) {
  const [words, shape] = PRESENCES[there];
  return h("li.row", { dataset: { there } }, icon(shape, "0 0 12 12"), h("span", who, h("span.says", ` ${words}`)));
}
