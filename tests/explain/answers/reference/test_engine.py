"""How an act is answered: by whom, of which part of the ride, and what is refused."""

from typing import Any

import pytest

from tests.explain.answers.reasons.test_explainers import ONE, STOP, of
from tests.explain.answers.stated import decision, did, look, result, scene
from xavi_dialogue.causal.model import CausalError
from xavi_dialogue.domain.answers import (
    CannotSay,
    Counted,
    Declined,
    DidNotHappen,
    Measures,
    NotRecorded,
    NotUnderstood,
)
from xavi_dialogue.domain.discourse import GroundedAct, Span
from xavi_dialogue.domain.meaning import (
    Ask,
    AskHelp,
    Beyond,
    Changed,
    Doing,
    HowDecide,
    HowMany,
    HowMuch,
    Listing,
    Request,
    Where,
    Why,
)
from xavi_dialogue.domain.terms import (
    At,
    Between,
    Event,
    Happens,
    Is,
    Measured,
    Not,
    Related,
    Unsaid,
    WholeRide,
)
from xavi_dialogue.explain.answers import (
    causal,
)
from xavi_dialogue.explain.answers.engine import explain_in
from xavi_dialogue.explain.answers.reference.asked import Unanswered

# --- the engine ---------------------------------------------------------------------------------


def answered(act: Any, span: Any = None, **facts: Any) -> Any:
    asked = scene(**({"looks": {1: look(1), 2: look(2)}} | facts))
    return explain_in(GroundedAct(act, span), asked.ride, asked.world)


STOPS = (did("stop", 3.0, 5.0), did("stop", 12.0, 15.0))


def test_an_act_is_answered_by_whom_the_table_names() -> None:
    counted = answered(Ask(HowMany(Event("stop", time=WholeRide()))), episodes=STOPS)
    assert isinstance(counted, Counted)
    assert counted.count == 2
    traces = [decision(20.0)]
    assert isinstance(answered(Request(Event("honk")), traces=traces), Declined)
    assert answered(Beyond("advice", "buy it")) == CannotSay("advice", "buy it")
    assert answered(AskHelp()) == NotUnderstood()
    missing = answered(Ask(HowMany(ONE)), looks={2: look(2)})
    assert missing.thing == ONE


def test_a_question_that_nobody_answers_is_not_understood(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(causal, "explainer", lambda *_: None)
    assert answered(Ask(HowDecide())) == NotUnderstood()


def test_a_record_that_contradicts_itself_explains_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    def contradicted(*_: Any) -> Any:
        raise CausalError("no")

    monkeypatch.setattr(causal, "explainer", contradicted)
    assert answered(Ask(HowDecide())) == NotRecorded("gap-in-record", since=20.0)


#: When each span begins: the questions are answered by what they are about.
@pytest.mark.parametrize(
    ("question", "span"),
    [
        (Doing(time=At(4.0)), Span(4.0, 4.0, said=True)),
        (Doing(time=At(24.0)), Span(24.0, 24.0, said=True, ahead=True)),
        (Doing(time=Between(4.0, 6.0)), Span(4.0, 6.0, said=True)),
        (Doing(time=Between(22.0, 26.0)), Span(22.0, 26.0, said=True, ahead=True)),
        (Doing(time=At(20.0)), Span(20.0, 20.0, said=True)),
        (Why(Happens(Event("stop", time=At(4.0)))), Span(4.0, 4.0, said=True)),
        (Where(ONE, At(3.0)), Span(3.0, 3.0, said=True)),
        (Why(Not(Is("necessary", event=Event("stop", time=At(4.0))))), Span(4.0, 4.0, said=True)),
        (Changed(Unsaid()), None),
        (Why(Related("behind", ONE, time=At(4.0))), None),
        (HowMuch(Measured("speed", time=At(4.0))), None),
    ],
)
def test_the_part_of_the_ride_that_a_question_names(
    question: Any, span: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    seen: list[Any] = []

    def explainer(_: Any, asked: Any) -> Any:
        seen.append(asked.span)
        return lambda *_: Measures(())

    monkeypatch.setattr(causal, "explainer", explainer)
    assert answered(Ask(question)) == Measures(())
    given = Span(1.0, 2.0)
    answered(Ask(question), given)
    assert seen == [span, given]


LOST = ((2.0, 3.0), (8.0, 9.0))


@pytest.mark.parametrize(
    ("refusal", "told"),
    [
        (DidNotHappen(STOP), NotRecorded("gap-in-record", since=2.0, until=9.0)),
        (DidNotHappen(STOP, planned=25.0), None),
        (DidNotHappen(STOP, elsewhen=4.0), None),
        (DidNotHappen(STOP, STOPS), None),
        (NotRecorded("hidden"), None),
    ],
)
def test_what_may_have_been_lost_is_not_denied(
    refusal: Any, told: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refused(*_: Any) -> Any:
        raise Unanswered(refusal)

    monkeypatch.setattr(causal, "explainer", refused)
    assert answered(Ask(HowDecide()), gaps=LOST) == (refusal if told is None else told)
    assert answered(Ask(HowDecide())) == refusal


def test_results_of_explainers_are_handed_out() -> None:
    found = result(of(Listing("options")), Listing("options"), scene(traces=[decision(20.0)]))
    assert [option.action for option in found.options] == ["continue"]
