"""Objections: replies to "but he was leaving, so why did you wait?" by the belief then. Pure."""

from collections.abc import Sequence
from typing import Final

from msgspec.structs import replace

from xavi_dialogue.dialogue.pipeline import Situation
from xavi_dialogue.domain.answers import Beliefs, MotionReason, NeedRollout
from xavi_dialogue.domain.discourse import GroundedAct
from xavi_dialogue.domain.meaning import Ask, Claim, HowSure
from xavi_dialogue.domain.terms import At, Event, Happens, Next, Vehicle
from xavi_dialogue.domain.vocabulary import ActionName

#: Actions that show where a vehicle goes: in hindsight, we need not have waited for it.
TELLING: Final = frozenset[ActionName](
    ("leave", "exit-left", "exit-right", "exit-straight", "turn", "change-left", "change-right",
     "stop")
)  # fmt: skip
SURE: Final = 0.9  # probability from which we were sure of it


def foreseen_then(
    now: Situation, acts: Sequence[GroundedAct], done: Sequence[tuple[object, ...]]
) -> Beliefs | None:
    """Return our belief when we slowed for a vehicle, if a claim objects and we were not sure.

    Args:
        now: the situation.
        acts: the acts of the turn.
        done: the replies to each of them.
    """
    reasons = [r for results in done for r in results if isinstance(r, MotionReason)]
    reason = next((r for r in reasons if r.causes and r.causes[0].vehicle is not None), None)
    if reason is None:
        return None
    vehicle = Vehicle(reason.causes[0].vehicle or 0)
    event = next((e for act in acts if (e := _told(act)) is not None and e.actor == vehicle), None)
    if event is None:
        return None
    to_come = Event(event.action, vehicle, event.object, tense="future", time=Next())
    asked = Ask(HowSure(Happens(to_come), time=At(reason.deed.begin)))
    found = now.pipeline.explain(GroundedAct(asked), now.record)
    if isinstance(found, NeedRollout) or not isinstance(found, Beliefs):
        return None
    known = found.probability is not None and found.probability < SURE
    return replace(found, besides=(), came=None) if known else None


def _told(act: GroundedAct) -> Event | None:
    """Return the event of a claim that says where another vehicle went."""
    match act.act:
        case Claim(that=Happens(event=event)) if event.action in TELLING:
            return event
    return None
