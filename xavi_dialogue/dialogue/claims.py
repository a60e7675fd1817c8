"""Claims: replies to a claim that stands next to a question, or to another claim. Pure.

A claim next to a question is its background. The question is answered. The claim is corrected only
if it disputes what we said or did, is false, and matters, and if the answer does not correct it.
"""

from collections.abc import Sequence
from typing import Final, TypeAlias

from msgspec.structs import replace

from xavi_dialogue.dialogue.state.discourse import causes_of
from xavi_dialogue.dialogue.state.turn import Part
from xavi_dialogue.domain.answers import (
    Acknowledged,
    Answer,
    ChoiceReason,
    Comforting,
    Declined,
    DidNotHappen,
    GoReason,
    MotionReason,
    OtherReason,
    Priority,
    Reaction,
    Refusal,
    SupposedOfOther,
    SupposedOfUs,
    Unslowed,
    Verdict,
)
from xavi_dialogue.domain.discourse import GroundedAct
from xavi_dialogue.domain.facts import Look
from xavi_dialogue.domain.meaning import Ask, AskHelp, Claim, Request, Social, Whether
from xavi_dialogue.domain.rewriting import first, parts
from xavi_dialogue.domain.terms import (
    Believed,
    Compares,
    Ego,
    Event,
    Exists,
    Happens,
    Has,
    Is,
    Not,
    Proposition,
    Related,
    Vehicle,
    Vehicles,
)

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
#: Reasons: answers next to which a statement is only background.
REASONS: Final = (
    ChoiceReason | MotionReason | GoReason | OtherReason | SupposedOfUs | SupposedOfOther
    | Reaction | Unslowed
)  # fmt: skip
#: Motions for which people use various verbs.
PASSING: Final = frozenset(
    ("go", "come", "move", "do", "head", "leave", "enter", "pull-out", "stand", "follow", "wait",
     "see", "appear", "disappear", "approach", "pass", "happen", "keep-lane", "cross")
)  # fmt: skip
#: Feelings that get a word of sympathy even next to a question.
GRAVE: Final = frozenset(("afraid", "nervous", "startled", "sick", "sad"))
_PERSONAL: Final = frozenset(("how-are-you", "who-are-you", "are-you-human", "feelings"))
_BARE: Final = frozenset(("right", "wrong"))
_REAR: Final = ("behind", "behind-left", "behind-right")


def in_order(acts: Sequence[GroundedAct]) -> tuple[GroundedAct, ...]:
    """Return acts in the order of their replies: claims after questions."""
    if not asks(acts):
        return tuple(acts)
    return tuple(sorted(acts, key=lambda act: isinstance(act.act, Claim)))


def asks(acts: Sequence[GroundedAct]) -> bool:
    """Check whether there is a question or request among acts."""
    return any(
        isinstance(act.act, Ask | Request)
        or (isinstance(act.act, Social) and act.act.kind in _PERSONAL)
        for act in acts
    )


def is_ground(act: GroundedAct, acts: Sequence[GroundedAct]) -> bool:
    """Check whether a claim is too vague, or says too little next to other acts, to be checked.

    So is a cry for help beside a question: "help, why are we stopping?".
    """
    if isinstance(act.act, AskHelp):
        return asks(acts)
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
    """Check whether a claim only says that something is right, wrong or known."""
    match act.act:
        case Claim(that=Not(content=content) | content):
            known = isinstance(content, Believed) and act.leaned and not act.act.challenge
            return known or (isinstance(content, Is) and content.state in _BARE)
    return False


def told(said: Sequence[Part]) -> tuple[Part, ...]:
    """Return the parts of a reply that are put into words."""
    said = _without_setting(_declined_once(_once(said)))
    acts = [part.act for part in said if part.act is not None]
    answers = [part.result for part in said if not _is_claim(part)]
    if not asks(acts):
        plain = tuple(part for part in said if not (_is_claim(part) and part.result == NOTED))
        weighty = tuple(part for part in plain if not _is_remark(part))
        return _foremost(weighty if any(part.act is not None for part in weighty) else plain)
    return tuple(
        part
        for part in said
        if not (_is_claim(part) or _is_sympathy(part))
        or (_disputes_us(part.act) and _matters(part.result, answers))
        or _is_grave(part)
    )


def _foremost(said: Sequence[Part]) -> tuple[Part, ...]:
    """Keep the reply to one of several claims: a false one, else a challenge, else the last."""
    claims = [part for part in said if _is_claim(part)]
    false = [p for p in claims if isinstance(p.result, Verdict) and p.result.holds is False]
    disputed = [part for part in claims if _disputes_us(part.act)]
    chosen = (false or disputed[::-1] or claims[::-1])[:1]
    return tuple(p for p in said if not _is_claim(p) or any(p is one for one in chosen))


def _once(said: Sequence[Part]) -> tuple[Part, ...]:
    """Keep one part on right of way for each vehicle; if any replies yes or no, only such parts."""
    rules = [p for p in said if isinstance(p.result, Priority)]
    owned = [p for p in rules if isinstance(p.result, Priority) and p.result.holds is not None]
    kept_rules = {
        p.result.vehicle: p for p in reversed(owned or rules) if isinstance(p.result, Priority)
    }
    return tuple(p for p in said if p not in rules or p in kept_rules.values())


def _without_setting(said: Sequence[Part]) -> tuple[Part, ...]:
    """Leave out statements with a question mark next to a reason: "..., the road is free?"."""
    if not any(isinstance(part.result, REASONS) for part in said):
        return tuple(said)
    return tuple(part for part in said if not _is_statement(part))


def _is_statement(part: Part) -> bool:
    question = part.act.act.question if part.act and isinstance(part.act.act, Ask) else None
    return isinstance(question, Whether) and question.tag and isinstance(part.result, Verdict)


def _declined_once(said: Sequence[Part]) -> tuple[Part, ...]:
    """Keep at most one refusal to drive otherwise, and none if a reason explains it already.

    What the car cannot do at all is refused beside it: "honk and drive on".
    """
    told_why = any(isinstance(part.result, REASONS) for part in said)
    declined = [part for part in said if isinstance(part.result, Declined)]
    others = any(isinstance(p.act.act, Ask) for p in said if p.act is not None)
    idle = [part for part in declined if others and part.result.already]  # type: ignore[union-attr]
    able = [part for part in declined if part.result.able]  # type: ignore[union-attr]
    unable = [part for part in declined if part not in able]
    dropped = [*able[1:], *unable[1:], *idle]
    if told_why and declined and declined[0].result.cause is not None:  # type: ignore[union-attr]
        dropped = declined
    left = tuple(part for part in said if not any(part is one for one in dropped))
    return tuple(_without_reason(part) for part in left) if told_why else left


def _without_reason(part: Part) -> Part:
    """Leave out of a refusal to drive otherwise what is said in the reason beside it."""
    if not isinstance(part.result, Declined):
        return part
    return replace(part, result=replace(part.result, reason=None, ahead=None, facts=()))


def kept(said: Sequence[Part]) -> tuple[Part, ...]:
    """Return the parts of a reply as they are remembered: answers to questions come last."""
    acts = [part.act for part in said if part.act is not None]
    if not asks(acts):
        return tuple(said)
    return tuple(sorted(said, key=lambda part: not _is_claim(part)))


def _is_sympathy(part: Part) -> bool:
    return isinstance(part.result, Comforting)


def _is_grave(part: Part) -> bool:
    """Check whether a feeling is so grave that it always gets a reply."""
    return isinstance(part.result, Comforting) and part.result.feel.feeling in GRAVE


def _disputes_us(act: GroundedAct | None) -> bool:
    """Check whether a claim is a challenge to what we said, did or did not do."""
    match act:
        case GroundedAct(act=Claim(that=that, challenge=True)):
            return first(that, Believed) is not None or first(that, Ego) is not None
    return False


def _is_claim(part: Part) -> bool:
    return part.act is not None and isinstance(part.act.act, Claim)


def _matters(result: Result, answers: Sequence[Result]) -> bool:
    """Check whether a claim is false in a way that must be corrected besides the answers."""
    if not isinstance(result, Verdict) or result.holds is not False or result.mistaken:
        return False
    if any(isinstance(answer, DidNotHappen | Verdict | REASONS) for answer in answers):
        return False  # the answer itself states what was true, or what mattered
    if not _weighty(result.that):
        return False
    looks = [fact for fact in result.facts if isinstance(fact, Look)]
    if looks and all(look.bearing in _REAR or not look.in_view for look in looks):
        return False
    blamed = {vehicle for answer in answers for vehicle, _ in causes_of(answer) if vehicle}
    concerned = {look.vehicle for look in looks} | _vehicles(result.that)
    denies_all = first(result.that, Exists) is not None
    return not blamed or not (denies_all or blamed & concerned)


def _is_remark(part: Part) -> bool:
    """Check whether a part only agrees with what the passenger can see."""
    result = part.result
    agreed = isinstance(result, Verdict) and result.holds is True
    return _is_claim(part) and agreed and isinstance(result, Verdict) and not _weighty(result.that)


def _weighty(that: Proposition) -> bool:
    """Check whether it matters that a claim is false.

    Where somebody is, or that they go, come or stand, is an observation and needs no correction.
    """
    match that:
        case Not(content=content):
            return _weighty(content)
        case Happens(event=event):
            return event.action not in PASSING
        case Related(relation=relation):
            return relation in ("has-priority-over", "must-yield-to")
        case Exists() | Has():
            return False
    return True


def _vehicles(that: Proposition) -> set[int]:
    found = {vehicle.number for vehicle in parts(that, Vehicle)}
    return found.union(*(several.numbers for several in parts(that, Vehicles)))
