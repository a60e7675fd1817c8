"""Why we are in our lane or go straight on, and whether a choice was needed."""

from planner.record.trace import NotApplicable as Refused
from tests.explain.answers.chosen import (
    LEFT,
    RIGHT,
    STAY,
    STOP,
    TRACES,
    TURN,
    chosen,
    deeds,
)
from tests.explain.answers.reasons.test_choices import CHANGE, reason, told
from tests.explain.answers.stated import decision, result
from tests.traces import End
from xavi_dialogue.domain.answers import (
    ChoiceReason,
    NotApplicable,
)
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.explain.answers.reasons.choices import (
    in_lane,
    needed,
    straight,
)

# --- lanes and ways -----------------------------------------------------------------------------


def test_we_are_in_our_lane_because_we_moved_there() -> None:
    found = told(in_lane, now=18.5)
    assert reason(found) == (6.0, LEFT, STAY)
    assert (found.form, found.deed.action) == ("why", "change-left")
    found = told(in_lane, now=18.6)  # more than 12 s ago
    assert reason(found) == (12.0, STAY, ("change-left",))
    assert (found.form, found.deed.action, found.deed.begin) == ("why-not", "keep-lane", 12.0)


def test_else_because_of_what_speaks_against_the_better_other_lane() -> None:
    assert reason(told(in_lane)) == (12.0, STAY, ("change-left",))
    assert told(in_lane).past is False
    worse = {LEFT: End(time=13.0), RIGHT: End(time=12.0)}
    traces = [*TRACES[:3], decision(12.0, STAY, ends=worse)]
    assert reason(told(in_lane, traces=traces)) == (12.0, STAY, ("change-right",))
    then = told(in_lane, span=Span(3.0, 3.0, said=True))
    assert (reason(then), then.past) == ((2.0, STAY, ("change-left",)), True)
    none = told(in_lane, traces=[decision(12.0, STAY, ends={STOP: End(time=20.0)})], events=())
    assert reason(none)[2] == ("stop",)


def test_a_turn_since_or_a_change_given_up_at_once_is_no_reason() -> None:
    turned = deeds(("change-left", 6.0, 6.5, 9.0), ("exit-right", 12.0, 12.5, 15.0))
    assert reason(told(in_lane, now=17.0, events=turned))[0] == 12.0
    given_up = deeds(("change-left", 6.0, 6.0, 6.9))
    assert reason(told(in_lane, now=17.0, events=given_up))[0] == 12.0
    held = deeds(("change-left", 6.0, 6.0, 7.0))
    assert reason(told(in_lane, now=17.0, events=held))[0] == 6.0
    going = deeds(("change-left", 6.0, 6.5, None))
    assert reason(told(in_lane, now=17.0, events=going, traces=TRACES[:3]))[0] == 6.0


def test_a_lane_that_is_not_there_has_its_reason() -> None:
    refused = (
        Refused(("continue",), "change-left", "later"), Refused((), "exit-left", "no road"),
        Refused((), "change-right", "no lane"), Refused((), "change-left", "no lane either"),
    )  # fmt: skip
    trace = decision(12.0, STAY, ends={STOP: End(time=20.0)}, not_applicable=refused)
    found = told(in_lane, traces=[trace], events=())
    assert found == NotApplicable(("change-right", "change-left"), "no lane", 12.0)


def test_straight_on_is_the_way_where_we_could_turn() -> None:
    turning = decision(18.0, STAY, ends={TURN: End("dead"), LEFT: End(time=12.0)})
    found = told(straight, traces=[*TRACES, turning])
    assert (reason(found), found.contrast.way) == ((18.0, STAY, TURN), True)
    assert (found.deed.action, found.deed.begin, found.past) == ("continue", 18.0, False)
    then = told(straight, traces=[*TRACES, turning, decision(19.5, STAY)],
                span=Span(18.2, 18.4, said=True))  # fmt: skip
    assert then.past is True
    assert reason(told(straight))[2] == ("change-left",)  # no turn is known
    stopping = decision(18.0, STOP, ends={TURN: End("dead"), LEFT: End(time=12.0)})
    found = told(straight, traces=[*TRACES, stopping])
    assert found.deed.action == "keep-lane"
    early = told(straight, traces=[*TRACES, turning], span=Span(1.0, 1.0, said=True))
    assert not isinstance(early, ChoiceReason) or early.deed.action != "continue"  # type: ignore[union-attr]


# --- whether it was needed ----------------------------------------------------------------------


def test_what_was_needed_is_told_by_the_best_alternative() -> None:
    for form in ("necessary", "worth-it"):
        found = result(needed, CHANGE, chosen(), form)
        assert (reason(found), found.form, found.past) == ((6.0, LEFT, STAY), form, True)
        assert found.contrast.value == 5.0
    assert told(needed, CHANGE).form == "necessary"
    lonely = [decision(6.0, LEFT)]
    found = told(needed, CHANGE, traces=lonely)
    assert (reason(found), found.contrast.verdict) == ((6.0, LEFT, ()), "alone")
    assert found.deed.action == "change-left"
