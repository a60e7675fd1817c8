"""Clauses: any event, episode or proposition of the domain as a clause to be conjugated."""

from dataclasses import replace
from typing import Any

import msgspec

from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import (
    Ego,
    Event,
    Exit,
    Feature,
    Junction,
    Lane,
    Nobody,
    Pronoun,
    Road,
    Thing,
    Unknown,
)
from xavi_dialogue.domain.vocabulary import ActionName, Side
from xavi_dialogue.nlg.content.clauses.tenses import PRESENT, event_tense, goes_on, moment_of
from xavi_dialogue.nlg.surface.tables import table, word
from xavi_dialogue.nlg.surface.values import Bare, Clause, Owned, Tense, Who

#: Actions that last; in the present, they take the progressive.
STATES = frozenset(("see", "have", "happen"))
PLACES = (Junction, Exit, Lane, Road)  # the place itself is blocked, not its way
SITES = (*PLACES, Feature)  # places where one turns; everything else is passed in front of
LEAVING = frozenset(("leave", "exit-left", "exit-right", "exit-straight", "turn"))
TURNS = frozenset(("turn", "exit-left", "exit-right"))
_AS = {"same-as": "like", "with": "with"}  # prepositions instead of the relation
_PREPOSITIONS = frozenset(("for", "to", "of", "at", "from", "with"))


def doing(
    action: ActionName,
    *,
    side: Side | None = None,
    ego: bool = False,
    roundabout: bool = False,
    has_object: bool = False,
) -> str:
    """Return the verb phrase for an action, with {} where its object goes."""  # fmt: skip
    section = table("doings")
    entry: Any = section["roundabout"].get(action) if roundabout else None
    entry = entry or section["action"][action]
    phrase = str(entry["say"])
    if has_object and "with" in entry:
        phrase = str(entry["own_with"] if ego and "own_with" in entry else entry["with"])
    elif ego and "ego" in entry:
        phrase = str(entry["ego"])
    if side is not None and side in entry:
        phrase = str(entry[side]) + (" for {}" if has_object and "with" in entry else "")
    return phrase.replace("{own}", "my" if ego else "its")


def verb_phrase(
    action: ActionName,
    actor: Thing,
    target: Thing | None,
    side: Side | None = None,
    *,
    roundabout: bool = False,
    time: float | None = None,
) -> tuple[str, tuple[object, ...]]:
    """Return the verb and what follows it, with the object in its place."""  # fmt: skip
    if isinstance(target, Junction | Exit) and roundabout and action == "continue-next-exit":
        target = None
    if isinstance(target, Junction) and roundabout:
        target = None
    if isinstance(target, Exit) and not roundabout and action in LEAVING:
        return "take", (Who(target, time),)
    phrase = doing(
        action,
        side=side,
        ego=isinstance(actor, Ego),
        roundabout=roundabout,
        has_object=target is not None,
    )
    if target is not None and action in TURNS and not isinstance(target, SITES):
        phrase = f"{doing(action, side=side)} in front of {{}}"
    if "{way}" in phrase and isinstance(target, PLACES):
        phrase = phrase.replace("{way}", "{}")
    if "{way}" in phrase:
        head, _, tail = phrase.partition("{way}")
        owner = Who(target, time, ride=True) if target is not None else None
        return head.strip(), (Owned(owner, "way"), tail.strip()) if owner else ("the way",)
    if action == "merge" and isinstance(target, Lane | Road):
        phrase = "merge into {}"
    if action == "come" and isinstance(target, Ego):
        return doing(action), ()
    head, mark, tail = phrase.partition("{}")
    if not mark or target is None:
        return phrase, ()
    return head.strip(), (Who(target, time), tail.strip())


def subject_of(actor: Thing, action: ActionName | None = None, time: float | None = None) -> Who:
    """Return the subject of a clause: "we" if our car does not act but is moved along."""
    ride = action is not None and bool(table("doings")["action"][action].get("ride"))
    return Who(actor, time, ride=ride, placed=action != "come")


def event_clause(
    event: Event, now: float, *, tense: Tense | None = None, negated: bool = False
) -> Clause:
    """Return an event as a clause, by default in its own tense."""
    told, modal = event_tense(event, now)
    if tense is not None:
        told, modal = tense, None
    negated = negated and not isinstance(event.actor, Nobody)  # "nobody does" is a negation already
    at = moment_of(event.time)
    target = event.object
    if told in ("present", "future") and not negated and _is_meeting(event):
        target = None  # the turn is what is expected, not the one it meets
    if event.action == "leave" and isinstance(target, Junction) and event.actor != Ego():
        target = msgspec.structs.replace(target, rank=None)  # the one that it is in
    verb, rest = verb_phrase(event.action, event.actor, target, event.side, time=at)
    if negated:
        rest = tuple(map(denied, rest))
    obliged = modal == "must"
    manners = table("doings")["manner"]
    told_by_verb = ("first",) if event.action == "let-go" else ()
    adverbs: tuple[object, ...] = tuple(
        str(manners[m]) for m in event.manner if m in manners and m not in told_by_verb
    )
    *head, last = verb.split(" ")
    if adverbs and rest and last in _PREPOSITIONS:  # "brake hard for"
        verb, adverbs = " ".join((*head, *map(str, adverbs), last)), ()
    coming = event.action in ("come", "approach")  # the verb itself means towards us
    if event.where is not None and not coming and not isinstance(event.where.to, Unknown):
        place = word("doings", "relation", event.where.relation).lstrip("+!").partition(" ")[2]
        place = _AS.get(event.where.relation, place)
        adverbs = (*adverbs, place, Who(event.where.to, at))
    if event.then is not None:
        after = event_clause(
            msgspec.structs.replace(
                event.then, tense=event.tense, time=event.time, modal=event.modal
            ),
            now,
            tense=tense,
            negated=negated,
        )
        adverbs = (*adverbs, "and then", Bare(after))
    lasting = told == "present" and modal is None and event.action not in STATES
    if obliged:
        verb, modal = f"have to {verb}", None
    told_of = ("still",) if negated else ("still", "already")
    adverb = next((m for m in event.manner if m in told_of), "")
    return Clause(
        subject_of(event.actor, event.action, at),
        verb,
        (*rest, *adverbs),
        told,
        progressive=lasting,
        negated=negated,
        modal=modal,
        adverb=adverb,
    )


def denied(part: object) -> object:
    """Return a part for a negated verb, with "anybody" in place of nobody."""
    if isinstance(part, Owned) and denied(part.owner) != part.owner:
        return f"{denied(part.owner)}'s {part.noun}"
    if not isinstance(part, Who) or not isinstance(part.thing, Nobody):
        return part
    of = part.thing.described
    if of is None or (of.kind == "vehicle" and of.colour is None):
        return "anybody"
    named = of.colour, word("vehicles", "kind", of.kind)
    return " ".join(("any", *filter(None, named)))


def episode_clause(
    episode: Episode, now: float, *, tense: Tense | None = None, negated: bool = False
) -> Clause:
    """Return an episode as a clause: past, or progressive while it goes on."""
    over = episode.end
    going_on = over is None or (goes_on(episode, now) and over > episode.begin)
    told: Tense = tense or ("past" if not going_on or episode.begin > now else "present")
    if tense is None and episode.begin > now + PRESENT:
        told = "future"
    place = episode.place
    roundabout = place is not None and place.form == "roundabout"
    target = episode.object
    if roundabout and episode.exit is not None:
        target = Exit(episode.exit)
    time = episode.begin if told == "past" else None
    halted = episode.action == "stop" and over is None and episode.standing and told == "present"
    verb, rest = verb_phrase(
        "stand" if halted else episode.action, episode.actor, target, episode.side,
        roundabout=roundabout, time=time,
    )  # fmt: skip
    return Clause(
        subject_of(episode.actor, episode.action, time),
        verb,
        rest,
        told,
        progressive=told == "present",
        negated=negated,
    )


def _is_meeting(event: Event) -> bool:
    """Check whether an event is a turn in front of somebody."""
    return event.action in TURNS and not isinstance(event.object, SITES)


def relative_clause(event: Event, now: float) -> Clause:
    """Return an event as a relative clause: "that cut in", "that I waited for"."""
    clause = event_clause(event, now)
    if not isinstance(event.actor, Ego):
        return replace(clause, subject="that")
    verb, rest = verb_phrase(event.action, event.actor, Pronoun("it"), event.side)
    rest = tuple(part for part in rest if isinstance(part, str))
    return replace(clause, verb=verb, rest=rest, lead="that")


def state_word(state: str, too: bool = False) -> str:
    """Return the adjective for a state."""
    adjective = word("doings", "state", state)
    return f"too {adjective}" if too else adjective
