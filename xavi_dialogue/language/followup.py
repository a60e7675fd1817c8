"""Follow-ups: a reading in the light of the question before it.

Every function takes the reading and the earlier query and gives the query meant, or None where
the earlier turn does not supply what is missing.
"""

import msgspec

from xavi_dialogue.explain.avoidance import CRASH
from xavi_dialogue.explain.blame import INFLUENCE
from xavi_dialogue.explain.query import Query, QueryAction, Tense
from xavi_dialogue.explain.timing import ARRIVAL
from xavi_dialogue.language.readings import Reading

_TALK = frozenset({"smalltalk", "help", "out_of_scope", "ambiguous"})
#: Types whose counterfactual is what they ask about.
_ABOUT_FOIL = frozenset({"why_not", "what_if", "compare"})
AGAIN = "again"  # the event of a bare "why?", which asks for the reason behind the answer
#: Rules that mean nothing without an earlier question.
LEANING = frozenset({"more", "less", "again", "replace", "correction"})


def answerable(query: Query) -> bool:
    """Whether the query asks about the record (and can be leant on)."""
    return query.type not in _TALK


def resolve(reading: Reading, previous: Query | None) -> Query | None:
    """The query meant, given the last question before it.

    Returns None where the reading leans on an earlier turn that is missing or does not fit.
    """
    query = reading.query
    if reading.rule in LEANING:
        return _lean(reading, previous) if previous is not None else _alone(reading)
    blamed = query.type == "why" and query.hypothesised_cause and previous is not None
    if (query.event == INFLUENCE or blamed) and not query.factual:
        return _laid_to(reading, previous)
    if reading.anaphoric or reading.elided:
        if previous is None:
            return _pointed_at(reading)
        if reading.elided and _thought_away(reading):
            return None  # "and if vehicle 1 had not been there?" leaves nothing out
        query = _supply_actions(reading, previous)
    if query.actor == "vehicle:it" and previous is not None:
        known = previous.actor.startswith("vehicle:")
        query = _refer(query, actor=previous.actor if known else query.actor)
    if query.event == CRASH and query.actor == "vehicle:it":
        query = msgspec.structs.replace(query, actor="ego")  # whoever it was with
    if previous is not None:
        return _inherit(reading, query, previous)
    ahead = reading.tensed and query.tense == "future"  # "how long will this take?": to get there
    if reading.rule == "when" and not (ahead or reading.named_actor) and _empty(query):
        return Query(type="ambiguous", tense=query.tense)
    return query


def _empty(query: Query) -> bool:
    return not (query.factual or query.counterfactual or query.intervention)


def _refer(query: Query, **changes: object) -> Query:
    return msgspec.structs.replace(query, refers_to_previous=True, **changes)


def _asked(query: Query) -> tuple[QueryAction, ...] | None:
    """The actions that a question is about."""
    if query.type in _ABOUT_FOIL:
        return query.counterfactual or query.factual
    return query.factual or query.counterfactual


def _alone(reading: Reading) -> Query | None:
    """A leaning reading with no earlier turn: only the bare "why?" is a question to clarify."""
    tense = reading.query.tense
    if reading.proposed and reading.query.factual:
        return _proposed(reading, "future")
    return Query(type="ambiguous", tense=tense) if reading.rule != "correction" else None


def _pointed_at(reading: Reading) -> Query | None:
    """The query of "why did you do that?" out of the blue: it speaks of what was just seen."""
    query = reading.query
    if query.actor == "ego" and (reading.otherwise or (reading.elided and query.negated)):
        return query
    if reading.anaphoric and query.type == "why" and query.hypothesised_cause is None:
        return query
    return None


def _laid_to(reading: Reading, previous: Query | None) -> Query:
    """What a vehicle had to do with what was spoken of; by itself, with what was just done."""
    query, cause = reading.query, reading.query.hypothesised_cause
    if previous is None or not previous.factual or previous.actor == cause:
        return query
    if previous.actor != "ego" and not reading.laid:
        return query  # "it was vehicle 5 that I meant"
    if cause == "vehicle:it":
        cause = previous.hypothesised_cause or cause
    return _refer(
        query,
        actor=previous.actor,
        factual=previous.factual,
        hypothesised_cause=cause,
        tense=previous.tense,
        underspecified=previous.underspecified,
    )


def _supply_actions(reading: Reading, previous: Query) -> Query:
    """Put the actions of the earlier question where "do that" or an elision stands."""
    query = reading.query
    actions = _asked(previous)
    slot = "factual" if query.type in ("why", "what", "how", "when") else "counterfactual"
    actor = query.actor
    if reading.otherwise:  # than what was done; of a foil, than not to do it
        return _refer(query, counterfactual=actions, negated=previous.type not in _ABOUT_FOIL)
    if reading.elided and previous.negated and not query.negated:
        return _refer(query, counterfactual=actions, negated=False)
    return _refer(query, actor=actor, **{slot: actions})


def _lean(reading: Reading, previous: Query) -> Query | None:
    query = reading.query
    if reading.rule in ("more", "less"):
        return _refer(previous, detail=query.detail)
    if reading.rule == "again":
        return _again(reading, previous)
    if reading.heading is not None:
        return _turned(reading.heading, previous)
    if _thought_away(reading) and previous.type != "sensitivity":
        return _without(reading, previous)
    if query.factual:
        if reading.proposed and not (reading.named_actor or _asks_of_deeds(previous)):
            return _refer(_proposed(reading, previous.tense))
        asked = _with_actions(previous, query.factual)
        return _refer(asked, actor=query.actor) if reading.named_actor else asked
    if query.time and not reading.named_actor:
        now = query.tense if reading.tensed else previous.tense  # "after that" goes on from there
        return _refer(previous, time=query.time, tense=now)
    _, _, number = query.actor.partition(":")
    if previous.type == "sensitivity" and number.isdecimal():
        return _refer(previous, condition=f"without vehicle {number}")  # the decision is still ours
    return _refer(previous, actor=query.actor)


def _thought_away(reading: Reading) -> bool:
    """Whether it supposes that another vehicle were not there: "and without vehicle 1?"."""
    other = reading.named_actor and reading.query.actor != "ego"
    return reading.absent and other and not reading.query.factual


def _without(reading: Reading, previous: Query) -> Query:
    """What a vehicle's absence would have changed about what was spoken of."""
    query = reading.query
    gone = Query(type="what_if", actor=query.actor, negated=True, intervention="remove")
    return _refer(gone, tense=query.tense if reading.tensed else previous.tense)


def _asks_of_deeds(query: Query) -> bool:
    """Whether the question can be asked of other deeds as well: "when will you stop?"."""
    return query.type in _ABOUT_FOIL or (query.type != "why" and not _empty(query))


def _proposed(reading: Reading, tense: Tense) -> Query:
    """What "what about stopping?" asks, where nothing is known to have been done so."""
    query = reading.query
    return Query(
        type="what_if",
        actor=query.actor,
        counterfactual=query.factual,
        tense=tense,
        underspecified=query.underspecified,
    )


def _again(reading: Reading, previous: Query) -> Query:
    """A bare "why?" or "why not?" after another question; "because of vehicle 2?"."""
    if reading.query.hypothesised_cause:
        return _laid_to(reading, previous)
    if reading.query.negated:
        return _refer(
            previous, type="why_not", factual=None, counterfactual=_asked(previous), negated=False
        )
    if previous.type == "why":
        return _refer(previous, detail="more", event=AGAIN)
    if previous.type in ("why_not", "compare"):
        kind = "why_not" if previous.type == "why_not" else "why"
        return _refer(previous, type=kind, event=AGAIN)
    keep = previous.factual if previous.type in ("what", "when", "how", "confidence") else None
    plain = Query(type="why", actor=previous.actor, factual=keep, tense=previous.tense)
    return _refer(plain, event=AGAIN)


def _turned(side: str, previous: Query) -> Query | None:
    """The earlier question, with every direction replaced."""
    asked = _asked(previous)
    if not asked:
        return None
    turned = tuple(_to(side, name) for name in asked)
    if turned == asked and previous.type not in _ABOUT_FOIL:
        return None
    return _with_actions(previous, turned)


def _to(side: str, action: QueryAction) -> QueryAction:
    stem = action.rpartition("-")[0]
    if stem in ("change", "exit"):
        return f"{stem}-{side}"  # type: ignore[return-value]
    return f"exit-{side}"  # type: ignore[return-value]


def _with_actions(previous: Query, actions: tuple[QueryAction, ...]) -> Query:
    if previous.type in _ABOUT_FOIL:
        return _refer(previous, counterfactual=actions, negated=False)
    return _refer(previous, factual=actions)


def _inherit(reading: Reading, query: Query, previous: Query) -> Query:
    """What a short question leaves out, it takes from the one before."""
    changes: dict[str, object] = {}
    if query.type == "why_not" and not reading.tensed:
        changes["tense"] = previous.tense
        if previous.factual and query.factual is None and query.counterfactual:
            changes["counterfactual"] = _same_kind(query.counterfactual, previous.factual)
            changes["factual"] = previous.factual
    arriving = query.type == "when" and reading.named_actor  # complete as it stands
    elliptic = query.type in ("confidence", "compare", "sensitivity", "when", "how")
    if _empty(query) and elliptic and not arriving and not _turns_away(reading, previous):
        compared = _asked(previous) if query.type == "compare" else None
        if not reading.named_actor and (compared or query.type != "compare"):
            changes["actor"] = previous.actor
        if query.type == "compare":
            changes["counterfactual"] = compared
        else:
            changes["factual"] = previous.factual
            changes["counterfactual"] = previous.counterfactual
            changes |= {"event": CRASH} if previous.event == CRASH else {}
        if not reading.tensed:
            changes["tense"] = previous.tense
    if query.actor == "vehicle:unknown" and not reading.tensed:
        changes["tense"] = previous.tense
    if not changes:
        return query
    return _refer(query, **changes)


def _turns_away(reading: Reading, previous: Query) -> bool:
    """Whether a short question asks nothing about what was spoken of, but about us at large.

    "How long will this take?" after what is over; "what mattered most?" after a mere wish.
    """
    query = reading.query
    if query.event in (CRASH, ARRIVAL):
        return True  # "how likely is a crash?"
    if query.type == "when":
        return reading.tensed and query.tense == "future" and previous.tense == "past"
    if query.type == "sensitivity" and reading.named_actor and query.actor != previous.actor:
        return True
    wished = previous.type == query.type and previous.counterfactual is not None
    return query.type == "sensitivity" and wished


def _same_kind(
    asked: tuple[QueryAction, ...], before: tuple[QueryAction, ...]
) -> tuple[QueryAction, ...]:
    """After a lane change, "why not right?" speaks of a lane change."""
    if len(asked) == 1 and len(before) == 1 and before[0].startswith("change-"):
        side = asked[0].rpartition("-")[2]
        if asked[0] in ("exit-left", "exit-right"):
            return (f"change-{side}",)  # type: ignore[return-value]
    return asked
