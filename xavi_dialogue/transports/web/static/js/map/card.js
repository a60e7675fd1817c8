/** The small card of a vehicle: what it is, how fast, what it is expected to do. */

import { fill, h } from "../dom.js";
import { looksOf, nameOf, percent, speed } from "./words.js";

const EDGE = 8; // [px] kept from the sides of the map

/** "red car, 30 km/h; turns left: 80 %, ...", for who cannot see the card. */
export function cardInWords(vehicle, goals) {
  const expected = goals.map(([words, p]) => `${words}: ${percent(p)}`).join(", ");
  const name = vehicle.id === 0 ? "Our car" : `Vehicle ${vehicle.id}`;
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
  const name = vehicle.id === 0 ? "our car" : nameOf(vehicle.id);
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
  const left = Math.min(Math.max(x + reach + 10, EDGE), width - wide - EDGE);
  const covers = left < x + reach && left + wide > x - reach;
  const top = covers ? y - reach - high - 10 : y - high / 2;
  const kept = Math.min(Math.max(top < EDGE && covers ? y + reach + 10 : top, EDGE), Math.max(height - high - EDGE, EDGE));
  element.style.transform = `translate(${Math.round(left)}px, ${Math.round(kept)}px)`;
}
