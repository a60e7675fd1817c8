"""Effects: questions about what an action would cause, its purpose, and its conditions."""

from typing import Any, cast

from xavi_dialogue.domain.meaning import (
    Compare,
    Doing,
    HowMuch,
    HowSure,
    Question,
    WhatIf,
    WhatWouldChange,
    Whither,
    Why,
)
from xavi_dialogue.domain.terms import Ego, Event, Happens, Measured, Pronoun, Proposition
from xavi_dialogue.nlu.compose.alternatives.nearness import between_deeds
from xavi_dialogue.nlu.compose.alternatives.polar import Polar
from xavi_dialogue.nlu.compose.clauses.adoption import as_of, timed
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.sem import Measure, Notes, as_thing
from xavi_dialogue.nlu.compose.clauses.tree import words_of
from xavi_dialogue.nlu.compose.wh_questions.wh import Wh

#: Verbs with an action as their subject: "what would braking have done".
_EFFECTS = frozenset(
    {"do", "mean", "lead", "have", "change", "bring", "cause", "come", "get", "cost", "result",
     "give", "make", "look", "end", "achieve", "gain", "save", "trigger"}
)  # fmt: skip
#: Verbs that ask for the benefit of an action: "what did turning left gain us".
_GAINS = frozenset({"gain", "achieve", "accomplish", "serve", "bring", "get", "buy"})
_EFFECT_OF = frozenset({"of", "from", "with", "behind"})
_UNREAL = frozenset({"would", "could", "might"})


class Effects(Polar):
    """Builds questions about actions and their effects."""

    notes: Notes

    def deeds(self, clause: Clause) -> tuple[Any, ...]:
        """Read "changing left or staying here" as actions to choose between."""
        if clause.gerund is None:
            return ()
        later = [c for j, c in (*clause.gerund.chained, *clause.chained) if j == "or"]
        clause.gerund.chained = [(j, c) for j, c in clause.gerund.chained if j != "or"]
        found: list[Any] = []
        for one in (clause.gerund, *later):
            one.subject, one.aux = Ego(), []
            deed = self.propositions.as_event(one)
            if isinstance(deed, Event):
                self.notes.taken.add(id(one))
                found.append(Happens(deed))
        return tuple(found) if len(found) > 1 else ()

    def margin(self, wh: Wh, clause: Clause) -> Question | None:
        """Ask "how close was it, staying or changing lanes", "... between stopping and going"."""
        deeds = self.deeds(clause) if wh.key == "close" else ()
        return Compare(deeds, "margin") if deeds else between_deeds(clause)

    def effect(self, wh: Wh, clause: Clause) -> Question | None:
        """Read "what would braking have done", "what was that stop for", "what is with it"."""
        if wh.kind not in ("what", "which"):
            return None
        if (chances := self._chances(clause)) is not None:
            return chances
        place = isinstance(wh.sem, Measure) and wh.sem.of.attribute == "place"
        if place and clause.verb is not None:
            return Whither(as_thing(clause.subject) or Ego(), clause.time)
        if clause.modal == "would" and (hangs := self._hanging(clause)) is not None:
            return hangs
        things = [clause.subject, *(p.sem for p in clause.complements if p.key in _EFFECT_OF)]
        deed = next((sem for sem in things if isinstance(sem, Event)), None)
        return None if deed is None else _of_deed(clause, deed)

    def _chances(self, clause: Clause) -> Question | None:
        """Read "what is the probability of vehicle 1 turning right"."""
        of = clause.subject.of if isinstance(clause.subject, Measure) else None
        verbal = clause.verb is not None and clause.verb.form == "ing"
        if of is None or of.attribute != "probability" or not verbal:
            return None
        clause.subject, clause.gap = of.thing, None
        return HowSure(self.propositions.plain(clause), clause.time)

    def _hanging(self, clause: Clause) -> Question | None:
        """Read "what would it take for you to turn", "what would need to be different"."""
        inner = clause.infinitive
        if inner is None:
            return None
        if clause.verb is None or clause.verb.key == "take":
            return WhatWouldChange(self._pivot(clause, inner))
        if inner.infinitive is not None:
            return WhatWouldChange(self._pivot(inner, inner.infinitive))
        return None

    def weighed(self, wh: Wh, clause: Clause) -> Question | None:
        """Read "how much worse would stopping have been than going on"."""
        if not isinstance(clause.subject, Event | Pronoun):
            return None
        clause.comparisons.append(("better" if wh.key == "worse" else "fast", " ".join(wh.words)))
        return self.comparison(clause)

    def needing(self, clause: Clause) -> Question | None:
        """Read "how far would it need to be for you to go", "how big a gap would you need"."""
        needs = "semi-must" in clause.aux or (clause.verb is not None and clause.verb.key == "need")
        if clause.modal != "would" or not needs or clause.infinitive is None:
            return None
        return WhatWouldChange(self._pivot(clause, clause.infinitive))

    def _pivot(self, clause: Clause, governed: Clause) -> Proposition | None:
        """Read what the condition decides: "for you to turn left"."""
        actors = (as_thing(p.sem) for p in clause.complements if p.key == "for")
        governed.subject = next((actor for actor in actors if actor is not None), Ego())
        if clause.modal == "would" and not governed.has("modal"):
            governed.aux.append("modal-would")
        return self.propositions.plain(governed)


def _of_deed(clause: Clause, deed: Event) -> Question | None:
    key = clause.verb.key if clause.verb is not None else ""
    if key in _EFFECTS and clause.modal in _UNREAL:
        tense: Any = "past" if clause.tense == "past" else "present"
        return WhatIf(as_of(Happens(deed), tense), Doing(None, clause.time, tense))
    if key in _GAINS and clause.modal is None and deed is clause.subject:
        if _in_time(clause):
            return HowMuch(Measured("delay", event=deed, tense=cast(Any, clause.tense)))
        return Why(as_of(Happens(deed), clause.tense))
    if key:
        return None
    keys = [(p.key, p.sem) for p in clause.complements]
    about = any(sem is None and key in ("for", "about", "in-aid") for key, sem in keys)
    about = about or any(bearing == "around" for bearing, _ in clause.bearings)
    beside = any(sem is deed and key in ("with", "behind") for key, sem in keys)
    if not beside and not (about and deed is clause.subject):
        return None
    return Why(timed(as_of(Happens(deed), clause.tense), clause.time))


def _in_time(clause: Clause) -> bool:
    """Check whether a clause asks for time: "what did it buy us in time"."""
    named = (words_of(p.node).split()[-1:] for p in clause.complements if p.key == "in")
    spent = any(words in (["time"], ["seconds"], ["minutes"]) for words in named)
    return spent or "early" in clause.manner  # "in time" is read as "early"
