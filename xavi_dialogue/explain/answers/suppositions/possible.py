"""Possible: whether we could have done otherwise, and whether we had to do what we did."""

from msgspec.structs import replace

from xavi_dialogue.domain.answers import Answer, DidNotHappen
from xavi_dialogue.domain.meaning import Whether
from xavi_dialogue.domain.terms import (
    Compares,
    Event,
    Happens,
    Is,
    Measured,
    Now,
    Proposition,
    Unsaid,
)
from xavi_dialogue.domain.vocabulary import BEYOND, ActionName
from xavi_dialogue.explain.answers.expectations.foreseen import HALTS
from xavi_dialogue.explain.answers.reasons import motions
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.occasions import occasion
from xavi_dialogue.explain.answers.reference.reading import event_of, is_own, unwrapped
from xavi_dialogue.explain.answers.ride.comfort import comfort_of, stretch
from xavi_dialogue.explain.answers.suppositions import deciding
from xavi_dialogue.explain.answers.suppositions.own_suppositions import of_us
from xavi_dialogue.explain.answers.suppositions.undone import is_paced_turn

#: Actions that are not ways of driving to choose from.
NOT_DRIVING = frozenset[ActionName](
    ("see", "do", "happen", "collide", "nearly-collide", "arrive", "signal", "appear", "disappear")
)
YIELDING = frozenset[ActionName](("give-way", "let-go", "wait"))
BRAKING = frozenset[ActionName](("brake", "slow-down", "stop"))
FASTER = frozenset[ActionName](("speed-up",))


def is_could(of: Proposition | None) -> bool:
    """Check whether the question is what we could have done."""
    of = _uncounted(of)
    event = event_of(of)
    if not isinstance(of, Happens) or event is None or not is_own(event.actor):
        return False
    driving = event.action not in NOT_DRIVING and event.action not in BEYOND
    return driving and event.modal == "could" and event.tense in ("past", "perfect")


def _uncounted(of: Proposition | None) -> Proposition | None:
    """Read "could have overtaken twice by now" as that it could have been done."""
    of, _ = unwrapped(of)
    match of:
        case Compares(left=Measured(attribute="count", event=Event() as event)):
            time = Unsaid() if isinstance(event.time, Now) else event.time
            return Happens(replace(event, time=time))
    return of


def is_must(of: Proposition | None) -> bool:
    """Check whether the question is what we had to do; right of way is another matter."""
    of, _ = unwrapped(of)
    event = event_of(of)
    if not isinstance(of, Happens) or event is None or not is_own(event.actor):
        return False
    named = event.object is not None or event.tense == "present"
    owed = event.action in ("give-way", "let-go") or (event.action == "wait" and named)
    coming = event.action in HALTS and event.tense == "future"  # the plan answers that
    driving = event.action not in NOT_DRIVING and not coming
    return event.modal == "must" and driving and not owed


def could(question: Whether, scene: Asked) -> Answer:
    """Return the consequences of what we could have done.

    Raises:
        Unanswered: it could not be done; or rollouts are needed.
    """
    event = event_of(_uncounted(question.that))
    assert event is not None
    if "late" in event.manner and event.action in BRAKING:
        return _braked(replace(event, modal=None, manner=()), scene)
    if is_paced_turn(event):
        return of_us(replace(event, modal="would"), scene, "could")
    if event.action in FASTER or "fast" in event.manner:
        return motions.slow(scene)
    return of_us(replace(event, modal="would"), scene, "could")


def _braked(event: Event, scene: Asked) -> Answer:
    """Return how hard we braked: braking later would have been harder.

    Raises:
        Unanswered: we did not brake, or the record has no motion there.
    """
    done = occasion(scene, replace(event, action="brake", object=None))
    if done is None:
        raise Unanswered(DidNotHappen(event))
    return comfort_of(scene, stretch(scene, done), done)


def must(question: Whether, scene: Asked) -> Answer:
    """Answer whether we had to do what we did, or have to.

    Raises:
        Unanswered: we did not do it; or rollouts are needed.
    """
    event = event_of(question.that)
    assert event is not None
    if "slowly" in event.manner and event.action in ("go", "move", "continue"):
        return motions.slow(scene)
    plain: Event = replace(event, modal=None)
    about = Whether(Is("necessary", event=plain, time=plain.time, tense=plain.tense))
    return deciding.needed(about, scene)
