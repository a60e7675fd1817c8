/** Small things that lines and places are marked with; contexts draw in pixels of CSS. */

/** An arrow head at the end of a line. */
export function arrowHead(context, view, { x, y, heading }, colour, size = 9) {
  const [px, py] = view.toScreen(x, y);
  const [c, s] = [Math.cos(heading), -Math.sin(heading)];
  context.beginPath();
  context.moveTo(px + c * size, py + s * size);
  context.lineTo(px - c * size * 0.6 - s * size * 0.75, py - s * size * 0.6 + c * size * 0.75);
  context.lineTo(px - c * size * 0.2, py - s * size * 0.2);
  context.lineTo(px - c * size * 0.6 + s * size * 0.75, py - s * size * 0.6 - c * size * 0.75);
  context.closePath();
  context.fillStyle = colour;
  context.fill();
}

/** A flag that stands at a place. */
export function flag(context, view, [x, y], colours) {
  const [px, py] = view.toScreen(x, y);
  context.beginPath();
  context.arc(px, py, 3.5, 0, 2 * Math.PI);
  context.fillStyle = colours.get("accent");
  context.fill();
  context.beginPath();
  context.moveTo(px, py);
  context.lineTo(px, py - 24);
  context.strokeStyle = colours.get("ink");
  context.lineWidth = 2;
  context.stroke();
  context.beginPath();
  context.moveTo(px, py - 25);
  context.quadraticCurveTo(px + 7, py - 28, px + 11, py - 24);
  context.quadraticCurveTo(px + 14, py - 22, px + 19, py - 24);
  context.lineTo(px + 19, py - 13);
  context.quadraticCurveTo(px + 13, py - 10, px + 9, py - 13);
  context.quadraticCurveTo(px + 5, py - 15, px, py - 13);
  context.closePath();
  context.fillStyle = colours.get("accent");
  context.fill();
  context.strokeStyle = colours.get("card");
  context.lineWidth = 1;
  context.stroke();
}

/** The sign that one gives way: a triangle on its tip. */
export function giveWay(context, view, { x, y }, colours) {
  const [px, py] = view.toScreen(x, y);
  const size = 11;
  context.beginPath();
  context.moveTo(px - size, py - size * 0.75);
  context.lineTo(px + size, py - size * 0.75);
  context.lineTo(px, py + size);
  context.closePath();
  context.lineJoin = "round";
  context.fillStyle = colours.get("card");
  context.fill();
  context.strokeStyle = colours.get("warn");
  context.lineWidth = 3.5;
  context.stroke();
}

/** Where a line ends in a collision. */
export function crash(context, view, { x, y }, colours) {
  const [px, py] = view.toScreen(x, y);
  for (const [width, colour] of [
    [6, colours.get("card")],
    [3, colours.get("bad")],
  ]) {
    context.beginPath();
    for (const [dx, dy] of [
      [7, 7],
      [7, -7],
    ]) {
      context.moveTo(px - dx, py - dy);
      context.lineTo(px + dx, py + dy);
    }
    context.lineCap = "round";
    context.strokeStyle = colour;
    context.lineWidth = width;
    context.stroke();
  }
}
