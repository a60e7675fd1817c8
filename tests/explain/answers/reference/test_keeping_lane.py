"""Keeping the lane is held against a change of lanes, not against a way at a junction."""

from types import SimpleNamespace
from typing import Any

import pytest

from tests.explain.answers.stated import decision, scene
from xavi_dialogue.domain.terms import Event
from xavi_dialogue.explain.answers.reference.foils import Did, check_kept
from xavi_dialogue.explain.causes.plans import options
from xavi_dialogue.explain.causes.plans.premise import Premise

KEEP = Event("keep-lane", modal="would")


def test_who_turns_from_its_lane_keeps_it() -> None:
    asked = scene(traces=[decision(8.0, plan=("exit-right", "continue"))])
    with pytest.raises(Did) as found:
        check_kept(asked, KEEP)
    assert (found.value.performed.action, found.value.performed.when) == ("keep-lane", "doing")
    check_kept(asked, Event("continue"))


def test_who_is_to_change_lanes_does_not_keep_it() -> None:
    check_kept(scene(traces=[decision(8.0, plan=("change-left", "continue"))]), KEEP)


def test_the_choice_is_that_of_the_decision_for_what_is_under_way(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    traces = [decision(t, plan=("continue",)) for t in (7.0, 8.0, 9.0)]
    traces.insert(1, decision(7.5, plan=("continue",)))
    ride: Any = SimpleNamespace(traces=traces, model=lambda trace: trace)
    known = {7.5: ["stop"]}
    monkeypatch.setattr(options, "alternatives", lambda trace, _: known.get(trace.sim_time, []))
    found = options.with_choice(ride, Premise(traces[-1], None))
    assert found.trace.sim_time == 7.5
    known.clear()
    assert options.with_choice(ride, Premise(traces[-1], None)).trace is traces[-1]
