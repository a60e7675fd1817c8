/** The road network: what of it is drawn, and how, by scale. */

import { beforeEnd, boundsOf, lengthOf, meet, offset, pathOf, trace } from "./lines.js";
import { paint } from "./paint.js";
import { placesOfSignals } from "./signals.js";

const DASH = [3, 4.5]; // [m]
const LINE = 0.14; // [m] width of markings
const LINES = 500; // of a grid, each way
const KERB = 0.35; // [m] on each side
const ZEBRA = [0.5, 0.6]; // [m] stripe and gap
const GROUNDS = { bicycles: "map-cycleway", people: "map-pavement", rails: "map-rails", others: "road" };
const TURNS = { left: 1, right: -1, turnaround: 1 }; // sides

/** Scales [px/m] from which on things are drawn: below, they would only be clutter. */
const FROM = { crossings: 1.1, sides: 1.1, dashes: 2, stops: 2.6, arrows: 4.2 };

export class RoadLayer {
  /** @param {Roads} roads */
  constructor(roads) {
    this.lanes = new Map(roads.lanes.map((lane) => [lane.id, lane]));
    this.links = new Map(roads.links.map((link) => [link.id, link]));
    this.bounds = roads.bounds;
    this.lanesOf = Map.groupBy(roads.lanes, (lane) => lane.edge);
    const leaving = Map.groupBy(roads.links, (link) => link.from_lane);
    const open = roads.lanes.filter((lane) => !lane.internal);
    this.surfaces = roads.lanes.map((lane) => item(lane.line, lane.width, lane));
    this.others = new Map((roads.others ?? []).map((lane) => [lane.id, lane]));
    this.beside = [...this.others.values()].map((lane) => item(lane.line, lane.width, lane));
    this.crossings = (roads.crossings ?? []).map(({ line, width }) => item(line, width));
    this.signals = placesOfSignals(roads, this.lanes);
    this.junctions = roads.junctions.map((outline) => {
      const path = new Path2D();
      trace(path, outline, true);
      return { path, box: boundsOf([outline]) ?? [0, 0, 0, 0] };
    });
    this.sides = [];
    this.dashes = [];
    for (const lane of open) this.mark(lane);
    this.stops = open.filter((lane) => leaving.get(lane.id)?.some((link) => link.yields_to.length)).map(stopLine);
    this.arrows = this.arrowsOf(open, leaving);
  }

  mark(lane) {
    const widths = this.lanesOf.get(lane.edge).map((one) => one.index);
    const [rightmost, leftmost] = [Math.min(...widths), Math.max(...widths)];
    if (lane.index === rightmost) this.sides.push(item(offset(lane.line, -lane.width / 2), LINE));
    const left = item(offset(lane.line, lane.width / 2), LINE);
    (lane.index === leftmost ? this.sides : this.dashes).push(left);
  }

  /** Arrows only where lanes of an edge lead to different places. */
  arrowsOf(open, leaving) {
    const ways = (lane) => [...new Set((leaving.get(lane.id) ?? []).map((link) => link.direction))];
    const turns = (lane) => ways(lane).some((way) => way !== "straight");
    const choice = (lane) => ways(lane).length && this.lanesOf.get(lane.edge).some(turns);
    return open.filter((lane) => choice(lane) && lengthOf(lane.line) > 14).map((lane) => arrow(lane, ways(lane)));
  }

  /** Draw what is within bounds; the context draws in metres. */
  draw(context, bounds, scale, colours) {
    const seen = (items) => items.filter((one) => meet(one.box, bounds));
    const surfaces = seen(this.surfaces);
    const inside = surfaces.filter((one) => one.lane.internal);
    const outside = surfaces.filter((one) => !one.lane.internal);
    context.lineJoin = "round";
    context.lineCap = "butt";
    context.setLineDash([]);
    this.kerbs(context, outside, seen(this.junctions), colours);
    for (const { path } of seen(this.junctions)) paint(context, path, { fill: colours.get("road-junction") });
    stroke(context, inside, colours.get("road-junction"), (one) => one.width);
    stroke(context, outside, colours.get("road"), (one) => one.width + 0.04);
    this.besides(context, seen(this.beside), colours);
    this.markings(context, seen, scale, colours);
  }

  /** Lanes that cars may not use. */
  besides(context, lanes, colours) {
    for (const [use, colour] of Object.entries(GROUNDS)) {
      const own = lanes.filter(({ lane }) => lane.use === use && !lane.internal);
      stroke(context, own, colours.get(colour), (one) => one.width);
    }
  }

  kerbs(context, lanes, junctions, colours) {
    const colour = colours.get("map-kerb");
    stroke(context, lanes, colour, (one) => one.width + 2 * KERB);
    stroke(context, junctions, colour, () => 2 * KERB);
  }

  markings(context, seen, scale, colours) {
    const colour = colours.get("marking");
    const thin = () => Math.max(LINE, 0.9 / scale);
    if (scale >= FROM.crossings) {
      context.setLineDash(ZEBRA);
      stroke(context, seen(this.crossings), colour, (one) => one.width);
      context.setLineDash([]);
    }
    if (scale >= FROM.sides) stroke(context, seen(this.sides), colour, thin);
    if (scale >= FROM.dashes) {
      context.setLineDash(DASH);
      stroke(context, seen(this.dashes), colour, thin);
      context.setLineDash([]);
    }
    if (scale >= FROM.stops) stroke(context, seen(this.stops), colour, () => 0.4);
    if (scale >= FROM.arrows) {
      stroke(context, seen(this.arrows), colour, () => 0.24);
      for (const { heads } of seen(this.arrows)) paint(context, heads, { fill: colour });
    }
  }

  /** The lane that a point is on, the nearest one; null: none within its width. */
  laneAt(x, y) {
    let best = null;
    for (const one of this.surfaces) {
      if (!meet(one.box, [x, y, x, y])) continue;
      const away = distance(one.lane.line, x, y);
      if (away < one.lane.width && (!best || away < best.away)) best = { lane: one.lane, away };
    }
    return best?.lane ?? null;
  }
}

/** A plain grid for where roads are not known; returns its spacing [m]. */
export function drawGrid(context, [left, bottom, right, top], scale, colours) {
  const spacing = [10, 50, 100, 500].find((step) => step * scale >= 24) ?? 1000;
  const upright = multiples(spacing, left, right).map((x) => [x, bottom, x, top]);
  const level = multiples(spacing, bottom, top).map((y) => [left, y, right, y]);
  paint(context, pathOf(...upright, ...level), { stroke: colours.get("map-grid"), width: 1 / scale });
  return spacing;
}

/** Counted, not added up: far out, a step may be too small to change a number. */
function multiples(step, from, to) {
  const first = Math.ceil(from / step);
  const many = Math.min(Math.max(Math.floor(to / step) - first + 1, 0), LINES);
  return Array.from({ length: many || 0 }, (_, k) => (first + k) * step);
}

function item(line, width, lane = null) {
  return { path: pathOf(line), width, lane, box: boundsOf([line], width) ?? [0, 0, 0, 0] };
}

function stopLine(lane) {
  const { x, y, heading } = beforeEnd(lane.line, 0.4);
  const [dx, dy] = [-Math.sin(heading) * lane.width * 0.44, Math.cos(heading) * lane.width * 0.44];
  return item([x + dx, y + dy, x - dx, y - dy], 0.4);
}

/** The arrow painted on a lane before its end: a shaft, and a head for every way that it leads. */
function arrow(lane, ways) {
  const { x, y, heading } = beforeEnd(lane.line, Math.min(9, lengthOf(lane.line) / 3));
  const [c, s] = [Math.cos(heading), Math.sin(heading)];
  const place = (u, v) => [x + u * c - v * s, y + u * s + v * c];
  const lines = [[...place(-3, 0), ...place(0.1, 0)]];
  const heads = new Path2D();
  for (const way of ways) {
    const side = Object.hasOwn(TURNS, way) ? TURNS[way] : 0;
    const around = way === "turnaround";
    const back = around ? -0.9 : 0.4;
    const tip = side ? [back, side * 0.85] : [1.6, 0];
    const round = [place(0.1, 0), place(0.4, side * 0.25), place(Math.max(back, 0.4), side * 0.6)];
    const bend = side ? round : [place(0, 0)];
    lines.push([...bend, place(...tip)].flat());
    const angle = side * (around ? Math.PI : Math.PI / 2);
    const [ca, sa] = [Math.cos(angle), Math.sin(angle)];
    const corner = (along, across) => place(tip[0] + along * ca - across * sa, tip[1] + along * sa + across * ca);
    trace(heads, [...corner(side ? 0.6 : 1.1, 0), ...corner(-0.1, 0.45), ...corner(-0.1, -0.45)], true);
  }
  return { path: pathOf(...lines), heads, width: 0.2, lane: null, box: [x - 4, y - 4, x + 4, y + 4] };
}

function stroke(context, items, colour, widthOf) {
  for (const one of items) paint(context, one.path, { stroke: colour, width: widthOf(one) });
}

function distance(line, x, y) {
  let least = Infinity;
  for (let i = 2; i < line.length; i += 2) {
    const [ax, ay] = [line[i - 2], line[i - 1]];
    const [bx, by] = [line[i] - ax, line[i + 1] - ay];
    const along = ((x - ax) * bx + (y - ay) * by) / (bx * bx + by * by || 1);
    const part = Math.min(Math.max(along, 0), 1);
    least = Math.min(least, Math.hypot(x - ax - bx * part, y - ay - by * part));
  }
  return least;
}
