"""Amounts: "how many cars", "how much time": what is counted or measured of a clause."""

from typing import Any, cast

from msgspec import structs
from msgspec.structs import replace

from xavi_dialogue.domain.meaning import HowLong, HowMany, HowMuch, HowSure, Listing, Question, When
from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Event,
    Exit,
    Happens,
    Is,
    Junction,
    Measured,
    Pronoun,
    Related,
    Relative,
    That,
    Thing,
    Unknown,
    Vehicle,
    Wanted,
)
from xavi_dialogue.nlu.compose.clauses.adoption import with_fields
from xavi_dialogue.nlu.compose.clauses.candidates import Special
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.nominal import counted
from xavi_dialogue.nlu.compose.clauses.sem import Measure, Moment, Noun, Sem, as_thing
from xavi_dialogue.nlu.compose.propositions.specials import proposition_of
from xavi_dialogue.nlu.compose.wh_questions.grades import (
    CHANGING,
    sure_of,
)
from xavi_dialogue.nlu.compose.wh_questions.lasting import (
    SAVING,
    how_often,
    left_over,
    long_lasting,
    measured,
    saving,
    spent_by,
    until,
)
from xavi_dialogue.nlu.compose.wh_questions.towards import (
    WAYS,
    far_to,
    reference,
    remaining,
    until_turn,
)


def amounts(sem: Sem, clause: Clause, value: Any, words: tuple[str, ...] = ()) -> Question:
    """Ask "how many cars", "how much time" of a clause; "how many more turns" are to come."""
    if isinstance(sem, Noun) and sem.key == "wrong-prediction":
        return Listing("wrong-predictions", time=clause.time)  # "how many mistakes ..."
    if isinstance(sem, Event) and _to_come(clause, value, words, sem):
        return HowMany(cast(Event, with_fields(sem, tense="future")))
    actor = as_thing(clause.subject)
    event = value.event if isinstance(value, Happens) else None
    lost = isinstance(value, Special) and value.name in ("cost", "delay", *SAVING)
    counting = isinstance(sem, Noun) and sem.key == "time" and sem.plural and not lost
    if (isinstance(sem, Moment) and sem.unit == "times" and not lost) or counting:
        if event is not None and isinstance(event.actor, Unknown):
            event = with_fields(event, actor=Ego())  # it is the word "times"
        return how_often(value, event) or HowMany(Event("do", time=clause.time))
    if (isinstance(sem, Moment) and (lost or sem.unit in ("s", "min", "h"))) or (
        isinstance(sem, Noun) and sem.key == "time"
    ):
        return _stretch(clause, value, actor, event)
    if isinstance(sem, Moment) and isinstance(value, Is) and value.state == "lost":
        return measured("delay", clause, actor)  # "how many seconds have we lost?"
    if isinstance(sem, Moment):
        return _lengths(sem, clause, value, actor, event)
    if isinstance(sem, Measure) and sem.of.attribute == "speed" and _changes(clause, event):
        return measured("speed-change", clause, actor, event=event)
    if isinstance(sem, Measure) and isinstance(sem.of.event, Event):
        return HowSure(Happens(replace(sem.of.event, tense=clause.tense)), clause.time)
    if isinstance(sem, Measure):
        to = reference(clause)
        if sem.of.attribute == "distance" and to is None and remaining(clause, actor):
            return measured("distance-to-go", clause, Ego())
        whose = Ego() if isinstance(clause.subject, Measure) else actor
        return measured(sem.of.attribute, clause, sem.of.to or whose, to=to)
    if isinstance(sem, Noun) and sem.key in ("side",):
        return measured("distance", clause, actor)
    aboard = value.to if isinstance(value, Related) and value.relation in ("near", "on") else None
    people = isinstance(sem, Described) and sem.kind == "pedestrian"
    if people and isinstance(aboard, Described | Vehicle | Pronoun):
        return measured("occupant", clause, aboard)  # "how many people are on the bus?"
    question = counted(sem)
    driven = clause.tense in ("past", "perfect") and not _to_come(clause, value, ())
    if isinstance(question, HowMany) and isinstance(question.of, Junction) and driven:
        ring = question.of.form == "roundabout"  # "how many roundabouts was that?"
        return HowMany(Event("enter" if ring else "cross", object=question.of))
    if isinstance(question, HowMany) and isinstance(question.of, Exit) and driven:
        return HowMany(Event("pass", object=Exit(), tense=cast(Any, clause.tense)))
    if isinstance(question, HowMany):
        return HowMany(_restricted(question.of, value))
    return question or measured("count", clause, actor)


#: What of ours is counted ahead where the present is spoken of: "how many turns are there".
_AHEAD = WAYS | {"change-left", "change-right", "change-lane"}


def _to_come(clause: Clause, value: Any, words: tuple[str, ...], sem: Sem | None = None) -> bool:
    """Say whether it is asked how many are left, or still to come."""
    ours = isinstance(clause.subject, Ego | None) and clause.tense == "present"
    if ours and isinstance(sem, Event) and sem.action in _AHEAD and isinstance(sem.actor, Ego):
        return True  # "how many turns do we still have"
    coming = isinstance(value, Happens) and value.event.action in ("come", "go", "leave", "move")
    left = clause.side == "left" and clause.verb is None
    ahead = any(key == "ahead" for key, _ in clause.bearings) or clause.tense == "future"
    return "more" in words or left or ahead or (coming and clause.tense != "past")


_GAINING = frozenset({"lose", "gain", "drop", "shed", "put", "add"})


def _changes(clause: Clause, event: Event | None) -> bool:
    """Say whether a clause is of a change of speed: "how much speed did we lose"."""
    if event is not None and event.action in CHANGING:
        return True
    return clause.verb is not None and clause.verb.key in _GAINING


def _stretch(clause: Clause, value: Any, actor: Thing | None, event: Event | None) -> Question:
    if isinstance(clause.time, Relative) and clause.time.relation == "until":
        return until_turn(clause) or until(clause.time.anchor)
    if (turn := until_turn(clause)) is not None:
        return turn
    if isinstance(value, Special) and value.name in ("cost", "delay", *SAVING):
        deed = spent_by(clause, value)
        if value.name in SAVING and deed is None:
            deed = saving(clause)
        return measured("delay", clause, actor, event=deed)
    if left_over(event):
        return HowMuch(Measured("time-to-go"))  # "how much time have we left"
    if event is not None and event.action in WAYS and event.tense in ("present", "future"):
        return When(Happens(with_fields(event, tense="future")))  # "in how many seconds"
    if event is not None:
        return HowLong(event) if event.action != "arrive" else HowMuch(Measured("time-to-go"))
    whom = reference(clause)
    if clause.verb is None and isinstance(whom, Described | Vehicle | Pronoun):
        return measured("headway", clause, actor, to=whom)  # "how many seconds behind it are we"
    return long_lasting(clause, event, value, actor)


def _lengths(
    sem: Moment, clause: Clause, value: Any, actor: Thing | None, event: Event | None
) -> Question:
    if sem.unit in ("kmh", "mph", "ms"):
        return measured("speed", clause, actor)
    if sem.unit == "percent":
        return sure_of(clause, value)
    onward = reference(clause) is None and event is None and until_turn(clause) is None
    if sem.unit in ("km", "mile") and onward:
        return measured("distance-to-go", clause, Ego())
    if event is not None and event.action in WAYS and event.tense in ("present", "future"):
        return HowMuch(Measured("turn", event=event))  # "after how many metres do we turn"
    return far_to(clause, event, value, actor)


def _restricted(of: Thing | Event, value: Any) -> Thing | Event:
    """Say of what is counted what it does: "how many cars can you see"."""
    if not isinstance(of, Described):
        return of
    if isinstance(value, Special):
        value = proposition_of(value)
    if isinstance(value, Related | Is) and _is_in_view(value):
        value = None
    if of.among is not None and (kinds := _kinds(value)) is not None:
        of = structs.replace(kinds, among=of.among)
    elif isinstance(value, Happens):
        of = structs.replace(of, doing=value.event)
    elif value is not None and not isinstance(value, That):
        of = structs.replace(of, such=value)
    return structs.replace(of, plural=True, definite=False)


def _is_in_view(value: Related | Is) -> bool:
    """Say whether it is said of those that are counted just that they are seen, as all are."""
    match value:
        case Related(relation="can-see", thing=Ego(), to=Wanted(), tense="present"):
            return True
        case Is(state="visible", thing=Wanted(), tense="present"):
            return True
    return False


def _kinds(value: Any) -> Described | None:
    """Give what some of those are said to be: "how many of them are bicycles"."""
    match value:
        case Related(relation="same-as", thing=Wanted(), to=Described() as kinds):
            return structs.replace(kinds, plural=True, definite=False)
    return None
