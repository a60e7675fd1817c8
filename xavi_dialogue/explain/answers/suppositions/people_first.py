"""People first: whether we are going to let people on foot go first, by the rule."""

from collections.abc import Callable
from typing import Any, Final

from msgspec.structs import replace

from planner.record.trace import ON_FOOT
from xavi_dialogue.domain.answers import Answer, Priority
from xavi_dialogue.domain.meaning import Question, Whether
from xavi_dialogue.domain.terms import Happens, Proposition, Unsaid, Vehicle
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.expectations.forecast import forecast
from xavi_dialogue.explain.answers.measuring.durations import stands
from xavi_dialogue.explain.answers.propositions import standing_rules, verdicts
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.naming import is_us
from xavi_dialogue.explain.answers.reference.reading import numbers_in, unwrapped

HALTS: Final = frozenset[ActionName](("stop", "wait"))


def explainer(question: Question, asked: Asked) -> Callable[[Any, Asked], Answer] | None:
    """Find the explainer of whether we let people on foot go first; None: something else."""
    affirmed, negated = unwrapped(question.that) if isinstance(question, Whether) else (None, True)
    return whether if not negated and _asks(affirmed, asked) else None


def _asks(of: Proposition | None, asked: Asked) -> bool:
    if not isinstance(of, Happens) or not is_us(of.event.actor) or of.event.object is None:
        return False
    event = of.event
    if (
        event.modal is not None
        or event.tense != "future"
        or event.action not in standing_rules.HALTING
    ):
        return False
    if event.action in HALTS and stands(asked):
        return False  # why we stand says more
    looks = [asked.world.look(v, asked.now) for v in numbers_in(event.object)]
    return bool(looks) and all(look is not None and look.kind in ON_FOOT for look in looks)


def whether(question: Whether, asked: Asked) -> Answer:
    """Return whether the rule makes us let people go first; the plan may not show it yet.

    Where the record has no rule between us, the answer is what they are expected to do.

    Raises:
        Unanswered: the record does not hold the rule.
    """
    of, _ = unwrapped(question.that)
    assert isinstance(of, Happens)
    due = replace(of.event, action="give-way", modal="must", tense="present", time=Unsaid())
    found = verdicts.whether(Whether(Happens(due)), asked)
    if not isinstance(found, Priority) or found.rule != "none":
        return found
    people = (Vehicle(number) for number in numbers_in(due.object))
    return forecast(asked, people) or found
