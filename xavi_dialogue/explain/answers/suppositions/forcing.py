"""Forcing: whether another vehicle would have had to brake or wait if we had gone first."""

from xavi_dialogue.domain.answers import Unslowed
from xavi_dialogue.domain.meaning import Question, Whether
from xavi_dialogue.domain.terms import Event, Happens, Vehicle
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.reading import is_own
from xavi_dialogue.explain.answers.suppositions.hastening import hastened
from xavi_dialogue.explain.answers.suppositions.undone import GOING, HINDERED

FORCED = frozenset[ActionName](
    ("brake", "slow-down", "stop", "wait", "give-way", "avoid", "swerve")
)


def forced(
    event: Event | None, then: Question | None, scene: Asked, *, negated: bool
) -> Unslowed | None:
    """Return who would have been first, and by how much, which decides whether the other brakes.

    It is None if the question is something else, or if we did not slow down or wait.

    Raises:
        Unanswered: rollouts are needed.
    """
    match then:
        case Whether(that=Happens(event=Event(action=action, actor=Vehicle(number=other)))):
            pass
        case _:
            return None
    if event is None or not is_own(event.actor) or action not in FORCED:
        return None
    if event.action not in (HINDERED if negated else GOING):
        return None
    found = hastened(event, scene, "forces", other)
    return found if isinstance(found, Unslowed) else None
