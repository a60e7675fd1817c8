"""Comparing: whether one action is or would have been better than another."""

from typing import Any, cast

from xavi_dialogue.domain.meaning import Compare, Question, Why
from xavi_dialogue.domain.terms import Ego, Event, Happens, Not, Pronoun, That
from xavi_dialogue.nlu.compose.clauses.adoption import as_of, timed, with_fields
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.sem import Sem, as_thing
from xavi_dialogue.nlu.compose.wh_questions.frames import Frames
from xavi_dialogue.nlu.compose.wh_questions.savings import lane_taken

BY = {
    "fast": "time",
    "soon": "time",
    "safe": "safety",
    "dangerous": "safety",
    "comfortable": "comfort",
    "better": "best",
    "close": "distance",
    "far": "distance",
    "big": "size",
    "small": "size",
    "likely": "probability",
    "slow": "time",
    "long": "time",
    "efficient": "best",
    "late": "time",
    "hard": "comfort",
    "high": "best",
    "low": "best",
    "important": "best",
    "first": "time",
}

#: Words for the worse of two options.
_WORSE = frozenset({
    "worse", "slower", "riskier", "longer", "later", "less", "lower", "costlier",
    "less safe",
})  # fmt: skip


class Comparing(Frames):
    """Builds questions that compare actions."""

    def comparison(self, clause: Clause) -> Question | None:
        """Read "would turning right have been quicker" as a question that compares actions."""
        if _sooner(clause):
            whose = clause.subject
            of = Happens(whose) if isinstance(whose, Event) else That()
            return Compare((_at(of, clause.tense),), "time")
        if not clause.comparisons or clause.comparisons[0][1] == "as":
            return None
        by = cast(Any, BY.get(clause.comparisons[0][0], "best"))
        least = any(word in _WORSE for _, word in clause.comparisons)
        deed: Any = clause.subject if isinstance(clause.subject, Event) else None
        governed = clause.infinitive or clause.gerund
        if deed is None and governed is not None and isinstance(clause.subject, Pronoun):
            governed.subject = Ego()
            deed = self.propositions.as_event(governed)
        if deed is None and clause.modal in ("would", "could"):
            deed = lane_taken(clause)
        spoken = isinstance(clause.subject, Pronoun) and clause.subject.form in (
            "that",
            "it",
            "this",
        )
        unreal = clause.modal in ("would", "could", "might")
        key = clause.comparisons[0][0]
        if deed is None and governed is not None and key == "better" and unreal:
            governed.subject = as_thing(clause.subject) or Ego()
            deed = self.propositions.as_event(governed)
        ours = isinstance(clause.subject, Ego) and clause.verb is None and not clause.than
        if deed is None and key in ("better", "safe", "fast") and ours and unreal:
            return Compare((That(), *self._other(clause)), by, least)
        if not isinstance(deed, Event):
            judged = key in ("safe", "better", "comfortable", "dangerous")
            hypothetical = unreal or judged or isinstance(clause.than, Event | Clause)
            if not (spoken and hypothetical) or clause.verb is not None:
                return None
            return Compare((That(), *self._other(clause)), by, least)
        if unreal:
            deed = with_fields(deed, modal=clause.modal)
        options = (Happens(deed), *self._other(clause))
        return Compare(tuple(_at(option, clause.tense) for option in options), by, least)

    def weighed_deed(self, clause: Clause) -> Happens | None:
        """Read the action in "stopping would have been worse"; if it was worse, it was not done."""
        compare = self.comparison(clause)
        if not isinstance(compare, Compare) or not isinstance(compare.options[0], Happens):
            return None
        deed = compare.options[0]
        worse = any(word in _WORSE for _, word in clause.comparisons)
        return Happens(with_fields(deed.event, modal="would")) if worse else deed

    def outdone(self, clause: Clause) -> Why | None:
        """Read "why is stopping better than driving on": why one deed, and not the other."""
        compare = self.comparison(clause)
        if not isinstance(compare, Compare):
            return None
        told = (_spoken(option, clause) for option in compare.options)
        first, *others = (timed(cast(Any, deed), clause.time) for deed in told)
        if not all(isinstance(deed, Happens) for deed in (first, *others)):
            return None
        least = any(not _WORSE.isdisjoint(word.split()) for _, word in clause.comparisons)
        if not others:  # "why would moving left be worse?"
            return Why(Not(first) if least else first)
        return Why(others[0], first) if least else Why(first, others[0])

    def _other(self, clause: Clause) -> tuple[Any, ...]:
        clauses = [c for c in (clause, clause.infinitive, clause.gerund) if c is not None]
        spoken = [o for c in clauses for o in (c.than, c.contrast) if o is not None]
        than = spoken[0] if spoken else None
        if isinstance(than, Clause):
            if than.subject is None or isinstance(than.subject, Event | Pronoun):
                than.subject = Ego()
            found = self.propositions.plain(than)
            return (found,) if found is not None else ()
        if isinstance(than, Event):
            return (Happens(than),)
        thing = as_thing(cast("Sem | None", than)) if not isinstance(than, str) else None
        return (thing,) if thing is not None else ()


def _at(option: Any, tense: str) -> Any:
    return as_of(option, tense) if isinstance(option, Happens) else option


def _spoken(option: Any, clause: Clause) -> Any:
    """Take "it is worse" as doing what was spoken of."""
    if not isinstance(option, That) or not isinstance(clause.subject, Pronoun):
        return option
    return Happens(Event("do", object=clause.subject, tense=cast(Any, clause.tense)))


def _sooner(clause: Clause) -> bool:
    """Check whether a clause asks if we would have arrived sooner."""
    key = clause.verb.key if clause.verb is not None else ""
    unreal = clause.modal in ("would", "could", "might") or clause.has("have-past")
    sooner = ("soon", "sooner") in clause.comparisons or "early" in clause.manner
    return key in ("get", "arrive", "be") and unreal and sooner
