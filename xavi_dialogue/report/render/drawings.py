"""The strip of maps as SVG."""

import math
from collections.abc import Callable, Sequence

from msgspec.structs import replace

from sim.boxes import corners
from sim.scene import EGO, Point
from xavi_dialogue.report.content import Body, Frame, Map
from xavi_dialogue.report.render.colours import LIGHTS, colour, stroke
from xavi_dialogue.report.render.markup import Markup, tag
from xavi_dialogue.report.render.words import seconds

SIDE = 240.0  # [px] of one map
CLOSE = 12.0  # [m] to the edges of the enlarged map
BARS = (2.0, 5.0, 10.0, 20.0, 50.0)  # [m] lengths of a scale


def strip(shown: Map, moment: float, involved: Sequence[int]) -> Markup:
    """Return the maps side by side."""
    figures = [_figure(shown, frame, moment, involved) for frame in shown.frames]
    at = [frame for frame in shown.frames if frame.time <= moment + 1e-6]
    if at:
        figures.append(_figure(_enlarged(shown, at[-1]), at[-1], moment, involved, ", enlarged"))
    return tag("div", *figures, class_="strip")


def _enlarged(shown: Map, frame: Frame) -> Map:
    """Return a map of the surroundings of the car alone."""
    own = next((body.position for body in frame.bodies if body.vehicle == EGO), shown.centre)
    return replace(shown, centre=own, reach=CLOSE)


def _figure(
    shown: Map, frame: Frame, moment: float, involved: Sequence[int], note: str = ""
) -> Markup:
    by = frame.time - moment
    sign = "±0" if abs(by) < 1e-6 else f"{by:+.1f}".replace("-", "\N{MINUS SIGN}")
    return tag(
        "figure",
        _map(shown, frame, involved),
        tag("figcaption", tag("b", seconds(frame.time)), f" ({sign} s){note}"),
    )


def _map(shown: Map, frame: Frame, involved: Sequence[int]) -> Markup:
    scale = SIDE / (2.0 * shown.reach)

    def place(point: Point) -> Point:
        x, y = point[0] - shown.centre[0], point[1] - shown.centre[1]
        return SIDE / 2.0 + scale * x, SIDE / 2.0 - scale * y

    parts = [tag("rect", width=SIDE, height=SIDE, fill="#eef1ea")]
    for inside in (True, False):
        for road in shown.roads:
            if road.inside == inside:
                parts.append(_line([place(p) for p in road.line], "#c9ccd1", road.width * scale))
    for road in shown.roads:
        if not road.inside:
            parts.append(_line([place(p) for p in road.line], "#fff", 0.6, "4 5"))
    for vehicle, track in shown.tracks.items():
        way = [place(p) for p in track]
        parts.append(_line(way, colour(vehicle, involved), 1.0, stroke(vehicle, involved)))
    for light in frame.lights:
        x, y = place(light.position)
        fill = LIGHTS.get(light.state, "#888")
        parts.append(tag("circle", cx=x, cy=y, r="3.2", fill=fill, stroke="#222"))
    ranked = sorted(frame.bodies, key=lambda one: (one.vehicle == EGO, one.vehicle in involved))
    parts += [_body(body, place, involved) for body in ranked]
    parts.append(_bar(shown, scale))
    return tag("svg", *parts, viewBox=f"0 0 {SIDE:g} {SIDE:g}", role="img", class_="map",
               aria_label=f"Map at {frame.time:.1f} s",
               xmlns="http://www.w3.org/2000/svg")  # fmt: skip


def _body(body: Body, place: Callable[[Point], Point], involved: Sequence[int]) -> Markup:
    ends = [place(corner) for corner in corners(body)]
    around = " ".join(f"{x:.1f},{y:.1f}" for x, y in ends)
    (lx, ly), (rx, ry) = ends[0], ends[1]
    x = sum(x for x, _ in ends) / 4.0
    y = sum(y for _, y in ends) / 4.0
    known = body.vehicle == EGO or body.vehicle in involved
    label = tag("text", str(body.vehicle), x=x + 8.0, y=y - 6.0, font_size="10" if known else "7",
                font_weight="bold" if known else None, class_="halo")  # fmt: skip
    return tag(
        "g",
        tag("polygon", points=around, fill=colour(body.vehicle, involved), stroke="#111",
            stroke_width="0.6"),
        tag("line", x1=lx, y1=ly, x2=rx, y2=ry, stroke="#fff", stroke_width="1.4"),
        label,
    )  # fmt: skip


def _bar(shown: Map, scale: float) -> Markup:
    """Return the scale, and where north is."""
    length = max((one for one in BARS if one <= shown.reach / 2.0), default=BARS[0])
    end, y = 10.0 + length * scale, SIDE - 10.0
    return tag(
        "g",
        tag("path", d=f"M10,{y - 4:.1f} V{y:.1f} H{end:.1f} V{y - 4:.1f}", fill="none",
            stroke="#222"),
        tag("text", f"{length:g} m", x=14.0, y=y - 4.0, font_size="9"),
        tag("path", d=f"M{SIDE - 14:.0f},10 l4,12 l-4,-3 l-4,3 z", fill="#222"),
        tag("text", "N", x=SIDE - 14.0, y=32.0, font_size="9", text_anchor="middle"),
    )  # fmt: skip


def _line(points: Sequence[Point], colour_: str, width: float, dashes: str | None = None) -> Markup:
    way = " ".join(f"{x:.1f},{y:.1f}" for x, y in points if math.isfinite(x + y))
    return tag("polyline", points=way, fill="none", stroke=colour_, stroke_width=width,
               stroke_dasharray=dashes)  # fmt: skip
