"""Which: questions for one of a sort: "which exit", "what colour", "which car is the fastest"."""

from typing import Any, cast

from msgspec import structs

from xavi_dialogue.domain.meaning import (
    HowMuch,
    HowSure,
    Identify,
    Listing,
    Peak,
    Question,
    WhatWouldChange,
    When,
    Where,
    Which,
    Why,
)
from xavi_dialogue.domain.terms import (
    Back,
    Caused,
    Compares,
    Described,
    Ego,
    Event,
    Exists,
    Exit,
    Feature,
    Happens,
    Junction,
    Lane,
    Measured,
    Passenger,
    Pronoun,
    Rank,
    Related,
    Relative,
    Road,
    That,
    Thing,
    Unsaid,
    Wanted,
)
from xavi_dialogue.domain.vocabulary import Extreme
from xavi_dialogue.nlu.compose.clauses.adoption import with_fields
from xavi_dialogue.nlu.compose.clauses.candidates import Special
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.extents import extreme_of
from xavi_dialogue.nlu.compose.clauses.nominal import asked_of
from xavi_dialogue.nlu.compose.clauses.peaks import most_of, of_choice
from xavi_dialogue.nlu.compose.clauses.sem import Measure, Moment, Noun, SideOf, as_thing
from xavi_dialogue.nlu.compose.propositions.severally import MUTUAL
from xavi_dialogue.nlu.compose.verbs.others import nearest, placed
from xavi_dialogue.nlu.compose.wh_questions.lasting import is_aimed, meanwhile, measured
from xavi_dialogue.nlu.compose.wh_questions.towards import reference
from xavi_dialogue.nlu.compose.wh_questions.wh import (
    Wh,
    actor_of,
    content_of,
    fact,
    held_then,
    time_of,
)


def _moment(clause: Clause, value: Any) -> Any:
    """Tell the time of a value: that of the deed in "what speed did you take the bend at"."""
    if isinstance(value, Happens) and isinstance(value.event.time, Unsaid):
        return meanwhile(clause, value.event)
    return time_of(clause, value)


def _is_for_us(of: Any) -> bool:
    """Tell whether it is asked which light is the one for us: "which light applies to us?"."""
    match of:
        case Happens(event=Event(actor=Feature(kind="light"), action=action)):
            return action not in ("show", "turn-colour")
        case Exists(thing=Feature(kind="light")) | Related(thing=Feature(kind="light"), to=Ego()):
            return True
    return False


class WhichOne:
    """Builds questions that "which" asks."""

    def which(self, wh: Wh, clause: Clause, value: Any) -> Question:
        """Ask which of a sort: "which exit", "what colour", "which car is the fastest"."""
        sem = wh.sem
        actor = as_thing(clause.subject)
        if isinstance(actor, (Wanted, Passenger)):
            actor = None
        ours = actor is None or isinstance(actor_of(value, actor), Ego)
        if sem is None and value is not None and _is_for_us(fact(value)):
            return Identify(Feature("light"))
        match sem:
            case Measure(of=Measured(attribute="heading")) if ours:
                return self._way(clause, value, actor)
            case Measure() if wh.preposition == "at" and _is_bare(value):
                of = sem.of  # "and at what speed?": of what was just spoken of
                return HowMuch(with_fields(of, time=Back("during"), tense="past"), sem.extreme)
            case Measure() if (end := end_of(wh, value)) is not None:
                of = structs.replace(sem.of, thing=actor or Ego(), tense="past")
                if _is_bare(value):  # "and from what speed?": of what was just spoken of
                    return HowMuch(structs.replace(of, time=Back("during")), end)
                return HowMuch(structs.replace(of, event=value.event), end)
            case Measure():
                return self._attribute(sem, clause, value, actor)
            case Noun(key="prediction") if any(key == "wrong" for key, _ in clause.adjectives):
                return Listing("wrong-predictions", time=clause.time)
            case Noun(key="decision") if most := of_choice(most_of(clause), ("decision",)):
                return Peak(cast(Any, most), clause.time)
            case Noun(key="event") | Event(action="do") if most := most_of(clause):
                return Peak(cast(Any, of_choice(most, wh.words)), clause.time)
            case Noun():
                return self._abstract(sem, clause, value)
            case Exit():
                whose = actor_of(value, actor)
                return HowMuch(
                    Measured(
                        "exit-number",
                        Ego() if isinstance(whose, Pronoun) else whose,
                        time=time_of(clause, value),
                        tense=cast(Any, clause.tense),
                    )
                )
            case Road() if clause.verb is None and isinstance(actor, Ego | Pronoun | None):
                return Where(Ego(), time_of(clause, value))  # roads have no names here
            case Lane():
                if (actor is None or isinstance(actor, Lane)) and clause.objects:
                    actor = as_thing(clause.objects[0][0])
                return measured("lane", clause, actor_of(value, actor))
            case SideOf() | None if wh.words and wh.words[-1] in ("way", "direction", "side"):
                return self._way(clause, value, actor)
            case Moment():
                return When(fact(value)) if value is not None else When(That())
        if getattr(sem, "kind", None) == "way" or wh.words[-1:] in (("way",), ("direction",)):
            return self._way(clause, value, actor)
        return self._which_one(wh, clause, value)

    def _which_one(self, wh: Wh, clause: Clause, value: Any) -> Question:
        thing = as_thing(wh.sem) or Wanted()
        if thing == Feature("line") and not isinstance(clause.subject, Ego | Lane):
            named = [as_thing(sem) for sem, _ in clause.objects]
            whose = named[0] if named and actor_is_open(clause) else as_thing(clause.subject)
            return measured("writing", clause, whose)  # "which line is it?"
        taken = clause.verb is not None and clause.verb.key == "take"
        if taken and isinstance(clause.subject, Ego) and thing in _BARE:
            return way_at(Ego(), time_of(clause, value), clause.tense)
        extreme = extreme_of(clause)
        if isinstance(thing, Described | Wanted):
            thing = thing if isinstance(thing, Described) or extreme is None else Described()
        if isinstance(thing, Described):
            if extreme is not None:
                return Identify(with_fields(thing, extreme=extreme, definite=True))
            thing = structs.replace(thing, definite=True)
        if value is None:
            return Which(thing)
        of = fact(value)
        near = clause.focus & {"closest", "nearest"} and isinstance(of, Related) and of.to == Ego()
        if near and isinstance(thing, Described) and isinstance(of, Related):
            return Identify(nearest(of, thing))
        if isinstance(of, Caused) and isinstance(of.cause, Wanted):
            return WhatWouldChange(of.effect, most=True)
        if isinstance(of, Related) and of.relation == "same-as":
            other = of.to if isinstance(of.thing, Wanted) else of.thing
            return Identify(other)
        return Which(thing, of)

    def _way(self, clause: Clause, value: Any, actor: Thing | None) -> Question:
        shown = fact(value) if value is not None else None
        if isinstance(shown, Happens) and shown.event.action == "signal":
            return way_at(actor_of(value, actor), time_of(clause, value), clause.tense, "indicator")
        return way_at(actor_of(value, actor), time_of(clause, value), clause.tense)

    def _attribute(self, sem: Measure, clause: Clause, value: Any, actor: Thing | None) -> Question:
        measure = sem.of
        if measure.attribute == "speed" and "semi-allowed" in clause.aux:
            return measured("limit", clause, actor)
        if measure.attribute == "probability":
            return HowSure(held_then(clause, content_of(clause, value)), clause.time)
        thing = None if isinstance(clause.subject, Measure) else actor
        if clause.objects and thing is None:
            thing = as_thing(clause.objects[0][0])
        if isinstance(value, Related) and thing is not None and value.thing == thing:
            thing = placed(value.relation, thing, value.to)  # "the car behind us"
        to = measure.to
        if to is None and measure.attribute in MUTUAL:
            to = reference(clause)  # "what gap do you leave to the bus"
        aimed = measure.attribute == "speed" and is_aimed(clause, thing)
        tense: Any = "future" if aimed else clause.tense
        return HowMuch(
            Measured(measure.attribute, thing or measure.thing, to, measure.event, None,
                     _moment(clause, value), tense), sem.extreme,
        )  # fmt: skip

    def _abstract(self, sem: Noun, clause: Clause, value: Any) -> Question:
        if isinstance(value, Special) and value.name in ("matter", "influence"):
            return WhatWouldChange(None, most=True)  # "which factor mattered most?"
        if sem.key == "factor" and isinstance(clause.subject, Wanted) and value is not None:
            match held := fact(value):
                case Caused(effect=effect) if effect is not None:
                    return Why(effect)  # "what factor made you stop?"
                case Compares() | Happens():
                    return Which(Wanted(), held)  # "which constraint limits our speed?"
        if sem.key in ("reason", "factor"):
            return Why(fact(value)) if value is not None else Why(That())
        if sem.key == "order":
            thing = as_thing(clause.subject)
            done = value.event if isinstance(value, Happens) else None
            if (
                done is not None
                and done.action not in ("do", "happen", "go")
                and done.actor != Ego()
            ):
                return Listing("events", time=clause.time, event=done)
            return Listing(
                "events", None if isinstance(thing, (Ego, Wanted)) else thing, clause.time
            )
        if sem.key == "time":
            return When(fact(value)) if value is not None else HowMuch(Measured("time"))
        if sem.key in ("way", "side"):
            return self._way(clause, value, as_thing(clause.subject))
        found = asked_of(sem, clause.time, clause.tense)
        return found or Which(Wanted(), fact(value) if value is not None else None)


def end_of(wh: Wh, value: Any) -> Extreme | None:
    """Say which end of a braking the speed is asked for of: "down to what speed", "from which"."""
    slows = isinstance(value, Happens) and value.event.action in ("brake", "slow-down")
    if wh.words[-1:] != ("speed",) or not (slows or _is_bare(value)):
        return None
    ends: dict[str, Extreme] = {"to": "lowest", "into": "lowest", "from": "highest"}
    return ends.get(wh.preposition)


def _is_bare(value: Any) -> bool:
    """Say whether nothing stands with what is asked for: "at what speed?"."""
    return value in (None, Related("same-as", Pronoun("it"), Wanted()))


def actor_is_open(clause: Clause) -> bool:
    """Say whether the subject is what is asked for."""
    return clause.subject is None or isinstance(clause.subject, Wanted)


_BARE = (Wanted(), Described(), Described(definite=False))


def way_at(actor: Thing, time: Any, tense: str, attribute: str = "turn") -> Question:
    """Ask which way somebody goes; what is said of the junction is kept where it is to come."""
    place = getattr(time, "anchor", None) if isinstance(time, Relative) else None
    if tense in ("past", "perfect") or not isinstance(place, Junction):
        place = None
    when = Unsaid() if place is not None or time == Rank(-1) else time
    return HowMuch(Measured(cast(Any, attribute), actor, place, time=when, tense=cast(Any, tense)))
