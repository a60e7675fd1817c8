"""Which explainer a causal question goes to by its type."""

from typing import Any

import pytest

from tests.explain.answers.reasons.test_explainers import GO, ONE, STOP, TWO, of
from tests.explain.answers.stated import US
from xavi_dialogue.domain.meaning import (
    Compare,
    Fault,
    HowAvoid,
    HowDecide,
    HowKnow,
    HowSure,
    Listing,
    WhatIf,
    WhatWouldChange,
    Whether,
    Which,
    Why,
)
from xavi_dialogue.domain.terms import (
    Both,
    Event,
    Everyone,
    Happens,
    Is,
    Vehicles,
    Wanted,
)
from xavi_dialogue.explain.answers import owing
from xavi_dialogue.explain.answers.abandoned_plans import wavered
from xavi_dialogue.explain.answers.propositions import reasons
from xavi_dialogue.explain.answers.reasons import knowing
from xavi_dialogue.explain.answers.reasons.provoked import because_of_us
from xavi_dialogue.explain.answers.suppositions import deciding, risks

# --- by type ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("question", "explainer"),
    [
        (WhatIf(Happens(STOP)), risks.what_if),
        (HowKnow(), knowing.how_know),
        (HowSure(), knowing.how_sure),
        (HowDecide(), knowing.how_decide),
        (WhatWouldChange(), deciding.what_would_change),
        (HowAvoid(), deciding.how_avoid),
        (Listing("options"), deciding.listed),
        (Compare((Happens(STOP), Happens(GO)), "time"), deciding.compared),
        (Why(Happens(STOP)), reasons.why),
        (Fault(), None),
        (Listing("events"), None),
        (Listing("decisions"), None),
        (Compare((), "time"), None),
        (Compare((ONE, TWO), "speed"), None),
        (Compare((Happens(STOP), Happens(Event("stop", ONE))), "time"), None),
        (Compare((Happens(STOP), ONE), "time"), None),
        (Whether(Both((Happens(STOP), Happens(GO)), join="or")), None),
        (Whether(Happens(STOP)), None),
        (Which(Wanted(), Happens(Event("overtake", Wanted(), US))), None),
        (Which(ONE), None),
    ],
)
def test_questions_by_type(question: Any, explainer: Any) -> None:
    assert of(question) is explainer


FIRST = {"manner": ("first",), "tense": "present"}


@pytest.mark.parametrize(
    ("question", "explainer"),
    [
        (Why(Happens(Event("go", ONE, **FIRST))), owing.before_us),  # type: ignore[arg-type]
        (Why(Happens(Event("go", Everyone(), **FIRST))), owing.before_us),  # type: ignore[arg-type]
        (Why(Happens(Event("go", Vehicles((1, 2)), **FIRST))), owing.before_us),  # type: ignore[arg-type]
        (Why(Is("allowed", event=Event("go", ONE, **FIRST))), owing.before_us),  # type: ignore[arg-type]
        (Why(Is("safe", event=Event("go", ONE, **FIRST))), reasons.why),  # type: ignore[arg-type]
        (Why(Happens(Event("go", US, **FIRST))), reasons.why),  # type: ignore[arg-type]
        (Why(Happens(Event("turn", ONE, **FIRST))), reasons.why),  # type: ignore[arg-type]
        (Why(Happens(Event("go", ONE))), reasons.why),
        (Why(Happens(Event("brake", ONE)), suspect=US), because_of_us),
        (Why(Happens(Event("let-go", ONE)), suspect=US), because_of_us),
        (Why(Happens(Event("brake", ONE)), suspect=TWO), reasons.why),
        (Why(Happens(Event("brake", US)), suspect=US), reasons.why),
        (Why(Happens(Event("turn", ONE)), suspect=US), reasons.why),
        (Why(Happens(Event("change-plan"))), wavered),
        (Why(Happens(Event("change-plan")), suspect=ONE), reasons.why),
        (Why(Happens(Event("change-plan", ONE))), reasons.why),
    ],
)
def test_reasons_of_a_kind_of_their_own(question: Any, explainer: Any) -> None:
    assert of(question) is explainer
