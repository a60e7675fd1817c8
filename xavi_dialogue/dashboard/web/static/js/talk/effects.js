/** An effect with its interval: a dot with a whisker around zero, and in words. */
import { h } from "../dom.js";
import { between, counted, difference } from "../figures.js";

const WIDTH = 240;
const HEIGHT = 28;
const MIDDLE = WIDTH / 2;
const REACH = MIDDLE - 10;

/** @param {EffectShown} effect */
export function createEffect(effect) {
  const { delta, low, high, unit } = effect;
  const samples = `from ${counted(effect.n_distinct, "distinct sample")}`;
  const said = [difference(delta, unit), between(low, high, unit), samples].filter(Boolean);
  return h("li", h("p", h("b", effect.words), `: ${said.join(", ")}`), picture(effect));
}

function picture({ delta, low, high, unit }) {
  const scale = REACH / Math.max(Math.abs(delta), Math.abs(low), Math.abs(high), Number.MIN_VALUE);
  const x = (value) => Math.round((MIDDLE + value * scale) * 10) / 10;
  const [less, more] = unit === "s" ? ["sooner", "later"] : ["less", "more"];
  const text = (at, anchor, words) => h("text", { x: at, y: 26, "text-anchor": anchor }, words);
  return h(
    "svg.effect",
    { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, "aria-hidden": "true" },
    h("path.axis", { d: `M4 10H${WIDTH - 4}` }),
    h("path.zero", { d: `M${MIDDLE} 2V18` }),
    h("path.whisker", { d: `M${x(low)} 10H${x(high)}M${x(low)} 5v10M${x(high)} 5v10` }),
    h("circle.dot", { cx: x(delta), cy: 10, r: 5 }),
    text(4, "start", less),
    text(MIDDLE, "middle", "0"),
    text(WIDTH - 4, "end", more),
  );
}
