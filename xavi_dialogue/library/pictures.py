"""Pictures of rides as SVG: maps, and curves over time."""

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from html import escape
from pathlib import Path

from planner.record.trace import PlanTrace
from sim.roads.network import Network
from sim.scene import EGO, PersonState, Point, Scene, VehicleState
from xavi_dialogue.library import paint
from xavi_dialogue.library.arguments import path_of
from xavi_dialogue.library.errors import LibraryError
from xavi_dialogue.library.paint import Rgb
from xavi_dialogue.library.trajectories import Trajectory

REACH = 60.0  # [m] around our own car that a map shows at least
FARTHEST = 160.0  # [m] from our own car that it shows at most
MARGIN = 8.0  # [m]
WIDTH = 760  # [px]
TALLEST = 520  # [px]
FAINTEST = 0.02  # probability of the least likely belief that is drawn
ROAD, OTHER_ROAD, MARKING, GROUND = "#c3c8d0", "#d8d2cb", "#ffffff", "#f4f5f2"


@dataclass(frozen=True, slots=True)
class Picture:
    """A picture that notebooks show."""

    svg: str = field(repr=False)  # the whole document
    caption: str = ""  # what it shows, in words

    def save(self, path: str | Path) -> Path:
        """Write it as an SVG file.

        Raises:
            XaviError: it cannot be written, or its name is that of another kind of file.
        """
        file = path_of(path)
        if file.suffix.lower() not in ("", ".svg"):
            raise LibraryError(f"pictures are written as SVG, not {file.suffix}; end {file} so")
        try:
            file.write_text(self.svg, encoding="utf-8")
        except OSError as error:
            raise LibraryError(f"cannot write {file}: {error.strerror}") from error
        return file

    def _repr_html_(self) -> str:
        told = f"<figcaption>{escape(self.caption)}</figcaption>" if self.caption else ""
        return f'<figure style="margin:0">{self.svg}{told}</figure>'


@dataclass(frozen=True, slots=True)
class View:
    """What a map shows."""

    scene: Scene
    network: Network | None = None
    planned: Trajectory | None = None
    ghost: Trajectory | None = None
    beliefs: PlanTrace | None = None  # the decision whose predictions are drawn


def drawn(view: View) -> Picture:
    """Return a map, north up."""
    left, bottom, right, top = _bounds(view)
    scale = min(WIDTH / (right - left), TALLEST / (top - bottom))
    parts = "".join((*_roads(view), *_beliefs(view), *_lines(view), *_users(view.scene)))
    box = f"{left:.1f} {-top:.1f} {right - left:.1f} {top - bottom:.1f}"
    size = f'width="{scale * (right - left):.0f}" height="{scale * (top - bottom):.0f}"'
    svg = (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{box}" {size}'
        f' style="max-width:100%;height:auto;background:{GROUND}" role="img">'
        f'<g font-family="sans-serif" font-size="{12.0 / scale:.2f}">{parts}</g></svg>'
    )
    return Picture(svg, _caption(view))


def css(colour: Rgb) -> str:
    """Return a colour as CSS has it."""
    return "#" + "".join(f"{round(255 * value):02x}" for value in colour)


def _caption(view: View) -> str:
    told = [f"At {view.scene.time:.1f} s"]
    if view.planned is not None:
        told.append(f"turquoise: the plan ({view.planned.outcome})")
    if view.ghost is not None:
        told.append(f"dashed: what would have been driven otherwise ({view.ghost.outcome})")
    if view.beliefs is not None and view.beliefs.predictions:
        told.append("orange: where others were expected to go")
    dots = "; dots are a second apart" if view.planned or view.ghost else ""
    return "; ".join(told) + dots + "."


def _bounds(view: View) -> tuple[float, float, float, float]:
    x, y = view.scene.ego.position
    lines = [line.points for line in (view.planned, view.ghost) if line is not None]
    near = [p for line in lines for p in line if math.dist(p, (x, y)) <= FARTHEST]
    near += [one.position for one in view.scene.vehicles.values()]
    near += [(x - REACH / 2.0, y), (x + REACH / 2.0, y), (x, y - REACH / 4.0), (x, y + REACH / 4.0)]
    xs, ys = [p[0] for p in near], [p[1] for p in near]
    return min(xs) - MARGIN, min(ys) - MARGIN, max(xs) + MARGIN, max(ys) + MARGIN


def _roads(view: View) -> Iterator[str]:
    if view.network is None:
        return
    others = [(lane.centreline, lane.width) for lane in view.network.other_lanes.values()]
    lanes = list(view.network.lanes.values())
    for line, width in others:
        yield _polyline(line, OTHER_ROAD, width)
    for lane in lanes:
        yield _polyline(lane.centreline, ROAD, lane.width)
    for crossing in view.network.crossings:
        dashes = f' stroke-dasharray="0.5 0.5" stroke-width="{crossing.width:.2f}"'
        yield _polyline(crossing.line, MARKING, crossing.width, dashes)
    for lane in lanes:
        if not lane.internal and lane.index:
            between = _aside(lane.centreline, -lane.width / 2.0)
            yield _polyline(between, MARKING, 0.2, ' stroke-dasharray="3 4"')


def _aside(line: Sequence[Point], offset: float) -> list[Point]:
    """Return a line [m] to the left of another."""
    result = []
    for k, (x, y) in enumerate(line):
        (ax, ay), (bx, by) = line[max(k - 1, 0)], line[min(k + 1, len(line) - 1)]
        length = math.hypot(bx - ax, by - ay) or 1.0
        result.append((x - offset * (by - ay) / length, y + offset * (bx - ax) / length))
    return result


def _beliefs(view: View) -> Iterator[str]:
    if view.beliefs is None:
        return
    for known in view.beliefs.predictions:
        for goal in known.goals:
            for way in goal.trajectories:
                chance = goal.probability * way.probability
                if chance >= FAINTEST and len(way.path) > 1:
                    faint = f' stroke-opacity="{0.15 + 0.75 * chance:.2f}"'
                    title = f"vehicle {known.vehicle}: {goal.place}, {chance:.0%}"
                    yield _polyline(way.path, css(paint.BELIEF), 0.8, faint, title)


def _lines(view: View) -> Iterator[str]:
    for line, colour, dashes in (
        (view.planned, paint.OURS, ""),
        (view.ghost, paint.GHOST, ' stroke-dasharray="2 1.4"'),
    ):
        if line is None:
            continue
        yield _polyline(line.points, css(colour), 0.7, dashes)
        every = max(round(1.0 / line.period), 1)
        for x, y in line.points[::every]:
            yield f'<circle cx="{x:.1f}" cy="{-y:.1f}" r="0.8" fill="{css(colour)}"/>'


def _users(scene: Scene) -> Iterator[str]:
    users: dict[int, VehicleState | PersonState] = {**scene.vehicles, **scene.people}
    for who, state in sorted(users.items()):
        colour = paint.OTHERS if isinstance(state, VehicleState) else paint.ON_FOOT
        if isinstance(state, VehicleState):
            colour = paint.PAINT.get(state.colour or "", colour)
        name = "us" if who == EGO else str(who)
        yield _box(state, css(paint.OURS if who == EGO else colour))
        x, y = state.position
        yield (
            f'<text x="{x:.1f}" y="{-y - state.width:.1f}" fill="#15181c" stroke="{GROUND}"'
            f' stroke-width="0.25em" paint-order="stroke">{escape(name)}'
            f"<title>{escape(f'{state.kind} {name}, {state.speed * 3.6:.0f} km/h')}</title></text>"
        )


def _box(state: VehicleState | PersonState, colour: str) -> str:
    x, y = state.position
    turned = -math.degrees(state.heading)
    return (
        f'<rect x="{-state.length:.2f}" y="{-state.width / 2.0:.2f}" width="{state.length:.2f}"'
        f' height="{state.width:.2f}" rx="0.4" fill="{colour}" stroke="#15181c" stroke-width="0.2"'
        f' transform="translate({x:.2f} {-y:.2f}) rotate({turned:.1f})"/>'
    )


def _polyline(
    line: Iterable[Point], colour: str, width: float, more: str = "", title: str = ""
) -> str:
    points = " ".join(f"{x:.1f},{-y:.1f}" for x, y in line)
    told = f"<title>{escape(title)}</title>" if title else ""
    stroke = "" if "stroke-width" in more else f' stroke-width="{width:.2f}"'
    return (
        f'<polyline points="{points}" fill="none" stroke="{colour}"{stroke}'
        f' stroke-linejoin="round"{more}>{told}</polyline>'
    )
