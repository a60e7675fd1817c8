"""Grades: "how fast", "how long", "how many": measures asked of a clause."""

from typing import Any, cast

from msgspec.structs import replace

from xavi_dialogue.domain.meaning import (
    Compare,
    HowLong,
    HowMany,
    HowMuch,
    HowSure,
    Question,
    WhatIf,
    When,
    Whether,
)
from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Event,
    Exit,
    Feature,
    Happens,
    Is,
    Junction,
    Measured,
    Not,
    Pronoun,
    Proposition,
    Related,
    Relative,
    Tense,
    Thing,
    Wanted,
)
from xavi_dialogue.nlu.compose.alternatives.nearness import how_near
from xavi_dialogue.nlu.compose.clauses.adoption import with_fields
from xavi_dialogue.nlu.compose.clauses.candidates import Special
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.risks import crash_beside, moving_in
from xavi_dialogue.nlu.compose.clauses.sem import Measure, as_thing, between, each_other, is_thing
from xavi_dialogue.nlu.compose.clauses.times import is_moment
from xavi_dialogue.nlu.compose.states.predicates import tense_of
from xavi_dialogue.nlu.compose.wh_questions.lasting import (
    how_often,
    left_over,
    long_lasting,
    measured,
    pace,
    spent_by,
)
from xavi_dialogue.nlu.compose.wh_questions.savings import UNREAL
from xavi_dialogue.nlu.compose.wh_questions.towards import far_to, reference, remaining, until_turn
from xavi_dialogue.nlu.compose.wh_questions.wh import content_of, held_then, sureness

_PACES = frozenset({"faster", "slower", "quicker"})
_PASSING = frozenset({"avoid", "nearly-collide", "pass", "overtake"})
CHANGING = frozenset({"slow-down", "speed-up"})


def graded(grade: str, words: tuple[str, ...], clause: Clause, value: Any) -> Question:
    """Ask for the measure that "how" and an adjective name of a clause."""
    event = value.event if isinstance(value, Happens) else None
    if isinstance(value, Not) and isinstance(value.content, Happens):
        event = value.content.event
    actor = event.actor if event is not None else as_thing(clause.subject)
    if grade in _LENGTHS and (pair := apart(clause, actor, words)) is not None:
        return measured("distance", clause, pair[0], to=pair[1])
    match grade:
        case "fast" if _permitted(clause):
            return measured("limit", clause, actor if isinstance(actor, Described) else Ego())
        case "fast":
            return pace(clause, event, actor, words)
        case "hard" if isinstance(clause.subject, Event):
            deed = clause.subject
            return measured("deceleration", clause, deed.actor, event=deed)
        case "hard":
            return measured("deceleration", clause, actor, event=event)
        case "far":
            on = {"further", "farther"} & set(words) and not isinstance(actor, Described)
            if on and reference(clause) is None and not isinstance(actor, (Exit, Junction)):
                return measured("distance-to-go", clause, Ego())
            return far_to(clause, event, value, actor, words)
        case "close" if (even := how_near(clause)) is not None:
            return even
        case "close":
            return _close(clause, event, value, actor)
        case "long":
            asked = until_turn(clause) or _for_whom(
                long_lasting(clause, event, value, actor), clause
            )
            return _from_now(asked) if {"longer", "more"} & {*words} else asked
        case "big" if isinstance(actor, Feature) and (to := reference(clause)) is not None:
            return measured("distance", clause, Ego(), to=to)  # "the space to the lorry"
        case "big" if isinstance(clause.subject, Measure):
            return measured("distance", clause, actor, to=clause.subject.of.to)
        case "big":
            return measured("size", clause, actor)
        case "likely":
            return sure_of(clause, value)
        case "often":
            return how_often(value, event) or HowMany(Event("do"))
        case "late":
            if event is not None:
                return When(Happens(event))
            return measured("delay", clause, actor)
        case "faster":
            return _faster(clause, event, actor, bool(_PACES & set(words)))
        case "many" if event is not None and event.action in _DONE_TO and event.object is None:
            done = with_fields(event, object=Wanted())
            return HowMany(Described(doing=cast(Event, done), plural=True, definite=False))
        case "many":
            return HowMany(actor or Described(plural=True, definite=False))
        case "worse" if actor is None and clause.verb is None:
            return HowMuch(UNREAL)
        case "much":
            return _much(clause, value, actor)
        case _:
            return _quality(clause, words, value, actor)


def _for_whom(asked: Question, clause: Clause) -> Question:
    """Add to a waiting who caused it: "how long did they wait because of us?"."""
    whom = None if isinstance(clause.because, Clause) else as_thing(clause.because)
    match asked:
        case HowLong(of=Event(action="wait", object=None) as event) if whom is not None:
            return HowLong(with_fields(event, object=whom))
    return asked


def _faster(clause: Clause, event: Event | None, actor: Thing | None, pace: bool) -> Question:
    """Ask how much faster: of speeds where a pace is named, else of times."""
    verb = clause.verb
    if pace and event is None and verb is None:
        than = None if isinstance(clause.than, Clause) else as_thing(clause.than)
        other: Thing = Pronoun("it") if isinstance(actor, Ego | Pronoun | None) else Ego()
        return measured("speed", clause, actor, to=than or other)
    if pace and verb is not None and verb.key in ("get", "become", "grow"):
        return measured("speed-change", clause, actor)
    arrives = event is not None and event.action == "arrive"
    return measured("delay", clause, actor, event=None if arrives else event)


_LENGTHS = frozenset({"far", "big", "close", "much", "long"})


def apart(
    clause: Clause, actor: Thing | None, words: tuple[str, ...]
) -> tuple[Thing, Thing] | None:
    """Find the two others between whom it is measured: "how far apart are they"; None: else.

    Several that are one thing stand on both sides.
    """
    found = (between(phrase.sem) for phrase in clause.complements if phrase.key == "between")
    pair = next((one for one in found if one is not None), None)
    if pair is not None or "apart" not in words:
        return pair
    return each_other(actor)


def _from_now(asked: Question) -> Question:
    """Ask how long something goes on: "how much longer do we sit here"."""
    if not isinstance(asked, HowLong) or getattr(asked.of, "tense", "") != "present":
        return asked
    return HowLong(with_fields(asked.of, tense="future"))


def _permitted(clause: Clause) -> bool:
    """Say whether it is asked how fast one may go: "how fast can we go here?"."""
    able = clause.modal in ("can", "might", "should") and clause.tense == "present"
    allowed = any(key == "allowed" for key, _ in clause.adjectives)
    named = (clause.subject, *(sem for sem, _ in clause.objects))
    allowed |= any(isinstance(s, Measure) and s.of.attribute == "limit" for s in named)
    allowed |= clause.verb is not None and clause.verb.key in ("allow", "permit")
    return allowed or "semi-allowed" in clause.aux or (able and clause.verb is not None)


def _quality(clause: Clause, words: tuple[str, ...], value: Any, actor: Thing | None) -> Question:
    state = {"safe": "safe", "dangerous": "dangerous", "risky": "dangerous", "bad": "dangerous",
             "unsafe": "dangerous", "hazardous": "dangerous",
             "important": "necessary", "necessary": "necessary", "well": "visible",
             "free": "free", "busy": "busy", "old": "right", "crowded": "busy"}  # fmt: skip
    if isinstance(value, Related) and value.relation == "can-see":
        return HowMuch(Measured("visibility", value.to, time=clause.time))
    deed_told = isinstance(value, Happens) and not isinstance(clause.subject, Event)
    event = value.event if deed_told else _weighed(clause, actor)
    name: Any = state.get(words[-1], "safe")
    deed = actor in (Pronoun("that"), Pronoun("it"))
    risk = name in ("safe", "dangerous")
    if clause.modal == "would" and risk and (deed or event is not None):
        collides = HowSure(Happens(Event("collide", modal="would")))
        if event is None:
            return collides  # "how risky would that have been?"
        tense: Tense = "perfect" if clause.has("have") else "present"
        return WhatIf(Happens(replace(event, tense=tense)), collides)
    asked = Is(name, None if event else actor, event, time=clause.time, tense=tense_of(clause))
    return Whether(asked, degree=risk)


def _weighed(clause: Clause, actor: Thing | None) -> Event | None:
    """Find the deed that is called risky: "how risky is moving back?", "... is the left lane?"."""
    if isinstance(clause.subject, Event):
        return replace(clause.subject, tense=tense_of(clause))
    if (change := moving_in(clause, actor)) is not None:
        return change
    deeds = (part.sem for part in clause.complements if isinstance(part.sem, Event))
    deed = next(deeds, None)  # "how risky would it be to move to the left lane?"
    return None if deed is None else replace(deed, tense=tense_of(clause))


def sure_of(clause: Clause, value: Any) -> Question:
    """Ask how sure we are of what a clause says."""
    content: Proposition | None = None
    if isinstance(value, Special):  # "how likely did you think a collision was?"
        content = content_of(clause, value)
    elif isinstance(value, Happens) and not isinstance(value.event.object, Wanted):
        content = value
    elif isinstance(clause.subject, Event):
        if (risk := crash_beside(clause, clause.subject)) is not None:
            return risk
        met = _met(clause, clause.subject)
        unreal = clause.modal == "would" and met.action == "collide"
        content = Happens(replace(met, modal="would") if unreal else met)
    return sureness(clause, held_then(clause, content))


def _met(clause: Clause, deed: Event) -> Event:
    """Add to a deed with whom it is: "a collision with the bus"."""
    found = (as_thing(part.sem) for part in clause.complements if part.key == "with")
    whom = next((thing for thing in found if thing is not None), deed.object)
    return replace(deed, object=whom, tense=tense_of(clause))


def _close(clause: Clause, event: Event | None, value: Any, actor: Thing | None) -> Question:
    to = reference(clause) or (event.object if event is not None else None)
    if to is None and remaining(clause, actor):
        return measured("distance-to-go", clause, Ego())
    before = isinstance(clause.time, Relative) and clause.time.relation == "before"
    if isinstance(clause.time, Relative) and before and to in (None, Ego()):
        anchor = clause.time.anchor  # "how much room before he reaches us"
        if isinstance(anchor, Event) and anchor.tense == "present":
            return HowMuch(Measured("distance", to=anchor.actor))
    owned = clause.verb is not None and clause.verb.words == ("got",)  # "have we got"
    past = clause.tense in ("past", "perfect") and not owned
    at_once = clause.verb is None and is_moment(clause.time)  # "how close was it when we set off"
    extreme = "lowest" if (past and not at_once) or event is not None else None
    if left_over(event) and clause.tense == "perfect":
        return HowMuch(Measured("distance", actor or Ego(), to))  # "how much room have you left"
    return measured("distance", clause, actor, to=to, extreme=extreme)


#: What is done to other road users: "how many have we overtaken?".
_DONE_TO = frozenset({"overtake", "pass", "let-go", "give-way", "wait", "follow"})
_DIFFERENCES = {"fast": "speed", "slow": "speed", "close": "distance", "far": "distance"}


def _much(clause: Clause, value: Any, actor: Thing | None) -> Question:
    subject = clause.subject
    if subject is None and remaining(clause, actor):
        return measured("distance-to-go", clause, Ego())
    if isinstance(subject, Measure) and subject.of.attribute == "speed" and clause.verb is not None:
        return measured("speed-change", clause, subject.of.thing)
    if isinstance(subject, Measure):
        return HowMuch(subject.of, subject.extreme)
    if isinstance(value, Happens) and value.event.action in CHANGING:
        return measured("speed-change", clause, actor, event=value.event)
    if clause.comparisons and clause.comparisons[0][0] in _DIFFERENCES:
        than = None if isinstance(clause.than, Clause) else as_thing(clause.than)
        attribute = _DIFFERENCES[clause.comparisons[0][0]]
        if attribute == "distance" and is_thing(actor) and than is not None:
            far = clause.comparisons[0][0] == "far"
            return Compare((cast(Thing, actor), than), "distance", far)
        return measured(attribute, clause, actor, to=than)
    if isinstance(value, Special) and value.name in ("cost", "delay", "save", "gain", "take-time"):
        return measured("delay", clause, actor, event=spent_by(clause, value))
    if any(key == "allowed" for key, _ in clause.adjectives):
        return measured("limit", clause, Ego())
    if isinstance(value, Happens) and value.event.action in _PASSING:
        to = actor if isinstance(value.event.object, Ego) else value.event.object
        return measured("distance", clause, Ego(), to=to, extreme="lowest")
    if isinstance(value, Happens):
        return measured("deceleration" if value.event.action in ("brake", "slow-down") else "speed",
                        clause, actor, event=value.event)  # fmt: skip
    return measured("count", clause, actor)
