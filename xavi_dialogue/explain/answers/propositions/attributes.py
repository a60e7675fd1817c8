"""Attributes: values that need more than a look, such as waits, costs, places, right of way."""

from collections.abc import Callable, Mapping

from msgspec.structs import replace

from xavi_dialogue.domain.answers import (
    Answer,
    ChoiceReason,
    Evidence,
    Identified,
    Located,
    Measures,
    NeedRollout,
    NotRecorded,
    Options,
    SupposedOfOther,
)
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.meaning import HowMany, HowMuch, HowSure, WhatIf, Where, Whither, Why
from xavi_dialogue.domain.terms import (
    At,
    Ego,
    Event,
    Everyone,
    Exists,
    Happens,
    Junction,
    Measured,
    Not,
    Vehicle,
    Vehicles,
)
from xavi_dialogue.domain.vocabulary import ActionName, Attribute
from xavi_dialogue.explain.answers import causal
from xavi_dialogue.explain.answers.events.acting import activity
from xavi_dialogue.explain.answers.events.beliefs import how_sure
from xavi_dialogue.explain.answers.measuring.counting import how_many
from xavi_dialogue.explain.answers.measuring.durations import (
    LITTLE,
    cost_of,
    event_lasting,
    held_for,
    remaining_wait,
    stands,
    total_cost,
    waited,
)
from xavi_dialogue.explain.answers.measuring.simulations import options, simulations
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.moments import (
    SHORT,
    Window,
    instant,
    is_ahead,
    is_past,
    was_said,
    window,
)
from xavi_dialogue.explain.answers.reference.naming import (
    first_look,
    is_us,
    looks,
    number,
    somebodies,
)
from xavi_dialogue.explain.answers.reference.occasions import did_not_happen, occasion
from xavi_dialogue.explain.answers.ride.comfort import asked_stretch, comfort
from xavi_dialogue.explain.answers.ride.onward import which_way
from xavi_dialogue.explain.answers.ride.passages import cost_of_passage
from xavi_dialogue.explain.answers.ride.places import gone, locate, where, whither
from xavi_dialogue.explain.answers.ride.priority import right_of_way, where_rule_holds
from xavi_dialogue.explain.causes.plans.options import options_at

MOSTLY = 0.9  # minimum probability of arriving for a comparison of the times of two choices
GOING: frozenset[ActionName] = frozenset(("move", "go", "follow", "continue"))
#: Actions that are chosen; their cost follows from the alternatives.
CHOSEN: frozenset[ActionName] = frozenset(
    ("change-left", "change-right", "change-lane", "overtake")
)


def _waiting(of: Measured, asked: Asked) -> Answer:
    """Return how long somebody waited; while they wait, also how long that is expected to last."""
    about = window(asked, of.time, of.tense)
    if is_ahead(asked, of.time, of.tense) and stands(asked):
        return Measures((remaining_wait(asked),))
    return Measures((waited(asked, of.thing, of.to, about),))


def _options(of: Measured, asked: Asked) -> Answer:
    """Return how the options of a decision were valued."""
    at = instant(asked, of.time, of.tense)
    trace = asked.ride.at(at)
    known = options_at(asked.ride, at)
    if trace is None or not known:
        raise Unanswered(NotRecorded("not-recorded", about=of.attribute, since=at))
    return Options(known, trace.sim_time, Evidence("tree", traces=(trace.trace_id,)))


def _comfort(of: Measured, asked: Asked) -> Answer:
    return comfort(asked, of.event, asked_stretch(asked, of.event))


def _duration(of: Measured, asked: Asked) -> Answer:
    return event_lasting(of.event or Event("do", of.thing, time=of.time), asked)


def _delay(of: Measured, asked: Asked) -> Answer:
    """Return what a manoeuvre cost; for one that was chosen, by the causal explainers."""
    if of.event is not None and of.event.action == "overtake":
        of = replace(of, event=replace(of.event, side=None))
    if of.event is not None and (undone := _not_done(of, of.event, asked)) is not None:
        supposed = WhatIf(Happens(undone), HowMuch(Measured("delay")))
        if (suppose := causal.explainer(supposed, asked)) is not None:
            return suppose(supposed, asked)
    if of.event is not None and of.event.action in CHOSEN:
        why = Why(Happens(of.event))
        explainer = causal.explainer(why, asked)
        if explainer is not None:
            explained = explainer(why, asked)
            gained = _gained(explained)
            if gained is not None:
                return Measures((gained,))
            return _instead(of.event, asked) or explained
    event = of.event
    if event is not None and event.action in GOING and number(event.object) is not None:
        event = held_for(asked, event.object or Ego())  # "crawling behind the van"
    spent = cost_of_passage(asked, of.thing) if isinstance(of.thing, Junction) else None
    if spent is not None:
        return Measures((spent,))
    if event is None and isinstance(of.thing, Vehicle | Vehicles):
        cost = total_cost(asked, of.thing, _told_of(of, asked))
        costs_now = of.tense == "present" and (cost.value or 0.0) < LITTLE
        held = _without(of.thing, asked) if costs_now else None
        return Measures((cost,)) if held is None else held
    return Measures((cost_of(asked, event, window(asked, of.time)),))


def _without(other: Vehicle | Vehicles, asked: Asked) -> Answer | None:
    """Return what we would gain without somebody who has not slowed us yet; None: nothing.

    Raises:
        Unanswered: rollouts are needed.
    """
    supposed = WhatIf(Not(Exists(other)))
    suppose = causal.explainer(supposed, asked)
    try:
        found = None if suppose is None else suppose(supposed, asked)
    except Unanswered as unanswered:
        if isinstance(unanswered.result, NeedRollout):
            raise
        return None
    if not isinstance(found, SupposedOfOther) or found.contrast is None:
        return None
    saved = [-e.delta for e in found.contrast.effects if e.component == "time"]
    return found if any(gain >= LITTLE for gain in saved) else None


def _told_of(of: Measured, asked: Asked) -> Window:
    """Return the stretch in which a cost is asked for: the one named, else the ride."""
    about = window(asked, of.time)
    named = was_said(asked, of.time) and not about.instant
    return about if named else Window(asked.world.begin, asked.now)


def _not_done(of: Measured, event: Event, asked: Asked) -> Event | None:
    """Return a choice that we did not make, if the question is what it would have cost."""
    if not is_us(event.actor) or event.action not in (*CHOSEN, "stop"):
        return None
    at = of.time if isinstance(of.time, At) else event.time
    meant = replace(event, time=at, tense="past")
    if event.modal == "would":
        return meant  # "would stopping have cost us time?"
    if occasion(asked, replace(meant, time=event.time)) is not None:
        return None
    if event.action == "change-lane":
        raise did_not_happen(asked, meant)  # "how much time did we save?"
    return meant


def _instead(event: Event, asked: Asked) -> Answer | None:
    """Return the consequences of another choice, if no difference in time is known."""
    supposed = WhatIf(Not(Happens(event)), HowMuch(Measured("delay")))
    suppose = causal.explainer(supposed, asked)
    return None if suppose is None else suppose(supposed, asked)


def _gained(explained: Answer) -> Measure | None:
    """Return what a choice cost or saved in time against its alternative, if that is known.

    If the alternative would mostly not arrive, the few times of arrival mean nothing.
    """
    if not isinstance(explained, ChoiceReason) or explained.deed is None:
        return None
    ends = (explained.contrast.outcome, explained.contrast.fact_outcome)
    if any(end is None or end.name != "done" or end.probability < MOSTLY for end in ends):
        return None
    effects = explained.contrast.effects
    saved = next((e.delta for e in effects if e.component == "time"), None)
    deed = explained.deed
    return None if saved is None else Measure("delay", Ego(), deed.begin, value=-saved)


def _probability(of: Measured, asked: Asked) -> Answer:
    about = of.about
    if about is None and of.event is not None:
        about = Happens(of.event)
    return how_sure(HowSure(about, time=of.time), asked)


def _place(of: Measured, asked: Asked) -> Answer:
    return where(Where(of.thing if of.event is None else of.event, of.time), asked)


def _heading(of: Measured, asked: Asked) -> Answer:
    return whither(Whither(of.thing, of.time), asked)


def _name(of: Measured, asked: Asked) -> Answer:
    at = instant(asked, of.time, of.tense)
    if is_us(of.thing):
        return Measures((asked.world.measure("name", Ego(), at),))
    numbers = tuple(v.number for v in somebodies(asked, of.thing, at) if isinstance(v, Vehicle))
    return Identified(looks(asked, numbers, at), none=not numbers)


def _turn(of: Measured, asked: Asked) -> Answer:
    """Return which way somebody takes next; for others, where they are believed to go, or went."""
    other = number(of.thing)
    if other is not None and is_past(asked, of.time, of.tense) and not was_said(asked, of.time):
        return gone(asked, Vehicle(other))
    if other is not None or isinstance(of.thing, Vehicles):
        return whither(Whither(of.thing, of.time), asked)
    if of.tense == "present" and asked.past is None and _is_turning(asked):
        return activity(asked, Ego(), asked.now)
    return which_way(of, asked)


def _is_turning(asked: Asked) -> bool:
    """Check whether we are in a turn just now."""
    on = asked.world.episodes(Ego(), ("exit-left", "exit-right"), asked.now, asked.now)
    return any(e.end is None or e.end > asked.now for e in on)


def _speed_change(of: Measured, asked: Asked) -> Answer:
    """Return by how much the speed changed: over the time named, else in the latest change."""
    at = instant(asked, of.time, of.tense)
    who = (somebodies(asked, of.thing, at) or (Ego(),))[0]
    about = window(asked, of.time, of.tense)
    if of.event is not None or about.instant or not was_said(asked, of.time):
        changes: tuple[ActionName, ...] = ("slow-down", "brake", "speed-up", "stop")
        wanted = changes if of.event is None else (of.event.action, "brake", "stop")
        found = asked.world.episodes(actor=who, actions=wanted, end=about.end + SHORT)
        if not found:
            raise did_not_happen(asked, of.event or Event("slow-down", who))
        last = max(found, key=lambda e: e.begin)
        about = Window(last.begin, asked.now if last.end is None else last.end)
    first, after = (asked.world.measure("speed", who, t) for t in (about.begin, about.end))
    if first.value is None or after.value is None:
        return Measures((first if first.value is None else after,))
    change = Measure(
        "speed-change", who, about.begin, value=after.value - first.value, until=about.end,
        low=first.value, high=after.value,
    )  # fmt: skip
    return Measures((change,))


def _count(of: Measured, asked: Asked) -> Answer:
    return how_many(HowMany(of.thing if number(of.thing) is not None else Everyone()), asked)


def _right_of_way(of: Measured, asked: Asked) -> Answer:
    about = where_rule_holds(asked, window(asked, of.time, of.tense))
    return right_of_way(asked, of.thing, of.to, about)


def _origin(of: Measured, asked: Asked) -> Answer:
    """Return where somebody came from: by the record, else where it was first seen."""
    at, vehicle = instant(asked, of.time, of.tense), number(of.thing)
    if vehicle is None:
        return locate(asked, of.thing, asked.world.begin)
    known = asked.world.measure("origin", of.thing, at)
    if known.gap is None:
        return Measures((known,))
    first = first_look(asked, vehicle, asked.world.begin)
    return Located(of.thing, () if first is None else (first,), gap=known.gap)


SPECIAL: Mapping[Attribute, Callable[[Measured, Asked], Answer]] = {
    "waiting-time": _waiting,
    "speed-change": _speed_change,
    "value": _options,
    "cost": _options,
    "comfort": _comfort,
    "duration": _duration,
    "delay": _delay,
    "probability": _probability,
    "place": _place,
    "heading": _heading,
    "name": _name,
    "right-of-way": _right_of_way,
    "origin": _origin,
    "route": _heading,
    "turn": _turn,
    "exit-number": _turn,
    "count": _count,
    "simulations": simulations,
    "options": options,
}
