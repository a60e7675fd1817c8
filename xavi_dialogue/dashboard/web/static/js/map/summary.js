/** What the map shows, in words, for who cannot see it. */

import { say } from "../dom.js";
import { clock, speed } from "../figures.js";
import { calledOf, capital } from "../words.js";
import { cardInWords } from "./card.js";
import { lightInWords } from "./signals.js";
import { laneInWords, whereTo } from "./words.js";

const PAUSE = 3000; // [ms] between changes
const NAMED = 4; // vehicles, the nearest
const STANDS = 0.3; // [m/s] below which a car stands

/**
 * Make it: `summary` is a paragraph that describes the map, `aloud` is what is announced at once.
 * The description is announced as it changes only while the map has the focus: else it would talk
 * over the conversation all the time.
 */
export function createSummary({ summary, aloud }) {
  let last = -Infinity;
  return {
    announced: (is) => summary.setAttribute("aria-live", is ? "polite" : "off"),
    due: (now) => now - last >= PAUSE,
    update(picture, now) {
      last = now;
      say(summary, inWords(picture));
    },
    say: (vehicle, goals) => void (aloud.textContent = vehicle ? cardInWords(vehicle, goals) : ""),
  };
}

/** {t, live, state, gone, vehicles, lights, hidden, roads, words: of the decision} in a few sentences. */
function inWords(picture) {
  const ego = picture.vehicles.find(({ id }) => id === 0);
  if (!ego) return "There is nothing on the map yet.";
  const said = [
    ...opening(picture, ego),
    lightAhead(picture, ego),
    ...others(picture, ego),
    picture.hidden?.length && "Parts of the roads around us are out of our sight.",
    picture.words && `The plan: ${picture.words}.`,
  ];
  return said.filter(Boolean).join(" ");
}

function opening({ live, t, gone, state, roads }, ego) {
  const where = whereWeAre(ego, roads);
  const stands = ego.speed < STANDS;
  const fast = `at ${speed(ego.speed)}${where}`;
  const at = clock(t, 1);
  if (gone && live) {
    const was = stands ? `stood${where}` : `drove ${fast}`;
    return [`The car is not heard of any more; last, at ${at}, we ${was}.`];
  }
  if (!live) return [`At ${at}: we ${stands ? `stand${where}` : `drive ${fast}`}.`];
  if (state === "ended") return ["The ride is over."];
  return [stands ? `We are standing${where}.` : `We are driving ${fast}.`];
}

/** " in the right one of two lanes"; empty where it is not known, or there is only one. */
function whereWeAre({ x, y, heading }, roads) {
  const lane = roads?.laneAt(x - Math.cos(heading), y - Math.sin(heading));
  if (!lane) return "";
  const words = lane.internal ? "within a junction" : laneInWords(lane.index, roads.lanesOf.get(lane.edge).length);
  return words && ` ${words}`;
}

/** What the light at the end of our lane shows; empty where it has none that is in view. */
function lightAhead({ lights, roads }, { x, y }) {
  const lane = roads?.laneAt(x, y);
  const place = lane && roads.signals.find((one) => one.lane === lane.id);
  const shown = new Map(lights ?? []);
  const states = (place?.lamps ?? []).map((lamp) => shown.get(lamp.signal)).filter(Boolean);
  const words = [...new Set(states.map(lightInWords))].join(" or ");
  return words && `Our traffic light is ${words}.`;
}

function others({ vehicles }, ego) {
  const away = ({ x, y }) => Math.hypot(x - ego.x, y - ego.y);
  const near = vehicles.filter(({ id }) => id !== 0).sort((a, b) => away(a) - away(b));
  if (!near.length) return ["There is nobody else in sight."];
  const told = near.slice(0, NAMED).map((one) => `${calledOf(one)} is ${whereTo(ego, one)}, at ${speed(one.speed)}`);
  const more = near.length - told.length;
  const rest = `${more} more ${more === 1 ? "road user is" : "road users are"} farther away.`;
  return [`${capital(told.join("; "))}.`, more > 0 && rest];
}
