/** Buttons of the map, its scale bar, and the badge that tells which moment is shown. */

import { fill, h } from "../dom.js";
import { clock } from "../figures.js";
import { isFinished, standing } from "../standing.js";

const ICONS = {
  in: "M12 5v14M5 12h14",
  out: "M5 12h14",
  fit: "M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5",
  follow: "M12 3v4M12 17v4M3 12h4M17 12h4M12 8a4 4 0 1 0 0 8 4 4 0 0 0 0-8z",
  both: "M3 17c5 0 6-10 12-10h6M3 17h18M18 4l3 3-3 3",
};
const STILL = { over: "ride over", played: "recording ended", paused: "paused" };
const GONE = { unheard: "not connected", coming: "car starting", gone: "car gone" };
const LENGTHS = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000]; // [m]
const BAR = 96; // [px] the longest scale bar

function button(icon, label, keys, onclick, extra = {}) {
  const drawing = h("svg", { viewBox: "0 0 24 24", "aria-hidden": "true" }, h("path", { d: ICONS[icon] }));
  const title = keys ? `${label} (${keys})` : label;
  return h("button", { type: "button", class: "map-button", "aria-label": label, title, onclick, ...extra }, drawing);
}

/**
 * Make the controls.
 * @param on {zoomIn(), zoomOut(), fit(), follow(), both()}
 * @returns {{element, badge, bar, following(is), comparing(is), scale(pxPerMetre)}}
 */
export function createControls(on) {
  const follow = button("follow", "Follow our car", "F", on.follow, { "aria-pressed": "true" });
  const both = button("both", "Show both lines whole", "", on.both, { hidden: true });
  const element = h(
    "div",
    { class: "map-controls", role: "group", "aria-label": "Map" },
    both,
    follow,
    button("in", "Zoom in", "+", on.zoomIn),
    button("out", "Zoom out", "-", on.zoomOut),
    button("fit", "Show everything", "0", on.fit),
  );
  const length = h("span", {});
  const bar = h("div", { class: "map-scale", role: "img", "aria-label": "Scale" }, length, h("i", {}));
  let shown = null;
  return {
    element,
    bar,
    following: (is) => follow.setAttribute("aria-pressed", String(is)),
    comparing: (is) => void (both.hidden = !is),
    scale(pixels) {
      const metres = LENGTHS.filter((one) => one * pixels <= BAR).at(-1) ?? LENGTHS[0];
      bar.lastChild.style.width = `${Math.round(metres * pixels)}px`;
      if (metres === shown) return;
      shown = metres;
      length.textContent = metres < 1000 ? `${metres} m` : `${metres / 1000} km`;
      bar.setAttribute("aria-label", `Scale: the bar is ${length.textContent} long`);
    },
  };
}

/** The badge; `update(store)` lets it tell the moment shown. */
export function createBadge() {
  const what = h("b", {});
  const when = h("span", {});
  const element = h("p", { class: "map-badge", hidden: true }, h("i", { "aria-hidden": "true" }), what, when);
  let shown = "";
  return {
    element,
    update(store) {
      element.hidden = !store.latest;
      if (!store.latest) return;
      const [word, text, state] = told(store);
      const key = `${state} ${word} ${text}`;
      if (key === shown) return;
      shown = key;
      element.dataset.state = state;
      fill(what, word);
      fill(when, text);
    },
  };
}

function told(store) {
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
