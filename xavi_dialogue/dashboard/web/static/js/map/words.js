/** Looks and places in words. */

/** "red car"; what is not known is left out. */
export function looksOf({ kind, colour }) {
  const words = [colour, kind || "vehicle"].filter(Boolean).join(" ");
  return words.length > 40 ? `${words.slice(0, 39)}…` : words;
}

const WAYS = {
  continue: "straight on",
  "exit-left": "left",
  "exit-right": "right",
  "exit-straight": "straight on",
  stop: "stops",
};

/** Where a goal leads, as short as can be: "right"; else as the car says it. */
export function wayOf({ kind, words }) {
  return WAYS[kind] ?? words;
}

const AROUND = [
  "ahead of us",
  "ahead to the left",
  "to our left",
  "behind to the left",
  "behind us",
  "behind to the right",
  "to our right",
  "ahead to the right",
];

/** "20 m ahead of us": from our front bumper to that of another vehicle. */
export function whereTo(ego, other) {
  const [x, y] = [other.x - ego.x, other.y - ego.y];
  const angle = Math.atan2(y, x) - ego.heading;
  const eighth = ((Math.round(angle / (Math.PI / 4)) % 8) + 8) % 8;
  return `${Math.round(Math.hypot(x, y))} m ${AROUND[eighth]}`;
}

const NUMBERS = ["no", "one", "two", "three", "four", "five", "six", "seven", "eight"];

/** "in the right one of two lanes"; empty where there is only one. */
export function laneInWords(index, lanes) {
  if (lanes < 2) return "";
  const which = index === 0 ? "right" : index === lanes - 1 ? "left" : "middle";
  return `in the ${which} one of ${NUMBERS[lanes] ?? lanes} lanes`;
}
