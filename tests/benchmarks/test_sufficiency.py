"""The benchmark of reasons: what is asked, whom the rival takes its words from, what is counted."""

from random import Random

import msgspec
import pytest
from typer.testing import CliRunner

from benchmarks.commands import commands
from benchmarks.figures import Measure
from benchmarks.sufficiency import sufficiency
from benchmarks.sufficiency.sufficiency import SufficiencyReport, report
from benchmarks.sufficiency.sufficiency_asking import Answered, Put, questions
from benchmarks.sufficiency.sufficiency_judging import Judged, Read, Wrong, donor, read
from tests.traces import s1_ride

WHY = Put("why-not", "Why don't you stop?", "stop")
MISSING = Wrong("risk", "risk not said of the foil", "stop: 20.0..20.0 %")


def one(
    text: str, *wrong: Wrong, declined: bool = False, uncovered: tuple[str, ...] = ()
) -> Judged:
    return Judged("s1", 0, 3.0, "why-not", WHY.text, text, declined, wrong, 1, uncovered)


def judged(*, rival: tuple[Judged, ...]) -> SufficiencyReport:
    ours = (
        one("It costs 2 seconds."),
        one("It is dangerous.", MISSING, uncovered=("It is dangerous. [all of it]",)),
        one("I did not understand that.", declined=True),
    )
    return report([Read("s1", 0, ours, rival, same=1)])


def test_answers_are_counted_by_check_and_declined_ones_apart() -> None:
    found = judged(rival=(one("It saves 2 seconds.", MISSING),))
    assert (found.all.asked, found.all.declined, found.all.answers) == (3, 1, 2)
    assert found.all.passed == 50.0
    assert found.all.failed["risk"] == 1
    assert found.all.failed["sign"] == 0
    assert found.all.understood == 50.0
    assert found.rival.passed == 0.0
    assert not found.met
    assert [(e.check, e.count) for e in found.worst] == [("risk", 1)]
    shown = found.table()
    assert "stop: 20.0..20.0 %" in shown
    assert "It is dangerous. [all of it]" in shown  # what was not read is never passed over
    assert msgspec.json.decode(msgspec.json.encode(found))["bench"] == "sufficiency"


@pytest.mark.parametrize(("failing", "met"), [(3, True), (1, False)])
def test_a_bench_that_another_reason_passes_is_too_easy(failing: int, met: bool) -> None:
    rival = tuple(one("x", *((MISSING,) if k < failing else ())) for k in range(4))
    found = report([Read("s1", 0, (one("It costs 2 seconds."),), rival)])
    assert found.met == met


def test_the_rival_takes_the_words_of_another_decision() -> None:
    mine = Answered(3.0, WHY, "a", "answer", "now")
    same = Answered(4.0, WHY, "b", "answer", "now")  # of the same decision
    other = Answered(5.0, WHY, "c", "answer", "later")
    else_asked = Answered(
        5.0, Put("why-not", "Why don't you turn?", "exit-left"), "d", "answer", "l"
    )
    refused = Answered(6.0, WHY, "e", "refusal", "later")
    every = (mine, same, other, else_asked, refused)
    assert all(donor(mine, every, Random(k)) == other for k in range(9))
    assert donor(mine, (mine, same, else_asked), Random(0)) == else_asked
    assert donor(mine, (mine, same, refused), Random(0)) is None


def test_every_option_that_was_tried_is_asked_about() -> None:
    trace = s1_ride().traces[0]
    tried = {r.actions[0].action for r in trace.rollouts if r.actions}
    asked = questions(trace)
    assert {put.foil for put in asked} == (tried - {trace.plan[0].action}) | {None}
    assert {put.kind for put in asked} == {"why", "why-not", "instead", "what-if", "how"}
    assert len({put.text for put in asked}) == len(asked)


def test_a_scenario_that_cannot_be_driven_is_told_in_the_report() -> None:
    found = read(("no-such-scenario", 0, 1))
    assert found.error is not None
    whole = report([found])
    assert not whole.met
    assert "no-such-scenario" in whole.table()


def test_the_exit_status_says_whether_any_answer_fails(monkeypatch: pytest.MonkeyPatch) -> None:
    shown: list[str] = []

    def show(measure: Measure, as_json: bool) -> None:
        shown.append(measure(lambda _: None).table())

    for wrong, status in (((), 0), ((MISSING,), 1)):
        ours = (one("It costs 2 seconds.", *wrong),)
        found = report([Read("s1", 0, ours, (one("x", MISSING),))])
        monkeypatch.setattr(sufficiency, "measure", lambda *_, found=found: found)
        ended = CliRunner().invoke(commands(show), ["sufficiency", "--scenario", "s1"])
        assert ended.exit_code == status
    assert len(shown) == 2


def test_answers_of_a_story_are_read() -> None:
    found = read(("s1", 0, 8))
    assert found.error is None
    whole = report([found])
    assert whole.all.answers > 30
    assert whole.all.understood is not None
    assert whole.all.understood > 90.0
    assert whole.all.passed is not None
    assert whole.rival.passed is not None
    assert whole.all.passed > whole.rival.passed + 25.0
