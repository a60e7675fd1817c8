/** What is on the map now, and how it is drawn; to be folded. */

import { fill, h } from "../dom.js";

/** In the order in which they are listed: kind, words, drawing, class. */
// Vehicles are not among them: each has its name beside it.
const ENTRIES = [
  ["plan", "our path as planned now", "line", "accent"],
  ["predictions", "where others may go", "fade", "other"],
  ["ours", "our way through the junction", "strip", "accent"],
  ["yields", "goes first: we give way", "strip", "warn"],
  ["view", "how far we see", "circle", "accent"],
  ["goal", "our destination", "flag", "accent"],
  ["lights", "traffic light: stop, wait, go", "lamps", "ink"],
  ["hidden", "out of our sight", "hatch", "hidden"],
  ["imagined", "somebody may come from there", "car", "warn"],
  ["fact", "my plan in the answer", "band", "accent"],
  ["ghost", "what it is compared with", "dash", "foil"],
  ["preview", "the alternative looked at", "dots", "foil"],
  ["cause", "a cause", "ring", "cause"],
  ["pointed", "spoken of or pointed at", "ring", "ink"],
];

const DRAWINGS = {
  line: () => h("path", { d: "M2 8h20M18 4l6 4-6 4" }),
  band: () => h("path", { class: "map-band", d: "M2 8h24" }),
  fade: () => [
    h("path", { d: "M2 8h8" }),
    h("path", { d: "M10 8h8", opacity: 0.6 }),
    h("path", { d: "M18 8h8", opacity: 0.3 }),
  ],
  strip: () => h("path", { class: "map-strip", d: "M2 8h24" }),
  circle: () => h("circle", { class: "map-thin", cx: 14, cy: 8, r: 7 }),
  flag: () => [h("path", { d: "M9 15V2" }), h("path", { class: "map-filled", d: "M9 2h11v7H9z" })],
  dash: () => h("path", { d: "M2 8h24", "stroke-dasharray": "6 4" }),
  dots: () => h("path", { d: "M2 8h24", "stroke-dasharray": "2 4" }),
  lamps: () => [
    h("circle", { class: "map-lamp map-lamp-red", cx: 5, cy: 8, r: 4 }),
    h("circle", { class: "map-lamp map-lamp-amber", cx: 14, cy: 8, r: 4 }),
    h("circle", { class: "map-lamp map-lamp-green", cx: 23, cy: 8, r: 4 }),
    h("path", { class: "map-lamp-sign", d: "M2.5 8h5M23 11V5.5M21 7.5l2-2 2 2" }),
  ],
  hatch: () => [
    h("path", { class: "map-strip", d: "M2 8h24" }),
    h("path", { class: "map-thin", d: "M4 12l8-8M11 12l8-8M18 12l8-8" }),
  ],
  car: () => h("rect", { class: "map-imagined", x: 6, y: 4, width: 16, height: 8, rx: 3 }),
  ring: () => h("circle", { cx: 14, cy: 8, r: 6 }),
};

/** Make the legend; `update(kinds, roads)` tells it what is drawn, and that roads are not known. */
export function createLegend(changed, folded) {
  const list = h("ul", {});
  const toggle = h("button", { type: "button", "aria-expanded": String(!folded) }, "Legend");
  const element = h("div", { class: "map-legend", hidden: true }, toggle, list);
  list.hidden = folded;
  toggle.addEventListener("click", () => {
    list.hidden = !list.hidden;
    toggle.setAttribute("aria-expanded", String(!list.hidden));
    changed();
  });
  let shown = null;
  return {
    element,
    update(kinds, spacing) {
      const key = `${[...kinds].sort().join()} ${spacing}`;
      if (key === shown) return;
      shown = key;
      element.hidden = kinds.size === 0 && !spacing;
      const grid = spacing && h("li", {}, `roads not known: a grid of ${spacing} m`);
      fill(list, ENTRIES.filter(([kind]) => kinds.has(kind)).map(entry), grid);
      changed();
    },
  };
}

function entry([, words, drawing, colour]) {
  const swatch = h(
    "svg",
    { viewBox: "0 0 28 16", class: `map-swatch map-is-${colour}`, "aria-hidden": "true" },
    DRAWINGS[drawing](),
  );
  return h("li", {}, swatch, words);
}
