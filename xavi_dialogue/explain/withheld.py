"""Why another vehicle did not do something: what it did instead, and what we expected of it."""

from msgspec.structs import replace

from xavi_dialogue.explain import hindered, vehicles
from xavi_dialogue.explain.details import Contrary
from xavi_dialogue.explain.explanation import Explanation, NoExplanation
from xavi_dialogue.explain.motion import Motion, Sighting
from xavi_dialogue.explain.query import Query, QueryAction
from xavi_dialogue.explain.ride import Ride, Unanswered, decline
from xavi_dialogue.explain.vehicles import EXPECTED, actor_of, last_with, matching

#: What a vehicle does instead, that answers why it did not do something.
INSTEAD: dict[QueryAction, tuple[QueryAction, ...]] = {
    "speed-up": ("slow-down", "stop"),
    "slow-down": ("speed-up",),
    "continue": ("stop", "exit-left", "exit-right"),
    "exit-straight": ("stop", "exit-left", "exit-right"),
    "exit-left": ("exit-right",),
    "exit-right": ("exit-left",),
    "change-left": ("change-right",),
    "change-right": ("change-left",),
}


def why_not(query: Query, ride: Ride) -> Explanation:
    """Why a vehicle did not do something: why it did the contrary, or what is expected of it.

    Raises:
        Unanswered: it did, and nothing to the contrary since.
    """
    vehicle = actor_of(query, ride)
    asked = query.counterfactual or ()
    if query.tense != "past" or not asked:
        found = vehicles.where(query, ride)
        present = query.tense == "present"
        return hindered.at_present(found, ride, vehicle) if present else found
    motion = ride.motion(vehicle)
    done = [motion.last(action) for action in asked]
    since = max((s.start for s in done if s), default=None) if all(done) else None
    contrary = _contrary(motion, asked, since)
    if contrary is None and since is not None:
        vehicles.check_contrary(ride, vehicle, asked, done=False)
    if contrary is None:
        return _expected(query, ride, vehicle, asked)
    why = replace(query, type="why", factual=(contrary.action,), counterfactual=None)
    found = vehicles.why(why, ride)
    return replace(found, contrary=Contrary(asked, since, contrary.action))


def compare(query: Query, ride: Ride) -> Explanation:
    """What would have been better for another vehicle is not known; what it means to us may be.

    Raises:
        Unanswered: always, with what can be asked instead.
    """
    actor_of(query, ride)
    supposed = query.counterfactual or query.factual
    offered = Query(type="what_if", actor=query.actor, counterfactual=supposed, tense=query.tense)
    if not supposed:
        raise decline("out-of-scope", what="compare")
    raise Unanswered(
        NoExplanation(reason="out-of-scope", facts={"what": "compare"}, suggestions=(offered,))
    )


def _contrary(
    motion: Motion, asked: tuple[QueryAction, ...], since: float | None
) -> Sighting | None:
    """The last time that a vehicle did the contrary, after what was asked about if it did that."""
    others = {other for action in asked for other in INSTEAD.get(action, ())} - set(asked)
    seen = [s for s in motion.sightings() if s.action in others]
    return next((s for s in reversed(seen) if since is None or s.start > since), None)


def _expected(
    query: Query, ride: Ride, vehicle: int, asked: tuple[QueryAction, ...]
) -> Explanation:
    """What is expected of it; and what is asked about, where that may come yet."""
    model = ride.model(last_with(ride, vehicle))
    ways = matching(model, vehicle, asked)
    chance = min(sum(model.choices(vehicle)[way] for way in ways), 1.0)
    found = vehicles.where(query, ride)
    yet = chance if chance >= EXPECTED and found.seen is None else None
    return replace(found, contrary=Contrary(asked, chance=yet))
