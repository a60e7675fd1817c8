"""Which: questions for one of a sort: "which exit", "what colour", "which car is the fastest"."""

from typing import Any, cast

from xavi_dialogue.domain.meaning import (
    HowMuch,
    HowSure,
    Identify,
    Listing,
    Question,
    WhatWouldChange,
    When,
    Which,
    Why,
)
from xavi_dialogue.domain.terms import (
    Caused,
    Described,
    Ego,
    Exit,
    Lane,
    Measured,
    Passenger,
    Related,
    That,
    Thing,
    Wanted,
)
from xavi_dialogue.nlu.compose.clause import Clause
from xavi_dialogue.nlu.compose.grades import measured
from xavi_dialogue.nlu.compose.nominal import asked_of
from xavi_dialogue.nlu.compose.sem import Measure, Moment, Noun, SideOf, as_thing
from xavi_dialogue.nlu.compose.wh import (
    Wh,
    actor_of,
    content_of,
    fact,
    time_of,
)


class WhichOne:
    """Builds questions that "which" asks."""

    def which(self, wh: Wh, clause: Clause, value: Any) -> Question:
        """Ask which of a sort: "which exit", "what colour", "which car is the fastest"."""
        sem = wh.sem
        actor = as_thing(clause.subject)
        if isinstance(actor, (Wanted, Passenger)):
            actor = None
        match sem:
            case Measure():
                return self._attribute(sem, clause, value, actor)
            case Noun():
                return self._abstract(sem, clause, value)
            case Exit():
                return HowMuch(
                    Measured(
                        "exit-number",
                        actor_of(value, actor),
                        time=time_of(clause, value),
                        tense=cast(Any, clause.tense),
                    )
                )
            case Lane():
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
        extreme = _superlative(clause)
        if isinstance(thing, Described):
            fields: dict[str, Any] = {k: getattr(thing, k) for k in thing.__struct_fields__}
            if extreme is not None:
                return Identify(Described(**{**fields, "extreme": extreme, "definite": True}))
            thing = Described(**{**fields, "definite": True})
        if value is None:
            return Which(thing)
        of = fact(value)
        if isinstance(of, Caused) and isinstance(of.cause, Wanted):
            return WhatWouldChange(of.effect, most=True)
        if isinstance(of, Related) and of.relation == "same-as":
            other = of.to if isinstance(of.thing, Wanted) else of.thing
            return Identify(other)
        return Which(thing, of)

    def _way(self, clause: Clause, value: Any, actor: Thing | None) -> Question:
        time = time_of(clause, value)
        return HowMuch(Measured("turn", actor_of(value, actor), time=time,
                                tense=cast(Any, clause.tense)))  # fmt: skip

    def _attribute(self, sem: Measure, clause: Clause, value: Any, actor: Thing | None) -> Question:
        measure = sem.of
        if measure.attribute == "probability":
            return HowSure(content_of(clause, value), clause.time)
        thing = None if isinstance(clause.subject, Measure) else actor
        if clause.objects and thing is None:
            thing = as_thing(clause.objects[0][0])
        return HowMuch(
            Measured(measure.attribute, thing or measure.thing, measure.to, measure.event, None,
                     time_of(clause, value), cast(Any, clause.tense)), sem.extreme,
        )  # fmt: skip

    def _abstract(self, sem: Noun, clause: Clause, value: Any) -> Question:
        if sem.key in ("reason", "factor"):
            return Why(fact(value)) if value is not None else Why(That())
        if sem.key == "order":
            thing = as_thing(clause.subject)
            return Listing(
                "events", None if isinstance(thing, (Ego, Wanted)) else thing, clause.time
            )
        if sem.key == "time":
            return When(fact(value)) if value is not None else HowMuch(Measured("time"))
        if sem.key in ("way", "side"):
            return self._way(clause, value, as_thing(clause.subject))
        found = asked_of(sem, clause.time, clause.tense)
        return found or Which(Wanted(), fact(value) if value is not None else None)


def _superlative(clause: Clause) -> str | None:
    for sem, _ in clause.objects:
        extreme = getattr(sem, "extreme", None)
        if extreme in ("nearest", "farthest", "fastest", "slowest", "biggest"):
            return cast(str, extreme)
    return None
