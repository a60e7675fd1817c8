"""Questions about another vehicle: what it does, why, where it goes, how sure that is."""

from msgspec.structs import replace

from planner.trace import PlanTrace
from sim.scene import EGO
from xavi_dialogue.causal.model import CausalModel, Choice
from xavi_dialogue.explain import hindered
from xavi_dialogue.explain.deeds import HALTS, elsewhere
from xavi_dialogue.explain.details import Suspect
from xavi_dialogue.explain.expectation import expectation, last_seen, recorded
from xavi_dialogue.explain.explanation import Activity, Explanation
from xavi_dialogue.explain.motion import foresees
from xavi_dialogue.explain.query import Query, QueryAction
from xavi_dialogue.explain.ride import ROUNDING, Ride, Unanswered, decline, prediction
from xavi_dialogue.explain.sighted import last_time, sighted

EXPECTED = 0.3  # probability from which something may be said to be expected
RECENT = 2.0  # [s] since when something is still going on


def vehicle_of(query: Query) -> int | None:
    """The number of the vehicle asked about; None for the ego and for descriptions."""
    return number_of(query.actor)


def number_of(actor: str) -> int | None:
    """The number in "vehicle:N"; None for the ego and for descriptions."""
    kind, _, number = actor.partition(":")
    return int(number) if kind == "vehicle" and number.isdecimal() else None


def check_known(ride: Ride, vehicle: int) -> None:
    """Decline a vehicle that was never seen.

    Raises:
        Unanswered: it is unknown.
    """
    if vehicle not in ride.vehicles:
        known = tuple(str(name) for name in ride.vehicles)
        raise decline("unknown-vehicle", vehicle=vehicle, known=known)


def what(query: Query, ride: Ride) -> Explanation:
    """What a vehicle did, does or will probably do."""
    vehicle = actor_of(query, ride)
    if query.factual:
        return _why(query, ride, vehicle, query.factual)
    motion = ride.motion(vehicle)
    trace = last_with(ride, vehicle)
    if ride.past is not None:
        return sighted(ride, ride.past, vehicle, trace)
    seen = motion.sightings()
    if query.tense != "past" or not seen:
        found = expectation(ride, trace, vehicle, ())
        present = query.tense == "present"
        return hindered.at_present(found, ride, vehicle) if present else found
    actions = tuple(s.action for s in seen)
    activity = Activity(vehicle, actions[-2:], None, motion.speed[-1], motion.trend)
    return Explanation(
        factual=(),
        counterfactual=(),
        outcome=None,
        effects=(),
        causes=(),
        evidence=recorded(trace),
        activity=activity,
        sim_time=trace.sim_time,
        moment=seen[-1].start,
        seen=last_seen(ride, vehicle),
    )


def why(query: Query, ride: Ride) -> Explanation:
    """Why a vehicle does what it does: its goal that makes it rational, and who is in its way."""
    vehicle = actor_of(query, ride)
    return _suspected(query, ride, _why(query, ride, vehicle, query.factual or ()))


def _suspected(query: Query, ride: Ride, found: Explanation) -> Explanation:
    """With a word on the vehicle taken for the cause, where it is known who was in the way.

    Raises:
        Unanswered: that vehicle is unknown.
    """
    blamed = query.hypothesised_cause or ""
    suspect = EGO if blamed == "ego" else number_of(blamed)
    if suspect is None:
        return found
    if suspect != EGO:
        check_known(ride, suspect)
    named = [cause.vehicle for cause in found.causes]
    if not named:
        return found
    if suspect not in named:
        return replace(found, suspect=Suspect(suspect, "none"))
    first = sorted(found.causes, key=lambda cause: cause.vehicle != suspect)
    part = Suspect(suspect, "main" if named[0] == suspect else "some")
    return replace(found, causes=tuple(first), suspect=part)


def where(query: Query, ride: Ride) -> Explanation:
    """Where a vehicle is probably going."""
    vehicle = actor_of(query, ride)
    return expectation(ride, last_with(ride, vehicle), vehicle, ())


def when(query: Query, ride: Ride) -> Explanation:
    """When a vehicle did something; what it is yet to do has no time that we know.

    Raises:
        Unanswered: it did not do so.
    """
    vehicle = actor_of(query, ride)
    asked = query.factual or ()
    motion = ride.motion(vehicle)
    found = [last_time(ride, vehicle, a) for a in asked] or list(motion.sightings()[-1:])
    trace = last_with(ride, vehicle)
    if not found or not all(found):
        model = ride.model(trace)
        chance = sum(model.choices(vehicle)[c] for c in matching(model, vehicle, asked))
        raise _not_seen(ride, trace, vehicle, asked, chance if asked else 0.0)
    last = max((s for s in found if s), key=lambda s: s.end)
    return Explanation(
        factual=(),
        counterfactual=(),
        outcome=None,
        effects=(),
        causes=(),
        evidence=recorded(trace),
        activity=Activity(vehicle, asked or (last.action,), None, None, None),
        sim_time=trace.sim_time,
        moment=last.start,
    )


def confidence(query: Query, ride: Ride) -> Explanation:
    """How probable it is that a vehicle does something."""
    vehicle = actor_of(query, ride)
    trace = last_with(ride, vehicle)
    asked = query.factual or query.counterfactual or ()
    if not asked:
        return expectation(ride, trace, vehicle, ())
    if query.tense == "present" and set(asked) <= HALTS and halted(ride, vehicle):
        found = expectation(ride, trace, vehicle, asked)
        activity = Activity(vehicle, asked, None, 0.0, "standing")
        return replace(found, activity=activity, destination=None, rival=())
    model = ride.model(trace)
    chance = sum(model.choices(vehicle)[choice] for choice in matching(model, vehicle, asked))
    found = expectation(ride, trace, vehicle, asked)
    motion = ride.motion(vehicle).until(trace.sim_time)
    activity = Activity(vehicle, asked, min(chance, 1.0), motion.speed[-1], motion.trend)
    return replace(found, activity=activity)


def matching(model: CausalModel, vehicle: int, asked: tuple[QueryAction, ...]) -> frozenset[Choice]:
    """The goals and trajectories of a vehicle in which all actions asked about occur."""
    known = prediction(model.trace, vehicle)
    if known is None:
        return frozenset()
    return frozenset(
        (g, t)
        for g, t in model.choices(vehicle)
        if all(foresees(known.goals[g].trajectories[t], action) for action in asked)
    )


def check_contrary(ride: Ride, vehicle: int, asked: tuple[QueryAction, ...], *, done: bool) -> None:
    """Decline a question about the contrary of what a vehicle did, if that is what it did.

    Args:
        ride: the record.
        vehicle: whose actions they are.
        asked: the actions.
        done: whether the question takes for granted that they were done.

    Raises:
        Unanswered: they were not done, or were.
    """
    seen = [ride.motion(vehicle).last(action) for action in asked]
    trace = last_with(ride, vehicle)
    if done and not any(seen):
        raise _not_seen(ride, trace, vehicle, asked, 0.0)
    if not done and all(seen):
        time = min(s.start for s in seen if s)
        raise decline(
            "did-not-happen", vehicle=vehicle, asked=asked, did=True, happened=asked, time=time
        )


def actor_of(query: Query, ride: Ride) -> int:
    """The vehicle asked about.

    Raises:
        Unanswered: it is only described, or unknown.
    """
    vehicle = vehicle_of(query)
    if vehicle is None:
        raise decline("ambiguous", vehicle=query.actor)
    check_known(ride, vehicle)
    return vehicle


def halted(ride: Ride, vehicle: int) -> bool:
    """Whether a vehicle is in view and stands."""
    return last_seen(ride, vehicle) is None and ride.motion(vehicle).trend == "standing"


def _why(query: Query, ride: Ride, vehicle: int, asked: tuple[QueryAction, ...]) -> Explanation:
    present = query.tense == "present" or (bool(asked) and query.tense == "future")
    if present and set(asked) <= HALTS and halted(ride, vehicle):
        since = ride.motion(vehicle).since_standing
        waiting = expectation(ride, last_with(ride, vehicle), vehicle, asked, since)
        return hindered.at_present(waiting, ride, vehicle, least=EXPECTED)
    found = [last_time(ride, vehicle, action) for action in asked]
    if query.tense == "present":
        found = [s if s and s.end >= ride.now - RECENT else None for s in found]
    if asked and query.tense != "future" and all(found):
        last = max((s for s in found if s), key=lambda s: s.end)
        known = [t for t in ride.traces if t.sim_time >= last.end and prediction(t, vehicle)]
        trace = known[0] if known else last_with(ride, vehicle)
        explained = expectation(ride, trace, vehicle, asked, last.start)
        if query.tense == "present" and last.action in hindered.BRAKING:
            return hindered.at_present(explained, ride, vehicle)
        return hindered.behind(explained, ride, vehicle, last)
    trace = last_with(ride, vehicle)
    model = ride.model(trace)
    ways = matching(model, vehicle, asked)
    chance = sum(model.choices(vehicle)[choice] for choice in ways)
    if asked and (query.tense == "past" or chance < EXPECTED):
        raise _not_seen(ride, trace, vehicle, asked, chance)
    expected = expectation(ride, trace, vehicle, asked, among=ways)
    if not asked:
        present = query.tense == "present"
        return hindered.at_present(expected, ride, vehicle) if present else expected
    if not set(asked) & set(hindered.BRAKING):
        return expected
    return hindered.foreseen(expected, ride, trace, vehicle, ways)


def _not_seen(
    ride: Ride, trace: PlanTrace, vehicle: int, asked: tuple[QueryAction, ...], chance: float
) -> Unanswered:
    seen = ride.motion(vehicle).sightings()
    another = elsewhere(ride, vehicle, asked)
    if another:
        return decline("did-not-happen", vehicle=vehicle, asked=asked, did=False, **another)
    return decline(
        "did-not-happen",
        vehicle=vehicle,
        asked=asked,
        did=False,
        planned=True if chance >= EXPECTED else None,
        probability=chance,
        happened=(seen[-1].action,) if seen else None,
        time=seen[-1].start if seen else trace.sim_time,
    )


def last_with(ride: Ride, vehicle: int) -> PlanTrace:
    """The last decision that expects something of a vehicle; by the time asked about, if any.

    Raises:
        Unanswered: none does.
    """
    time = ride.now if ride.past is None else ride.past.moment
    for trace in reversed(ride.traces):
        if trace.sim_time <= time + ROUNDING and prediction(trace, vehicle) is not None:
            return trace
    raise decline("outside-record", vehicle=vehicle, time=time)
