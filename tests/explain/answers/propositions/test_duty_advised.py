"""What we should or could have done, had to do, and whose fault it was."""

from typing import Any

import pytest

from tests.explain.answers.propositions.test_duty import LOOKS, ONE, ROAD, action, weighed
from tests.explain.answers.stated import (
    US,
    decision,
    did,
    result,
    rolled,
    scene,
    they,
)
from xavi_dialogue.domain.answers import Measures, Priority, Verdict
from xavi_dialogue.domain.meaning import Fault, Whether, Why
from xavi_dialogue.domain.terms import (
    At,
    Happens,
    Is,
    Not,
)
from xavi_dialogue.explain.answers import causal
from xavi_dialogue.explain.answers.propositions.blame import blamed


@pytest.fixture
def handed(monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    """The questions that are handed on to the explainers of reasons, which answer all of them."""
    asked: list[Any] = []

    def explain(question: Any, _: Any) -> Any:
        asked.append(question)
        return Measures(())

    monkeypatch.setattr(causal, "explainer", lambda question, _: explain)
    return asked


# --- what we should do --------------------------------------------------------------------------


def test_what_we_could_have_done_is_supposed(handed: list[Any]) -> None:
    for tense in ("past", "perfect"):
        event = action("stop", modal="could", tense=tense)
        assert weighed(event).answer == Measures(())
        assert handed[-1] == Whether(Happens(event))
    assert weighed(action("stop", ONE, modal="could")) is None
    assert weighed(action("stop", modal="could", tense="present")) is None
    assert len(handed) == 2


def test_why_we_did_not_let_somebody_go_first(handed: list[Any]) -> None:
    event = action("give-way", US, ONE, modal="should", time=At(5.0))
    assert weighed(event).answer == Measures(())
    assert handed == [Why(Not(Happens(action("give-way", US, ONE))))]
    found = weighed(action("give-way", US, ONE, modal="should", tense="present"))
    assert found.answer.rule == "give-way"


def test_advice_is_met_with_the_reason(handed: list[Any]) -> None:
    for name, more in (
        ("turn", {}), ("go", {}), ("speed-up", {}), ("overtake", {}),
        ("stop", {"tense": "present"}), ("slow-down", {"tense": "future"}),
    ):  # fmt: skip
        event = action(name, modal="should", **more)
        assert weighed(event).answer == Measures(())
        assert handed[-1] == Why(Not(Happens(action(name, **more))))
    assert weighed(action("turn", ONE, modal="should")) is None


def test_what_we_do_as_advised_is_told_so(handed: list[Any]) -> None:
    stopping = did("stop", 18.0)
    event = action("stop", modal="should", tense="present", time=At(19.0))
    weighed(event, episodes=(stopping,))
    assert handed == [Why(Happens(action("stop", tense="present")))]
    soon = [rolled(5.0, 3.0, 1.0, 0.0, 0.0, 0.0, 0.0, plan=("stop",))]
    coming = weighed(action("stop", modal="should", tense="present"), traces=soon)
    assert isinstance(coming.answer, Verdict)
    assert (coming.answer.that, coming.answer.probability) == (
        Happens(action("stop", tense="future")), 1.0,
    )  # fmt: skip
    assert len(handed) == 1
    turned = did("turn", 4.0, 6.0)
    changed = did("change-left", 4.0, 6.0)
    found = weighed(action("change-left", modal="should"), episodes=(changed,))
    that = Not(Happens(action("change-left")))
    assert found.answer == Verdict(that, False, (changed,), claim=True, challenge=True)
    assert len(handed) == 1
    for name, more in (
        ("turn", {}), ("speed-up", {}), ("slow-down", {}), ("change-left", {"manner": ("fast",)}),
        ("change-left", {"manner": ("slowly",)}),
    ):  # fmt: skip
        told = (turned, changed, did("speed-up", 4.0, 6.0), did("slow-down", 4.0, 6.0))
        weighed(action(name, modal="should", **more), episodes=told)
        assert handed[-1] == Why(Not(Happens(action(name, **more))))


def test_whether_we_had_to_is_whether_it_was_necessary(handed: list[Any]) -> None:
    stopped = (did("stop", 4.0, 6.0),)
    for tense in ("past", "perfect"):
        event = action("stop", modal="must", tense=tense)
        assert weighed(event, episodes=stopped).answer == Measures(())
        assert handed[-1] == Whether(Is("necessary", event=action("stop", tense=tense)))
    assert weighed(action("stop", modal="must")) is None
    assert weighed(action("stop", modal="must", tense="present"), episodes=stopped) is None
    assert weighed(action("stop", ONE, modal="must"), episodes=stopped) is None


# --- whose fault --------------------------------------------------------------------------------


def blame(question: Fault, **facts: Any) -> Any:
    traces = [decision(20.0, road=ROAD)]
    return result(blamed, question, scene(looks=LOOKS, traces=traces, road=ROAD, **facts))


def test_what_we_did_is_explained_and_not_blamed(handed: list[Any]) -> None:
    stop = Happens(action("stop", modal="must"))
    assert blame(Fault(stop, ONE)) == Measures(())
    assert handed == [Why(Happens(action("stop")), suspect=ONE)]
    for name in ("keep-lane", "stand", "wait"):
        blame(Fault(Happens(action(name)), ONE))
        assert handed[-1] == Why(Not(Happens(action("go", tense="present"))), suspect=ONE)
    for question in (
        Fault(stop, ONE, legal=True),
        Fault(Happens(action("collide")), ONE),
        Fault(Happens(action("nearly-collide")), ONE),
        Fault(Happens(action("stop", ONE)), ONE),
        Fault(None, ONE),
        Fault(Is("safe"), ONE),
    ):
        found = blame(question, episodes=(they(1, "stop", 3.0, 5.0), did("collide", 6.0, 6.0)))
        assert isinstance(found, Priority)
        assert found.blame
    assert len(handed) == 4
