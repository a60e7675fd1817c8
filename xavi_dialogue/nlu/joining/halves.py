"""Halves: the second of two questions that takes its question word from the first."""

from xavi_dialogue.domain.meaning import Act, Ask, Elliptic, HowMuch, When, Why
from xavi_dialogue.domain.terms import Compares, Event, Happens, Lane, Measured, Relative
from xavi_dialogue.nlu.compose.wh_questions.savings import change_to


def halved(before: Act, act: Act) -> Act:
    """Ask for both moments: "the time it turned green, and the time at which you set off"."""
    match before, act:
        case Ask(question=When()), Elliptic(
            time=Relative("during", Event() as event), thing=None, event=None, form="same"
        ):
            return Ask(When(Happens(event)))
        case Ask(question=Why(of=Compares(left=Measured("value", Lane() as lane)))), (
            Elliptic(thing=None, event=None, form="how-much")
        ):  # "what makes the left lane better, and by how much?"
            return Ask(HowMuch(Measured("delay", event=change_to(lane, "present"))))
    return act
