"""What deserves a look, and in which order."""

from tests.audit.made import answered, audit, choice, facts, mistake
from xavi_dialogue.audit.audit import Audit
from xavi_dialogue.audit.results.findings import KINDS, Finding, findings
from xavi_dialogue.audit.values import Peak


def of(found: tuple[Finding, ...], kind: str) -> list[tuple[str, float]]:
    rows = [one for one in found if one.kind == kind]
    assert [one.rank for one in rows] == list(range(1, len(rows) + 1))
    return [(one.ride, one.value) for one in rows]


def test_the_worst_comes_first() -> None:
    known = findings(
        audit(
            (facts(braking=Peak(2.0, 5.0)), answered()),
            (
                facts(braking=Peak(6.5, 5.0), time_to_collision=Peak(0.8, 4.0, 2, "van 2")),
                answered(),
            ),
            (facts(braking=None, time_to_collision=None), answered()),
        )
    )
    assert of(known, "hard-braking") == [("s1-1", 6.5), ("s1-0", 2.0)]
    assert of(known, "close-call") == [("s1-1", 0.8), ("s1-0", 2.5)]
    assert [KINDS.index(one.kind) for one in known] == sorted(
        KINDS.index(one.kind) for one in known
    )


def test_a_collision_is_no_close_call() -> None:
    hit = facts(collision=Peak(10.0, 9.0, 1, "blue car 1"), ending="collided")
    known = findings(audit((hit, answered())))
    assert of(known, "collision") == [("s1-0", 10.0)]
    assert of(known, "close-call") == []
    assert known[0].text == "hit blue car 1 at 36 km/h"


def test_only_predictions_that_mattered_are_found() -> None:
    rides = [
        (facts(mistakes=(mistake(gain, mattered=mattered),)), answered())
        for gain, mattered in ((0.4, True), (2.0, True), (None, None), (None, False))
    ]
    known = findings(audit(*rides))
    assert of(known, "wrong-prediction") == [("s1-1", 2.0), ("s1-0", 0.4)]
    first = next(one for one in known if one.kind == "wrong-prediction")
    assert first.text == (
        "blue car 1 took the road to the right (20%), not the road straight on (70%); known"
        " before: change-left instead of continue, better by 2.0 s"
    )


def test_close_decisions_in_a_row_are_one_finding() -> None:
    row = (choice(1.0, 3.0), choice(2.0, 0.3), choice(3.0, 0.1), choice(4.0, 3.0), choice(5.0, 0.2))
    known = findings(audit((facts(choices=row), answered())))
    assert of(known, "close-decision") == [("s1-0", 0.1), ("s1-0", 0.2)]
    assert "2 decisions in a row" in next(one.text for one in known if one.value == 0.1)


def test_refusals_are_counted_by_question_and_reason() -> None:
    no = answered("I did not.", kind="refusal", reason="did-not-happen")
    odd = answered("What?", kind="refusal", reason="not-understood")
    known = findings(audit((facts(), odd), (facts(), no), (facts(), answered()), (facts(), no)))
    assert of(known, "refusal") == [("s1-1", 2.0), ("s1-0", 1.0)]


def test_rides_are_in_the_order_of_their_numbers() -> None:
    known = findings(audit(*[(facts(), answered())] * 12))
    assert [ride for ride, _ in of(known, "close-call")] == [f"s1-{k}" for k in range(12)]


def test_nothing_is_found_in_nothing() -> None:
    assert findings(Audit("program", (), (), ())) == ()
