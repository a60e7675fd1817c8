"""Whom another vehicle gives way to: claimed where predicted ways and its track agree."""

from collections.abc import Sequence

import pytest

from planner.trace import HeldUp, HoldUp, PlanTrace
from tests.explain.asking import told
from tests.traces import Aim, End, Way, World, straight_track, trace_of
from xavi_dialogue.explain.explanation import Explanation
from xavi_dialogue.explain.query import Query, QueryAction, Tense
from xavi_dialogue.explain.record import Record
from xavi_dialogue.language.context import SpeechContext
from xavi_dialogue.language.realise import realise

STOPPING = (8.0, 6.0, 4.0, 2.0, 0.0)
SPEEDS = (8.0,) * 11 + (6.0, 4.0, 2.0) + (0.0,) * 6  # 5 Hz, until 4 s: it stands from 3 s on


def stretch(
    other: int, start: float, end: float, how: HoldUp = "right-of-way", speed: float = 13.9
) -> HeldUp:
    return HeldUp(other, start, end, how, speed, speed)


def decision(
    time: float,
    left: Sequence[HeldUp],
    onward: Sequence[HeldUp] = (),
    *,
    speeds: Sequence[float] = SPEEDS,
    turns: float = 0.8,
) -> PlanTrace:
    """Vehicle 1 turns left or goes on; vehicle 2 comes towards it, and 3 is there as well."""
    aims = {
        1: (
            Aim("exit-left", turns, (Way(("exit-left",), 1.0, STOPPING, tuple(left)),)),
            Aim("continue", 1.0 - turns, (Way(("continue",), 1.0, STOPPING, tuple(onward)),)),
        ),
        2: (Aim("continue", 1.0, (Way(("continue",)),)),),
        3: (Aim("continue", 1.0, (Way(("continue",)),)),),
    }
    world = World(aims, (("continue",),), lambda plan, chosen: (End(), 1))
    seen = round(time * 5.0)
    known = speeds[: max(seen, 1)]
    return trace_of(
        world, time=time, decision=round(time), history={1: straight_track(time, 1, known)}
    )


def ask(
    *traces: PlanTrace,
    asked: tuple[QueryAction, ...] = ("stop",),
    tense: Tense = "past",
    kind: str = "why",
) -> tuple[Explanation, str]:
    query = Query(type=kind, actor="vehicle:1", factual=asked or None, tense=tense)  # type: ignore[arg-type]
    found = told(query, Record(traces[-1].sim_time, tuple(traces)))
    assert isinstance(found, Explanation)
    return found, realise(query, found, SpeechContext()).text


def test_who_stops_to_let_another_pass() -> None:
    found, text = ask(decision(3.0, [stretch(2, 3.0, 6.0)]), decision(4.0, [stretch(2, 4.0, 6.0)]))
    (cause,) = found.causes
    assert (cause.vehicle, cause.probability) == (2, 1.0)
    assert cause.mechanism is not None
    assert cause.mechanism.how == "right-of-way"
    assert cause.mechanism.share == pytest.approx(0.8)
    assert cause.mechanism.delay == pytest.approx(3.0)
    assert text == "Vehicle 1 stopped to let vehicle 2 pass before turning left."


def test_the_decision_behind_it_is_among_the_evidence() -> None:
    one, other = decision(3.0, [stretch(2, 3.0, 6.0)]), decision(4.0, [])
    found, _ = ask(one, other)
    assert set(found.evidence.traces) == {one.trace_id, other.trace_id}


def test_what_holds_it_up_later_is_not_why_it_stopped() -> None:
    found, text = ask(decision(3.0, [stretch(2, 9.0, 12.0)]), decision(4.0, [stretch(3, 4.0, 8.0)]))
    assert found.causes == ()
    assert text == "Vehicle 1 most likely stopped in order to turn left."


def test_what_is_improbable_is_not_named() -> None:
    found, _ = ask(decision(3.0, [stretch(2, 3.0, 6.0)], turns=0.4))
    assert found.causes == ()


def test_what_lasts_no_time_stops_nobody() -> None:
    found, _ = ask(decision(3.0, [stretch(2, 3.0, 3.2)]))
    assert found.causes == ()


def test_what_is_probable_is_said_to_be() -> None:
    _, text = ask(decision(3.0, [stretch(2, 3.0, 6.0)], turns=0.6))
    assert text.startswith("Vehicle 1 probably stopped to let vehicle 2 pass")


@pytest.mark.parametrize(
    ("held", "why"),
    [
        (stretch(2, 3.0, 6.0, "leader", 0.0), "because vehicle 2 was standing ahead of it"),
        (stretch(2, 3.0, 6.0, "blocked", 0.2), "because vehicle 2 was standing ahead of it"),
        (
            stretch(2, 3.0, 6.0, "leader", 5.0),
            "because vehicle 2 was driving ahead of it at 18 km/h",
        ),
        (stretch(2, 3.0, 6.0, "cut-in", 5.0), "because vehicle 2 was getting in its way"),
        (stretch(0, 3.0, 6.0), "to let me pass before turning left"),
        (stretch(0, 3.0, 6.0, "leader", 0.0), "because I was standing ahead of it"),
    ],
)
def test_how_it_is_in_the_way(held: HeldUp, why: str) -> None:
    _, text = ask(decision(3.0, [held], [held]))
    assert text == f"Vehicle 1 stopped {why}."


def test_two_who_take_turns_are_one_reason() -> None:
    """A queue: the one ahead, or the one ahead of that; neither of them is certain."""
    ahead, beyond = stretch(2, 3.0, 6.0, "leader", 0.0), stretch(3, 3.0, 6.0, "leader", 0.0)
    speeds = tuple(12.0 - 0.6 * k for k in range(21))
    traces = [
        decision(1.0, [], speeds=speeds),
        decision(2.0, [beyond], [beyond], speeds=speeds),
        decision(3.0, [ahead], [ahead], speeds=speeds),
        decision(4.0, [ahead], [], speeds=speeds),
    ]
    found, text = ask(*traces, asked=("slow-down",))
    assert [cause.vehicle for cause in found.causes] == [2]
    assert found.causes[0].mechanism is not None
    assert found.causes[0].mechanism.share == pytest.approx(1.8 / 4.0)
    assert text == "Vehicle 1 probably slowed down because vehicle 2 was standing ahead of it."


def test_slowing_down_is_explained_by_all_decisions_meanwhile() -> None:
    """What came up with the last of three decisions explains but a third of it."""
    speeds = tuple(12.0 - 0.6 * k for k in range(21))
    traces = [
        decision(1.0, [], speeds=speeds),
        decision(2.0, [], speeds=speeds),
        decision(3.0, [stretch(2, 3.0, 6.0)], speeds=speeds),
    ]
    found, _ = ask(*traces, asked=("slow-down",))
    assert found.causes == ()
    always = [decision(t, [stretch(2, t, 6.0)], speeds=speeds) for t in (1.0, 2.0, 3.0)]
    found, text = ask(*always, asked=("slow-down",))
    assert [cause.vehicle for cause in found.causes] == [2]
    assert text == "Vehicle 1 slowed down to let vehicle 2 pass before turning left."


def test_what_goes_on_is_told_by_the_latest_decision() -> None:
    traces = decision(3.0, [stretch(2, 3.0, 4.0)]), decision(4.0, [stretch(3, 4.0, 8.0)])
    _, text = ask(*traces, tense="present")
    assert text == "Vehicle 1 is waiting to let vehicle 3 pass before turning left."
    _, text = ask(*traces, asked=(), tense="present", kind="what")
    assert text == (
        "Vehicle 1 is standing still to let vehicle 3 pass. I expect vehicle 1 to turn left."
    )


def test_nobody_is_blamed_where_the_track_disagrees() -> None:
    """It was foreseen to be held up, and drives on."""
    held = [stretch(2, 3.0, 6.0)]
    found, _ = ask(decision(3.0, held, speeds=(8.0,) * 20), asked=(), tense="present", kind="what")
    assert found.causes == ()


def test_what_is_yet_to_come_is_explained_by_the_ways_on_which_it_does() -> None:
    held = [stretch(2, 6.0, 9.0)]
    found, text = ask(decision(3.0, held, held, speeds=(8.0,) * 20), tense="future")
    assert [cause.vehicle for cause in found.causes] == [2]
    assert text == "Vehicle 1 will stop to let vehicle 2 pass before turning left."


@pytest.mark.parametrize(
    ("suspect", "part", "answer"),
    [
        ("vehicle:2", "main", "Yes. Vehicle 1 stopped to let vehicle 2 pass"),
        ("vehicle:3", "none", "No, not because of vehicle 3. Vehicle 1 stopped to let vehicle 2"),
        ("ego", "none", "No, not because of me. Vehicle 1 stopped to let vehicle 2 pass"),
    ],
)
def test_a_suspect_is_confirmed_or_cleared(suspect: str, part: str, answer: str) -> None:
    query = Query(
        type="why", actor="vehicle:1", factual=("stop",), hypothesised_cause=suspect, tense="past"
    )
    found = told(query, Record(3.0, (decision(3.0, [stretch(2, 3.0, 6.0)]),)))
    assert isinstance(found, Explanation)
    assert found.suspect is not None
    assert found.suspect.part == part
    assert realise(query, found, SpeechContext()).text.startswith(answer)


def test_what_goes_on_or_is_to_come_is_not_told_as_done() -> None:
    slowing = tuple(12.0 - 0.6 * k for k in range(16))
    _, text = ask(decision(3.0, [], speeds=slowing), asked=("slow-down",), tense="present")
    assert text == "Vehicle 1 is most likely slowing down in order to turn left."
    _, text = ask(decision(3.0, [], speeds=(8.0,) * 20), asked=("slow-down",), tense="present")
    assert text == "I expect vehicle 1 to slow down, most likely in order to turn left."
