"""The section on what traffic lights showed, and who goes first at the next junction."""

from planner.record.places import First
from xavi_dialogue.explain.causes.plans.avoidance import SELDOM
from xavi_dialogue.report.content import LightSpan
from xavi_dialogue.report.figures import Figure
from xavi_dialogue.report.render.charts import bands
from xavi_dialogue.report.render.colours import LIGHTS
from xavi_dialogue.report.render.markup import Markup, joined, table, tag
from xavi_dialogue.report.render.notes import percent
from xavi_dialogue.report.render.observations import Page
from xavi_dialogue.report.render.words import phrase, seconds


def lights(page: Page) -> Markup:
    """Return what the traffic lights on the way showed, and who goes first."""
    report = page.report
    parts: list[Markup] = [tag("h3", "Traffic lights on this car's way")]
    if report.lights:
        parts += [_bands(page), _light_table(page)]
    else:
        parts.append(tag("p", "There was none in view on this car's way in these seconds."))
    parts.append(tag("h3", "Right of way at the next junction"))
    rows = [
        (
            f"{one.time:.1f} s",
            f"{one.decision}",
            "–" if one.rule is None else f"this car {phrase('rule', one.rule)}",
            page.notes.figure(one.distance),
            joined((_first(page, one.first), page.notes.ref(one.source))),
            _crossing(page, one.crossing),
        )
        for one in report.precedence
    ]
    head = (
        "From", "Decision", "Rule for this car among those on lanes", "Distance",
        "Who goes first, of those on lanes that cross or join this car's",
        "People who may cross, and how probably",
    )  # fmt: skip
    text = (
        "As the roads have it, by the decisions at which it changed. People on foot have no lane: "
        "the last column has those whom a decision believed to cross this car's way with more than "
        f"{percent(SELDOM)}. Plans of this car let people pass."
    )
    if report.lights:
        text += " Traffic lights are left out here: at red, this car waits whoever goes first."
    none = tag("p", "The record has no junction ahead in these seconds.")
    parts += [tag("p", text), table(head, rows, "long")] if rows else [none]
    return joined(parts)


def _first(page: Page, first: dict[int, First]) -> Markup:
    """Return who goes first, those involved in bold."""
    if not first:
        return joined(("nobody on a lane",))
    told_of = []
    for who in ("vehicle", "depends", "ego"):
        those = [vehicle for vehicle in first if first[vehicle] == who]
        names = [
            tag("b", page.names.short(v)) if v in page.names.order else f"{v}"
            for v in sorted(those, key=lambda v: (v not in page.names.order, v))
        ]
        if names:
            told_of.append(joined((f"{phrase('first', who)}: ", joined(names, ", "))))
    return joined(told_of, "; ")


def _crossing(page: Page, crossing: dict[int, Figure]) -> Markup:
    """Return who may cross the car's way on foot, likeliest first."""
    ranked = sorted(crossing.items(), key=lambda item: (-item[1].value, item[0]))
    told_of = [
        joined((page.names.short(vehicle), " ", page.notes.figure(chance)))
        for vehicle, chance in ranked
    ]
    return joined(told_of, ", ") if told_of else joined(("nobody",))


def _bands(page: Page) -> Markup:
    rows: dict[str, list[tuple[float, float, str, str]]] = {}
    for one in page.report.lights:
        fill = LIGHTS.get(one.state, "#888")
        rows.setdefault(_light_name(one), []).append(
            (one.since, one.until, fill, phrase("light", one.state).split(",")[0])
        )
    return bands(page.axes, "Light on this car's way", tuple(rows.items()))


def _light_table(page: Page) -> Markup:
    rows = (
        (
            f"{seconds(one.since)} to {seconds(one.until)}",
            _light_name(one),
            phrase("light", one.state),
            "seen to change" if one.change_seen else "came into view so",
            page.notes.figure(one.distance),
        )
        for one in page.report.lights
    )
    return table(("Seen", "Light", "State", "Begin", "Distance, at the first decision here"), rows)


def _light_name(one: LightSpan) -> str:
    return f"{one.controller}, place {one.place}"
