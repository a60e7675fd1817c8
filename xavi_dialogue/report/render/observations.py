"""Sections on what was observed: who is involved, the timeline, maps, speeds, lights, priority."""

from dataclasses import dataclass

from planner.record.trace import SAMPLE_PERIOD
from sim.scene import EGO
from xavi_dialogue.report.content import Entry, Incident, Party
from xavi_dialogue.report.figures import Figure, Source
from xavi_dialogue.report.render.charts import Axes, Line, chart
from xavi_dialogue.report.render.colours import REST, colour, stroke
from xavi_dialogue.report.render.drawings import strip
from xavi_dialogue.report.render.markup import EMPTY, Markup, joined, table, tag
from xavi_dialogue.report.render.notes import KMH, TIE, Notes, told
from xavi_dialogue.report.render.words import (
    Names,
    action_words,
    capital,
    chain,
    goal,
    phrase,
    restraint,
    seconds,
)

NOWHERE = Source("ride", "")  # of figures whose source stands elsewhere
BROAD = 7  # columns of speeds and distances in one table
LISTED = 20  # bystanders that are listed


@dataclass(frozen=True, slots=True)
class Page:
    """A report on its way to HTML."""

    report: Incident
    names: Names
    notes: Notes

    @property
    def axes(self) -> Axes:
        """The time axis of all charts."""
        report = self.report
        decisions = tuple((row.number, row.time) for row in report.decisions)
        return Axes(report.since, report.until, report.moment.time, decisions)

    def by(self, time: float) -> str:
        """Return a time relative to the moment: "−2.0 s"."""
        by = time - self.report.moment.time
        return "±0 s" if abs(by) < 0.05 else f"{by:+.1f} s".replace("-", "\N{MINUS SIGN}")


def involved(page: Page) -> Markup:
    """Return who is involved."""
    report, names = page.report, page.names
    rows = [
        (
            names.shown(one.vehicle),
            "; ".join(phrase("role", role) for role in one.roles),
            joined((_size(one), page.notes.ref(one.source))),
            page.notes.figure(one.nearest),
            "–" if one.nearest_at is None else seconds(one.nearest_at).replace(" ", TIE),
        )
        for one in report.involved
    ]
    known = (
        table(("Road user", "Role", "Size", "Least distance, by samples or contact", "at"), rows)
        if rows
        else tag("p", "No other road user is involved.")
    )
    others = ", ".join(map(str, report.bystanders[:LISTED]))
    if len(report.bystanders) > LISTED:
        others += f" and {len(report.bystanders) - LISTED} more"
    rest = tag("p", f"Also in view in these seconds: {others}.", class_="muted") if others else None
    own = tag("p", names.shown(EGO), ", number 0, is the car that made the record.")
    return joined((own, known, rest))


def _size(one: Party) -> str:
    if one.length is None or one.width is None:
        return "not seen"
    return f"{one.length:.1f} × {one.width:.1f} m"


def timeline(page: Page) -> Markup:
    """Return the events in order of time."""
    rows = (
        (
            seconds(one.time),
            page.by(one.time),
            joined((_entry(page, one), _entry_source(page, one))),
        )
        for one in page.report.timeline
    )
    text = (
        "Times at which somebody begins or ends to brake, speed up or turn are found in the "
        f"motion, whose samples are {SAMPLE_PERIOD:g} s apart, and are good to half a second. "
        "What kept this car from driving faster as these seconds begin stands first."
    )
    return joined((tag("p", text), table(("Time", "Relative", "What happened"), rows, "long")))


def _entry_source(page: Page, one: Entry) -> Markup | None:
    """Return the number of an entry's note, unless a figure in it has the same."""
    shown = one.kind in ("belief", "peak", "light") and one.figures
    same = any(figure.source == one.source for figure in one.figures.values())
    return None if shown and same else page.notes.ref(one.source)


def _entry(page: Page, one: Entry) -> Markup:
    names, figures = page.names, one.figures
    whom = names.of(one.other) if one.other is not None else "somebody"
    match one.kind:
        case "decision":
            return joined((tag("b", f"Decision {one.source.number}: "), f"{chain(one.plan)}."))
        case "light":
            here = figures.get("distance")
            state = phrase("light", one.what)
            if here is None:
                return joined((f"The light ahead turns {state}.",))
            far = page.notes.figure(here)
            return joined(("The light ahead, in ", far, f", shows {state}."))
        case "belief":
            chance = page.notes.figure(figures["probability"])
            what = f"{capital(names.of(one.vehicle))} most likely {_goal(one)}"
            return joined(("Belief: ", what, ", ", chance, "."))
        case "peak":
            value = page.notes.figure(next(iter(figures.values())))
            text = phrase("peak", one.what).format("", whom)
            return joined((tag("b", text), ": ", value, "."))
        case "restrained":
            why = restraint(one, whom).rstrip(",")
            return joined((f"From now on, this keeps this car from driving faster: {why}.",))
        case "episode":
            return _episode(page, one, whom)
    text = phrase("event", one.kind)
    doing = action_words(one.what) if one.what else ""  # type: ignore[arg-type]
    return joined((tag("b", text.format(doing, whom)),))


def _goal(one: Entry) -> str:
    return goal(one.what, one.place)  # type: ignore[arg-type]


def _episode(page: Page, one: Entry, whom: str) -> Markup:
    """Return what a road user was seen to do."""
    who = capital(page.names.of(one.vehicle))
    deed = phrase("deed", one.what).format(whom)
    parts: list[Markup | str] = [f"{who} {deed}"]
    known = one.figures
    if "from" in known and "to" in known and one.what not in ("stop",):
        parts.append(f", from {told(known['from'])} to {told(known['to'])}")
    if "peak" in known:
        parts.append(f", up to {told(known['peak'])}")
    if one.until is not None and one.until - one.time > 0.15:
        parts.append(f", until {one.until:.1f} s")
    return joined((*parts, "."))


def maps(page: Page) -> Markup:
    """Return the strip of maps."""
    shown, report = page.report.map, page.report
    text = "Boxes are true to scale, with their front in white; thin lines are the ways driven."
    known = [tag("span", page.names.shown(v), class_="key") for v in (EGO, *page.names.order)]
    rest = tag("span", class_="swatch", style=f"background:{REST}")
    grey = tag("span", rest, "anybody else", class_="key")
    legend = tag("p", "Colours stand for road users, as in the charts of speeds and "
                 "distances; they are not those of the vehicles: ", *known, grey)  # fmt: skip
    if not shown.roads:
        text += " The roads are not at hand."
    source = page.notes.ref(shown.frames[0].source) if shown.frames else EMPTY
    return joined(
        (
            tag("p", text, f" North is up. Roads: network {report.hashes.network}.", source),
            legend,
            strip(shown, report.moment.time, page.names.order),
        )
    )


def motions(page: Page) -> Markup:
    """Return speeds, accelerations and gaps over time, and a table of them."""
    report, names, axes = page.report, page.names, page.axes
    order = names.order
    speeds = [
        Line(
            names.short(one.vehicle),
            tuple((t, v * KMH) for t, v in zip(one.time, one.speed, strict=True)),
            colour(one.vehicle, order),
            stroke(one.vehicle, order),
        )
        for one in report.motions
    ]
    rates = [
        Line(
            names.short(one.vehicle),
            tuple(zip(one.time, one.rate, strict=True)),
            colour(one.vehicle, order),
            stroke(one.vehicle, order),
        )
        for one in report.motions
    ]
    gaps = [
        Line(
            names.short(one.vehicle),
            tuple(zip(one.time, one.distance, strict=True)),
            colour(one.vehicle, order),
            stroke(one.vehicle, order),
        )
        for one in report.gaps
    ]
    legend = tag("p", "Dashed line: the moment. Triangles: decisions, with their numbers.")
    return joined(
        (
            legend,
            chart(axes, "Speed [km/h]", speeds),
            chart(axes, "Change of speed [m/s²]: below zero, it slows", rates, low=None),
            chart(axes, "Distance from this car, body to body [m]", gaps) if gaps else None,
            _motion_table(page),
        )
    )


def _motion_table(page: Page) -> Markup:
    """Return speeds and gaps at whole seconds from the moment."""
    report, names, notes = page.report, page.names, page.notes
    speeds = [
        joined((f"Speed of {names.short(one.vehicle)}", notes.ref(one.source)))
        for one in report.motions
    ]
    gaps = [
        joined((f"Distance of {names.short(one.vehicle)}", notes.ref(one.source)))
        for one in report.gaps
    ]
    rows: list[tuple[str, list[str], list[str]]] = []
    moment = report.moment.time
    for by in range(-7, 8):
        time = moment + by
        if not report.since - 1e-6 <= time <= report.until + 1e-6:
            continue
        driven = [(_at(time, one.time, one.speed), "m/s") for one in report.motions]
        apart = [(_at(time, one.time, one.distance), "m") for one in report.gaps]
        rows.append((f"{time:.1f} s ({page.by(time)})", _cells(driven), _cells(apart)))
    text = "Values are those of the nearest sample, up to 0.15 s away."
    if len(speeds) + len(gaps) <= BROAD:
        whole = [([at, *a, *b]) for at, a, b in rows]
        shown = [table(["Time", *speeds, *gaps], whole, "long")]
    else:
        shown = [
            table(["Time", *speeds], [[at, *a] for at, a, _ in rows], "long"),
            table(["Time", *gaps], [[at, *b] for at, _, b in rows], "long"),
        ]
    return joined((tag("p", text), tag("div", *shown, class_="wide")))


def _cells(values: list[tuple[float | None, str]]) -> list[str]:
    """Return values with their units; a dash where there is none."""
    return ["–" if value is None else told(Figure(value, unit, NOWHERE)) for value, unit in values]


def _at(time: float, times: tuple[float, ...], values: tuple[float, ...]) -> float | None:
    """Return the value of the sample nearest to a time [s], if it is within 0.15 s."""
    near = min(range(len(times)), key=lambda k: abs(times[k] - time), default=None)
    return None if near is None or abs(times[near] - time) > 0.15 else values[near]
