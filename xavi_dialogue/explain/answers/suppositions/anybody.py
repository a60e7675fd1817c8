"""Anybody: what if somebody who is not there comes, or nobody does what is owed to us."""

from msgspec.structs import replace

from xavi_dialogue.domain.answers import CannotSay, Reaction
from xavi_dialogue.domain.terms import Ego, Event, Happens, Nobody, Proposition, Vehicle
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.reading import event_of
from xavi_dialogue.explain.answers.suppositions import reacting

YIELDING: tuple[ActionName, ...] = ("give-way", "wait", "let-go")


def of_anybody(of: Proposition | None, scene: Asked, *, negated: bool) -> Reaction | Happens | None:
    """Return what a supposition about nobody, or somebody who is not there, would lead to.

    It is a proposition if it stands for one about a vehicle: that the one that gives way to us, or
    did so last, does not. It is None for all other suppositions.

    Raises:
        Unanswered: nobody can be added, or nobody gives way to us.
    """
    event = event_of(of)
    if event is not None and reacting.is_somebody(event) and not negated:
        return reacting.for_anybody(event, scene)
    if event is None or not isinstance(event.actor, Nobody):
        return None
    if negated and event.action in reacting.DUTIES:
        return Happens(_owed(event, scene))
    raise Unanswered(CannotSay("unsupported-condition" if negated else "imagined"))


def _owed(event: Event, scene: Asked) -> Event:
    """Return an event of nobody as that of the vehicle that gives way to us, or did so last.

    Raises:
        Unanswered: nobody gives way to us, or did.
    """
    since = scene.now if event.tense in ("present", "future") else None
    gave = scene.world.episodes(None, YIELDING, begin=since, object=Ego())
    whom = [e.actor for e in gave if isinstance(e.actor, Vehicle)]
    if not whom:
        raise Unanswered(CannotSay("unsupported-condition"))
    return replace(event, actor=whom[-1])
