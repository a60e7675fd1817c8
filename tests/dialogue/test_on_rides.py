"""Questions on recorded rides, where the nearest thing on record is not what is asked about."""

import pytest

import xavi_dialogue
from tests.dialogue.talking import RIDES, Talk


@pytest.mark.parametrize("text", ["why are we stopping?", "why are you coming to a stop?"])
def test_why_we_stop_again_is_not_why_we_stood_before(text: str) -> None:
    """We stood for the light until 26.4 s, and come to a halt for a bicycle at 29.6 s."""
    reply = Talk("junction-0", 28.2, planner=False).say(text).reply.text
    assert "bicycle" in reply
    assert "traffic light" not in reply
    assert "light" in Talk("junction-0", 27.0, planner=False).say(text).reply.text


@pytest.mark.parametrize(
    ("at", "text", "told", "untold"),
    [
        (55.0, "did pedestrian 11 cross our way?", "Yes", "did not"),
        (55.0, "did you cross anybody's path?", "Yes", "did not"),
        (55.0, "did anyone cross our path?", "Yes, the pedestrian", "nobody"),
        (55.0, "was vehicle 2 moving at 35 s?", "standing still", "Yes"),
        (55.0, "were we moving at 20 s?", "standing still", "Yes"),
        (55.0, "did anyone come near us?", "vehicle 3", "No"),
        (55.0, "did the bus come near us?", "Yes", "No"),
        (55.0, "was anyone faster than us?", "Yes, the black car", "No"),
        (40.0, "is anyone faster than us?", "Yes, the red car", "No"),
        (55.0, "how hard did you brake at most?", "1.9 m/s²", "0:49"),
        (55.0, "how close did anyone come?", "1.1 metres", "1 metre "),
        (55.0, "did you brake hard, and why?", "because", "because of nothing"),
        (55.0, "did you stop, and why?", "because", "because of nothing"),
        (50.0, "is it icy?", "the weather", "vehicle"),
        (50.0, "is the road slippery?", "the weather", "destination"),
    ],
)
def test_what_the_whole_ride_shows(at: float, text: str, told: str, untold: str) -> None:
    reply = Talk("junction-0", at).say(text).reply.text
    assert told in reply
    assert untold not in reply


def test_all_who_crossed_are_listed() -> None:
    reply = Talk("junction-0", 55.0).say("which pedestrians crossed?").reply.text
    assert all(reply.count(f"vehicle {number})") == 1 for number in (8, 9, 10, 11, 13))


def test_all_whom_we_let_go_are_listed() -> None:
    """Those for whom our driving was restrained count as much as those for whom we stood."""
    reply = Talk("city-0", 55.0).say("who did you give way to on this ride?").reply.text
    assert reply == "I gave way to the six pedestrians."
    assert "Yes" in Talk("city-0", 55.0).say("did you give way to pedestrian 9?").reply.text


def test_a_prediction_is_judged_by_what_was_expected_right_before() -> None:
    """It was wrong seconds before, when vehicle 2 was not yet at its exit."""
    reply = Talk("s3-0").say("did vehicle 2 do what you expected?").reply.text
    assert "I was right" in reply


def test_had_the_light_been_green_people_would_still_have_crossed() -> None:
    ride = xavi_dialogue.open(RIDES / "junction-0.ride.jsonl.gz")
    reply = ride.ask("what if the light had been green?", at=22.0).text
    assert "would have let" in reply
    assert "without stopping" not in reply


@pytest.mark.parametrize(
    "text", ["why are we going?", "why are we moving?", "why do you drive on?"]
)
def test_why_we_move_is_no_question_while_we_stand(text: str) -> None:
    reply = Talk("junction-0", 18.0).say(text).reply.text
    assert "I am standing still" in reply
    assert "because" not in reply


def test_how_much_longer_it_takes_is_until_we_go_on() -> None:
    assert "turn green" in Talk("junction-0", 18.0).say("how much longer?").reply.text


def test_whom_we_have_to_give_way_to_in_a_turn_to_come_is_who_comes_now() -> None:
    plain = "do we have to give way to oncoming cars?"
    turning = "do we have to give way to oncoming cars when turning left?"
    first, second = (Talk("town-0", 38.0, planner=False).say(text) for text in (plain, turning))
    assert "vehicle 39" in first.reply.text
    assert second.reply.text == first.reply.text


def test_a_cry_for_help_beside_a_question_is_not_answered() -> None:
    plain = Talk("junction-0", 18.0).say("why are we stopping?").reply.text
    assert Talk("junction-0", 18.0).say("help, why are we stopping?").reply.text == plain
    assert "Ask me what I see" in Talk("junction-0", 18.0).say("help!").reply.text


def test_how_long_we_have_been_here_is_how_long_we_stand() -> None:
    reply = Talk("junction-0", 18.0).say("how long have we been here?").reply.text
    assert reply.startswith("We have been standing still for 2 seconds")


def test_what_may_be_broken_is_the_light_that_was_spoken_of() -> None:
    reply = Talk("junction-0", 18.0).say("this red is taking forever. is it broken?").reply.text
    assert "the traffic light is broken" in reply
    assert "vehicle" not in reply


def test_what_is_busy_is_the_road_and_the_nearest_are_told() -> None:
    reply = Talk("junction-0", 18.0).say("how busy is it?").reply.text
    assert "our road is" in reply
    assert reply == Talk("junction-0", 18.0).say("how busy is our road?").reply.text


def test_the_last_seconds_are_told_of() -> None:
    reply = Talk("junction-0", 36.0).say("tell me about the last ten seconds").reply.text
    assert "0:27" in reply
    assert "0:16" not in reply


def test_how_the_traffic_is_asks_how_busy_it_is() -> None:
    for text in ("how's the traffic?", "how is the traffic ahead?"):
        assert "busy" in Talk("junction-0", 18.0).say(text).reply.text


def test_how_hard_is_of_the_braking_that_was_spoken_of() -> None:
    talk = Talk("junction-0", 55.0)
    talk.say("did we brake just now?")
    assert "m/s²" in talk.say("how hard?").reply.text
    assert "not braking" in Talk("junction-0", 18.0).say("how hard are we braking?").reply.text


def test_what_just_any_driver_would_do_is_no_question_of_this_ride() -> None:
    talk = Talk("junction-0", 18.0)
    assert "no opinions" in talk.say("what would a human have done?").reply.text
    assert "no opinions" not in talk.say("what would the car behind us do?").reply.text


@pytest.mark.parametrize(
    ("where", "told", "untold"),
    [
        ("on the right", ("vehicle 18",), ("vehicle 17", "vehicle 21")),
        ("ahead of us", ("vehicle 18", "vehicle 21"), ()),
        ("on the left", ("vehicle 17", "vehicle 21"), ("vehicle 18",)),
    ],
)
def test_what_we_see_at_a_place_is_who_is_there(
    where: str, told: tuple[str, ...], untold: tuple[str, ...]
) -> None:
    reply = Talk("town-0", 18.0).say(f"what do you see {where}?").reply.text
    assert all(name in reply for name in told)
    assert not any(name in reply for name in untold)


def test_what_we_put_on_is_the_indicator() -> None:
    talk = Talk("town-0", 24.0)
    known = talk.say("when did you start indicating?").reply.text
    assert "indicated" in known
    assert "indicated" in Talk("town-0", 24.0).say("when did you put it on?").reply.text


def test_following_a_slow_vehicle_costs_time_against_the_limit() -> None:
    reply = Talk("motorway-0", 30.0).say("what did sitting behind that lorry cost us?").reply.text
    assert "seconds" in reply
    assert "no difference" not in reply


def test_an_unknown_word_is_owned_up_to_in_a_question_that_is_likened_to_a_plain_one() -> None:
    asked = "blorbflisk what was the second best thing you could have done"
    assert '"blorbflisk"' in Talk("s1-0").say(asked).reply.text


@pytest.mark.parametrize(
    ("text", "reply"),
    [
        ("will it be green when we get there?", "No, "),
        ("will the light be red by the time we reach it?", "Yes, "),
        ("will we make the light?", "No, "),
        ("are we going to catch the green?", "No, "),
        ("gonna make this light?", "No, "),
        ("will we get through the light without stopping?", "No, "),
        ("will we have to stop at the light?", "Yes, "),
        ("won't we have to stop at the light?", "Yes, "),
        ("how likely is it that the light is green when we arrive?", ""),
        ("what are the odds we make the light", ""),
    ],
)
def test_a_light_ahead_is_met_by_the_chance_that_we_have_to_stop(text: str, reply: str) -> None:
    told = Talk("junction-0", 9.0).say(text).reply.text
    assert told.startswith(f"{reply}we will" if reply else "We will")
    assert "have to stop for the traffic light" in told
    assert "not have to stop" not in told


@pytest.mark.parametrize(
    "text", ["wats it showing", "what does it show?", "what colour is it", "what's it showing now?"]
)
def test_what_shows_a_colour_is_the_light_in_view(text: str) -> None:
    assert "The traffic light is red" in Talk("junction-0", 18.0).say(text).reply.text


@pytest.mark.parametrize(
    "text", ["stuck at red?", "are we stuck at a red light?", "stuck at the light?"]
)
def test_who_is_stuck_at_a_light_stands(text: str) -> None:
    assert Talk("junction-0", 18.0).say(text).reply.text.startswith("Yes, ")


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("did the car hit anybody?", "we did not collide"),
        ("how close did the car come to the pedestrians?", "We came as close as"),
        ("what was the least distance between the car and any pedestrian?", "We came as close as"),
        ("how close did the car come to the bicycle while turning right?", "We came as close as"),
    ],
)
def test_the_car_beside_others_is_ours(text: str, told: str) -> None:
    assert told in Talk("junction-0", 40.0).say(text).reply.text


def test_what_the_car_would_have_done_is_asked_of_us() -> None:
    known = Talk("junction-0", 40.0).say("would you have hit somebody had you not braked at 0:17?")
    told = Talk("junction-0", 40.0).say("would the car have hit somebody had it not braked at 0:17")
    assert told.reply.text == known.reply.text


def test_at_a_decision_the_brake_light_of_its_scene_counts() -> None:
    """We begin to brake for the pedestrian at 36.6 s, where a decision is taken."""
    talk = Talk("junction-0", planner=False)
    times = [t.sim_time for t in talk.ride.traces if "brake" in t.scene[0].signals]
    moving = [at for at in times if talk.ride.traces and at > 30.0]
    reply = Talk("junction-0", moving[0], planner=False).say("are you braking?").reply.text
    assert reply.startswith("Yes, ")


@pytest.mark.parametrize(
    "text",
    ["what's limiting speed at the moment?", "what is limiting our speed?", "what restricts us?"],
)
def test_what_limits_our_speed_is_what_slows_us(text: str) -> None:
    assert "because" in Talk("junction-0", 13.0, planner=False).say(text).reply.text


@pytest.mark.parametrize(
    "text",
    [
        "State the moment at which the light changed to green.",
        "give the time when the light turned green",
        "state when the light turned green",
        "specify the exact time at which it turned green",
    ],
)
def test_when_something_was_is_told_on_demand(text: str) -> None:
    assert "0:26" in Talk("junction-0", 40.0).say(text).reply.text


@pytest.mark.parametrize(
    "text",
    ["did the prediction hold?", "did your prediction come true?", "did the prediction pan out?"],
)
def test_a_prediction_is_judged_in_other_words(text: str) -> None:
    talk = Talk("s3-0")
    known = talk.hear("where did you expect vehicle 2 to go?", "were you right?")
    assert Talk("s3-0").hear("where did you expect vehicle 2 to go?", text) == known


@pytest.mark.parametrize(
    ("text", "reply"),
    [
        ("without the blue car, would we still be in the right lane?", "I would have stayed"),
        ("would we be in the right lane without the blue car?", "I would have stayed"),
        ("without the blue car, would we be in the left lane now?", "I would not have moved"),
    ],
)
def test_being_in_a_lane_without_somebody_is_having_kept_to_it(text: str, reply: str) -> None:
    assert reply in Talk("s1-0", 8.0).say(text).reply.text


@pytest.mark.parametrize(
    "text",
    [
        "did you enter the junction?",
        "did the car enter the junction?",
        "have you entered the junction?",
    ],
)
def test_who_turned_has_entered_the_junction(text: str) -> None:
    talk = Talk("junction-0", 40.0)
    talk.say("when did you reach the junction?")
    assert talk.say(text).reply.text.startswith("Yes, I turned right")


@pytest.mark.parametrize(
    "text", ["does it know we're turning?", "does it know that we turn?", "does the bike see us?"]
)
def test_what_another_knows_of_us_is_not_what_we_do(text: str) -> None:
    talk = Talk("junction-0", 28.0, planner=False)
    talk.say("there's a bike right next to us")
    assert not talk.say(text).reply.text.startswith("Yes, I am turning")


@pytest.mark.parametrize(
    ("text", "word"),
    [
        ("zolk what if vehicle 1 turns left", "zolk"),
        ("what are you doing once we reach the traffic pleex circle", "pleex"),
        ("forgive kroolk my curiosity, but is there something ahead of us?", "kroolk"),
    ],
)
def test_an_unknown_word_beside_what_is_answered_is_owned_up_to(text: str, word: str) -> None:
    assert f'"{word}"' in Talk("s1-0", 8.0, planner=False).say(text).reply.text


@pytest.mark.parametrize(
    "text",
    ["do we have to stop up there?", "do we have to stop at the junction?", "must we stop there"],
)
def test_what_we_have_to_do_up_there_is_to_come(text: str) -> None:
    reply = Talk("s4-0", 8.0, planner=False).say(text).reply.text
    assert not reply.startswith("I am not stopping")


@pytest.mark.parametrize(
    "text",
    ["in how much we arrive?", "in how many minutes do we get there?"],
)
def test_in_how_much_time_we_arrive_is_when(text: str) -> None:
    assert "there in about" in Talk("s1-0", 8.0).say(text).reply.text


def test_who_stands_in_a_queue_is_counted() -> None:
    """Two more cars drive past the queue."""
    reply = Talk("s4-0", 14.0, planner=False).say("how many cars are in the queue?").reply.text
    everybody = Talk("s4-0", 14.0, planner=False).say("how many cars do you see?").reply.text
    assert reply.startswith(("Two cars", "Three cars"))
    assert not everybody.startswith(("Two cars", "Three cars"))


def test_whom_nobody_is_behind_is_named_as_an_object() -> None:
    talk = Talk("s4-0", 16.0, planner=False)
    assert (
        "behind he" not in talk.say("what about the cars behind him that we can't see?").reply.text
    )


@pytest.mark.parametrize(
    "text",
    [
        "was any pedestrian endangered on this ride?",
        "was any pedestrian in danger on this ride?",
        "was anybody on foot in danger on this ride?",
    ],
)
def test_danger_to_people_is_told_of_people(text: str) -> None:
    reply = Talk("junction-0", 55.0).say(text).reply.text
    assert "pedestrian" in reply
    assert "bicycle" not in reply
