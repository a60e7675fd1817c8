"""What a reply tells, read back from its plain objects as the typed answer that it was."""

import pytest

from xavi_dialogue.dashboard.typed_answer import asked_about, title_of, told_of
from xavi_dialogue.dialogue.explanation import as_json
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.domain.answers import (
    Answer,
    ChoiceReason,
    Comforting,
    Contrast,
    Evidence,
    Options,
    OtherReason,
    OutcomeEstimate,
    Sociable,
    SupposedOfOther,
    SupposedOfUs,
)
from xavi_dialogue.domain.discourse import GroundedAct
from xavi_dialogue.domain.meaning import Ask, Feel, WhatIf, Why
from xavi_dialogue.domain.reasons import Performed
from xavi_dialogue.domain.terms import Event, Exists, Happens, Not, Vehicle, Vehicles

RESTS = Evidence("tree", 12, 6, ("abc",))
CONTRAST = Contrast(
    ("change-left",), ("continue",), OutcomeEstimate("done", 1.0), (), (), RESTS, 3.0
)
CHANGED = Happens(Event("change-left"))
STRAIGHT = Happens(Event("continue"))
WHY = Ask(Why(CHANGED))


def reply(*answers: Answer, act: Ask = WHY) -> Reply:
    acts, told = (as_json(GroundedAct(act)),), tuple(map(as_json, answers))
    return Reply(text="So.", kind="answer", acts=acts, answers=told, sim_time=5.0)


def test_the_first_causal_answer_is_told() -> None:
    reason = ChoiceReason("why", None, CONTRAST)
    told = told_of(reply(Sociable("greeting"), Options((), 2.0, RESTS), reason))
    assert told is not None
    assert told.answer == reason
    assert (told.said.factual, told.said.counterfactual) == (("change-left",), ("continue",))
    assert (told.decided, told.ours) == (3.0, True)


def test_an_answer_that_is_not_causal_is_told_where_it_names_evidence() -> None:
    told = told_of(reply(Sociable("greeting"), Options((), 2.0, RESTS)))
    assert told is not None
    assert (told.said.kind, told.said.evidence, told.decided) == ("options", RESTS, 2.0)
    assert told_of(reply(Sociable("greeting"))) is None


def test_an_answer_within_another_is_told() -> None:
    reason = ChoiceReason("why", None, CONTRAST)
    told = told_of(reply(Comforting(Feel("afraid"), reason)))
    assert told is not None
    assert told.answer == reason


def test_what_another_vehicle_does_is_not_ours() -> None:
    told = told_of(reply(OtherReason(1, None, evidence=RESTS)))
    assert told is not None
    assert not told.ours


def test_a_refusal_tells_nothing() -> None:
    assert told_of(Reply(text="No.", kind="refusal", sim_time=1.0)) is None


@pytest.mark.parametrize(
    ("answer", "act", "title"),
    [
        (ChoiceReason("why", None, CONTRAST), WHY, "instead"),
        (ChoiceReason("why", None, CONTRAST), Ask(Why(CHANGED, instead=STRAIGHT)), "asked"),
        (ChoiceReason("why-not", None, CONTRAST), Ask(Why(Not(STRAIGHT))), "asked"),
        (SupposedOfUs(CONTRAST), Ask(WhatIf(STRAIGHT)), "asked"),
        (
            SupposedOfUs(CONTRAST, done=Performed("change-left", "did")),
            Ask(WhatIf(CHANGED)),
            "instead",
        ),
        (
            SupposedOfOther(1, None, None, (), ("continue",), False, CONTRAST),
            Ask(WhatIf(Not(Exists(Vehicle(1))))),
            "then",
        ),
    ],
)
def test_a_foil_is_called_by_how_it_came_up(answer: Answer, act: Ask, title: str) -> None:
    asked = reply(answer, act=act)
    told = told_of(asked)
    assert told is not None
    assert title_of(told, asked) == title


def test_vehicles_that_are_asked_about() -> None:
    both = Ask(Why(Happens(Event("stop", Vehicles((2, 4)), object=Vehicle(1)))))
    assert set(asked_about(reply(Sociable("greeting"), act=both))) == {1, 2, 4}
