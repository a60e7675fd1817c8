"""The engine: a query and the record in; an explanation, a refusal or a request out."""

from collections.abc import Callable, Mapping
from contextlib import suppress
from typing import TypeAlias

from msgspec.structs import replace

from sim.scene import EGO as OURSELVES
from xavi_dialogue.causal.model import CausalError
from xavi_dialogue.explain import (
    avoidance,
    certainty,
    choices,
    collision,
    ego,
    grounds,
    lanes,
    method,
    present,
    ranking,
    sensitivity,
    sights,
    suppositions,
    timing,
    vehicles,
    withheld,
)
from xavi_dialogue.explain.details import Suspect
from xavi_dialogue.explain.direction import directed
from xavi_dialogue.explain.explanation import Explanation, NeedRollout, NoExplanation
from xavi_dialogue.explain.premise import premise
from xavi_dialogue.explain.query import Query, QueryType
from xavi_dialogue.explain.record import Record
from xavi_dialogue.explain.ride import Ride, Unanswered, decline
from xavi_dialogue.explain.whereabouts import place_asked

#: What is answered with the time that it is about.
DATED = frozenset[QueryType](("why", "why_not", "what_if", "what", "where_goal"))
#: What is answered from a decision that the question need not name, ...
FOILS = frozenset[QueryType](("why_not", "what_if"))
#: What is told of the moment at which it is asked.
PRESENT = frozenset[QueryType](("what", "why", "where_goal", "when"))
RECENT = 3.0  # [s] ... and with its time, where it is older than this

Explainer: TypeAlias = Callable[[Query, Ride], Explanation]

#: What is asked about the ego.
EGO: Mapping[QueryType, Explainer] = {
    "why": ego.why,
    "why_not": ego.why_not,
    "what_if": ego.what_if,
    "compare": ranking.compare,
    "what": present.what,
    "where_goal": present.where,
    "when": timing.when,
    "confidence": certainty.confidence,
    "how": method.how,
    "how_avoid": avoidance.how_avoid,
    "sensitivity": sensitivity.sensitivity,
}
#: What is asked about another vehicle.
OTHERS: Mapping[QueryType, Explainer] = {
    "why": vehicles.why,
    "why_not": withheld.why_not,
    "compare": withheld.compare,
    "what_if": suppositions.what_if,
    "what": vehicles.what,
    "where_goal": vehicles.where,
    "confidence": vehicles.confidence,
    "when": vehicles.when,
    "how": grounds.how,
}
#: What is asked beyond the type, by `Query.event`: of what is seen, whoever it is about; ...
SEEN: Mapping[str, Explainer] = dict.fromkeys(
    ("speed", "distance", "place", "count", "colour", sights.ONCOMING), sights.sight
)
#: ... and about the ego.
ASPECTS: Mapping[str, Explainer] = {
    **dict.fromkeys(("options", "second", "worst", "sooner"), choices.options),
    **dict.fromkeys(("necessary", "other-way", "better-way"), choices.needed),
    "lane": lanes.lane,
}


def explain(query: Query, record: Record) -> Explanation | NoExplanation | NeedRollout:
    """Answer a query from the record of the ride.

    Pure: the same query and record give the same result. A NeedRollout is answered by asking
    again with the plan made anew among `record.extra`.
    """
    return explain_ride(query, Ride(record))


def explain_ride(query: Query, ride: Ride) -> Explanation | NoExplanation | NeedRollout:
    """Answer a query from a record that was read before; see `explain`."""
    now = next((gap for gap in ride.gaps if gap[0] < ride.now < gap[1]), None)
    if now is not None and query.tense != "past" and query.type in PRESENT:
        return NoExplanation(reason="trace-gap", facts={"since": now[0], "until": now[1]})
    try:
        return _dated(query, ride, _checked(query, ride, _explainer(query, ride)(query, ride)))
    except Unanswered as unanswered:
        return _doubted(unanswered.result, ride)
    except CausalError:  # a record that contradicts itself explains nothing
        return NoExplanation(reason="trace-gap", facts={"time": ride.now})


def _doubted(result: NoExplanation | NeedRollout, ride: Ride) -> NoExplanation | NeedRollout:
    """The result, unless it denies what may have been in a part of the record that was lost."""
    denial = isinstance(result, NoExplanation) and result.reason == "did-not-happen"
    if not denial or not ride.gaps:
        return result
    since, until = ride.gaps[0][0], ride.gaps[-1][1]
    return NoExplanation(reason="trace-gap", facts={"since": since, "until": until})


def settled(query: Query, record: Record) -> Query:
    """The query with what its words leave open and the record settles: on which side it was."""
    try:
        return directed(query, Ride(record))
    except Unanswered:
        return query


def _checked(query: Query, ride: Ride, found: Explanation) -> Explanation:
    """The explanation with a word on the vehicle that the question takes for the cause.

    Where it is one of the causes it goes first, so that it is the one that is spoken of.

    Raises:
        Unanswered: that vehicle is unknown.
    """
    suspect = vehicles.number_of(query.hypothesised_cause or "")
    if suspect is None or suspect == OURSELVES or _of_another(found):
        return found
    vehicles.check_known(ride, suspect)
    named = [cause.vehicle for cause in found.causes]
    if suspect not in named:
        return replace(found, suspect=Suspect(suspect, "none"))
    first = sorted(found.causes, key=lambda cause: cause.vehicle != suspect)
    part = Suspect(suspect, "main" if named[0] == suspect else "some")
    return replace(found, causes=tuple(first), suspect=part)


def _dated(query: Query, ride: Ride, found: Explanation) -> Explanation:
    """The explanation with the time that it is about, where the question speaks of one.

    So too where it asks of what might have been done, names nothing that was, and it is an
    earlier decision that tells: a later one may find otherwise.
    """
    if found.impact is not None:
        return found  # it has a time of its own
    if ride.past is None and ride.ahead is None and _is_old(query, ride, found):
        return replace(found, then=found.sim_time)
    if (ride.past is None and ride.ahead is None) or query.type not in DATED:
        return found
    moment = found.moment
    if moment is None and ride.past is not None and not _of_another(found):
        with suppress(Unanswered):
            about = premise(ride, query)
            if about.deed is not None and about.trace.sim_time == found.sim_time:
                moment = about.deed.time if about.deed.action != "continue" else None
    if moment is None and ride.past is None:
        return found
    return replace(found, then=found.sim_time if moment is None else moment)


def _is_old(query: Query, ride: Ride, found: Explanation) -> bool:
    """Whether a foil is told of from a decision that is past, though nothing says from which."""
    named = query.factual or not query.counterfactual or query.negated
    old = ride.now - found.sim_time > RECENT
    return query.type in FOILS and not named and _ours(query) and old


def _of_another(found: Explanation) -> bool:
    return found.activity is not None and found.activity.vehicle != OURSELVES


def _explainer(query: Query, ride: Ride) -> Explainer:
    if query.type == "out_of_scope" and query.reason == "not-an-action":
        raise decline("not-an-action")
    if query.type == "ambiguous":
        raise decline("ambiguous")
    if place_asked(query) is not None:
        return sights.nobody
    if collision.names_collision(query):
        return collision.collision
    if collision.tells_collision(query, ride):
        return collision.happened
    if (aspect := _aspect(query)) is not None:
        return aspect
    if _ours(query) and query.event == timing.ARRIVAL and query.type != "confidence":
        return timing.when
    table = EGO if _ours(query) else OTHERS
    found = table.get(query.type)
    if found is None:
        raise decline("out-of-scope", what=query.reason or query.type)
    return found


def _aspect(query: Query) -> Explainer | None:
    """Who explains what is asked beyond the type, if anything is."""
    if query.type == "out_of_scope" and query.reason != "perception":
        return None
    wanted = query.event or ""
    return SEEN.get(wanted) or (ASPECTS.get(wanted) if _ours(query) else None)


def _ours(query: Query) -> bool:
    return query.actor in ("ego", "vehicle:0")
