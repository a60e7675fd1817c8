"""Why the ego slowed down, stopped, gave way or sped up: who held it up under its own plan."""

from contextlib import suppress

from msgspec.structs import replace

from planner.events import Event
from planner.trace import PlanTrace
from sim.scene import EGO
from xavi_dialogue.causal.effects import SCALES
from xavi_dialogue.causal.holdups import hold_ups
from xavi_dialogue.causal.model import CausalModel, Intervention
from xavi_dialogue.explain.causes import LIKELY, expected_actions, holding_up
from xavi_dialogue.explain.contrast import against_best, arrival, evidence, factual, outcome
from xavi_dialogue.explain.deeds import did_not_happen
from xavi_dialogue.explain.explanation import Activity, Cause, Explanation, Mechanism
from xavi_dialogue.explain.motion import Motion, Sighting
from xavi_dialogue.explain.necessity import proven
from xavi_dialogue.explain.query import QueryAction, Tense
from xavi_dialogue.explain.ride import Ride, Unanswered, chose, decline
from xavi_dialogue.explain.when import pick

RECENT = 2.0  # [s] since when something is still going on
WORTH = 0.25  # of a component's scale: a difference that is a reason
BEFORE = 3.0  # [s] by which way may be given before the ego stands or slows for it
LEEWAY = 1.0  # [s] by which a hold-up may lie beside the change of speed that it explains


def explain_driving(ride: Ride, asked: tuple[QueryAction, ...], tense: Tense) -> Explanation:
    """Why the ego drove as described.

    Raises:
        Unanswered: it did not, or the record lacks the decision.
    """
    motion = ride.motion(EGO)
    seen, wait = _find(ride, motion, asked, tense)
    trace = _decision(ride, seen, wait)
    model = ride.model(trace)
    plan = factual(model, trace)
    # What freed the way is not recorded: only braking and waiting have causes among the others.
    braked = seen.action != "speed-up"
    window = (seen.start - LEEWAY, seen.end + LEEWAY)
    causes = holding_up(model, plan, window) if braked else ()
    done = () if seen.action in asked else (seen.action,)
    if braked and not causes and wait is None and chose(trace, "stop"):
        best = against_best(ride, trace)
        if _tells(best):
            return replace(best, moment=seen.start, done=done)
    given_way_to = None if wait is None else wait.vehicle
    causes = proven(ride, model, _first(model, causes, given_way_to), plan)
    found = replace(_explanation(ride, model, plan, causes, motion, seen), done=done)
    if wait is None and causes and causes[0].necessary is False:
        return replace(found, causes=(), cleared=causes[0].vehicle)
    return found


def _tells(found: Explanation) -> bool:
    """Whether a contrast tells of something that speaks for what was chosen."""
    worse = any(e.delta >= WORTH * SCALES[e.component] for e in found.effects)
    return worse or (found.outcome is not None and found.outcome.name != "done")


def decision_of(ride: Ride, asked: tuple[QueryAction, ...], tense: Tense) -> PlanTrace:
    """The decision under which the ego last drove as described.

    Raises:
        Unanswered: it did not, or the record lacks the decision.
    """
    return _decision(ride, *_find(ride, ride.motion(EGO), asked, tense))


def driven(ride: Ride, asked: tuple[QueryAction, ...], tense: Tense) -> QueryAction:
    """What the ego last did of what is described; for a stop, slowing down if it was no more.

    Raises:
        Unanswered: it did not.
    """
    return _find(ride, ride.motion(EGO), asked, tense)[0].action


def began(ride: Ride, asked: tuple[QueryAction, ...], tense: Tense) -> float:
    """When [s] the ego last began to drive as described.

    Raises:
        Unanswered: it did not.
    """
    return _find(ride, ride.motion(EGO), asked, tense)[0].start


def _explanation(
    ride: Ride,
    model: CausalModel,
    plan: Intervention,
    causes: tuple[Cause, ...],
    motion: Motion,
    seen: Sighting,
) -> Explanation:
    then = motion.until(seen.end)
    return Explanation(
        factual=plan.plan,
        counterfactual=(),
        outcome=outcome(plan),
        effects=(),
        causes=causes,
        evidence=evidence(model, ride, plan),
        activity=Activity(EGO, plan.plan, None, then.speed[-1], then.trend),
        sim_time=model.trace.sim_time,
        arrival=arrival(model.trace, plan),
        moment=seen.start,
    )


def _find(
    ride: Ride, motion: Motion, asked: tuple[QueryAction, ...], tense: Tense
) -> tuple[Sighting, Event | None]:
    """When it happened, and the giving way where it was that."""
    waits = [event for event in ride.events if event.kind == "gave-way"]
    found: list[tuple[Sighting, Event | None]] = []
    for action in asked:
        if action == "give-way":
            wait = pick(ride.past, waits, lambda event: (event.sim_time, event.sim_time))
            now = tense != "past" and ride.past is None
            found += [(_given_way(motion, e, going_on=now), e) for e in (wait,) if e]
        elif (sighting := pick(ride.past, motion.times(action), lambda s: s.span)) is not None:
            near = [e for e in waits if sighting.start - BEFORE <= e.sim_time <= sighting.end]
            waited = bool(near) and action != "speed-up"
            found.append((sighting, near[-1] if waited else None))
    if tense != "past" and ride.past is None:
        found = [pair for pair in found if pair[0].end >= ride.now - RECENT]
    if not found and "stop" in asked:  # who says brake may mean either
        with suppress(Unanswered):
            return _find(ride, motion, ("slow-down",), tense)
    if not found:
        raise did_not_happen(ride, asked)
    return max(found, key=lambda pair: pair[0].end)


def _given_way(motion: Motion, event: Event, *, going_on: bool) -> Sighting:
    """A giving way; where it is asked whether it goes on, with the slowing and standing for it."""
    moment = event.sim_time
    ends = [moment]
    if going_on:
        slowed = (*motion.times("slow-down"), *motion.times("stop"))
        ends += [s.end for s in slowed if s.start - BEFORE <= moment <= s.end]
    return Sighting("give-way", moment, max(ends))


def _decision(ride: Ride, seen: Sighting, wait: Event | None) -> PlanTrace:
    """The decision under which it happened.

    That is the last one before way was given; else, of those taken meanwhile, the one whose plan
    is held up most, or the last one before the middle of what was seen.
    """
    trace = ride.at((seen.start + seen.end) / 2.0 if wait is None else wait.sim_time)
    if trace is None:
        raise decline("outside-record", vehicle=EGO, time=seen.start)
    if wait is not None or seen.action == "speed-up":
        return trace
    window = (seen.start - LEEWAY, seen.end + LEEWAY)
    meanwhile = [t for t in ride.traces if seen.start - LEEWAY <= t.sim_time <= seen.end]
    return max((trace, *meanwhile), key=lambda t: _held(ride, t, window))


def _held(ride: Ride, trace: PlanTrace, window: tuple[float, float]) -> float:
    """How long [s] the plan of a decision is held up by somebody, at the most."""
    try:
        plan = factual(ride.model(trace), trace)
    except Unanswered:
        return 0.0
    found = hold_ups(plan, window).values()
    return max((held.expected for held in found if held.share >= LIKELY), default=0.0)


def _first(
    model: CausalModel, causes: tuple[Cause, ...], waited_for: int | None
) -> tuple[Cause, ...]:
    """The vehicle that was given way to goes first."""
    if waited_for is None:
        return causes
    mechanism = Mechanism("right-of-way", None, None, None, 1.0)  # as the events tell
    known = [
        c if c.mechanism and c.mechanism.how == "right-of-way" else replace(c, mechanism=mechanism)
        for c in causes
        if c.vehicle == waited_for
    ]
    if not known and waited_for in model.vehicles:
        choices = model.choices(waited_for)
        likeliest = max(choices, key=lambda choice: choices[choice])
        actions, probability = expected_actions(model, waited_for, likeliest)
        known = [Cause(waited_for, actions, probability, mechanism, None, None)]
    return (*known, *(cause for cause in causes if cause.vehicle != waited_for))
