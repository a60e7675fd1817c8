"""Reasons for how we drive, and what would have been, asked on recorded rides."""

import pytest

from tests.dialogue.talking import Talk


@pytest.mark.parametrize("text", ["Why are we standing still?", "Why have we stopped here?"])
def test_who_is_let_go_first_is_why_we_stand_or_only_just_move_off(text: str) -> None:
    told = Talk("junction-0", 30.0).hear(text)
    assert "because I have to let the green bicycle" in told
    assert "red" in Talk("junction-0", 20.0).hear(text)


def test_a_plan_that_was_not_changed_is_denied() -> None:
    assert Talk("junction-0", 30.0).hear("Why did you change your plan?").startswith("I did not")


def test_crawling_behind_somebody_all_the_way_is_of_what_is_to_come() -> None:
    told = Talk("motorway-0", 8.0).hear("Are we going to crawl behind the lorry all the way?")
    assert told.startswith("I do not plan to overtake the white lorry")


def test_being_further_along_is_of_time() -> None:
    asked = "If we had overtaken right at the start, would we be further along by now?"
    assert Talk("motorway-0", 30.0).hear(asked).startswith("No, that would have saved us no time")


def test_how_often_we_could_have_done_it_is_of_what_was_possible() -> None:
    told = Talk("motorway-0", 30.0).hear("You could have overtaken the lorry twice by now.")
    assert "so far" not in told
    assert "would have" in told


def test_who_asks_why_we_stay_behind_hears_how_fast_it_drives() -> None:
    told = Talk("motorway-0", 8.0).hear("Why are we stuck behind this lorry?")
    assert "is driving ahead of us at 80 km/h. I am not moving to the left lane, because" in told


def test_who_asks_why_so_hard_hears_how_hard() -> None:
    assert "at up to 2.0 m/s²" in Talk("s4-0", 14.0).hear("Why did you brake so hard?")
    assert "m/s²" not in Talk("s4-0", 14.0).hear("Why did you brake?")


def test_who_asks_why_we_changed_lanes_where_we_did_not_is_corrected() -> None:
    told = Talk("s4-0", 20.0).hear("Why did you change lanes?")
    assert told.startswith("I did not change lanes")


def test_the_basis_for_entering_beside_somebody_is_who_goes_first() -> None:
    told = Talk("s3-0", 8.0).hear("On what basis are you entering with the blue car there?")
    assert "the blue car" in told
    assert "simulated" not in told


def test_overtaking_where_the_only_lane_is_the_oncoming_one_says_so() -> None:
    told = Talk("bend-0", 5.0).hear("Why don't you just overtake it?")
    assert told.endswith("and I do not use an oncoming lane.")


def test_without_it_is_asked_of_the_deed_whose_reason_was_told() -> None:
    talk = Talk("s1-0", 9.0)
    talk.hear("Why did you change lanes?")
    assert talk.hear("And without it?").startswith("Without the blue car, I would have stayed")


@pytest.mark.parametrize("text", ["How much time would that save?", "How much sooner would we be?"])
def test_what_it_would_save_is_asked_of_the_option_spoken_of(text: str) -> None:
    talk = Talk("motorway-0", 8.0)
    talk.hear("Why don't you move to the left lane?")
    told = talk.hear(text)
    assert told.startswith("If I moved to the left lane, we would get there about")


def test_what_it_would_save_is_of_the_next_best_option_where_none_was_spoken_of() -> None:
    told = Talk("motorway-0", 8.0).hear("How much time would it save?")
    assert "the next best option was" in told


@pytest.mark.parametrize("text", ["How close is that?", "How close was it?"])
def test_how_close_it_was_after_why_not_is_of_the_decision(text: str) -> None:
    talk = Talk("motorway-0", 8.0)
    talk.hear("Why don't you move to the left lane?")
    answer = talk.hear(text)
    assert answer.startswith("I chose staying in my lane rather than moving to the left lane")


@pytest.mark.parametrize("text", ["Was that because of someone?", "Was that because of anybody?"])
def test_because_of_anybody_asks_for_the_reason_of_what_was_spoken_of(text: str) -> None:
    talk = Talk("town-0", 22.0)
    told = talk.hear("Why did you slow down?")
    assert told.split(":")[0].split(" (")[0] in talk.hear(text)


def test_a_light_passed_at_green_was_not_run() -> None:
    for text in ("did we run that light?", "did you run a red?", "have we gone through any reds?"):
        assert Talk("junction-0", 45.0).hear(text).startswith("No, the light was green"), text


def test_the_closest_decision_is_that_with_the_nearest_rival() -> None:
    told = Talk("s1-0", 10.0).hear("Which decision was the closest?")
    assert told.startswith("My closest decision was at 0:")
    assert "the next best option was" in told


def test_the_highest_risk_is_that_of_all_decisions() -> None:
    told = Talk("s1-0", 10.0).hear("What was your highest risk?")
    assert told.startswith("The highest risk of a collision that I planned with was")


def test_hard_braking_is_looked_for_in_the_whole_ride() -> None:
    assert Talk("s2-2", 9.0).hear("Did you brake hard?").startswith("Yes")
    told = Talk("junction-0", 45.0).hear("Did you make an emergency stop?")
    assert told.startswith("No, I did not brake hard")


def test_for_whom_we_braked_is_told_with_the_reason() -> None:
    for text in ("Did you brake for anybody?", "Did you slow down for someone?"):
        told = Talk("s4-0", 30.0).hear(text)
        assert told.startswith("I braked at 0:18, because the black car (vehicle 4)"), text


def test_who_came_close_is_asked_of_all_that_were_ever_seen() -> None:
    for text in ("Who came within 2 metres of us?", "Which road users came within 2 metres?"):
        told = Talk("junction-0", 45.0).hear(text)
        assert all(f"(vehicle {n})" in told for n in (2, 3, 11)), text
    told = Talk("junction-0", 45.0).hear("Did anybody come within 2 metres?")
    assert told.startswith("Yes, we came as close as 1.1 metres to the green bicycle")
    assert Talk("junction-0", 45.0).hear("Did anyone come within 0.2 metres?").startswith("No")


def test_the_cyclist_is_the_one_that_came_closest() -> None:
    told = Talk("junction-0", 45.0).hear("How close did the cyclist get?")
    assert "the green bicycle" in told
    assert "1 metre" in told


def test_a_near_miss_is_a_collision_nearly_had() -> None:
    for text in ("Was there a near miss?", "Have there been any close calls?"):
        assert Talk("s4-0", 30.0).hear(text).startswith("No: "), text


@pytest.mark.parametrize("text", ["Will you stop for the pedestrians?", "Will you let them cross?"])
def test_people_go_first_by_the_rule_whatever_is_planned(text: str) -> None:
    told = Talk("junction-0", 15.0).hear(text)
    assert told.startswith("Yes, the pedestrian ahead of us (vehicle 8) and the ped"), told
    assert Talk("junction-0", 8.0).hear(text).startswith("Yes, the traffic light is red for us")


def test_a_reason_is_no_verdict_of_fault() -> None:
    talk = Talk("s4-0", 24.0)
    assert "the black car (vehicle 4)" in talk.hear("Why did you brake?")
    told = talk.hear("Was that his fault?")
    assert not told.startswith(("Yes", "As I said, yes"))


def test_the_pedestrian_just_spoken_of_is_the_one_that_is_meant() -> None:
    talk = Talk("junction-0", 45.0)
    talk.hear("Is vehicle 13 crossing?")
    assert "(vehicle 13)" in talk.hear("How close did we get to the pedestrian?")


def test_slowing_for_somebody_who_went_after_us_is_no_giving_way() -> None:
    told = Talk("bend-0", 12.0).hear("Did you have to wait for anyone?")
    assert told.endswith("in fact we went first.")


def test_people_are_counted_by_our_way_as_in_front_of_us() -> None:
    told = {
        Talk("junction-0", 60.0).hear(text)
        for text in ("How many people crossed our way?", "How many people crossed in front of us?")
    }
    assert len(told) == 1
    assert "that crossed our way" in told.pop()


def test_without_a_rule_people_are_told_by_what_they_are_expected_to_do() -> None:
    told = Talk("junction-0", 30.0).hear("Will you let the pedestrians cross?")
    assert told.startswith("I expect the pedestrian ahead of us on the right (vehicle 11) and the")
    assert told.endswith("to cross our way (90 % or more).")


@pytest.mark.parametrize(
    ("text", "reply"),
    [
        ("What would you do differently?", "Yes, I was wrong"),
        ("would you do anything differently", "Yes, I was wrong"),
        ("How did it go?", "So far we have driven"),
        ("how did that go", "So far we have driven"),
    ],
)
def test_what_is_asked_of_a_ride_behind_a_lorry(text: str, reply: str) -> None:
    assert Talk("motorway-0", 40.0).hear(text).startswith(reply)


@pytest.mark.parametrize(
    "text",
    [
        "Did you follow all the rules?",
        "did you do everything by the book",
        "Did you play by the rules?",
        "have you driven by the book so far",
    ],
)
def test_the_rules_as_a_whole_are_the_law(text: str) -> None:
    assert Talk("s2-0", 12.0).hear(text).startswith("The law is not for me to judge")


@pytest.mark.parametrize("text", ["Sum it up for me, please.", "can you sum that up"])
def test_summing_up_is_a_summary_of_the_ride(text: str) -> None:
    assert Talk("s2-0", 12.0).hear(text).startswith("So far we have driven about")
