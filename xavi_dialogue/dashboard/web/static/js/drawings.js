/** Small drawings for what is not there. In the colours of the text around them. */
import { h } from "./dom.js";

const CAR = "M22 46v-7l5-3 5-9h22l8 9 9 3v7z";

function drawing(name, ...shapes) {
  return h(
    "svg",
    { class: `drawing ${name}`, viewBox: "0 0 96 64", "aria-hidden": "true", focusable: "false" },
    shapes,
  );
}

const road = (dashes = "8 6") => h("path", { class: "soft", d: "M4 54H92", "stroke-dasharray": dashes });
const wheels = (kind = "full") => [
  h("circle", { class: kind, cx: 33, cy: 47, r: 5 }),
  h("circle", { class: kind, cx: 61, cy: 47, r: 5 }),
];

const DRAWINGS = {
  connecting: () =>
    drawing(
      "connecting",
      h("circle", { class: "accent", cx: 16, cy: 32, r: 7 }),
      h("path", { class: "soft moving", d: "M28 32H68", "stroke-dasharray": "4 6" }),
      h("rect", { x: 72, y: 20, width: 18, height: 24, rx: 3 }),
      h("path", { class: "soft", d: "M77 27h8m-8 6h8" }),
    ),
  unreachable: () =>
    drawing(
      "unreachable",
      h("path", { d: "M6 32H36m24 0H90" }),
      h("path", { d: "M36 22v20m24-20v20" }),
      h("path", { class: "bad", d: "M42 26 54 38M54 26 42 38" }),
    ),
  hub: () =>
    drawing(
      "hub",
      h("path", { class: "soft", d: "M20 16 44 30M76 16 52 30M48 52V40", "stroke-dasharray": "3 5" }),
      h("circle", { cx: 48, cy: 32, r: 9, "stroke-dasharray": "5 4" }),
      h("circle", { class: "full", cx: 16, cy: 14, r: 5 }),
      h("circle", { class: "full", cx: 80, cy: 14, r: 5 }),
      h("circle", { class: "full", cx: 48, cy: 56, r: 5 }),
    ),
  car: () => drawing("car", road(), h("path", { d: CAR, "stroke-dasharray": "5 4" }), wheels("open")),
  coming: () =>
    drawing(
      "coming",
      h("path", { class: "soft moving", d: "M92 54H4", "stroke-dasharray": "12 8" }),
      h("path", { class: "accent", d: CAR }),
      wheels(),
    ),
  gone: () =>
    drawing(
      "gone",
      h("path", { class: "soft", d: "M4 54H40" }),
      h("path", { class: "accent", d: "M8 44q14-2 22-14t26-14" }),
      h("circle", { class: "accent full", cx: 8, cy: 44, r: 3 }),
      h("circle", { class: "accent full", cx: 31, cy: 29, r: 3 }),
      h("path", { class: "soft", d: "M60 14q8-3 30-3", "stroke-dasharray": "2 7" }),
      h("path", { d: "M70 34a7 7 0 1 1 9 7c-2 .7-2 2-2 4m0 6v.5" }),
    ),
  over: () =>
    drawing(
      "over",
      road("0"),
      h("g", { transform: "translate(-12 0)" }, h("path", { d: CAR }), wheels()),
      h("path", { d: "M76 54V12" }),
      h("path", { class: "accent full", d: "M76 12h15l-4 5 4 5H76z" }),
    ),
  recording: () =>
    drawing(
      "recording",
      h("rect", { x: 10, y: 12, width: 76, height: 36, rx: 5 }),
      h("circle", { cx: 33, cy: 30, r: 8 }),
      h("circle", { cx: 63, cy: 30, r: 8 }),
      h("path", { class: "accent", d: "M33 38h30" }),
      h("path", { class: "soft", d: "M14 56h68" }),
    ),
  service: () =>
    drawing(
      "service",
      h("path", { d: "M10 12h40a5 5 0 0 1 5 5v16a5 5 0 0 1-5 5H28l-9 8v-8h-9a5 5 0 0 1-5-5V17a5 5 0 0 1 5-5z" }),
      h("path", {
        class: "soft",
        d: "M62 24h24a5 5 0 0 1 5 5v14a5 5 0 0 1-5 5h-3v8l-8-8H62a5 5 0 0 1-5-5",
        "stroke-dasharray": "4 4",
      }),
      h("path", { class: "soft", d: "M66 36h.5m7 0h.5m7 0h.5" }),
    ),
  talk: () =>
    drawing(
      "talk",
      h("path", {
        class: "accent",
        d: "M38 6h44a6 6 0 0 1 6 6v14a6 6 0 0 1-6 6h-8l-8 7v-7H38a6 6 0 0 1-6-6V12a6 6 0 0 1 6-6z",
      }),
      h("path", { class: "accent", d: "M56 16a4 4 0 1 1 5 4c-1 .4-1 1-1 2m0 4v.4" }),
      h("path", { d: "M10 30h14m-14 0a4 4 0 0 0-4 4v14a4 4 0 0 0 4 4h4v7l8-7h26a4 4 0 0 0 4-4v-5" }),
      h("path", { class: "soft", d: "M14 40h20m-20 6h12" }),
    ),
};

/** @param {"connecting"|"unreachable"|"hub"|"car"|"coming"|"gone"|"over"|"recording"|"service"|"talk"} name */
export function draw(name) {
  return DRAWINGS[name]();
}
