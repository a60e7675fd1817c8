/** The top bar: whose car this is, who is there, what time it is. */
import { fill, h, say } from "./dom.js";
import { clock, counted } from "./figures.js";
import { Slowness } from "./slowness.js";
import { standing } from "./standing.js";
import { createThemeSwitch } from "./theme.js";

// Told apart by shape as well as by colour: full, cut through, open.
const SHAPES = {
  there: () => h("circle", { cx: 6, cy: 6, r: 5 }),
  left: () => h("path", { d: "M2 6H10" }),
  gone: () => h("path", { d: "M2 2 10 10M10 2 2 10" }),
  awaited: () => h("circle", { cx: 6, cy: 6, r: 4, class: "open" }),
  coming: () => h("circle", { cx: 6, cy: 6, r: 4, class: "open" }),
  unknown: () => h("path", { d: "M2 6H10" }),
};
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
const SAYS = {
  there: "there",
  left: "left",
  gone: "gone",
  awaited: "awaited",
  coming: "starting",
  unknown: "not known", // not connected
};

/**
 * @param {HTMLElement} bar holds the heading
 * @param {import("./store.js").Store} store
 * @param {{open: () => void}} help
 */
export function createBar(bar, store, help) {
  const scenario = h("p", { class: "scenario" });
  const presence = h("ul", { class: "presence", "aria-label": "Who is there" });
  const time = h("span", { class: "time" });
  const mode = h("span", { class: "mode" });
  const dropped = h("p", { class: "dropped", hidden: true, title: SLOW });
  const slowness = new Slowness();
  const helping = { type: "button", class: "icon", "aria-label": "Help and keys", title: "Help and keys (?)" };
  const ask = h("button", { ...helping, onclick: () => help.open() }, "?");
  bar.append(scenario, presence, h("p", { class: "clock" }, time, mode), dropped, createThemeSwitch(), ask);
  const moment = () => {
    say(time, store.latest ? clock(store.at) : "–:––");
    const [words, kind] = modeOf(store);
    say(mode, words);
    if (mode.dataset.kind !== kind) mode.dataset.kind = kind;
  };
  const status = () => {
    named(bar, scenario, store);
    slowness.told(store.status.dropped, performance.now());
    showPresence(presence, store);
    slow();
    moment();
  };
  const slow = () => {
    const lately = slowness.worth(performance.now());
    if (lately > 0) say(dropped, `${counted(lately, "scene")} dropped`);
    if (dropped.hidden !== (lately === 0)) dropped.hidden = lately === 0;
  };
  for (const name of ["ride", "status"]) store.addEventListener(name, status);
  for (const name of ["scene", "moment"]) store.addEventListener(name, moment);
  store.addEventListener("scene", () => slowness.came(performance.now()));
  setInterval(slow, 1000); // what was told of lately is not for ever
  status();
}

function named(bar, scenario, store) {
  const vehicle = store.welcome?.vehicle;
  const name = store.ride?.scenario?.split("/").filter(Boolean).pop() ?? null; // of a folder, its own name
  const seed = store.ride?.seed ?? null;
  say(bar.querySelector("h1"), vehicle ?? "XAVI Dialogue");
  say(scenario, [name, seed === null ? null : `seed ${seed}`].filter((one) => one !== null).join(", "));
  const title = [vehicle, name, "XAVI Dialogue"].filter(Boolean).join(" · ");
  if (document.title !== title) document.title = title;
}

function modeOf(store) {
  const stands = standing(store);
  return stands !== "none" && !store.live ? ["earlier", "held"] : MODES[stands];
}

function showPresence(list, { status, latest }) {
  const left = status.car === "gone" && latest?.state === "ended";
  const { dropped } = status;
  list.title = dropped > 0 ? `${counted(dropped, "scene")} dropped since this page connected. ${SLOW}` : "";
  const key = JSON.stringify([status.connected, status.car, status.service, left]);
  if (list.dataset.key === key) return;
  list.dataset.key = key;
  const who = [
    ["car", left ? "left" : status.car],
    ["service", status.service],
  ];
  fill(
    list,
    who.map(([name, there]) => presenceOf(name, status.connected ? there : "unknown")),
  );
}

function presenceOf(name, there) {
  const shape = h("svg", { viewBox: "0 0 12 12", "aria-hidden": "true" }, SHAPES[there]());
  return h("li", { dataset: { there } }, shape, h("span", {}, name, h("span", { class: "says" }, ` ${SAYS[there]}`)));
}
