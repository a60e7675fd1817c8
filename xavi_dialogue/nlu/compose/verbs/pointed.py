"""Pointed at: "this braking", "that stop, the bus?": a deed of ours, and who may be behind it."""

from collections.abc import Callable
from dataclasses import replace
from typing import Final

from xavi_dialogue.domain.meaning import Act, Ask, Claim, Why
from xavi_dialogue.domain.terms import Ego, Happens, Pronoun, Proposition
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.sem import as_thing

_HELD: Final = ("brake", "slow-down", "stop", "wait", "give-way", "stand")
_NOMINAL: Final = ("base", "ing")  # forms of a verb that name a deed where no auxiliary is


def pointed(clause: Clause, propose: Callable[[Clause], Proposition | None]) -> Act | None:
    """Take a deed that is pointed at for ours, and who is named behind it for the suspect."""
    shown = isinstance(clause.subject, Pronoun) and clause.subject.form in ("this", "that")
    if not shown or clause.aux or clause.verb is None or clause.verb.form not in _NOMINAL:
        return None
    ours = propose(replace(clause, subject=Ego(), objects=[]))
    if not isinstance(ours, Happens) or ours.event.action not in _HELD:
        return None
    named = [as_thing(sem) for sem, _ in clause.objects]
    if not named:
        return Claim(ours)
    suspect = named[-1]
    return None if suspect is None or isinstance(suspect, Ego) else Ask(Why(ours, suspect=suspect))
