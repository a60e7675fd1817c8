"""Who goes first of two, or of all."""

from typing import Any

import pytest

from tests.explain.answers.propositions.test_duty import LOOKS, ONE, ROAD, TWO, action
from tests.explain.answers.stated import (
    US,
    decision,
    did,
    look,
    result,
    roads,
    scene,
)
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.terms import (
    At,
    Both,
    Everyone,
    Happens,
    Is,
    Related,
    Vehicles,
    Wanted,
)
from xavi_dialogue.explain.answers.propositions.duties import of_order, who_first

# --- which of two, and who of all ---------------------------------------------------------------


@pytest.mark.parametrize(
    ("part", "told"),
    [
        (Related("has-priority-over", ONE, US), Related("has-priority-over", ONE, US)),
        (Related("must-yield-to", ONE, US), Related("must-yield-to", ONE, US)),
        (Related("behind", ONE, US), None),
        (Related("has-priority-over", ONE, US, tense="past"), None),
        (Happens(action("go", ONE, manner=("first",), tense="present", time=At(3.0))),
         Related("has-priority-over", ONE, US, At(3.0))),
        (Happens(action("go", ONE, tense="present")), None),
        (Happens(action("stop", ONE, manner=("first",), tense="present")), None),
        (Happens(action("wait", ONE, US, tense="present", time=At(3.0))),
         Related("must-yield-to", ONE, US, At(3.0))),
        (Happens(action("wait", ONE, TWO, tense="present")), None),
        (Happens(action("wait", US, US, tense="present")), None),
        (Happens(action("wait", ONE, US)), None),
        (Happens(action("stop", ONE, US, tense="present")), None),
    ],
)  # fmt: skip
def test_the_right_of_way_that_is_asked_after(part: Any, told: Any) -> None:
    assert of_order(Both((Is("safe"), part), join="or")) == told


def test_who_gave_way_of_both_is_asked_of_the_rule_then() -> None:
    gave = Happens(action("give-way", ONE, US)), Happens(action("give-way", US, ONE))
    told = of_order(Both(gave, join="or"))
    assert told == Related("must-yield-to", ONE, US, tense="past")


def first(such: Any, *, road: Any = ROAD, span: Any = None, **facts: Any) -> Any:
    traces = facts.pop("traces", [decision(20.0, road=road)])
    asked = scene(span, **({"looks": LOOKS, "traces": traces, "road": road} | facts))
    return result(who_first, asked, such)


def test_who_goes_first_is_told_of_whom_it_is_asked() -> None:
    for such in (
        Related("has-priority-over", ONE, US),
        Related("must-yield-to", US, ONE),
        Is("allowed", event=action("go", ONE, manner=("first",), tense="present")),
        Happens(action("wait", Wanted(), ONE, modal="must", tense="present")),
        Happens(action("go", ONE, manner=("first",), tense="present")),
        Happens(action("go", ONE, manner=("first",), tense="present", modal="can")),
    ):
        found = first(such)
        assert (found.vehicle, found.rule) == (1, "give-way")
    for other in (
        None,
        Related("behind", ONE, US),
        Is("allowed"),
        Is("safe", event=action("go", ONE, manner=("first",))),
        Happens(action("go", ONE, manner=("first",))),
        Happens(action("go", ONE, manner=("first",), tense="present", modal="will")),
        Happens(action("wait", ONE, US, tense="present")),
        Happens(action("turn", US, modal="must")),
    ):
        assert first(other) is None


def test_to_whom_of_all_we_have_to_yield() -> None:
    found = first(Related("must-yield-to", US, Wanted()))
    assert (found.vehicle, found.others, found.holds, found.rule) == (1, (2,), None, "give-way")
    found = first(Related("must-yield-to", Wanted(), US))
    assert (found.vehicle, found.others, found.rule) == (3, (), "priority")
    unseen = {1: look(1), 2: look(2, in_view=False), 3: look(3)}
    found = first(Related("must-yield-to", US, Wanted()), looks=unseen)
    assert (found.vehicle, found.others) == (1, ())
    found = first(Related("must-yield-to", Wanted(), Everyone()))
    assert (found.vehicle, found.others) == (1, ())  # whoever crosses our way
    found = first(Related("must-yield-to", US, Wanted()), road=roads((3, "ego")))
    assert (found.vehicle, found.rule) == (3, "priority")


def test_of_the_past_the_rule_of_then_is_told() -> None:
    traces = [decision(5.0, road=roads((1, "ego"))), decision(20.0, road=roads((1, "vehicle")))]
    road = lambda t: traces[0].road if t < 20.0 else traces[1].road  # noqa: E731
    for such in (
        Related("has-priority-over", ONE, US, At(5.0), "past"),
        Related("has-priority-over", Wanted(), US, At(5.0), "past"),
    ):
        found = first(such, traces=traces, road=road)
        assert (found.time, found.rule) == (5.0, "priority")
    turned = (did("exit-left", 12.0, 14.0),)
    ever = Related("has-priority-over", ONE, US, tense="past")
    found = first(ever, traces=traces[:1], road=road, episodes=turned)
    assert (found.time, found.rule) == (5.0, "priority")  # of whom is named, at any time
    span = Span(4.0, 6.0, said=True)
    found = first(Related("has-priority-over", ONE, US), span=span, traces=traces, road=road)
    assert (found.time, found.rule) == (5.0, "priority")


def test_where_nobody_crosses_now_the_last_crossing_is_told() -> None:
    before = roads((1, "vehicle"))
    traces = [decision(5.0, road=before), decision(20.0, road=roads())]
    road = lambda t: before if t < 20.0 else roads()  # noqa: E731
    turned = (did("exit-left", 5.0, 8.0),)
    such = Related("has-priority-over", Wanted(), US)
    found = first(such, traces=traces, road=road, episodes=turned)
    assert (found.time, found.rule) == (5.0, "give-way")
    assert first(such, traces=traces, road=road).rule == "none"
    found = first(Related("has-priority-over", TWO, US), traces=traces, road=road)
    assert (found.vehicle, found.rule) == (2, "none")


def test_of_several_the_one_that_goes_before_us_is_told() -> None:
    for numbers, vehicle, rule in (((3, 2, 1), 2, "give-way"), ((1, 3), 1, "give-way")):
        found = first(Related("has-priority-over", Vehicles(numbers), US))
        assert (found.vehicle, found.rule) == (vehicle, rule)
    both = first(Related("must-yield-to", US, Vehicles((3, 1))))
    assert (both.vehicle, both.rule) == (1, "give-way")
