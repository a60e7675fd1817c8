"""Claims: what is said of a claim that stands beside a question, or beside another claim. Pure.

A claim beside a question is the ground on which it is asked. The question is answered; the claim
is put right only where it is false, where that matters, and where the answer does not do so.
"""

from collections.abc import Sequence
from typing import Final, TypeAlias

from xavi_dialogue.dialogue.discourse import causes_of
from xavi_dialogue.dialogue.turn import Part
from xavi_dialogue.domain.answers import (
    Acknowledged,
    Answer,
    DidNotHappen,
    Priority,
    Refusal,
    Verdict,
)
from xavi_dialogue.domain.discourse import GroundedAct
from xavi_dialogue.domain.facts import Look
from xavi_dialogue.domain.meaning import Ask, Claim, Request
from xavi_dialogue.domain.terms import (
    Believed,
    Compares,
    Event,
    Exists,
    Is,
    Not,
    Proposition,
    Vehicle,
    Vehicles,
)
from xavi_dialogue.nlu.grounding.rewriting import first, parts

Result: TypeAlias = Answer | Refusal

NOTED: Final = Acknowledged("noted")
#: Manners and states that are a matter of opinion.
MANNERS: Final = frozenset(
    ("hard", "gently", "suddenly", "fast", "slowly", "early", "late", "close", "far", "long")
)
STATES: Final = frozenset(
    ("fast", "slow", "close", "far", "big", "late", "dangerous", "uncomfortable", "normal",
     "worth-it", "better", "busy", "stuck", "comfortable", "safe")
)  # fmt: skip
_BARE: Final = frozenset(("right", "wrong"))
_REAR: Final = ("behind", "behind-left", "behind-right")


def in_order(acts: Sequence[GroundedAct]) -> tuple[GroundedAct, ...]:
    """Return acts in the order in which they are replied to: claims after questions."""
    if not asks(acts):
        return tuple(acts)
    return tuple(sorted(acts, key=lambda act: isinstance(act.act, Claim)))


def asks(acts: Sequence[GroundedAct]) -> bool:
    """Tell whether there is a question or request among acts."""
    return any(isinstance(act.act, Ask | Request) for act in acts)


def is_ground(act: GroundedAct, acts: Sequence[GroundedAct]) -> bool:
    """Tell whether a claim is so vague, or so bare beside the others, that nobody checks it."""
    if not isinstance(act.act, Claim) or len(acts) < 2:
        return False
    if asks(acts):
        return _is_vague(act.act.that) or _is_bare(act)
    others = [o for o in acts if isinstance(o.act, Claim) and o is not act]
    return _is_bare(act) and any(not _is_bare(other) for other in others)


def _is_vague(that: Proposition) -> bool:
    match that:
        case Not(content=content):
            return _is_vague(content)
        case Is(state=state, too=too):
            return too or state in STATES
        case Compares(right=None):
            return True
    event = first(that, Event)
    if event is None:
        return False
    opinion = event.modal is not None or event.action == "do"
    return opinion or any(manner in MANNERS for manner in event.manner)


def _is_bare(act: GroundedAct) -> bool:
    """Tell whether a claim only says of others that they are so, not so, or known."""
    match act.act:
        case Claim(that=Not(content=content) | content):
            known = isinstance(content, Believed) and act.leaned
            return known or (isinstance(content, Is) and content.state in _BARE)
    return False


def told(said: Sequence[Part]) -> tuple[Part, ...]:
    """Return the parts of a reply that are put into words."""
    said = _once(said)
    acts = [part.act for part in said if part.act is not None]
    answers = [part.result for part in said if not _is_claim(part)]
    if not asks(acts):
        return tuple(part for part in said if not (_is_claim(part) and part.result == NOTED))
    return tuple(part for part in said if not _is_claim(part) or _matters(part.result, answers))


def _once(said: Sequence[Part]) -> tuple[Part, ...]:
    """Leave out who has right of way where another part tells it of the same vehicle."""
    rules = [p for p in said if isinstance(p.result, Priority)]
    owned = [p for p in rules if isinstance(p.result, Priority) and p.result.holds is not None]
    kept_rules = {
        p.result.vehicle: p for p in reversed(owned or rules) if isinstance(p.result, Priority)
    }
    return tuple(p for p in said if p not in rules or p in kept_rules.values())


def kept(said: Sequence[Part]) -> tuple[Part, ...]:
    """Return the parts of a reply as they are remembered: what was asked counts last."""
    acts = [part.act for part in said if part.act is not None]
    if not asks(acts):
        return tuple(said)
    return tuple(sorted(said, key=lambda part: not _is_claim(part)))


def _is_claim(part: Part) -> bool:
    return part.act is not None and isinstance(part.act.act, Claim)


def _matters(result: Result, answers: Sequence[Result]) -> bool:
    """Tell whether what a claim came to is to be said beside the answers."""
    if not isinstance(result, Verdict) or result.holds is not False or result.mistaken:
        return False
    if any(isinstance(answer, DidNotHappen | Verdict) for answer in answers):
        return False  # the answer tells what was so itself
    looks = [fact for fact in result.facts if isinstance(fact, Look)]
    if looks and all(look.bearing in _REAR or not look.in_view for look in looks):
        return False
    blamed = {vehicle for answer in answers for vehicle, _ in causes_of(answer) if vehicle}
    concerned = {look.vehicle for look in looks} | _vehicles(result.that)
    denies_all = first(result.that, Exists) is not None
    return not blamed or not (denies_all or blamed & concerned)


def _vehicles(that: Proposition) -> set[int]:
    found = {vehicle.number for vehicle in parts(that, Vehicle)}
    return found.union(*(several.numbers for several in parts(that, Vehicles)))
