"""Going deeper: what a bare "why?", "how do you know?" or "which car?" asks after an answer.

A row of whys goes one level down each time: from a decision to the prediction of the vehicle
behind it, from there to the evidence for the prediction, and there it ends.
"""

from typing import Literal

import msgspec

from sim.scene import EGO
from xavi_dialogue.dialogue.memory import Memory
from xavi_dialogue.dialogue.referents import PREFIX
from xavi_dialogue.dialogue.turn import Turn
from xavi_dialogue.explain.avoidance import CRASH
from xavi_dialogue.explain.details import Impact
from xavi_dialogue.explain.explanation import Cause, Explanation, NoExplanation
from xavi_dialogue.explain.query import Query, QueryAction

WHICH = "which"  # the event of "which car?"
#: Beneath the evidence, and what the road allows, there are no further reasons.
BOTTOM = NoExplanation(reason="out-of-scope", facts={"what": "deeper"})

_REASONED = frozenset({"why", "why_not", "what_if", "compare", "how_avoid", "sensitivity"})


def deeper(memory: Memory, query: Query) -> Query | None:
    """What a bare "why?" asks after an answer; None where there is nothing beneath it.

    Args:
        memory: the conversation.
        query: the bare "why?" as the words alone are understood.
    """
    last = _reasoned(memory)
    if last is None:
        return query
    before, found = last.query, last.reply.explanation
    if before is None:
        return query
    if found is None:
        return _of_refusal(query, last)
    if found.impact is not None:
        return _of_collision(before, found.impact)
    foretold = before.type == "what" and before.tense == "future" and before.actor != "ego"
    if before.type == "what" and not (foretold and before.factual):
        return _of_doing(query, found)
    if before.type not in (*_REASONED, "confidence", "how", "where_goal", "what"):
        return query
    if before.type == "what_if" and before.intervention == "remove" and found.factual:
        return Query(
            type="why", factual=found.factual[:1], tense=before.tense, refers_to_previous=True
        )
    if before.actor == "ego" and before.type in _REASONED:
        cause = _first_cause(last)
        if cause is not None:
            return _motive(cause, before)
        return msgspec.structs.replace(query, detail="more") if before.detail != "more" else None
    if before.type == "where_goal" and before.actor == "ego":
        return query
    if before.type in ("why", "confidence", "where_goal", "what"):
        return Query(
            type="how",
            actor=before.actor,
            factual=(before.factual if foretold else None) or _expected(last)[-1:] or None,
            tense=before.tense,
            refers_to_previous=True,
        )
    return None


def _of_refusal(query: Query, last: Turn) -> Query | None:
    """After a wrong premise: why we did what we did, or do what we do, instead."""
    if last.reply.reason != "did-not-happen":
        return None
    if last.leans is not None:
        return msgspec.structs.replace(query, detail=None)
    said = last.query
    if said is not None and said.actor != "ego" and said.tense != "past" and said.factual:
        return Query(  # "I do not expect vehicle 12 to stop": how we know
            type="how",
            actor=said.actor,
            factual=said.factual,
            tense=said.tense,
            refers_to_previous=True,
        )
    if query.actor != "ego" or query.tense != "present" or query.type != "why":
        return None
    return msgspec.structs.replace(query, factual=None, underspecified=None, detail=None)


def _of_doing(query: Query, found: Explanation) -> Query:
    """After an answer that told what we did, or what another does: why that is done."""
    doing = found.activity
    if query.actor != "ego":
        return msgspec.structs.replace(query, detail="more")
    told = doing is not None and doing.vehicle == EGO and query.tense == "past"
    if doing is None or not told or query.factual or not doing.actions:
        return query
    return msgspec.structs.replace(query, factual=doing.actions[:1])


def _of_collision(before: Query, impact: Impact) -> Query | None:
    """After an answer that told of a collision: why, and then what we expected of that vehicle."""
    if before.type not in ("why", "how"):
        return Query(type="why", event=CRASH, refers_to_previous=True)
    if impact.vehicle is None or not impact.actions:
        return None
    expected = _last_of(impact.actions)
    actor = f"{PREFIX}{impact.vehicle}"
    return Query(type="how", actor=actor, factual=expected, refers_to_previous=True)


def _reasoned(memory: Memory) -> Turn | None:
    """The turn whose reasons are asked for: of "are you sure?", the one that was doubted."""
    about = [turn for turn in memory.turns if turn.query is not None and turn.reply.explanation]
    last = memory.last
    while last is not None and last in about and _doubts(last):
        before = about[: about.index(last)]
        last = before[-1] if before else None
    return last if last is not None else memory.last


def _doubts(turn: Turn) -> bool:
    query = turn.query
    return query is not None and (query.type, query.actor) == ("confidence", "ego")


def evidence_for(last: Turn) -> Query | None:
    """What "how do you know?" asks after an answer that blames a vehicle: how we saw it coming."""
    before, cause = last.query, _first_cause(last)
    if before is None or cause is None or before.actor != "ego" or before.type not in _REASONED:
        return None
    return Query(
        type="how",
        actor=f"{PREFIX}{cause.vehicle}",
        factual=_last_of(cause.actions),
        tense=before.tense,
        refers_to_previous=True,
    )


def doubted(last: Turn) -> Query | Literal["seen"] | None:
    """What "are you sure?" doubts after an answer that says what held us up.

    Returns:
        How sure we are of what that vehicle was expected to do; "seen" where it was in our way
        before our eyes; None where the answer compared what could be done.
    """
    before, found = last.query, last.reply.explanation
    if before is None or found is None or before.type != "why" or found.counterfactual:
        return None
    cause = _first_cause(last)
    if cause is None or before.actor != "ego":
        return None
    seen = cause.mechanism is not None and cause.mechanism.present
    if seen or not cause.actions:
        return "seen"
    return Query(
        type="confidence",
        actor=f"{PREFIX}{cause.vehicle}",
        factual=_last_of(cause.actions),
        tense=before.tense,
        refers_to_previous=True,
    )


def meant_vehicle(query: Query, memory: Memory) -> Query | None:
    """What "which car?" asks after an answer: about the vehicle it named first."""
    named = next((t.mentioned for t in reversed(memory.turns) if t.mentioned), ())
    if not named:
        return None
    return Query(
        type="what",
        actor=f"{PREFIX}{named[0]}",
        tense="present",
        event=WHICH,
        refers_to_previous=query.refers_to_previous,
    )


def _motive(cause: Cause, before: Query) -> Query:
    return Query(
        type="why",
        actor=f"{PREFIX}{cause.vehicle}",
        tense=before.tense,
        detail="more",
        refers_to_previous=True,
    )


def _first_cause(last: Turn) -> Cause | None:
    found = last.reply.explanation
    others = () if found is None else tuple(c for c in found.causes if c.vehicle != 0)
    return others[0] if others else None


def _expected(last: Turn) -> tuple[QueryAction, ...]:
    """What the last answer expected of a vehicle."""
    found = last.reply.explanation
    if found is None:
        return ()
    if found.activity is not None and found.activity.probability is not None:
        return found.activity.actions
    kind = None if found.destination is None else found.destination.kind
    return () if kind is None else (kind,)


def _last_of(actions: tuple[QueryAction, ...]) -> tuple[QueryAction, ...] | None:
    return actions[-1:] or None
