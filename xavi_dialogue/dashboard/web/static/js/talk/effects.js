/** An effect with its interval: a dot with a whisker around zero, and in words. */
import { h } from "../dom.js";
import { between, counted, difference } from "../figures.js";

const WIDTH = 240;
const HEIGHT = 28;
const MIDDLE = WIDTH / 2;
const REACH = MIDDLE - 10;

/** @param {{words: string, unit: string, delta: number, low: number, high: number, n_distinct: number}} effect */
export function createEffect(effect) {
  const range = between(effect.low, effect.high, effect.unit);
  const words = [difference(effect.delta, effect.unit), range, `from ${counted(effect.n_distinct, "distinct sample")}`];
  return h("li", {}, h("p", {}, h("b", {}, effect.words), `: ${words.filter(Boolean).join(", ")}`), picture(effect));
}

function picture({ delta, low, high, unit }) {
  const scale = REACH / Math.max(Math.abs(delta), Math.abs(low), Math.abs(high), Number.MIN_VALUE);
  const x = (value) => Math.round((MIDDLE + value * scale) * 10) / 10;
  const y = 10;
  const [less, more] = unit === "s" ? ["sooner", "later"] : ["less", "more"];
  return h(
    "svg",
    { class: "effect", viewBox: `0 0 ${WIDTH} ${HEIGHT}`, "aria-hidden": "true" },
    h("path", { class: "axis", d: `M4 ${y}H${WIDTH - 4}` }),
    h("path", { class: "zero", d: `M${MIDDLE} 2V18` }),
    h("path", { class: "whisker", d: `M${x(low)} ${y}H${x(high)}M${x(low)} ${y - 5}v10M${x(high)} ${y - 5}v10` }),
    h("circle", { class: "dot", cx: x(delta), cy: y, r: 5 }),
    h("text", { x: 4, y: 26 }, less),
    h("text", { x: MIDDLE, y: 26, "text-anchor": "middle" }, "0"),
    h("text", { x: WIDTH - 4, y: 26, "text-anchor": "end" }, more),
  );
}
