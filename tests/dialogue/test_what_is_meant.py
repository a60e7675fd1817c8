"""Short questions that leave open who, what or when is meant, asked about recorded rides."""

import pytest

from tests.dialogue.talking import Talk


@pytest.mark.parametrize("text", ["why are you giving way?", "why did you give way?"])
def test_why_we_gave_way_is_right_of_way_before_all_else_that_slowed_us(text: str) -> None:
    told = Talk("s2-2", 6.5).hear(text)
    assert told.startswith("The blue car"), told
    assert "had right of way" in told


def test_he_is_who_walks_and_not_our_car() -> None:
    talk = Talk("junction-0", 20.0)
    talk.hear("can't you turn right on red here?")
    assert talk.hear("how fast is he walking").startswith("The pedestrian")


def test_was_it_him_asks_who_was_the_reason() -> None:
    talk = Talk("junction-0", 29.0)
    talk.hear("what happened?")
    assert talk.hear("was it the bike").startswith("Yes: the green bicycle has right of way")


def test_who_brakes_for_somebody_waits_for_him() -> None:
    told = Talk("junction-0", 42.0).hear("is the orange car waiting for the pedestrian?")
    assert "is braking, because it has to let the pedestrian" in told
    assert Talk("junction-0", 42.0).hear("is the orange car waiting for us?").startswith("No")


@pytest.mark.parametrize(
    "text", ["are they allowed to cross now", "are those people allowed to cross?"]
)
def test_who_may_cross_now_is_told_of_now(text: str) -> None:
    told = Talk("junction-0", 14.0).hear(text)
    assert "has right of way" in told or "have right of way" in told, told


def test_tailgating_is_following_too_closely() -> None:
    told = Talk("motorway-0", 20.0).hear("is the brown lorry tailgating us?")
    assert told.startswith("No, "), told
    assert "the gap between us" in told


@pytest.mark.parametrize("before", [None, "who is in front of us?"])
def test_it_is_our_way_that_is_clear(before: str | None) -> None:
    talk = Talk("junction-0", 16.0)
    if before is not None:
        talk.hear(before)
    assert "the way is not free" in talk.hear("is it clear now?")


def test_nobody_is_not_denied_twice() -> None:
    told = Talk("s4-0", 24.0).hear("are we blocking anyone?")
    assert told.startswith("No, I am not blocking anybody"), told


def test_enough_distance_is_kept_from_who_is_ahead() -> None:
    told = Talk("s4-0", 29.0).hear("are we keeping enough distance")
    assert told.startswith("Yes, I am keeping a distance"), told


def test_what_is_denied_by_a_word_is_affirmed_where_it_is_so() -> None:
    talk = Talk("junction-0", 45.0)
    assert talk.hear("is the green bicycle out of our way?").startswith("Yes, ")
    assert Talk("junction-0", 16.0).hear("is our way blocked?").startswith("Yes, the way is not")


def test_hard_braking_that_is_felt_is_ours() -> None:
    talk = Talk("s2-2", 4.0)
    talk.hear("what is the blue car doing?")
    told = talk.hear("That was hard braking. How hard exactly?")
    assert told.startswith("We braked with up to"), told


def test_that_is_the_bus_where_another_was_spoken_of() -> None:
    talk = Talk("junction-0", 34.0)
    talk.hear("what is the red car doing?")
    assert "yellow" in talk.hear("Wow, was that a bus?")


def test_the_maximum_speed_here_is_the_limit() -> None:
    told = Talk("junction-0", 12.0).hear("what is maximum speed here and how much we drive now?")
    assert told.startswith("The limit here is 50 km/h."), told
    assert "on average" not in told


@pytest.mark.parametrize("text", ["Is finish soon?", "is the destination near?"])
def test_whether_the_end_is_near_is_how_far_it_is(text: str) -> None:
    told = Talk("junction-0", 54.0).hear(text)
    assert "about 80 metres to our destination" in told, told


def test_the_end_is_the_destination() -> None:
    told = Talk("junction-0", 40.0).hear("How many meters still until the end?")
    assert told.startswith("It is about"), told
    assert "destination" in told


@pytest.mark.parametrize("at", [5.0, 15.0])
def test_who_rolls_up_to_a_red_light_has_to_stop_for_it(at: float) -> None:
    """The lines of its rollouts are not recorded, as there are many others."""
    assert Talk("city-0", at).hear("will we have to stop at the light?").startswith("Yes")
    assert Talk("city-0", at).hear("will we make the light?").startswith("No")


def test_people_are_counted_as_people() -> None:
    told = Talk("city-0", 31.0).hear("how many are on the crossing?")
    assert told.startswith("Six pedestrians"), told
