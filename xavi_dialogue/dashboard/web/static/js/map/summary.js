/** What the map shows, in words, for who cannot see it. */

import { h, say } from "../dom.js";
import { clock, speed } from "../figures.js";
import { calledOf, capital } from "../words.js";
import { cardInWords } from "./card.js";
import { lightInWords } from "./signals.js";
import { laneInWords, whereTo } from "./words.js";

const PAUSE = 3000; // [ms] between changes
const NAMED = 4; // vehicles, the nearest

/**
 * Make it: `element` is a paragraph that describes the map, `said` is what is announced at once.
 * The description is announced as it changes only while the map has the focus: else it would talk
 * over the conversation all the time.
 */
export function createSummary(id) {
  const element = h("p", { id, class: "map-unseen", "aria-live": "off" });
  const said = h("p", { class: "map-unseen", "aria-live": "polite" });
  let last = -Infinity;
  return {
    element,
    said,
    announced: (is) => element.setAttribute("aria-live", is ? "polite" : "off"),
    due: (now) => now - last >= PAUSE,
    update(picture, now) {
      last = now;
      say(element, inWords(picture));
    },
    say(vehicle, goals) {
      said.textContent = vehicle ? cardInWords(vehicle, goals) : "";
    },
  };
}

/** {t, live, state, gone, vehicles, roads, words: of the decision} in a few sentences. */
export function inWords(picture) {
  const ego = picture.vehicles.find((vehicle) => vehicle.id === 0);
  if (!ego) return "There is nothing on the map yet.";
  const others = picture.vehicles.filter((vehicle) => vehicle.id !== 0);
  const near = others.sort((a, b) => away(ego, a) - away(ego, b));
  const told = near.slice(0, NAMED).map((one) => `${calledOf(one)} is ${whereTo(ego, one)}, at ${speed(one.speed)}`);
  const more = near.length - told.length;
  const rest = more > 0 ? ` ${more} more ${more === 1 ? "road user is" : "road users are"} farther away.` : "";
  const list = told.length ? ` ${capital(told.join("; "))}.${rest}` : " There is nobody else in sight.";
  const plan = picture.words ? ` The plan: ${picture.words}.` : "";
  return `${opening(picture, ego)}${lightAhead(picture, ego)}${list}${unseen(picture)}${plan}`;
}

/** What the light at the end of our lane shows; empty where it has none that is in view. */
function lightAhead({ lights, roads }, ego) {
  const lane = roads?.laneAt(ego.x, ego.y);
  const place = lane && roads.signals.find((one) => one.lane === lane.id);
  const shown = new Map(lights ?? []);
  const states = (place?.lamps ?? []).map((lamp) => shown.get(lamp.signal)).filter(Boolean);
  const words = [...new Set(states.map(lightInWords))].join(" or ");
  return words && ` Our traffic light is ${words}.`;
}

function unseen({ hidden }) {
  return hidden?.length ? " Parts of the roads around us are out of our sight." : "";
}

function opening({ live, t, gone, state, roads }, ego) {
  const lane = roads?.laneAt(ego.x - Math.cos(ego.heading), ego.y - Math.sin(ego.heading));
  const where = !lane
    ? ""
    : lane.internal
      ? " within a junction"
      : spaced(laneInWords(lane.index, roads.lanesOf.get(lane.edge).length));
  const moves = ego.speed < 0.3 ? `stand${where}` : `drive at ${speed(ego.speed)}${where}`;
  if (gone && live)
    return `The car is not heard of any more; last, at ${clock(t, 1)}, we ${ego.speed < 0.3 ? "stood" : `drove at ${speed(ego.speed)}`}${where}.`;
  if (!live) return `At ${clock(t, 1)}: we ${moves}.`;
  if (state === "ended") return "The ride is over.";
  return ego.speed < 0.3 ? `We are standing${where}.` : `We are driving at ${speed(ego.speed)}${where}.`;
}

function spaced(text) {
  return text && ` ${text}`;
}

function away(a, b) {
  return Math.hypot(a.x - b.x, a.y - b.y);
}
