"""Questions about traffic lights are answered from what was seen of them, and by nothing else."""

import pytest

from planner.kernels.limits import FOLLOWING
from tests.explain.lit import DT, GREEN, LINE, PASSED, STANDS, Story, answer, driven
from xavi_dialogue.domain.answers import Verdict
from xavi_dialogue.domain.meaning import (
    Ask,
    Claim,
    Doing,
    HowKnow,
    HowLong,
    HowMany,
    HowMuch,
    HowSure,
    WhatIf,
    When,
    Where,
    Whether,
    Which,
    Why,
)
from xavi_dialogue.domain.terms import (
    Believed,
    Ego,
    Event,
    Exists,
    Feature,
    Happens,
    Has,
    Is,
    Measured,
    Not,
    Related,
    Relative,
    Vehicle,
    Wanted,
)
from xavi_dialogue.domain.traffic_lights import (
    Crossed,
    LightForeseen,
    LightPassed,
    LightTold,
    Shown,
    SupposedOfLight,
    TurnOnRed,
)
from xavi_dialogue.explain.answers.lights import lights_seen
from xavi_dialogue.explain.history.traffic_lights import Passing, Signal

LIGHT = Feature("light")
RED = Feature("light", colour="red")
TO_GREEN = Event("turn-colour", LIGHT, Feature("light", colour="green"))
RAN = Happens(Event("pass", Ego(), RED))
DARK = Story(first="?")  # never in view
WILD = Story(obeys=False)


def is_lit(colour, tense="present", **more):
    return Has("colour", colour, LIGHT, tense=tense, **more)


@pytest.mark.parametrize(("colour", "holds"), [("red", True), ("green", False), ("amber", False)])
def test_whether_it_is_red(colour, holds):
    found = answer(Ask(Whether(is_lit(colour))), 20.0)
    assert (found.asked, found.holds, found.shown.colour) == ("whether", holds, "red")
    assert answer(Ask(Whether(Not(is_lit(colour)))), 20.0).holds is not holds


def test_a_claim_is_held_against_it():
    found = answer(Claim(is_lit("green")), 20.0)
    assert (found.asked, found.holds) == ("claim", False)


def test_what_it_showed_at_a_time():
    found = answer(Ask(Whether(is_lit("red", "past"))), 40.0, span=(20.0, 20.0))
    assert (found.holds, found.past, found.time) == (True, True, 20.0)


def test_with_no_time_said_it_is_when_we_passed_it():
    found = answer(Ask(Whether(is_lit("green", "past"))), 40.0)
    assert found.holds
    assert found.time == pytest.approx(PASSED, abs=0.15)


def test_before_it_came_into_view_none_was_seen():
    found = answer(Ask(HowMuch(Measured("colour", LIGHT, tense="past"))), 20.0, span=(1.0, 1.0))
    assert isinstance(found, LightTold)
    assert found.shown is None
    assert answer(Ask(Whether(Exists(LIGHT))), 1.0).holds is False


def test_when_we_have_not_crossed_that_is_said():
    time = Relative("during", Event("pass", Ego(), LIGHT))
    found = answer(Ask(Whether(is_lit("green", "past", time=time))), 20.0)
    assert isinstance(found, LightPassed)
    assert found.crossed is None


def test_since_when_and_for_how_long():
    turned = answer(Ask(When(Happens(TO_GREEN))), 35.0)
    assert (turned.shown.begin, turned.shown.begun) == (GREEN, True)
    lasted = answer(Ask(HowLong(is_lit("red", "past"))), 35.0)
    assert (lasted.shown.begin, lasted.shown.end, lasted.shown.begun) == (2.0, GREEN, False)
    never = answer(Ask(When(Happens(TO_GREEN))), 20.0)
    assert never.shown.colour == "red"


def test_when_it_will_change_is_a_belief():
    future = Happens(Event("turn-colour", LIGHT, TO_GREEN.object, tense="future"))
    found = answer(Ask(When(future)), 20.0)
    assert isinstance(found, LightForeseen)
    assert (found.foreseen.low, found.foreseen.middle, found.foreseen.high) == (26.0, 32.0, None)
    sure = answer(Ask(HowSure(future)), 20.0)
    assert sure.foreseen.chance == pytest.approx(0.7)
    stays = answer(Ask(HowLong(is_lit("red", "future"))), 20.0)
    assert (stays.foreseen.to, stays.foreseen.middle) == ("green", 32.0)
    known = answer(Ask(HowKnow(future)), 20.0)
    assert isinstance(known, LightForeseen)


def test_what_was_expected_is_held_against_what_came():
    believed = Believed(Happens(Event("turn-colour", LIGHT)))
    found = answer(Ask(Whether(believed)), 35.0)
    assert found.holds
    assert found.foreseen.came == GREEN
    assert found.foreseen.time < GREEN


def test_running_a_red_light_is_denied_where_it_was_green():
    for act, asked in (
        (Ask(Whether(RAN)), "whether"),
        (Claim(RAN), "claim"),
        (Ask(Why(RAN)), "why"),
    ):
        found = answer(act, 40.0)
        assert isinstance(found, LightPassed)
        assert (found.holds, found.asked) == (False, asked)
        assert found.crossed.shown.colour == "green"
        assert found.crossed.since == pytest.approx(PASSED - GREEN, abs=0.2)


def test_running_a_red_light_is_owned_up_to():
    found = answer(Claim(RAN), 14.0, WILD)
    assert found.holds is True
    assert found.crossed.shown.colour == "red"
    assert found.crossed.time == pytest.approx(10.0, abs=0.15)


def test_any_light_that_was_passed_at_red_was_run(monkeypatch):
    signal = answer(Claim(RAN), 14.0, WILD).crossed.shown.light
    done = [Passing(Signal("a", 0), time, 9.0, None) for time in (10.0, 30.0)]

    def crossed(ride, one):
        colour = "red" if one.time == 10.0 else "green"
        return Crossed(one.time, one.speed, Shown(signal, colour, 5.0, True))

    monkeypatch.setattr(lights_seen, "passings", lambda ride: done)
    monkeypatch.setattr(lights_seen, "crossed", crossed)
    found = answer(Ask(Whether(RAN)), 40.0)
    assert (found.holds, found.crossed.time) == (True, 10.0)


def test_who_has_passed_none_ran_none():
    found = answer(Claim(RAN), 20.0)
    assert (found.crossed, found.holds, found.ahead.colour) == (None, False, "red")


def test_how_another_passed_it_is_not_recorded():
    found = answer(Ask(Whether(Happens(Event("pass", Vehicle(3), RED)))), 40.0)
    assert isinstance(found, Verdict)
    assert (found.holds, found.gap) == (None, "not-recorded")


def test_where_it_is_and_how_many_there_were():
    found = answer(Ask(Where(LIGHT)), 20.0)
    assert found.distance == pytest.approx(5.0, abs=0.1)
    assert answer(Ask(Where(LIGHT)), 34.0).passed == pytest.approx(PASSED, abs=0.15)
    assert answer(Ask(HowMany(LIGHT)), 40.0).count == 1
    assert answer(Ask(HowMany(RED)), 40.0).count == 0
    assert len(answer(Ask(HowMany(RED)), 40.0).others) == 1
    assert answer(Ask(HowMany(RED)), 14.0, WILD).count == 1


def test_whether_it_is_seen():
    assert answer(Ask(Whether(Related("can-see", Ego(), LIGHT))), 20.0).holds
    assert answer(Ask(Doing(LIGHT)), 20.0).shown.colour == "red"


def test_had_it_been_green_we_had_not_stopped():
    found = answer(Ask(WhatIf(is_lit("green", "past"), Whether(Happens(Event("stop"))))), 40.0)
    assert isinstance(found, SupposedOfLight)
    assert (found.waits, found.holds, found.past) == (False, False, True)
    assert found.decided == pytest.approx(4.0, abs=1.0)
    assert found.passing == pytest.approx(10.0, abs=1.0)
    assert found.passed == pytest.approx(PASSED, abs=0.15)


def test_had_it_been_red_we_had_stopped_while_that_was_possible():
    """The last decision before the line comes too late for that."""
    green = Story(obeys=False, first="G")
    found = answer(Ask(WhatIf(is_lit("red", "past"))), 14.0, green)
    assert isinstance(found, SupposedOfLight)
    speeds, places = driven(green)
    step = round(found.decided / DT)
    assert 2.0 * FOLLOWING * (LINE - places[step]) >= speeds[step] ** 2
    assert found.waits


def test_the_line_that_we_crossed_is_that_of_a_light():
    over = Event("cross", Ego(), Feature("line"), tense="past")
    found = answer(Ask(When(Happens(over))), 40.0)
    assert found.episodes[0].begin == pytest.approx(PASSED, abs=0.15)


def test_the_lights_that_we_passed_are_listed():
    passed = Happens(Event("pass", Ego(), Wanted(), tense="past"))
    found = answer(Ask(Which(LIGHT, passed)), 40.0)
    assert (found.asked, found.count) == ("count", 1)
    assert answer(Ask(Which(LIGHT, passed)), 20.0).count == 0


def test_had_it_stayed_red_we_had_waited():
    stayed = Happens(Event("show", LIGHT, RED, tense="perfect"))
    found = answer(Ask(WhatIf(stayed)), 40.0)
    assert (found.waits, found.past, found.standing) == (True, True, False)
    stays = Happens(Event("show", LIGHT, RED, tense="past"))
    now = answer(Ask(WhatIf(stays)), 20.0)
    assert (now.waits, now.past, now.standing) == (True, False, True)


def test_why_not_on_red_is_answered_by_the_way_and_the_light():
    turn = Event("exit-right", object=RED, tense="present", modal="can")
    allowed = Is("allowed", event=Event("exit-right", object=RED, tense="present"))
    for act in (Ask(Why(Not(Happens(turn)))), Ask(Whether(allowed))):
        found = answer(act, 20.0)
        assert isinstance(found, TurnOnRed)
        assert (found.asked, found.way, found.shown.colour) == ("right", "straight", "red")


def test_no_light_is_known_of_one_that_was_never_in_view():
    for act in (Ask(Whether(is_lit("red"))), Ask(HowLong(is_lit("red"))), Ask(Where(LIGHT))):
        found = answer(act, 20.0, DARK)
        assert isinstance(found, LightTold)
        assert found.shown is None
    assert STANDS < 20.0


def test_the_last_light_is_the_one_that_we_passed():
    last = Has("colour", "green", Feature("light", rank=-1), tense="past")
    found = answer(Ask(Whether(last)), 45.0)
    assert found.holds
    assert found.time == pytest.approx(PASSED, abs=0.15)
    none = answer(Ask(Whether(last)), 20.0)
    assert isinstance(none, LightPassed)
    assert none.crossed is None


def test_how_long_a_light_has_shown_what_it_shows_is_told_of_its_colour():
    shows = Has("colour", "what", LIGHT)
    found = answer(Ask(HowLong(shows)), 20.0)
    assert (found.asked, found.wanted, found.shown.colour) == ("how-long", "red", "red")
    assert answer(Ask(HowLong(is_lit("green"))), 20.0).wanted == "green"
