"""Questions: readings of a passenger's words, as indirect and as direct questions.

"Why I stopped" and "Why did you stop?" are two forms of the same parts: see the rules MEANT and
ASKED of `grammars/answer_questions.rules`.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, cast, get_args

from xavi_dialogue.domain import meaning
from xavi_dialogue.domain.answers import WhichOne
from xavi_dialogue.domain.meaning import Act, Ask, Claim, Feel, Request
from xavi_dialogue.domain.terms import Event, Happens, Measured, Not, Proposition, Thing, Wanted
from xavi_dialogue.nlg.content.clauses.clauses import event_clause
from xavi_dialogue.nlg.content.clauses.propositions import clause_of
from xavi_dialogue.nlg.content.clauses.tenses import moment_of, tense_of
from xavi_dialogue.nlg.surface.message import Message
from xavi_dialogue.nlg.surface.quantities import plural
from xavi_dialogue.nlg.surface.tables import word
from xavi_dialogue.nlg.surface.values import Clause, Moment, Owned, Tense, Who

THINGS = get_args(Thing)
BETTER = {"best": "better", "time": "quicker", "safety": "safer", "comfort": "smoother",
          "speed": "faster", "distance": "closer", "probability": "likelier",
          "size": "bigger", "place": "ahead", "margin": "better"}  # fmt: skip


@dataclass(frozen=True, slots=True)
class Asking:
    """An act in parts: the words that ask, and the clause that they ask about."""

    kind: str  # for the rule ASK_WORD, or for MEANT and ASKED
    clause: Clause | None = None
    past: bool = False  # of a supposition
    noun: str | None = None  # what is counted
    who: Who | None = None
    other: Clause | None = None  # the alternative to the clause
    time: float | None = None  # [s] of the ride, if one is meant

    def message(self, rule: str, *, timed: bool = False) -> Message:
        """Return the message of a rule, with the time if it is to be stated."""
        when = Moment(self.time) if timed and self.time is not None else None
        slots = {"kind": self.kind, "it": self.clause, "past": self.past, "noun": self.noun}
        return Message(rule, {**slots, "who": self.who, "other": self.other, "when": when})


def asking(act: Act | Proposition | Thing, now: float) -> Asking:
    """Return an act, or what it is about, in parts.

    Args:
        act: the act, grounded.
        now: [s] the time of the question.
    """
    match act:
        case Ask(question=question):
            found = _QUESTIONS[type(question)](question, now)
            return _timed(found, question)
        case Claim(that=that):
            return _timed(Asking("claim", clause_of(that, now)), act)
        case Request(event=event):
            return Asking("request", event_clause(event, now, tense="present"))
        case Feel(about=about) if about is not None:
            return asking(about, now)
    if isinstance(act, THINGS):
        return Asking("thing", who=Who(cast(Thing, act), ride=True))
    if isinstance(act, get_args(Proposition)):
        return _timed(Asking("claim", clause_of(cast(Proposition, act), now)), act)
    return Asking("other")


def meant(answer: WhichOne, now: float) -> tuple[Asking, ...]:
    """Return the choices of a clarification: whole acts if they are known."""
    return tuple(asking(one, now) for one in answer.acts or answer.readings)


def _timed(found: Asking, act: Any) -> Asking:
    return Asking(
        found.kind, found.clause, found.past, found.noun, found.who, found.other, _time(act)
    )


def _time(part: Any) -> float | None:
    """Return the first time of the ride that an act, a proposition or an event names."""
    at = moment_of(part.time) if hasattr(part, "time") else None
    for name in ("of", "that", "event", "content", "supposed", "such", "left"):
        if at is None and getattr(part, name, None) is not None:
            at = _time(getattr(part, name))
    return at


# --- each kind of question ------------------------------------------------------------------------


def _why(question: meaning.Why, now: float) -> Asking:
    other = None if question.instead is None else clause_of(question.instead, now)
    return Asking("why", clause_of(question.of, now), other=other)


def _what_if(question: meaning.WhatIf, now: float) -> Asking:
    inner: Any = question.supposed
    while isinstance(inner, Not):
        inner = inner.content
    tense = getattr(inner.event if isinstance(inner, Happens) else inner, "tense", "past")
    past = tense in ("past", "perfect")
    told: Tense = "past-perfect" if past else "past"
    return Asking("what-if", clause_of(question.supposed, now, tense=told), past)


def _whether(question: meaning.Whether, now: float) -> Asking:
    return Asking("whether", clause_of(question.that, now))


def _which(question: meaning.Which, now: float) -> Asking:
    if question.such is None:
        return Asking("who", Clause(Who(question.thing), "be", (), "present"))
    clause = clause_of(question.such, now)
    if isinstance(clause.subject, Who) and isinstance(clause.subject.thing, Wanted):
        return Asking("subject", clause)
    kept = tuple(r for r in clause.rest if not (isinstance(r, Who) and r.thing == question.thing))
    kind = "who" if isinstance(question.thing, Wanted) and kept != clause.rest else "whether"
    return Asking(kind, _with(clause, kept))


def _with(clause: Clause, rest: tuple[object, ...]) -> Clause:
    return Clause(clause.subject, clause.verb, rest, clause.tense, clause.progressive,
                  clause.negated, clause.modal, clause.adverb)  # fmt: skip


def _identify(question: meaning.Identify, now: float) -> Asking:
    return Asking("what", Clause(Who(question.thing, ride=True), "be", (), "present"))


def _how_much(question: meaning.HowMuch, now: float) -> Asking:
    of: Measured = question.of
    told = tense_of(of.tense, of.time, now)
    owner = Who(of.thing, moment_of(of.time), ride=True)
    noun = word("doings", "attribute", of.attribute)
    if question.extreme in ("highest", "lowest"):
        noun = f"{question.extreme} {noun}"
    return Asking("what", Clause(Owned(owner, noun), "be", (), told))


def _how_many(question: meaning.HowMany, now: float) -> Asking:
    if isinstance(question.of, Event):
        return Asking("how-often", event_clause(question.of, now))
    kind = getattr(question.of, "kind", "vehicle")
    there = Clause("there", "be", (), "present", plural=True)
    return Asking("how-many", there, noun=plural(word("vehicles", "kind", kind)))


def _of_event(kind: str) -> Callable[[Any, float], Asking]:
    """Return the parts of a question about an event, a proposition or a thing."""

    def parts(question: Any, now: float) -> Asking:
        of = question.of
        if isinstance(of, Event):
            return Asking(kind, event_clause(of, now))
        if isinstance(of, THINGS):
            told = tense_of("present", question.time, now)
            return Asking(kind, Clause(Who(cast(Thing, of), ride=True), "be", (), told))
        return Asking(kind, clause_of(of, now))

    return parts


def _whither(question: meaning.Whither, now: float) -> Asking:
    told = tense_of("present", question.time, now)
    return Asking("where", Clause(Who(question.actor, ride=True), "go", (), told, True))


def _doing(question: meaning.Doing, now: float) -> Asking:
    told = tense_of(question.tense, question.time, now)
    if question.actor is None:
        return Asking("subject", Clause("what", "happen", (), told))
    ongoing = told in ("present", "past")
    return Asking("what", Clause(Who(question.actor), "do", (), told, ongoing))


def _compare(question: meaning.Compare, now: float) -> Asking:
    things = all(isinstance(one, THINGS) for one in question.options)
    told: Tense = "present" if things else "conditional"
    return Asking("subject", Clause("which", "be", (BETTER[question.by],), told))


_LISTS: Mapping[str, tuple[str, Clause]] = {
    "events": ("subject", Clause("what", "happen")),
    "vehicles": ("subject", Clause("which vehicles", "be", ("around us",), "present", plural=True)),
    "options": ("what", Clause(Who(), "do", modal="could")),
    "rivals": ("subject", Clause("what", "be", ("the next best option",))),
    "beliefs": ("what", Clause(Who(), "expect", ("others to do",))),
    "causes": ("why", Clause("that", "happen")),
    "reasons": ("why", Clause("that", "happen")),
    "stops": ("where", Clause(Who(ride=True), "stop")),
    "decisions": ("what", Clause(Who(), "decide")),
    "wrong-predictions": ("when", Clause(Who(), "be", ("wrong",))),
    "capabilities": ("what", Clause(Who(), "do", (), "present", modal="can")),
}


def _listing(question: meaning.Listing, now: float) -> Asking:
    return Asking(*_LISTS[question.of])


_PEAKS: Mapping[str, str] = {
    "danger": "the most critical moment", "difficulty": "the hardest moment",
    "closeness": "the closest moment", "braking": "the hardest braking",
    "slowness": "the slowest moment", "speed": "the fastest moment",
    "waiting": "the longest wait", "slowing": "when we slowed down most",
    "delay": "when we lost most time", "risk": "the highest risk", "choice": "the closest decision",
    "tightness": "the tightest turn",
}  # fmt: skip


def _peak(question: meaning.Peak, now: float) -> Asking:
    return Asking("subject", Clause("what", "be", (_PEAKS[question.of],)))


def _summary(question: meaning.Summarise, now: float) -> Asking:
    return Asking("subject", Clause("what", "happen"))


def _said(of: Proposition | None, now: float) -> tuple[object, ...]:
    return ("that",) if of is None else ("that", clause_of(of, now))


def _how_know(question: meaning.HowKnow, now: float) -> Asking:
    return Asking("how", Clause(Who(), "know", _said(question.of, now), "present"))


def _how_sure(question: meaning.HowSure, now: float) -> Asking:
    told = tense_of("present", question.time, now)
    of = _said(question.of, now)
    return Asking("how-sure", Clause(Who(), "be", of if question.of else ("of that",), told))


def _literal(kind: str, clause: Clause) -> Callable[[Any, float], Asking]:
    return lambda question, now: Asking(kind, clause)


def _change(question: meaning.WhatWouldChange, now: float) -> Asking:
    if question.most:
        return Asking("subject", Clause("what", "matter", ("most",)))
    return Asking("subject", Clause("what", "change", ("that",), "conditional-perfect"))


def _fault(question: meaning.Fault, now: float) -> Asking:
    if question.legal:
        return Asking("whether", Clause("that", "be", ("legal",)))
    return Asking("whose-fault", Clause("that", "be"))


_QUESTIONS: Mapping[type, Callable[[Any, float], Asking]] = {
    meaning.Why: _why,
    meaning.WhatIf: _what_if,
    meaning.Whether: _whether,
    meaning.Which: _which,
    meaning.Identify: _identify,
    meaning.HowMuch: _how_much,
    meaning.HowMany: _how_many,
    meaning.When: _of_event("when"),
    meaning.HowLong: _of_event("how-long"),
    meaning.Where: _of_event("where"),
    meaning.Whither: _whither,
    meaning.Doing: _doing,
    meaning.Compare: _compare,
    meaning.Listing: _listing,
    meaning.Peak: _peak,
    meaning.Changed: _literal("subject", Clause("what", "change")),
    meaning.Summarise: _summary,
    meaning.HowKnow: _how_know,
    meaning.HowSure: _how_sure,
    meaning.HowDecide: _literal("how", Clause(Who(), "decide", ("that",))),
    meaning.WhatWouldChange: _change,
    meaning.HowAvoid: _literal("how", Clause("that", "be", ("avoided",), modal="could")),
    meaning.Fault: _fault,
}
