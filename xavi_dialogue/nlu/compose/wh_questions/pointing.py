"""Pointing: questions for what stands out: "where did you brake hardest", "which came closest"."""

from typing import Final, cast, get_args

from msgspec.structs import replace

from xavi_dialogue.domain.meaning import Compare, Peak, Question, Why
from xavi_dialogue.domain.terms import Described, Event, Pronoun, That, Thing, Wanted
from xavi_dialogue.domain.vocabulary import Bearing, Merit, PeakKind
from xavi_dialogue.nlu.compose.alternatives.nearness import is_choice, rivals
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.peaks import deed_asked, nearest_of, peak_of
from xavi_dialogue.nlu.compose.clauses.sem import Noun, Sem, as_thing
from xavi_dialogue.nlu.compose.wh_questions.wh import Wh, is_that

_NEAR = frozenset({"around", "here", "there"})
_POINTING = frozenset({"where", "when", "what", "who", "which", "count"})


#: By what "which of those cost the most time" ranks, and whether the most is the worst.
_MERITS: Final[dict[PeakKind, tuple[Merit, bool]]] = {
    "delay": ("time", True), "waiting": ("size", False), "slowing": ("comfort", True),
    "braking": ("comfort", True), "difficulty": ("comfort", True), "danger": ("safety", True),
    "risk": ("safety", True),
}  # fmt: skip


def pointed(wh: Wh, clause: Clause) -> Question | None:
    """Ask for what stands out, "where did you brake hardest?"; or "who was that for?"."""
    if wh.kind == "when" and (nearest := nearest_of(clause)) is not None:
        return nearest
    for sem in (wh.sem, wh.of):  # "which bend was the sharpest", "which of the bends was"
        if sem is not None and (deed := deed_asked(clause, sem, wh.words)) is not None:
            return deed
    most = peak_of(clause)
    if most is not None and any(map(is_choice, (wh.of, wh.sem, clause.subject))):
        return rivals(clause)  # "which of the other options came closest"
    those = isinstance(wh.of, Pronoun) and wh.of.form in ("they", "them-all")
    if isinstance(most, Peak) and those and most.of in _MERITS:
        return Compare((Pronoun("them-all"),), *_MERITS[most.of])
    named = isinstance(clause.subject, Noun)  # "how hard was the hardest braking"
    if most is not None and (named or wh.kind in _POINTING):
        return most
    whom = any(phrase.key == "for" and phrase.sem is None for phrase in clause.complements)
    ours = wh.kind == "who" and whom and clause.verb is None and is_that(clause.subject)
    return Why(That()) if ours else None


def who_there(clause: Clause) -> Described | None:
    """Describe those at a place that is named of what we see: "on the left", "behind us"."""
    named: dict[str, Thing | None] = {key: None for key, _ in clause.bearings}
    named |= {c.key.removeprefix("bearing-"): as_thing(c.sem) for c in clause.complements}
    for key, of in named.items():
        if key in get_args(Bearing) and key not in _NEAR:
            where = cast(Bearing, key)
            return Described(bearing=where, of=of, plural=True, definite=False)
    return None


def as_said(subject: Sem, clause: Clause) -> Sem:
    """Add to a road user that is asked about what its clause says of it: "standing on the left"."""
    if not isinstance(subject, Described) or subject not in [sem for sem, _ in clause.objects]:
        return subject
    stands = any(key == "stationary" for key, _ in clause.adjectives)
    if stands and subject.doing is None:
        subject = replace(subject, doing=Event("stand", Wanted(), tense="present"))
    if subject.rank is not None and subject.doing is None and clause.infinitive is not None:
        done = clause.inner  # "the first one to cross"
        to = None if done is None else replace(done, actor=Wanted(), tense="past")
        subject = replace(subject, doing=to)
    there = next((key for key, _ in clause.bearings if key in get_args(Bearing)), None)
    if there is None or subject.bearing is not None:
        return subject
    return replace(subject, bearing=cast(Bearing, there))
