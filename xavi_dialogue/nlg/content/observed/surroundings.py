"""Surroundings: how many of each kind there are, and where the nearest of them are, in words."""

from collections import Counter

from xavi_dialogue.domain.facts import Episode, Fact, Look
from xavi_dialogue.domain.terms import Vehicle
from xavi_dialogue.nlg.content.clauses.plan import Plan
from xavi_dialogue.nlg.content.clauses.tenses import since
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.message import Message, message
from xavi_dialogue.nlg.surface.quantities import number
from xavi_dialogue.nlg.surface.referring import listed
from xavi_dialogue.nlg.surface.tables import word
from xavi_dialogue.nlg.surface.values import Number, Quantity, Range

NEAR = 4  # maximum of groups of which the place is told
SPREAD = 3.0  # [m] by which the nearest and the farthest of a group differ if both are told
REACH = 40.0  # [m] up to which somebody is near, but for the nearest


def telling(look: Look) -> bool:
    """Check whether a look tells a vehicle apart from others; people on foot have none such."""
    return look.kind != "pedestrian"


def is_past(look: Look, context: SpeechContext) -> bool:
    """Check whether a look is of a time that is over."""
    return context.now - look.time > since(context)


def plan_by_kind(looks: tuple[Look, ...], facts: tuple[Fact, ...], context: SpeechContext) -> Plan:
    """Plan many vehicles by colour and kind with the number of each, and who is near, and where."""
    heads = Counter(_head(look) for look in looks)
    counts = [number(Number(count, head)) for head, count in heads.items()]
    slots: dict[str, object] = {"rows": listed(counts)}
    if len(counts) > 1:
        slots["many"] = number(Number(len(looks), "other"))
    if is_past(looks[0], context) or any(not look.in_view for look in looks):
        return Plan((message("IDENTIFIED_KINDS", past=True, **slots),))
    rows, every = _places(looks, facts, alike=len(counts) == 1)
    if every and len(counts) == 1:
        slots |= {"places": rows, "one": len(rows) == 1, "crossing": _cross(looks, facts)}
        return Plan((message("IDENTIFIED_KINDS", **slots),))
    nearest = message("NEAR_ROWS", rows=rows, one=len(rows) == 1 and not rows[0].slots["many"])
    return Plan((message("IDENTIFIED_KINDS", **slots), nearest))


def _head(look: Look) -> str:
    kind = word("vehicles", "kind", look.kind)
    return f"{look.colour} {kind}" if look.colour and telling(look) else kind


def _places(
    looks: tuple[Look, ...], facts: tuple[Fact, ...], *, alike: bool
) -> tuple[tuple[Message, ...], bool]:
    """Return where the nearest are, those of one kind at one place together; if these are all."""
    met = _crossing(facts)
    together = _cross(looks, facts)
    groups: dict[tuple[str, str, bool], list[float]] = {}
    for look in sorted(looks, key=lambda look: look.distance):
        key = (_head(look), look.bearing, Vehicle(look.vehicle) in met)
        groups.setdefault(key, []).append(look.distance)
    near = [row for row in groups.items() if row[1][0] <= REACH][:NEAR] or [*groups.items()][:1]
    alone = alike and len(groups) == 1
    rows = tuple(
        message(
            "NEAR_ROW",
            number=None if alone else _number(len(far), head, alike=alike),
            place=word("vehicles", "place", bearing),
            far=_how_far(far),
            many=len(far) > 1,
            crossing=crossing and not together,
        )
        for (head, bearing, crossing), far in near
    )
    return rows, sum(len(far) for _, far in near) == len(looks)


def _how_far(far: list[float]) -> Quantity | Range:
    """Return the distance [m] of some, from the nearest to the farthest if they are apart."""
    nearest, farthest = Quantity(far[0], "m"), Quantity(far[-1], "m")
    return Range(nearest, farthest) if far[-1] - far[0] > SPREAD else nearest


def _number(count: int, head: str, *, alike: bool) -> str:
    return number(Number(count, head), "word" if alike else "plain")


def _crossing(facts: tuple[Fact, ...]) -> set[object]:
    return {f.actor for f in facts if isinstance(f, Episode) and f.action == "cross"}


def _cross(looks: tuple[Look, ...], facts: tuple[Fact, ...]) -> bool:
    """Check whether all of them are crossing our way."""
    return {Vehicle(look.vehicle) for look in looks} <= _crossing(facts)
