/** Times in words and figures. */

/** A moment of the ride [s] as m:ss. */
export function clock(t) {
  const whole = Math.max(0, Math.floor(t + 1e-6));
  return `${Math.floor(whole / 60)}:${String(whole % 60).padStart(2, "0")}`;
}

/** A time taken [ms], as one would say it. */
export function lasted(ms) {
  if (ms < 1) return "under 1 ms";
  if (ms < 1000) return `${Math.round(ms)} ms`;
  return `${(ms / 1000).toFixed(1)} s`;
}

/** "1 scene", "2 scenes". */
export function counted(count, noun, plural = `${noun}s`) {
  return `${count} ${count === 1 ? noun : plural}`;
}
