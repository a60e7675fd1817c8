"""Own deeds: "this slowing down, another light?" names what we do, and asks for the reason."""

import re
from typing import Final

from msgspec.structs import replace

from xavi_dialogue.domain.meaning import Act, Ask, Claim, Whether, Why
from xavi_dialogue.domain.terms import Ego, Event, Feature, Happens, Pronoun, Thing

_HELD: Final = ("brake", "slow-down", "stop", "wait", "give-way", "stand", "block")
_NAMED: Final = re.compile(
    r"(?:^|(?<!is )(?<!was )(?<!s )\b)(?:this|that|the) "
    r"(?:(?:sudden|hard|little|extra|bit of) )*(?:slowing|braking|stop|stopping|waiting|halt)\b"
)


def of_own_deed(act: Act, words: str) -> Act:
    """Take a deed that is pointed at for ours, and who is named behind it for the suspect."""
    match act:
        case (
            Claim(that=Happens(event=event)) | Ask(question=Whether(that=Happens(event=event)))
        ) if event.action in _HELD and _NAMED.search(words):
            suspect = _suspect(event)
            if suspect is not None:
                return Ask(Why(_ours(event), suspect=suspect))
            return Claim(_ours(event)) if _is_pointed(event) else act
        case Ask(question=Why(of=Happens(event=event)) as why) if (
            event.action in _HELD and _is_pointed(event) and _NAMED.search(words)
        ):
            return Ask(replace(why, of=_ours(event)))
    return act


def _is_pointed(event: Event) -> bool:
    return isinstance(event.actor, Pronoun) and event.actor.form in ("this", "that")


def _suspect(event: Event) -> Thing | None:
    """Give who is said to be behind a deed of ours."""
    if _is_pointed(event):
        return event.object
    return event.actor if isinstance(event.actor, Feature) else None


def _ours(event: Event) -> Happens:
    action = "stop" if event.action == "block" else event.action  # "this stop, the bus?"
    return Happens(Event(action, Ego(), tense=event.tense, time=event.time))
