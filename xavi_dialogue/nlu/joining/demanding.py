"""Demanding: a bare demand for a reason, and what we did that is stated beside it.

"And now we are slowing down again. Why, there is nobody in front of us" asks why we slow down, not
why there is nobody. Where nothing that we did is stated, it asks why we drive as we do.
"""

from collections.abc import Sequence
from typing import Final

from msgspec import structs

from xavi_dialogue.domain.meaning import (
    Act,
    Ask,
    Claim,
    Doing,
    Elliptic,
    Feel,
    Identify,
    Reading,
    Repair,
    Request,
    Social,
    TokenShare,
    Whether,
    Why,
)
from xavi_dialogue.domain.terms import (
    Both,
    Compares,
    Described,
    Ego,
    Event,
    Exists,
    Feature,
    Happens,
    Has,
    Is,
    Measured,
    Nobody,
    Not,
    Now,
    Pronoun,
    Proposition,
    Related,
    Tense,
    That,
    Unsaid,
    Vehicle,
)
from xavi_dialogue.nlu.text.tokens import Typed

COST: Final = 0.0
BLAMING: Final = 0.2  # cost of a thing that is named as what something was for, at most
THAT: Final = Ask(Why(That()))
#: Why we drive as we do: what a bare demand comes to where nothing else is stated.
DOING: Final = Ask(Why(Happens(Event("do", object=Pronoun("that"), tense="present"))))
#: The same, of now and no time that is stated: "what is it now? We had green".
DOING_NOW: Final = Ask(
    Why(Happens(Event("do", object=Pronoun("that"), time=Now(), tense="present")))
)
#: What happens to us, or is only a stage of the ride, and what is too vague to have a reason.
_IDLE: Final = frozenset(("arrive", "see", "do", "happen", "have", "get", "come", "appear", "know"))
_MOVING: Final = frozenset(("slow", "stationary", "stuck", "fast", "late"))


def demanding(sentence: Typed) -> Reading:
    """Read a sentence that does nothing but demand a reason."""
    words = [token.text for token in sentence.tokens]
    act = DOING_NOW if "now" in words else DOING
    return Reading((act,), tuple(TokenShare(w, w, "meaning", "demand", 0) for w in words), COST)


def blaming(reading: Reading) -> Reading:
    """Take a thing that is only named for whom something was for."""
    match reading.acts:
        case (Elliptic(form="same", thing=Described() | Vehicle() as thing, event=None), *rest):
            acts = (Ask(Why(That(), suspect=thing)), *rest)
            return structs.replace(reading, acts=acts, cost=min(reading.cost, BLAMING))
    return reading


def may_startle(before: Reading) -> bool:
    """Tell whether what was said just before is of how we drive, as far as it was understood."""
    return not before.acts or any(conduct(act) is not None for act in before.acts)


def attached(acts: Sequence[Act], lost: bool) -> list[Act]:
    """Put what is stated of us into the bare demand for a reason that stands beside it.

    Args:
        acts: of a text.
        lost: nothing was made of one of its sentences.
    """
    found = [_of_conduct(act, acts, k, lost) for k, act in enumerate(acts)]
    questions = [act.question for act in found if isinstance(act, Ask)]
    asked = [question.of for question in questions if isinstance(question, Why)]
    stated = (conduct(act) if isinstance(act, Request) else None for act in acts)
    return [
        act if of is None or of not in asked else Claim(of)  # "brake again, ..., what is it?"
        for act, of in zip(found, stated, strict=True)
    ]


def conduct(act: Act) -> Proposition | None:
    """Give what an act states of how we drive; None where it states nothing of that."""
    match act:
        case Claim(that=Is(state="right", thing=Pronoun(), event=Event() as event)):
            return _ours(Happens(event))  # "that was a hard brake"
        case Claim(that=that) | Ask(question=Whether(that=that, tag=True) | Why(of=that)):
            return _ours(that)
        case Elliptic(thing=None, event=Event() as event, negated=False, form="same"):
            return _ours(Happens(event))
        case Request(event=event, negated=False):
            return _ours(Happens(event))
    return None


def _ours(that: Proposition) -> Proposition | None:
    match that:
        case Both(contents=contents):
            return next((of for one in contents if (of := _ours(one)) is not None), None)
        case Not(content=content):
            return that if _ours(content) is not None else None
        case Has(attribute="indicator", value="left" | "right" | "on", thing=Ego(), tense=tense):
            return Happens(Event("signal", tense=tense))
        case Happens(event=Event(actor=Ego(), modal=None) as event):
            return None if event.action in _IDLE or event.tense == "future" else that
        case Is(state=state, thing=Ego()):
            return that if state in _MOVING else None
        case Compares(left=Measured(attribute="speed", thing=Ego(), tense="present")):
            return that
    return None


def _of_conduct(act: Act, acts: Sequence[Act], at: int, lost: bool) -> Act:
    """Ask for the reason of what was stated last, else of what is stated next."""
    now = act == DOING_NOW
    act = DOING if now else act
    question = act.question if isinstance(act, Ask) else None
    vague = act == Repair("why") or _wonders(question)
    if not (vague or act == DOING or (isinstance(question, Why) and _is_bare(question))):
        return act
    before, behind = acts[:at], acts[at + 1 :]
    told = [one for one in before if not isinstance(one, Repair | Social | Feel)]
    claims = [one for one in acts if isinstance(one, Claim)]
    for one in reversed(told):
        of = conduct(one)
        if of is not None and one is before[-1] and getattr(one, "that", of) == of:
            return THAT if act == DOING else act  # is made one with it
        if of is not None and (not vague or isinstance(of, Happens)):
            return _why(question, of)
        aside = isinstance(one, Claim) and (
            _is_circumstance(one.that) or _is_of_somebody(one.that, told)
        )
        if one is told[-1] and not aside:
            return THAT if act == DOING else act
    if vague or (act != DOING and lost):
        return act
    match told[-1:]:
        case [Claim(that=Exists(thing=Described() | Feature()))]:
            return THAT if act == DOING else act  # "there is a queue. Why?"
    of = next((of for one in behind if (of := conduct(one)) is not None), None)
    if of is None and not (claims or lost):
        return Elliptic(form="why") if act == DOING else act
    if of is None and (any(isinstance(one, Ask) for one in behind) or (claims and lost)):
        return Elliptic(form="why") if act == DOING else act
    return _why(question, of or _as_we_do(() if now else claims))


def _is_bare(question: Why) -> bool:
    return isinstance(question.of, That) and question.instead is None


def _wonders(question: object) -> bool:
    """Tell whether it is asked what the matter is: "what is it this time?"."""
    match question:
        case Doing(actor=None, time=Unsaid(), tense="present", besides=None):
            return True
        case Identify(thing=Pronoun(form="it")):
            return True
    return False


def _why(question: object, of: Proposition) -> Act:
    return Ask(structs.replace(question, of=of) if isinstance(question, Why) else Why(of))


def _is_circumstance(that: Proposition) -> bool:
    """Tell whether it is only stated how things are, which nobody asks the reason of."""
    match that:
        case Not(content=Exists() | Related() | Has() | Is()) | Has() | Related() | Exists():
            return True
        case Happens(event=Event(actor=Nobody())):
            return True
        case Is(state="free" | "roomy" | "far" | "possible"):
            return True
        case Compares(left=Measured(attribute="speed" | "limit", thing=Ego())):
            return True  # as it was before
    return False


def _is_of_somebody(that: Proposition, told: Sequence[Act]) -> bool:
    """Tell whether it is stated what somebody did, beside what we did ourselves."""
    match that:
        case Happens(event=Event(actor=Described(definite=False))):
            return any(conduct(act) is not None for act in told)
    return False


def _as_we_do(claims: Sequence[Claim]) -> Proposition:
    past = any(getattr(claim.that, "tense", "") in ("past", "perfect") for claim in claims)
    tense: Tense = "past" if past else "present"
    return Happens(Event("do", object=Pronoun("that"), tense=tense))
