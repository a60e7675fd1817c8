/** Figures as one would say them: units always, and no more digits than they bear. */

/** A value within its bounds. */
export function clamped(value, least, most) {
  return Math.min(Math.max(value, least), most);
}

const UNITS = { "m/s3": "m/s³", "rad/s2": "rad/s²", "m/s2": "m/s²" };

/** A moment of the ride [s]: "1:12", with one decimal "1:12.4"; never one that is yet to come. */
export function clock(t, decimals = 0) {
  const unit = 10 ** decimals;
  const whole = Math.floor(Math.max(t, 0) * unit + 1e-6);
  const minutes = Math.floor(whole / (60 * unit));
  const rest = ((whole % (60 * unit)) / unit).toFixed(decimals);
  return `${minutes}:${rest.padStart(decimals ? 3 + decimals : 2, "0")}`;
}

/** A time taken [ms], as one would say it. */
export function lasted(ms) {
  if (ms < 1) return "under 1 ms";
  if (ms < 1000) return `${Math.round(ms)} ms`;
  return seconds(ms / 1000);
}

/** "1 scene", "2 scenes". */
export function counted(count, noun, plural = `${noun}s`) {
  return `${count} ${count === 1 ? noun : plural}`;
}

/** A probability without false precision: "under 1 %", "72 %", "over 99 %". */
export function percent(p) {
  if (!(p > 0)) return "0 %";
  if (p < 0.01) return "under 1 %";
  if (p >= 1 - 1e-9) return "100 %";
  if (p > 0.99) return "over 99 %";
  return `${Math.round(p * 100)} %`;
}

/** "3.2", with a true minus, and none before zero. */
export function fixed(value) {
  return (Number(value.toFixed(1)) || 0).toFixed(1).replace("-", "−");
}

/** "12.4 s" */
export function seconds(t) {
  return `${fixed(t)} s`;
}

/** "30 km/h" of a speed [m/s]. */
export function speed(v) {
  return `${Math.round(v * 3.6)} km/h`;
}

/** A difference in words: "4.1 s later", "0.36 m/s³ less", "no difference". */
export function difference(value, unit) {
  const size = magnitude(value, unit);
  if (Number(size) === 0) return unit === "s" ? "no sooner or later" : "no difference";
  const direction = unit === "s" ? (value > 0 ? "later" : "sooner") : value > 0 ? "more" : "less";
  return `${size} ${UNITS[unit] ?? unit} ${direction}`;
}

/** An interval in words; both ends on one side are said in one breath. null: it has no width. */
export function between(low, high, unit) {
  const ends = alike(low, high, unit);
  if (ends[0] === ends[1]) return null;
  if (ends[0] < 0 && ends[1] > 0) return `between ${difference(ends[0], unit)} and ${difference(ends[1], unit)}`;
  const sizes = ends.map(Math.abs).sort((a, b) => a - b);
  return `between ${magnitude(sizes[0], unit)} and ${magnitude(sizes[1], unit)} ${UNITS[unit] ?? unit}`;
}

/** A magnitude: two digits that tell something, a tenth at the finest for times. */
function magnitude(value, unit) {
  const size = Math.abs(value);
  if (unit === "s") return size.toFixed(1);
  if (size === 0) return "0";
  return size >= 100 ? size.toFixed(0) : String(Number(size.toPrecision(2)));
}

/** Both ends to the digit that the larger one is told to. */
function alike(low, high, unit) {
  const largest = Math.max(Math.abs(low), Math.abs(high), 1e-9);
  const digits = unit === "s" ? 1 : clamped(1 - Math.floor(Math.log10(largest)), 0, 9);
  return [low, high].map((end) => Number(end.toFixed(digits)) || 0); // and no minus zero
}
