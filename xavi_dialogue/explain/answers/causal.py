"""Causal: who explains reasons, suppositions and decisions, by question and predicate."""

from collections.abc import Callable, Mapping
from typing import Any, TypeAlias

from xavi_dialogue.domain.answers import Answer
from xavi_dialogue.domain.meaning import (
    Compare,
    HowAvoid,
    HowDecide,
    HowKnow,
    HowSure,
    Listing,
    Question,
    WhatIf,
    WhatWouldChange,
    Whether,
    Which,
    Why,
)
from xavi_dialogue.domain.terms import Caused, Happens, Is, Proposition
from xavi_dialogue.explain.answers import choices, deciding, knowing, reasons, supposing
from xavi_dialogue.explain.answers.asked import Asked
from xavi_dialogue.explain.answers.reading import is_own, unwrapped

Explainer: TypeAlias = Callable[[Any, Asked], Answer]

#: By type of question alone.
QUESTIONS: Mapping[type, Explainer] = {
    Why: reasons.why,
    WhatIf: supposing.what_if,
    HowKnow: knowing.how_know,
    HowSure: knowing.how_sure,
    HowDecide: knowing.how_decide,
    WhatWouldChange: deciding.what_would_change,
    HowAvoid: deciding.how_avoid,
}
NEEDED = frozenset(("necessary", "worth-it", "better"))
LISTED = frozenset(("options", "decisions"))
REASONS = frozenset(("causes", "reasons"))


def explainer(question: Question, scene: Asked) -> Explainer | None:
    """Find the explainer of a causal question; None where it asks for facts alone."""
    del scene
    match question:
        case Whether(that):
            return _of_whether(that)
        case Which(such=such) if such is not None and isinstance(unwrapped(such)[0], Caused):
            return _who_caused
        case Compare(options) if options and all(_is_option(option) for option in options):
            return deciding.compared
        case Listing(of) if of in LISTED and of == "options":
            return deciding.listed
        case Listing(of) if of in REASONS:
            return _reasons
    return QUESTIONS.get(type(question))


def _of_whether(that: Proposition) -> Explainer | None:
    of, _ = unwrapped(that)
    if isinstance(of, Caused):
        return _was_cause
    if isinstance(of, Is) and of.state in NEEDED:
        about_us = of.event is None or is_own(of.event.actor)
        return deciding.needed if about_us and is_own(of.thing) else None
    return None


def _is_option(option: object) -> bool:
    return isinstance(option, Happens) and is_own(option.event.actor)


def _was_cause(question: Whether, scene: Asked) -> Answer:
    """Whether somebody is why something came about: the reason, with a word on that vehicle."""
    return reasons.why(Why(question.that), scene)


def _who_caused(question: Which, scene: Asked) -> Answer:
    """Because of whom something came about: the reason."""
    of, _ = unwrapped(question.such)
    assert isinstance(of, Caused)
    return reasons.why(Why(of.effect if of.effect is not None else of), scene)


def _reasons(question: Listing, scene: Asked) -> Answer:
    """The reasons of what was spoken of, or of the last manoeuvre."""
    del question
    return choices.why(None, scene)
