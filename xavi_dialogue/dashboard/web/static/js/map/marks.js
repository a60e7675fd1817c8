/** Small things that lines and places are marked with. */

import { disc, paint } from "./paint.js";

const ARROW = new Path2D("M1 0 -.6 .75 -.2 0 -.6 -.75z"); // ahead is to the right
const POLE = new Path2D("M0 0V-24");
const CLOTH = new Path2D("M0-25Q7-28 11-24 14-22 19-24V-13Q13-10 9-13 5-15 0-13z");
const TRIANGLE = new Path2D("M-11-8.25H11L0 11z");
const CROSS = new Path2D("M-7-7 7 7M-7 7 7-7");

/** An arrow head at the end of a line. */
export function arrowHead(context, view, { x, y, heading }, colour, size = 9) {
  view.place(context, view.toScreen(x, y), heading, size);
  paint(context, ARROW, { fill: colour });
}

/** A flag that stands at a place. */
export function flag(context, view, [x, y], colours) {
  view.place(context, view.toScreen(x, y));
  paint(context, disc(0, 0, 3.5), { fill: colours.get("accent") });
  paint(context, POLE, { stroke: colours.get("ink"), width: 2 });
  paint(context, CLOTH, { fill: colours.get("accent"), stroke: colours.get("card") });
}

/** The sign that one gives way: a triangle on its tip. */
export function giveWay(context, view, { x, y }, colours) {
  view.place(context, view.toScreen(x, y));
  context.lineJoin = "round";
  paint(context, TRIANGLE, { fill: colours.get("card"), stroke: colours.get("warn"), width: 3.5 });
}

/** Where a line ends in a collision. */
export function crash(context, view, { x, y }, colours) {
  view.place(context, view.toScreen(x, y));
  context.lineCap = "round";
  paint(context, CROSS, { stroke: colours.get("card"), width: 6 });
  paint(context, CROSS, { stroke: colours.get("bad"), width: 3 });
}
