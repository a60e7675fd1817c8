/** The small card of a vehicle: what it is, how fast, what it is expected to do. */

import { fill, h } from "../dom.js";
import { percent, speed } from "../figures.js";
import { calledOf, capital } from "../words.js";
import { looksOf } from "./words.js";

const EDGE = 8; // [px] kept from the sides of the map
const NAME = 28; // [px] kept from the vehicle, for its name

/** "red car, 30 km/h; turns left: 80 %, ...", for who cannot see the card. */
export function cardInWords(vehicle, goals) {
  const expected = goals.map(([words, p]) => `${words}: ${percent(p)}`).join(", ");
  const name = vehicle.id === 0 ? "Our car" : capital(calledOf(vehicle));
  return `${name}, ${looksOf(vehicle)}, ${speed(vehicle.speed)}.${expected ? ` Expected: ${expected}.` : ""}`;
}

/** Make the card; `show(vehicle, goals, x, y, reach)` at a place [px] of the map, `hide()`. */
export function createCard() {
  const element = h("div", { class: "map-card", hidden: true, "aria-hidden": "true" });
  let shown = "";
  return {
    element,
    hide() {
      element.hidden = true;
      shown = "";
    },
    show(vehicle, goals, place) {
      const key = JSON.stringify([vehicle.id, vehicle.kind, vehicle.colour, speed(vehicle.speed), goals]);
      if (key !== shown) {
        shown = key;
        fill(element, ...content(vehicle, goals));
      }
      element.hidden = false;
      moveTo(element, place);
    },
  };
}

function content(vehicle, goals) {
  const name = vehicle.id === 0 ? "our car" : calledOf(vehicle);
  const rows = goals.slice(0, 4).map(([words, p]) => {
    const bar = h("meter", { min: 0, max: 1, value: p });
    return h("li", {}, h("span", {}, words), bar, h("b", {}, percent(p)));
  });
  return [
    h("p", { class: "map-card-name" }, h("b", {}, name), h("span", {}, speed(vehicle.speed))),
    h("p", { class: "map-card-looks" }, looksOf(vehicle)),
    rows.length ? h("ul", {}, rows) : null,
  ];
}

function moveTo(element, { x, y, reach, width, height }) {
  const [wide, high] = [element.offsetWidth, element.offsetHeight];
  const left = Math.max(Math.min(x - wide / 2, width - wide - EDGE), EDGE);
  const above = y - reach - NAME - high;
  const top = above >= EDGE ? above : Math.min(y + reach + NAME, Math.max(height - high - EDGE, EDGE));
  element.style.transform = `translate(${Math.round(left)}px, ${Math.round(top)}px)`;
}
