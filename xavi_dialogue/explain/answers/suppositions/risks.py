"""Risks: who an option of a decision would have collided with in its rollouts."""

import dataclasses
from collections import Counter
from collections.abc import Sequence

from msgspec.structs import replace

from planner.record.trace import Action, PlanTrace, Rollout
from xavi_dialogue.causal.model import plan_of
from xavi_dialogue.domain.answers import (
    Answer,
    Identified,
    Measures,
    Options,
    SupposedOfOther,
    SupposedOfUs,
)
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.facts import OptionValue
from xavi_dialogue.domain.meaning import (
    HowLong,
    HowMuch,
    HowSure,
    WhatIf,
    When,
    Where,
    Whether,
    Which,
)
from xavi_dialogue.domain.terms import (
    At,
    Ego,
    Event,
    Exists,
    Feature,
    Happens,
    Is,
    Measured,
    Nobody,
    Not,
    Now,
    Proposition,
    Road,
    Unsaid,
    Vehicle,
    Vehicles,
)
from xavi_dialogue.explain.answers.measuring.closeness import closeness
from xavi_dialogue.explain.answers.measuring.durations import LITTLE, total_cost
from xavi_dialogue.explain.answers.reasons import knowing
from xavi_dialogue.explain.answers.reasons.against import EARLIER
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.moments import Window
from xavi_dialogue.explain.answers.reference.naming import first_look
from xavi_dialogue.explain.answers.reference.reading import event_of, unwrapped
from xavi_dialogue.explain.answers.suppositions import supposing
from xavi_dialogue.explain.answers.suppositions.undone import is_present
from xavi_dialogue.explain.causes.driving.stated_reasons import BARRED
from xavi_dialogue.explain.causes.plans.options import GOING, ONWARD, of_trace, situations
from xavi_dialogue.explain.causes.plans.premise import Premise
from xavi_dialogue.explain.causes.plans.terms import RISK
from xavi_dialogue.explain.causes.vehicles.actions import names_of
from xavi_dialogue.explain.history.restraints import restraints


def what_if(question: WhatIf, asked: Asked) -> Answer:
    """Return the consequences of something, or who an option would have met.

    Raises:
        Unanswered: it cannot be supposed; or it is what was; or rollouts are needed.
    """
    question = _standing(question)
    if _is_of_now(question):  # that is not the time of what is supposed
        asked = dataclasses.replace(asked, span=_hindered(question.supposed, asked))
    if question.then == HowSure():
        return _likelihood(question, asked)
    found = _met_by(question, asked) or supposing.what_if(question, asked)
    return _cost_of(found, question, asked) or found


def _cost_of(found: Answer, question: WhatIf, asked: Asked) -> Answer | None:
    """Return what vehicles cost us, where the plan without them does not tell how much sooner.

    The decision may have been made before it was seen that they would be in the way.
    """
    if not isinstance(found, SupposedOfOther) or found.form not in ("arrival", "quicker"):
        return None
    of, negated = unwrapped(question.supposed)
    gone = negated and isinstance(of, Exists)
    if not (gone or (found.past and isinstance(of, Happens))) or _gain(found) >= LITTLE:
        return None
    numbers = (found.vehicle, *found.others)
    whom = Vehicles(numbers) if found.others else Vehicle(found.vehicle)
    cost = total_cost(asked, whom, Window(asked.world.begin, asked.now))
    return Measures((cost,)) if (cost.value or 0.0) >= LITTLE else None


def _gain(found: SupposedOfOther) -> float:
    """Return how much sooner [s] we would have been there by the plan."""
    effects = () if found.contrast is None else found.contrast.effects
    return sum(-one.delta for one in effects if one.component == "time")


def _standing(question: WhatIf) -> WhatIf:
    """Take "if it had not moved" for standing still, and a free road for one with nobody else."""
    match question.supposed:
        case Not(Happens(Event("move" | "go", actor=Vehicle() | Vehicles()) as event)):
            event = replace(event, action="stand")
            return replace(question, supposed=Happens(event))
        case Is(state="free", thing=Road() | Feature(kind="way"), tense=tense, time=time):
            return replace(question, supposed=Exists(Nobody(), time, tense))
    return question


def _hindered(supposed: Proposition, asked: Asked) -> Span | None:
    """Return when a vehicle that is supposed to have done something else last held us up."""
    of = unwrapped(supposed)[0]
    event = event_of(of)
    whom = of.thing if isinstance(of, Exists) else None if event is None else event.actor
    other = whom.number if isinstance(whom, Vehicle) else None
    held = [one for one in restraints(asked.ride) if one.restraint.vehicle == other]
    last = held[-1] if other is not None and held else None
    return None if last is None else Span(last.begin, min(last.end, asked.now), said=False)


def _is_of_now(question: WhatIf) -> bool:
    """Check whether something else in the past is supposed, and asked where that leaves us now."""
    match question.supposed:
        case Happens(Event(tense="past" | "perfect", time=Unsaid())):
            pass
        case Not(Happens(Event(tense="past" | "perfect", time=Unsaid()))):
            pass
        case Not(Exists(Vehicle())):
            pass
        case _:
            return False
    match question.then:
        case Where(of=Ego(), time=Now() | At()) | Whether(that=Happens(Event("arrive", Ego()))):
            return True
        case When() | HowLong() | HowMuch(of=Measured(attribute="delay" | "time" | "duration")):
            return True
    return False


def _likelihood(question: WhatIf, asked: Asked) -> Answer:
    """Return how likely that is which an option would lead to, else how sure the choice is.

    Raises:
        Unanswered: it cannot be supposed; or it is what was; or rollouts are needed.
    """
    crash = HowSure(Happens(Event("collide", modal="would")))
    found = supposing.what_if(replace(question, then=crash), asked)
    if not isinstance(found, SupposedOfUs) or found.done is not None:
        return found
    ends = found.contrast.outcome
    if found.contrast.collision >= RISK or ends is None:
        return found
    if ends.name != "done":
        return replace(found, form="likely")
    return knowing.how_sure(HowSure(question.supposed), asked)


def who(question: Which, scene: Asked) -> Answer:
    """Return who we may hit by our plan, else by the riskiest of the other options.

    Raises:
        Unanswered: no decision is recorded.
    """
    del question
    trace, ride = scene.ride.latest, scene.ride
    rows = [_struck(trace, option) for option in of_trace(ride, trace)]
    ours = [found for found in rows if found.options[0].chosen and found.hits]
    risky = [found for found in rows if found.options[0].collision >= RISK]
    worst = max(ours or risky, key=lambda found: found.options[0].collision, default=None)
    if worst is None:
        return closeness(scene, None, Window(scene.now, scene.now), "hit", past=False)
    return worst


def _met_by(question: WhatIf, asked: Asked) -> Options | Identified | None:
    """Return who an option would have hit, or been held up by; None if that is not asked."""
    match question:
        case WhatIf(
            supposed=Happens(event=Event(actor=Ego()) as event),
            then=Which(
                such=Happens(
                    event=Event(action="collide" as how, actor=Ego())
                    | Event(action="block" as how, object=Ego())
                )
            ),
        ):
            pass
        case _:
            return None
    found = _weighed(event, asked)
    if found is None:
        return None
    trace, option = found
    told = _struck(trace, option)
    if how == "block" and option.collision < RISK:
        held = Counter[int]()
        for rollout in _begun(trace, option):
            for stretch in rollout.held_up:
                lasts = (rollout.weight or 0.0) * (stretch.until - stretch.since)
                held.update({stretch.vehicle: lasts})
        first = next((vehicle for vehicle, lasts in held.most_common(1) if lasts > 0.0), None)
        look = None if first is None else first_look(asked, first, trace.sim_time)
        return Identified(() if look is None else (look,), none=look is None)
    return replace(told, earlier=trace is not asked.ride.latest)


def _weighed(event: Event, asked: Asked) -> tuple[PlanTrace, OptionValue] | None:
    """Find the option that an event names, and the last decision that weighed it, if lately."""
    at = asked.now if is_present(event, asked) else asked.moment
    at = event.time.at if isinstance(event.time, At) else at
    onward = event.action in ONWARD | GOING
    names = set(names_of(event)) | (ONWARD if onward else set())
    for trace in reversed(asked.ride.traces):
        if at - EARLIER <= trace.sim_time <= at:
            rows = of_trace(asked.ride, trace)
            named = [row for row in rows if row.action in names]
            if event.action == "go":  # as we do, or straight on
                named += [row for row in rows if row.chosen and row.action != "stop"]
            if named:
                return trace, max(named, key=lambda row: row.collision)
    return None


def _begun(trace: PlanTrace, option: OptionValue) -> list[Rollout]:
    """List the rollouts that begin with an option, each once."""
    begun = (r for r in trace.rollouts if r.actions and r.actions[0].action == option.action)
    return list({(r.samples, plan_of(r)): r for r in begun}.values())


def barred(asked: Asked, actions: Sequence[Action]) -> Options | None:
    """Return whom one of some actions would hit by the decision in force, if that is likely."""
    trace = asked.ride.latest
    rows = [row for row in of_trace(asked.ride, trace) if row.action in actions and not row.chosen]
    worst = max(rows, key=lambda row: row.collision, default=None)
    if worst is None or worst.collision < BARRED:
        return None
    return _struck(trace, worst)


def _struck(trace: PlanTrace, option: OptionValue) -> Options:
    """Return who an option collided with in its rollouts."""
    drives = _begun(trace, option)
    struck = Counter(r.collided_with for r in drives if r.collided_with is not None)
    if option.collided_with is None and struck:
        option = replace(option, collided_with=struck.most_common(1)[0][0])
    evidence, hits = situations(Premise(trace, None)), sum(struck.values())
    return Options((option,), trace.sim_time, evidence, risk=True, hits=hits, drives=len(drives))
