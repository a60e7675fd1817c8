/** Times, probabilities and outcomes in words: units always, one decimal at most. */

/** What a rollout may come to, best first. */
export const OUTCOMES = [
  { key: "done", words: "arrives" },
  { key: "termination", words: "is not there in time" },
  { key: "dead", words: "leads elsewhere" },
  { key: "collision", words: "collides" },
];

const DOING = {
  continue: "go on",
  "change-left": "change left",
  "change-right": "change right",
  "exit-left": "turn left",
  "exit-right": "turn right",
  "exit-straight": "go straight on",
  "continue-next-exit": "pass an exit",
  stop: "stop",
};

/** A macro action in a few words, for where there is little room. */
export function doing(action) {
  return DOING[action] ?? String(action ?? "").replaceAll("-", " ");
}

/** 72.44 -> "1:12", with `decimals` 1 "1:12.4". */
export function clock(t, decimals = 0) {
  const unit = 10 ** decimals;
  const whole = Math.floor(Math.max(t, 0) * unit + 1e-6);
  const minutes = Math.floor(whole / (60 * unit));
  const seconds = ((whole % (60 * unit)) / unit).toFixed(decimals);
  return `${minutes}:${seconds.padStart(decimals ? 3 + decimals : 2, "0")}`;
}

/** A probability without false precision: "under 1 %", "72 %", "over 99 %". */
export function percent(p) {
  if (!Number.isFinite(p) || p <= 0) return "0 %";
  if (p < 0.01) return "under 1 %";
  if (p >= 1 - 1e-9) return "100 %";
  if (p > 0.99) return "over 99 %";
  return `${Math.round(p * 100)} %`;
}

/** "12.4 s" */
export function seconds(t) {
  return `${fixed(t)} s`;
}

/** A difference with its sign, a true minus: "+4.1 s", "−0.3 s", "0 s". */
export function signed(t) {
  const text = fixed(Math.abs(t));
  if (text === "0.0") return "0 s";
  return `${t < 0 ? "−" : "+"}${text} s`;
}

/** "3.2", with a true minus. */
export function fixed(value) {
  return value
    .toFixed(1)
    .replace(/^-(?=0\.0$)/, "")
    .replace("-", "−");
}

/** "1 rollout", "12 rollouts" */
export function many(count, one, several = `${one}s`) {
  return `${count} ${count === 1 ? one : several}`;
}

/** The car says "vehicle 1" and "us". */
export function named(vehicle) {
  return vehicle === 0 ? "us" : `vehicle ${vehicle}`;
}

/** "Change to the left lane" -> "change to the left lane"; other capitals stay. */
export function lower(words) {
  return words.charAt(0).toLowerCase() + words.slice(1);
}

/** "vehicle 1" -> "Vehicle 1" */
export function upper(words) {
  return words.charAt(0).toUpperCase() + words.slice(1);
}

/** Outcomes with their shares: "arrives 91 %, collides 9 %". */
export function outcomesInWords(outcomes) {
  const parts = OUTCOMES.filter(({ key }) => outcomes[key] > 0);
  return parts.map(({ key, words }) => `${words} ${percent(outcomes[key])}`).join(", ");
}
