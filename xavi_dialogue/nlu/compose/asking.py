"""Asking: a question word and a clause become a question."""

from typing import Any, cast

from xavi_dialogue.domain.meaning import (
    HowAvoid,
    HowDecide,
    HowKnow,
    HowMuch,
    HowSure,
    Listing,
    Question,
    When,
    Where,
    Whither,
    Why,
)
from xavi_dialogue.domain.terms import (
    Ego,
    Exists,
    Happens,
    Is,
    Measured,
    Related,
    That,
)
from xavi_dialogue.nlu.compose.adoption import with_fields
from xavi_dialogue.nlu.compose.candidates import Special
from xavi_dialogue.nlu.compose.clause import Clause
from xavi_dialogue.nlu.compose.grades import amounts, graded, measured
from xavi_dialogue.nlu.compose.nominal import propose
from xavi_dialogue.nlu.compose.sem import Measure, Noun, Sem, as_thing
from xavi_dialogue.nlu.compose.wh import Wh, content_of, deed_of, fact, is_that, time_of
from xavi_dialogue.nlu.compose.what import What
from xavi_dialogue.nlu.compose.which import WhichOne

_MOVING = frozenset({"go", "head", "move", "turn", "leave", "take-turn", "continue", "exit-left",
                     "exit-right", "change-lane"})  # fmt: skip


class Asking(What, WhichOne):
    """Builds questions."""

    def why(self, clause: Clause, value: Any) -> Question:
        """Ask why it is so, or not."""
        if value is None:
            return Why(propose(clause.subject) or That())
        if isinstance(value, Special) and value.name == "change":
            return HowSure(None, clause.time, changed=True)
        of = fact(value)
        if isinstance(of, Happens) and of.event.action == "do" and is_that(of.event.object):
            of = Happens(of.event)
        suspect = as_thing(clause.because) if not isinstance(clause.because, Clause) else None
        return Why(of, suspect=suspect)

    # --- which -------------------------------------------------------

    # --- where, when, how --------------------------------------------

    def where(self, wh: Wh, clause: Clause, value: Any) -> Question:
        """Ask for a place, a way to go or an origin."""
        actor = as_thing(clause.subject) or Ego()
        source = (
            wh.key == "whence"
            or wh.preposition == "from"
            or any(phrase.key == "from" and phrase.sem is None for phrase in clause.complements)
        )
        event = value.event if isinstance(value, Happens) else None
        if source or (event is not None and event.action in ("come", "appear")):
            return measured("origin", clause, event.actor if event else actor)
        if wh.key == "whither" or (
            event is not None and event.action in _MOVING and _onward(clause)
        ):
            return Whither(event.actor if event else actor, time_of(clause, value))
        if event is not None:
            return Where(event, clause.time)
        if value is None or isinstance(value, (Special, Related, Is, Exists)):
            if isinstance(value, Exists):
                return Where(value.thing, clause.time)
            if isinstance(value, Special) and value.name == "look":
                return Listing("vehicles", time=clause.time)
            return Where(actor, clause.time)
        return Where(actor, clause.time)

    def when(self, clause: Clause, value: Any) -> Question:
        """Ask at what time."""
        if value is None:
            return When(propose(clause.subject) or That())
        if isinstance(value, Special) and value.name in ("end", "begin"):
            of = value.content or fact(value)
            if isinstance(of, Happens):
                of = Happens(with_fields(of.event, tense=clause.tense))
            return When(of, "end" if value.name == "end" and value.content else "begin")
        if isinstance(value, Special) and value.name == "change":
            return HowSure(None, clause.time, changed=True)
        return When(fact(value))

    def how(self, clause: Clause, value: Any) -> Question:
        """Ask in what manner, by what evidence, or how to avoid."""
        if isinstance(value, Special):
            found = self._how_special(clause, value)
            if found is not None:
                return found
        if value is None:
            subject = clause.subject
            if isinstance(subject, Noun) and subject.key == "ride":
                return HowMuch(Measured("comfort", time=clause.time, tense=cast(Any, clause.tense)))
            if isinstance(subject, Measure):
                return HowMuch(subject.of, subject.extreme)
            return HowDecide(propose(subject) or That())
        of = fact(value)
        if isinstance(of, Happens) and of.event.action == "avoid":
            return HowAvoid(None if is_that(of.event.object) else propose(deed_of(of.event)))
        if isinstance(of, Happens) and of.event.action == "happen":
            return Why(That())
        return HowDecide(of)

    def _how_special(self, clause: Clause, value: Special) -> Question | None:
        match value.name:
            case "know" | "believe" | "conclude" | "see" | "say" | "tell" | "hear" | "find":
                content = value.content
                if content is None and value.object is not None and value.name == "see":
                    return HowKnow(fact(value))
                return HowKnow(content)
            case "decide" | "choose" | "plan" | "consider":
                return HowDecide(value.content or propose(value.object))
            case "prevent" | "improve":
                return HowAvoid(value.content or propose(value.object))
            case "score":
                return HowMuch(Measured("value", value.subject, time=clause.time))
            case "change":
                return HowSure(None, clause.time, changed=True)
            case "cost" | "take-time":
                return measured("delay", clause, value.subject)
            case "happen":
                return Why(That())
            case "work" | "do":
                return HowDecide(None if value.name == "work" else fact(value))
        return None

    # --- dispatch ----------------------------------------------------

    def ask(self, wh: Wh, clause: Clause, value: Any) -> Question:
        """Build the question that a question word asks of a clause."""
        match wh.kind:
            case "why":
                return self.why(clause, value)
            case "evidence":
                return HowKnow(content_of(clause, value))
            case "what" | "who" | "whose":
                return self.what(wh, clause, value)
            case "where":
                return self.where(wh, clause, value)
            case "when":
                return self.when(clause, value)
            case "grade":
                return graded(wh.key, wh.words, clause, value)
            case "count":
                return amounts(cast(Sem, wh.sem), clause, value)
            case "which":
                return self.which(wh, clause, value)
        return self.how(clause, value)


def _onward(clause: Clause) -> bool:
    return (
        clause.tense in ("present", "future")
        or clause.has("be")
        or clause.modal in ("must", "want", "should")
    )
