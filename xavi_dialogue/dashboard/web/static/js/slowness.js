/** Whether this page is too slow for the scenes that come: what it is told of is worth telling only then. */

const SPAN = 10_000; // [ms] that is looked at
const WORTH = 0.05; // share of dropped scenes from which on it is

export class Slowness {
  scenes = []; // [ms] when they came
  drops = []; // [ms, how many] when it was told that some were dropped
  total = 0; // since the page connected

  /** A scene came. */
  came(now) {
    this.scenes.push(now);
    while (this.scenes[0] < now - SPAN) this.scenes.shift();
  }

  /** So many were dropped since the page connected. */
  told(total, now) {
    if (total > this.total) this.drops.push([now, total - this.total]);
    this.total = total; // another connection counts from zero
    while (this.drops[0]?.[0] < now - SPAN) this.drops.shift();
  }

  /** Scenes that were dropped of late, if that is worth telling; else 0. */
  worth(now) {
    const lately = this.drops.filter(([at]) => at >= now - SPAN).reduce((sum, [, count]) => sum + count, 0);
    const came = this.scenes.filter((at) => at >= now - SPAN).length;
    return lately > WORTH * (lately + came) ? lately : 0;
  }
}
