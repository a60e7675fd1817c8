/** How near the map looks while it follows our car: what matters around it fills the view. */

import { clamped } from "../figures.js";
import { pointsOf } from "./lines.js";

const NEAREST = 4; // other vehicles that matter
const AHEAD = 70; // [m] in which they do, and in which a junction does
const BEHIND = 30; // [m]
const EDGE = 64; // [px] of the view in which nothing that matters should stand
const [LEAST, MOST] = [2.5, 9]; // [px/m]
const SLACK = 0.94; // of the scale that would just do
const CLOSER = 1.3; // times as close as now it could be, before it comes closer
const LOOK = 500; // [ms] from one look to the next
const CALM = 2500; // [ms] for which it must have been so, before it comes closer
const GLIDE = 700; // [ms]

export class Framing {
  constructor(view, following) {
    Object.assign(this, { view, following });
    this.reset();
  }

  /** Frame anew, at once; smoothly where it is the same ride. */
  reset(fresh = true) {
    this.on = true;
    this.fresh = fresh;
    this.looked = -Infinity; // [ms]
    this.roomSince = -Infinity; // [ms] since when it could come closer; null: it could not
  }

  /** Whether it is time for another look. */
  due(now) {
    return this.on && this.following.on && !this.view.glide && now - this.looked >= LOOK;
  }

  /** The reader has chosen a scale; it stays. */
  leave() {
    this.on = false;
  }

  /**
   * Look whether another scale is better, and go there.
   * @param {object} ego our car
   * @param {[number, number][]} points [m] around it that matter
   */
  step(ego, points, now) {
    const { view } = this;
    this.looked = now;
    const scale = clamped(this.largest(ego, points) * SLACK, LEAST, MOST);
    const roomy = scale > view.scale * CLOSER;
    this.roomSince = roomy ? (this.roomSince ?? now) : null;
    if (this.fresh) view.jump({ scale });
    else if (scale < view.scale * SLACK || (roomy && now - this.roomSince > CALM)) {
      view.glideTo({ scale }, now, GLIDE);
    }
    this.fresh = false;
  }

  /** [px/m] The largest scale at which all points are in view, with our car where it is followed. */
  largest(ego, points) {
    const { view } = this;
    const lead = this.following.leadFor(ego);
    let scale = Infinity;
    for (const point of points) {
      [view.width, view.height].forEach((size, axis) => {
        const away = point[axis] - [ego.x, ego.y][axis];
        const room = Math.max(size / 2 - EDGE + Math.sign(away) * lead[axis], 10);
        if (away) scale = Math.min(scale, room / Math.abs(away));
      });
    }
    return scale;
  }
}

/**
 * What matters around our car: the nearest vehicles, those that are spoken of, the junction ahead.
 * @param {Set<number>} told vehicles that are spoken of
 * @returns {[number, number][]} [m]
 */
export function pointsThatMatter(ego, { vehicles, told, detail, roads }) {
  const [c, s] = [Math.cos(ego.heading), Math.sin(ego.heading)];
  const near = [];
  const points = [];
  for (const { id, x, y } of vehicles) {
    if (id === 0) continue;
    const ahead = (x - ego.x) * c + (y - ego.y) * s;
    const away = Math.hypot(x - ego.x, y - ego.y);
    if (away > AHEAD || (ahead < -BEHIND && !told.has(id))) continue;
    if (told.has(id)) points.push([x, y]);
    else near.push({ away, point: [x, y] });
  }
  near.sort((a, b) => a.away - b.away);
  points.push(...near.slice(0, NEAREST).map((one) => one.point));
  const link = roads?.links.get(detail?.right_of_way?.ego);
  for (const id of link?.via ?? []) {
    const line = pointsOf(roads.lanes.get(id)?.line ?? []);
    points.push(...line.filter(([x, y]) => Math.hypot(x - ego.x, y - ego.y) < AHEAD));
  }
  return points;
}
