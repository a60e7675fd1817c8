/** The small card of a vehicle: what it is, how fast, what it is expected to do. */

import { fill, h, partsOf, say } from "../dom.js";
import { percent, speed } from "../figures.js";
import { calledOf, capital } from "../words.js";
import { looksOf } from "./words.js";

const EDGE = 8; // [px] kept from the sides of the map
const NAME = 28; // [px] kept from the vehicle, for its name
const GOALS = 4; // that are shown

/** "red car, 30 km/h; turns left: 80 %, ...", for who cannot see the card. */
export function cardInWords(vehicle, goals) {
  const expected = goals.map(([words, p]) => `${words}: ${percent(p)}`).join(", ");
  const name = vehicle.id === 0 ? "Our car" : capital(calledOf(vehicle));
  return `${name}, ${looksOf(vehicle)}, ${speed(vehicle.speed)}.${expected ? ` Expected: ${expected}.` : ""}`;
}

/** Make the card; `show(vehicle, goals, place)` at a place of the map, `hide()`. */
export function createCard(element) {
  const parts = partsOf(element);
  let shown = "";
  return {
    hide: () => void (element.hidden = true),
    show(vehicle, goals, place) {
      const words = [vehicle.id === 0 ? "our car" : calledOf(vehicle), speed(vehicle.speed), looksOf(vehicle)];
      const key = JSON.stringify([words, goals]);
      element.hidden = false;
      if (key !== shown) draw(parts, words, goals);
      shown = key;
      moveTo(element, place);
    },
  };
}

function draw(parts, [name, fast, looks], goals) {
  say(parts.name, name);
  say(parts.speed, fast);
  say(parts.looks, looks);
  const bar = (value) => h("meter", { min: 0, max: 1, value });
  fill(parts.goals, goals.slice(0, GOALS).map(([words, p]) => h("li", h("span", words), bar(p), h("b", percent(p)))));
}

function moveTo(element, { x, y, reach, width, height }) {
  const [wide, high] = [element.offsetWidth, element.offsetHeight];
  const left = Math.max(Math.min(x - wide / 2, width - wide - EDGE), EDGE);
  const above = y - reach - NAME - high;
  const top = above >= EDGE ? above : Math.min(y + reach + NAME, Math.max(height - high - EDGE, EDGE));
  element.style.transform = `translate(${Math.round(left)}px, ${Math.round(top)}px)`;
}
