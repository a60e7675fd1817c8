/** Figures as one would say them, with no more digits than they bear. */

const UNITS = { "m/s3": "m/s³", "rad/s2": "rad/s²", "m/s2": "m/s²" };

/** A probability. */
export function percent(p) {
  if (p > 0 && p < 0.01) return "under 1 %";
  if (p < 1 && p > 0.99) return "over 99 %";
  return `${Math.round(p * 100)} %`;
}

/** A unit, with its power as such. */
export function unit(name) {
  return UNITS[name] ?? name;
}

/** A magnitude: two digits that tell something, a tenth at the finest for times. */
export function magnitude(value, name) {
  const size = Math.abs(value);
  if (name === "s") return size.toFixed(1);
  if (size === 0) return "0";
  return size >= 100 ? size.toFixed(0) : String(Number(size.toPrecision(2)));
}

/** A difference in words: "4.1 s later", "0.36 m/s³ less", "no difference". */
export function difference(value, name) {
  const size = magnitude(value, name);
  if (Number(size) === 0) return name === "s" ? "no sooner or later" : "no difference";
  const direction = name === "s" ? (value > 0 ? "later" : "sooner") : value > 0 ? "more" : "less";
  return `${size} ${unit(name)} ${direction}`;
}

/** An interval in words; both ends on one side are said in one breath. */
export function between(low, high, name) {
  const ends = alike(low, high, name);
  if (ends[0] === ends[1]) return null;
  if (ends[0] < 0 && ends[1] > 0) return `between ${difference(ends[0], name)} and ${difference(ends[1], name)}`;
  const sizes = ends.map(Math.abs).sort((a, b) => a - b);
  return `between ${magnitude(sizes[0], name)} and ${magnitude(sizes[1], name)} ${unit(name)}`;
}

/** Both ends to the digit that the larger one is told to. */
function alike(low, high, name) {
  const digits =
    name === "s"
      ? 1
      : Math.min(Math.max(1 - Math.floor(Math.log10(Math.max(Math.abs(low), Math.abs(high), 1e-9))), 0), 9);
  return [low, high].map((end) => Number(end.toFixed(digits)) || 0); // and no minus zero
}
