"""Refusals, small talk and help: what the car says when it has no explanation to give."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Literal

from xavi_dialogue.explain.explanation import NoExplanation
from xavi_dialogue.explain.query import Query
from xavi_dialogue.language.context import SpeechContext, Utterance
from xavi_dialogue.language.doings import LANE_CHANGES, doing, vehicle_of
from xavi_dialogue.language.generator import expand
from xavi_dialogue.language.morphology import EGO, Doing, Vehicle, inflect
from xavi_dialogue.language.orthography import capitalise, join
from xavi_dialogue.language.quantities import Quantity
from xavi_dialogue.language.questions import question, questions
from xavi_dialogue.language.rules import load_grammar
from xavi_dialogue.language.suggestions import about_vehicle, answerable, fresh, from_situation
from xavi_dialogue.language.wording import lexicon, rewrite

MAX_CHOICES = 4
WAYS = 3  # in which the end of all reasons is worded
MAX_KNOWN = 5  # vehicles that are listed


@dataclass(frozen=True, slots=True)
class Choice:
    """One reading between which the passenger chooses."""

    number: Quantity
    question: str


@dataclass(frozen=True, slots=True)
class Refusal:
    """What `grammars/answer_refusals.rules` says of a refusal; absent facts are None."""

    reason: str  # of the contract, or smalltalk, help
    topic: str | None = None  # of out-of-scope, small talk, or what was not understood
    verb: str | None = None  # what cannot be done at all: "fly"
    past: bool = True
    ahead: bool = False  # it is asked about what is to come
    who: Vehicle | None = None  # the vehicle it is about; None: us
    asked: Doing | None = None  # what the question takes for granted, or asks about
    instead: Doing | None = None  # what happened in its place
    did: bool = False  # what was asked about is what was done
    undone: bool = False  # what was asked about is that it had not been done
    coming: Doing | None = None  # up to what we drive on
    only: bool = False  # what happened in its place is all that happened so far
    planned: bool = False  # what was asked about is yet to come ...
    probability: float | None = None  # ... and how probably
    chance: Quantity | None = None  # the same, to be told
    at: Quantity | None = None  # when that was
    landmark: bool = False  # the topic is a place at which it was
    elsewhere: bool = False  # what happened is what was asked about, at another time
    once: bool = False  # it happened just once, ...
    times: Quantity | None = None  # ... or so many times
    way: int = 0  # in which of the ways it is worded
    since: Quantity | None = None  # the record goes from here ...
    until: Quantity | None = None  # ... to here
    beyond: bool = False  # it is asked about what the plan does not reach
    clause: str | None = None  # the planner's reason
    known: tuple[Vehicle, ...] = ()  # some of them, where they are many ...
    many: Quantity | None = None  # ... and then how many there are
    nobody: str | None = None  # that nobody is at the place where the question has somebody, ...
    then: bool = False  # ... or was, at the time it names
    seen: bool = True  # the decision reckoned with the vehicle
    close: bool = False  # the times of arrival that were compared are the same to half a second
    tried: float | None = None  # distinct situations behind the evidence there is ...
    found: Quantity | None = None  # ... to be put into words
    needed: Quantity | None = None
    share: Quantity | None = None  # of all that may happen, behind that evidence
    suggestion: str | None = None  # a question that can be asked
    last: str | None = None  # the question that was asked last


#: Manoeuvres whose side the question left open.
SIDELESS = {
    "change-left": "change-lanes",
    "change-right": "change-lanes",
    "exit-left": "turn",
    "exit-right": "turn",
}


def refuse(query: Query, refusal: NoExplanation, context: SpeechContext) -> Utterance:
    """Say what is wrong with the question, and what can be asked instead."""
    about = (*refusal.suggestions, *about_vehicle(query, context))
    invited = (*answerable(about, context), *from_situation(context))
    offered = questions(fresh(invited, (query,)))
    content = _content(query, refusal, _unsaid(offered, context))
    content = replace(content, way=context.turn % WAYS)
    return _speak(_shortened(content, context), context, offered)


def realise_not_understood(
    cause: str, context: SpeechContext, readings: tuple[Query, ...] = ()
) -> Utterance:
    """Ask back: which of the readings is meant, or for other words.

    `cause` is empty, too-long, gibberish, ambiguous, what the text lacks (a key of
    malformed.toml), or another that gets the general wording.
    """
    choices = questions(readings, MAX_CHOICES)
    if len(choices) > 1:
        return realise_clarification(choices, context)
    offered = choices or questions(from_situation(context))
    return _chat("not-understood", cause, context, offered)


def realise_clarification(choices: tuple[str, ...], context: SpeechContext) -> Utterance:
    """Ask which of the questions is meant; they are numbered from 1 in the order given."""
    numbered = tuple(Choice(Quantity(i, "count"), c) for i, c in enumerate(choices, 1))
    tokens = expand(load_grammar("answer_refusals"), "CHOOSE", numbered)
    words, _ = inflect(tokens, context)
    return Utterance(capitalise(join(words)), choices=choices)


def realise_smalltalk(topic: str | None, context: SpeechContext) -> Utterance:
    """A friendly word on a greeting, thanks, assent, a question of identity, or anything else.

    Of topic `recall`, which question was asked last; of `recall-first`, which was the first.
    """
    offered = questions(from_situation(context))
    told = [question(query) for query in context.asked if _telling(query)]
    last = next(iter(told if topic == "recall-first" else reversed(told)), None)
    content = Refusal("smalltalk", topic, suggestion=_unsaid(offered, context), last=last)
    return _speak(content, context, offered)


def realise_help(context: SpeechContext) -> Utterance:
    """What can be asked, with examples from the situation."""
    return _chat("help", None, context, questions(from_situation(context)))


def _telling(query: Query) -> bool:
    return query.type not in ("smalltalk", "help", "ambiguous", "out_of_scope")


def _chat(
    reason: str, topic: str | None, context: SpeechContext, offered: tuple[str, ...]
) -> Utterance:
    content = Refusal(reason, topic, suggestion=_unsaid(offered, context))
    return _speak(content, context, offered)


def _speak(content: Refusal, context: SpeechContext, suggestions: tuple[str, ...]) -> Utterance:
    tokens = expand(load_grammar("answer_refusals"), "REFUSAL", content)
    words, mentioned = inflect(tokens, context)
    text = capitalise(rewrite(join(words), "passenger"))
    return Utterance(text, mentioned, suggestions)


def _shortened(content: Refusal, context: SpeechContext) -> Refusal:
    """With no more vehicles than are worth a list, those in view first."""
    if len(content.known) <= MAX_KNOWN:
        return content
    near = sorted(content.known, key=lambda v: (v.number not in context.vehicles, v.number))
    known = tuple(sorted(near[:MAX_KNOWN], key=lambda v: v.number))
    return replace(content, known=known, many=Quantity(len(content.known), "count"))


def _unsaid(offered: tuple[str, ...], context: SpeechContext) -> str | None:
    """The first of what can be asked that has not been said lately."""
    return next((one for one in offered if one not in context.suggested), None)


def _content(query: Query, refusal: NoExplanation, suggestion: str | None) -> Refusal:
    """The facts of a refusal as values that can be put into words; unfit ones are left out."""
    facts = refusal.facts
    named = _name(facts, "vehicle")
    actor = vehicle_of(query.actor) if named is None else named
    factual, foil = query.factual or (), query.counterfactual or ()
    claimed = foil if query.type in ("why_not", "what_if", "compare") else factual
    asked = _actions(facts, "asked") or claimed or factual or foil
    if refusal.reason == "too-little-evidence" and actor:
        asked = claimed  # what was tried too little is what we would do then
    instead = _actions(facts, "happened")
    clause, place = _text(facts, "reason"), _text(facts, "place")
    did = facts.get("did") is True
    sideless = query.underspecified == "direction" and not did
    if sideless and refusal.reason == "did-not-happen":
        asked = tuple(SIDELESS.get(action, action) for action in asked)
    return Refusal(
        reason=refusal.reason,
        topic=_text(facts, "what") or query.reason,
        verb=_text(facts, "verb") or query.event,
        past=query.tense == "past",
        ahead=query.tense == "future",
        who=Vehicle(actor) if actor else None,
        asked=doing(actor or EGO, asked, query.tense, in_lane=_moved(facts)),
        instead=doing(actor or EGO, instead, "past"),
        did=did,
        undone=facts.get("undone") is True,
        coming=doing(EGO, _actions(facts, "coming"), "future"),
        only=instead == ("continue",) and "time" not in facts,
        planned=facts.get("planned") is True,
        probability=_number_of(facts, "probability"),
        chance=None if sideless else _quantity(facts, "probability", "probability"),
        at=_quantity(facts, "time", "clock"),
        landmark=facts.get("what") in ("junction", "roundabout"),
        elsewhere=facts.get("elsewhere") is True,
        once=facts.get("times") == 1,
        times=_quantity(facts, "times", "count"),
        since=_quantity(facts, "since", "clock"),
        until=_quantity(facts, "until", "clock"),
        beyond=facts.get("ahead") is True,
        clause=clause if clause is None or actor else rewrite(clause, "own"),
        known=_vehicles(facts),
        nobody=None if place is None else lexicon().nobody_at(place),
        then=facts.get("then") is True,
        seen=facts.get("seen") is not False,
        close=abs(_number_of(facts, "delta") or math.inf) < 0.5 or facts.get("delta") == 0.0,
        tried=_number_of(facts, "distinct"),
        found=_quantity(facts, "distinct", "count"),
        needed=_quantity(facts, "needed", "count"),
        share=_quantity(facts, "coverage", "probability"),
        suggestion=suggestion,
    )


_Facts = Mapping[str, object]
Unit = Literal["clock", "count", "probability"]


def _moved(facts: _Facts) -> bool:
    """Whether what is asked about stands against a change of lane."""
    return any(action in LANE_CHANGES for action in _actions(facts, "chosen"))


def _text(facts: _Facts, key: str) -> str | None:
    value = facts.get(key)
    return value if isinstance(value, str) and value.strip() else None


def _name(facts: _Facts, key: str) -> int | None:
    """A vehicle's number, given as such or as its name."""
    value = facts.get(key)
    if isinstance(value, str):
        return vehicle_of(f"vehicle:{value.rpartition(' ')[2].rpartition(':')[2]}")
    return value if isinstance(value, int) and not isinstance(value, bool) else None


def _actions(facts: _Facts, key: str) -> tuple[str, ...]:
    """Actions the lexicon has words for, given as one name or several."""
    value = facts.get(key)
    names = (value,) if isinstance(value, str) else value
    known = lexicon().actions
    return tuple(n for n in names if n in known) if isinstance(names, tuple | list) else ()


def _quantity(facts: _Facts, key: str, unit: Unit) -> Quantity | None:
    value = _number_of(facts, key)
    return None if value is None else Quantity(value, unit)


def _number_of(facts: _Facts, key: str) -> float | None:
    value = facts.get(key)
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
        return None
    return float(value)


def _vehicles(facts: _Facts) -> tuple[Vehicle, ...]:
    """The vehicles that are known, without us, each once and in order."""
    value = facts.get("known")
    numbers = {_name({"n": n}, "n") for n in value} if isinstance(value, tuple | list) else set()
    return tuple(Vehicle(n) for n in sorted(filter(None, numbers)))
