"""Happenings: when something happened, and what somebody does, did or will do."""

from collections.abc import Sequence
from typing import Literal

from msgspec.structs import replace

from xavi_dialogue.domain.answers import (
    Answer,
    Happenings,
    Identified,
    Measures,
    NotRecorded,
    Verdict,
)
from xavi_dialogue.domain.facts import Episode, Fact, Look, Measure
from xavi_dialogue.domain.meaning import Doing, When, Whither
from xavi_dialogue.domain.terms import (
    At,
    Believed,
    Ego,
    Event,
    Happens,
    Not,
    Proposition,
    Related,
    Vehicle,
    Vehicles,
    WholeRide,
)
from xavi_dialogue.explain.answers.events.accounts import TOLD, select, summary, taking_part
from xavi_dialogue.explain.answers.events.acting import activity
from xavi_dialogue.explain.answers.events.beliefs import since_when
from xavi_dialogue.explain.answers.expectations.forecast import forecast
from xavi_dialogue.explain.answers.expectations.foreseen import besides, chance
from xavi_dialogue.explain.answers.expectations.plans import covers, foreseen, plan_ahead
from xavi_dialogue.explain.answers.measuring.durations import stands
from xavi_dialogue.explain.answers.propositions.weighing import weigh
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.findings import known as valued
from xavi_dialogue.explain.answers.reference.moments import SHORT, Window, instant, is_ahead, window
from xavi_dialogue.explain.answers.reference.naming import (
    first_look,
    is_us,
    number,
    somebodies,
)
from xavi_dialogue.explain.answers.reference.occasions import (
    PLAIN,
    did_not_happen,
    duration,
    occasion,
)
from xavi_dialogue.explain.answers.reference.reading import numbers_in
from xavi_dialogue.explain.answers.ride.onward import course, leaves_when, turning_ahead
from xavi_dialogue.explain.answers.ride.places import time_to_go, whither
from xavi_dialogue.explain.answers.ride.reaching import reaching
from xavi_dialogue.explain.causes.vehicles.announced import announced

SURE = 0.95  # minimum share of the rollouts that come to a turn, for its time to be stated
LIKELY = 0.5  # minimum probability of what is going to happen


def when(question: When, asked: Asked) -> Answer:
    """Return when something happened, or is going to.

    Raises:
        Unanswered: it did not happen and is not going to.
    """
    of = question.of.content if isinstance(question.of, Not) else question.of
    if not isinstance(of, Happens):
        return _first_held(of, asked)
    event = of.event
    soon = reaching(asked, event) if is_ahead(asked, event.time, event.tense) else None
    if soon is not None:
        return soon
    if event.action == "arrive" and is_us(event.actor) and not asked.ride.arrived:
        arrival = asked.world.measure("arrival-time", Ego(), asked.now)
        return Measures(valued(arrival) or (time_to_go(asked, asked.now),))
    leaving = leaves_when(asked, event)
    if leaving is not None:
        return leaving
    ahead = is_ahead(asked, event.time, event.tense)
    if ahead and event.action == "move" and event.object is None and is_us(event.actor):
        event = replace(event, action="go")
        of = Happens(event)
    if ahead and event.action == "go" and _rolls(asked, event) and not _foreseen(asked, event):
        return activity(asked, Ego(), asked.now)
    under_way = occasion(asked, replace(event, tense="present")) if ahead else None
    if ahead and under_way is None:
        return _to_come(asked, of)
    found = under_way or occasion(asked, event) or _entered(asked, event)
    if found is None:
        raise did_not_happen(asked, event, planned=_planned(asked, event))
    form: Literal["how-long", "when"] = "how-long" if question.edge == "end" else "when"
    return Happenings(
        form, (found,), found.actor, looks=taking_part(asked, (found,)), asked=event,
        measures=_until(asked, found) if question.edge == "end" else (),
    )  # fmt: skip


def _foreseen(asked: Asked, event: Event) -> bool:
    found = foreseen(asked, event)
    return found is not None and found.share >= LIKELY


def _rolls(asked: Asked, event: Event) -> bool:
    """Check whether we, who are asked when we go, do not stand at all."""
    return event.object is None and is_us(event.actor) and not stands(asked)


def _entered(asked: Asked, event: Event) -> Episode | None:
    """Return our way through the junction that we entered, or drove into, last."""
    if event.action != "enter" or not is_us(event.actor) or event.tense == "future":
        return None
    about = window(asked, event.time, event.tense)
    ways = asked.world.episodes(Ego(), ("exit-left", "exit-right", "exit-straight"), end=about.end)
    return ways[-1] if ways else None


def doing(question: Doing, asked: Asked) -> Answer:
    """Return what somebody is doing, did at a time, or will do next; or what happened.

    Raises:
        Unanswered: it is unknown, or not in the record.
    """
    if question.actor is None and is_ahead(asked, question.time, question.tense):
        return plan_ahead(asked)
    if question.actor is None:
        about = window(asked, question.time, question.tense)
        if question.tense == "present" and about.end >= asked.now:
            return activity(asked, Ego(), asked.now)
        return summary(asked, None, about, ride=isinstance(question.time, WholeRide))
    ahead = is_ahead(asked, question.time, question.tense)
    at = asked.now if ahead else instant(asked, question.time, question.tense)
    who = somebodies(asked, question.actor, at)
    if not who:
        raise Unanswered(NotRecorded("not-recorded", question.actor, about="doing"))
    if len(who) > 1:
        foretold = forecast(asked, who) if ahead else None
        return foretold or _several(asked, who, at)
    if ahead and is_us(who[0]):
        return plan_ahead(asked)
    if ahead and isinstance(who[0], Vehicle) and question.tense != "present":
        return intent(asked, who[0].number)
    about = window(asked, question.time, question.tense)
    if question.tense in ("past", "perfect") and not about.instant and not ahead:
        return _did(asked, who[0], about)
    return activity(asked, who[0], at)


def intent(asked: Asked, vehicle: int) -> Answer:
    """Return what another vehicle is about to do: by its indicator, else by our expectation."""
    lit = [
        e
        for e in asked.world.episodes(actor=Vehicle(vehicle), actions=("signal",))
        if e.begin <= asked.now and e.end is None
    ]
    told = announced(asked.ride, asked.world, vehicle, lit[-1], asked.now) if lit else None
    return told or whither(Whither(Vehicle(vehicle)), asked)


def _to_come(asked: Asked, of: Happens) -> Answer:
    """Return when something is going to happen: by our plan; for others, how probable it is."""
    event = of.event
    if is_us(event.actor):
        turn = turning_ahead(asked, event)
        found = covers(asked, turn.distance) if turn is not None else foreseen(asked, event)
        if turn is not None and (found is None or found.share < SURE):
            return course(asked, "way", (turn,))
        if found is None or found.share < LIKELY:
            past = occasion(asked, replace(event, tense="past"))
            raise (
                did_not_happen(asked, event)
                if past is None
                else did_not_happen(asked, replace(event, tense="future"))
            )
        time = Measure(
            "time", Ego(), asked.now, value=max(found.moment, asked.now),
            low=max(found.low, asked.now), high=max(found.high, asked.now),
        )  # fmt: skip
        return Verdict(of, True, (time,), probability=found.share, either=True)
    vehicle = number(event.actor)
    share = chance(asked, event, asked.now)
    belief = None if vehicle is None else asked.world.belief(vehicle, asked.now)
    if belief is not None:
        belief = replace(belief, expectations=besides(belief, event))
    return Verdict(
        of, None, gap="in-future", believed=() if belief is None else (belief,), probability=share
    )


def _planned(asked: Asked, event: Event) -> float | None:
    """Return when [s] our plan does an event that has not happened; None if it does not."""
    found = foreseen(asked, event) if is_us(event.actor) and asked.past is None else None
    return None if found is None or found.share < LIKELY else max(found.moment, asked.now)


def _first_held(of: Proposition, asked: Asked) -> Answer:
    """Return when a state or relation first held, among the times of our decisions."""
    match of:
        case Believed(content=Happens(event=event)) if number(event.actor) is not None:
            return since_when(asked, event)
        case Related(relation="can-see", thing=thing, to=Vehicle() | Vehicles() as seen) if is_us(
            thing
        ):
            known = (first_look(asked, one, asked.world.begin) for one in numbers_in(seen))
            looks = [look for look in known if look is not None]
            if looks:  # of several, the first of them
                first = min(looks, key=lambda look: look.time)
                sight = Episode(Ego(), "see", first.time, first.time, Vehicle(first.vehicle))
                return Happenings("when", (sight,), Ego(), looks=(first,))
    about = window(asked)
    for trace in asked.ride.traces:
        at = trace.sim_time
        if not about.begin - SHORT <= at <= about.end:
            continue
        moment = replace(of, time=At(at)) if hasattr(of, "time") else of
        found = weigh(moment, asked)
        if found.holds:
            return Verdict(moment, True, found.facts)
    return Verdict(of, False)


def _until(asked: Asked, episode: Episode) -> tuple[Measure, ...]:
    """Return when an episode ended, or how long it still lasts."""
    return (
        Measure(
            "duration", episode.actor, episode.begin, value=round(duration(asked, episode), 2),
            until=episode.end, at_least=episode.end is None,
        ),
    )  # fmt: skip


def _did(asked: Asked, actor: Ego | Vehicle, about: Window) -> Answer:
    """Return what somebody did in a stretch of the ride."""
    begin, end = max(about.begin, asked.world.begin), min(about.end, asked.now)
    told = [e for e in asked.world.account(begin, end) if e.actor == actor]
    told = told or list(asked.world.episodes(actor=actor, begin=begin, end=end))
    chosen = select(asked, [e for e in told if e.action not in PLAIN] or told, TOLD)
    looks = taking_part(asked, chosen)
    if not looks and isinstance(actor, Vehicle):
        look = first_look(asked, actor.number, begin)
        looks = () if look is None else (look,)
    return Happenings("doing", chosen, actor, begin, end, looks=looks)


def _several(asked: Asked, who: Sequence[Ego | Vehicle], at: float) -> Answer:
    """Return what several are doing: how each looks, its speed and its actions."""
    looks: list[Look] = []
    facts: list[Fact] = []
    for actor in who:
        found = activity(asked, actor, at)
        looks += [] if found.look is None else [found.look]
        facts += [*valued(asked.world.measure("speed", actor, at)), *found.doing[-1:]]
    return Identified(tuple(looks), facts=tuple(facts))
