"""Halting: whether we stop for somebody or drive on, if a question names both."""

from msgspec.structs import replace

from xavi_dialogue.domain.answers import Verdict
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.meaning import Why
from xavi_dialogue.domain.terms import Between, Both, Ego, Event, Happens, Next, Not, Now, Unsaid
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.expectations.plans import MOVES, foreseen, plan_ahead, steps
from xavi_dialogue.explain.answers.expectations.slowing import slowing
from xavi_dialogue.explain.answers.propositions import reasons
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.findings import EXPECTED, Finding
from xavi_dialogue.explain.answers.reference.naming import is_us, number
from xavi_dialogue.explain.answers.reference.occasions import occasion
from xavi_dialogue.explain.facts.looks import STILL

HALTS = frozenset[ActionName](("stop", "wait", "stand", "give-way", "let-go"))
SLOWS = frozenset[ActionName](("brake", "slow-down"))
GOES = frozenset[ActionName](("enter", "go", "move", "cross", "merge", "pull-out", "pass", "turn",
                              "exit-left", "exit-right", "exit-straight"))  # fmt: skip


def to_come(asked: Asked, event: Event) -> Verdict | None:
    """Return when we are going to do something by our plan; None if that is unlikely."""
    found = foreseen(asked, event)
    if found is None or found.share < EXPECTED:
        return None
    now = asked.now
    time = Measure(
        "time", Ego(), now, value=max(found.moment, now), low=max(found.low, now),
        high=max(found.high, now),
    )  # fmt: skip
    of = Happens(replace(event, tense="future", modal=None, time=Unsaid(), manner=()))
    return Verdict(of, True, (time,), probability=found.share, either=True)


def _under_way(asked: Asked, event: Event) -> Verdict | None:
    """Return that we are doing something already; None if we are not."""
    present = replace(event, tense="present", modal=None)
    found = occasion(asked, present)
    return None if found is None else Verdict(Happens(present), True, (found,), either=True)


def stop_or_go(of: Both, asked: Asked) -> Finding | None:
    """Return whether we stop, slow down without stopping, or go; None if that is not asked."""
    events = [part.event for part in of.contents if isinstance(part, Happens)]
    ahead = all(is_us(e.actor) and e.tense in ("present", "future") for e in events)
    meant = all(e.action in HALTS | GOES | SLOWS for e in events)
    if len(events) < len(of.contents) or not ahead or not meant:
        return None
    future = all(e.tense == "future" for e in events)  # "or go before it?" names no past
    said = asked.past is not None and asked.past.said and not future
    if said or not all(isinstance(e.time, Unsaid | Now | Next | Between) for e in events):
        return None
    events = [replace(e, time=Unsaid()) for e in events]
    halts = [e for e in events if e.action in HALTS]
    goes = [e for e in events if e.action in GOES | SLOWS]
    done = asked.world.episodes(actor=Ego(), actions=tuple(HALTS | SLOWS))
    held = [e for e in done if e.end is None]
    if len({e.action for e in events}) == 1 and events[0].action in HALTS | SLOWS:
        return Finding(None, answer=reasons.why(Why(Happens(_deed(events[0].action))), asked))
    if held and halts and not (future and held[-1].action in SLOWS):
        return Finding(None, answer=reasons.why(Why(Happens(_deed(held[-1].action))), asked))
    if not halts or not goes:
        return _moving(asked, events)
    named = slowing(asked, halts[0]) if halts[0].object is not None or held else None
    if named is not None:
        return Finding(None, answer=named)
    stops = to_come(asked, replace(halts[0], action="stop", object=None))
    slows = next((to_come(asked, e) for e in goes if e.action in SLOWS), None)
    told = stops or slows or _under_way(asked, goes[0]) or to_come(asked, goes[0])
    if told is not None and slows is None and stops is None and _drives(asked):
        return Finding(None, answer=Verdict(Not(Happens(halts[0])), True, either=True))
    return None if told is None else Finding(None, answer=told)


def _drives(asked: Asked) -> bool:
    """Check whether we drive already, so that we need not set off."""
    speed = asked.world.measure("speed", Ego(), asked.now).value
    return speed is not None and speed > STILL


def _moving(asked: Asked, events: list[Event]) -> Finding | None:
    """Return when we move out or in next, if the question is before or behind whom we do."""
    near = [e for e in events if e.where is not None or number(e.object) is not None]
    if not near or any(e.action in SLOWS for e in events):
        return None
    begins = (to_come(asked, Event(action)) for action, _ in steps(asked) if action in MOVES)
    told = next((found for found in begins if found is not None), None)
    return Finding(None, answer=told or plan_ahead(asked))


def _deed(action: ActionName) -> Event:
    """Return what we are doing as an event."""
    return Event(action, tense="present")
