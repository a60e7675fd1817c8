"""Who goes first, we or people on foot, before the record of the road has a rule between us."""

import pytest

from tests.dialogue.talking import Talk


@pytest.mark.parametrize(
    ("at", "question", "begins"),
    [
        (4.0, "Do we have right of way over the pedestrians?", "No, the pedestrian ahead of us"),
        (4.0, "Who goes first, we or the people?", "The pedestrian ahead of us (vehicle 8) has"),
        (4.0, "Do we have right of way?", "No, the pedestrian ahead of us (vehicle 8) has"),
        (4.0, "Who goes first here?", "The pedestrian ahead of us (vehicle 8) has right of way"),
        (26.0, "Do we have right of way over the pedestrians?", "No, nobody has to give way"),
        (26.0, "Who goes first, we or the people?", "Nobody has to give way"),
    ],
)
def test_people_whom_we_are_about_to_let_go_are_first(at: float, question: str, begins: str):
    assert Talk("junction-0", at).hear(question).startswith(begins)


@pytest.mark.parametrize(
    ("at", "question", "begins"),
    [
        (30.0, "Which way are those people walking?", "I expect the pedestrian ahead of us"),
        (40.0, "Who worries you most?", "The pedestrian (vehicle 13) will be in our way"),
    ],
)
def test_answers_name_the_people_of_the_question(at: float, question: str, begins: str):
    assert Talk("junction-0", at).hear(question).startswith(begins)


def test_people_who_go_first_are_allowed_to_walk() -> None:
    told = Talk("junction-0", 14.0).hear("Are those people allowed to walk there now?")
    assert told.startswith("Yes, the pedestrian")


@pytest.mark.parametrize(
    ("ride", "whom", "told"),
    [
        ("city-0", "people", "There were six pedestrians that I let go first."),
        ("junction-0", "people", "There was one pedestrian that I let go first"),
        ("junction-0", "bikes", "There was one bike that I let go first: the green bicycle"),
        ("junction-0", "vehicles", "There were two vehicles that I let go first."),
    ],
)
def test_as_many_are_counted_as_we_let_go_first(ride: str, whom: str, told: str):
    talk = Talk(ride, 60.0)
    assert talk.hear(f"How many {whom} did you let go first on this ride?").startswith(told)


@pytest.mark.parametrize("question", ["Who went first?", "Who went first there?"])
def test_who_went_first_is_whom_we_let_go_last(question: str) -> None:
    told = Talk("junction-0", 34.5).hear(question)
    assert told.startswith("The green bicycle that was")
    assert "had right of way, so I had to give way, which I did" in told


def test_as_many_are_counted_as_are_expected_to_cross() -> None:
    talk = Talk("junction-0", 9.0)
    talk.hear("Are there any people?")
    assert "will cross our way" in talk.hear("How many of them are going to cross?")
    assert "will cross our way" in talk.hear("Which of them will cross?")


@pytest.mark.parametrize(
    "question",
    [
        "Give me a list of everyone you gave way to.",
        "list everybody you gave way to",
        "List everyone you gave way to since we set off.",
    ],
)
def test_a_list_has_all_whom_we_let_go_first(question: str) -> None:
    told = Talk("junction-0", 60.0).hear(question)
    assert told.startswith("Twice")
    assert all(f"vehicle {number}" in told for number in (3, 13))


@pytest.mark.parametrize(
    "question",
    ["Did you let anyone go first?", "Have you given way to anybody so far?",
     "Who have you let go first?", "list everybody you gave way to"],
)  # fmt: skip
def test_those_who_crossed_while_our_light_was_red_were_not_let_go(question: str) -> None:
    told = Talk("junction-0", 20.0).hear(question)
    assert "not" in told
    assert "vehicle" not in told


@pytest.mark.parametrize(
    "question", ["did you let anyone go first so far", "have you given way to anybody?"]
)
def test_whether_we_let_anybody_go_tells_who_they_were(question: str) -> None:
    talk = Talk("junction-0", 60.0)
    told = talk.hear(question)
    assert all(f"vehicle {number}" in told for number in (3, 13))
    assert "bicycle" in talk.hear("which ones?")


@pytest.mark.parametrize("at", [6.0, 9.0])
@pytest.mark.parametrize(
    "question",
    ["who goes first here", "Who goes first?", "who has right of way", "do we have right of way"],
)
def test_those_with_a_green_light_go_first_while_ours_is_red(question: str, at: float) -> None:
    told = Talk("junction-0", at).hear(question)
    assert "the traffic light" in told.lower()
    assert "red" in told


@pytest.mark.parametrize(
    "question",
    ["is anybody walking across ahead", "Is anyone crossing?", "are there people crossing"],
)
def test_who_is_about_to_step_on_is_told_where_nobody_crosses_yet(question: str) -> None:
    told = Talk("junction-0", 39.0).hear(question)
    assert told.startswith("No, ")
    assert "I am giving way to the pedestrian" in told
    expected = Talk("city-0", 26.0).hear(question)
    assert "to cross our way (90 %)" in expected


def test_whoever_crosses_is_not_nobody() -> None:
    told = Talk("city-0", 15.0).hear("is anyone crossing")
    assert told == "Yes, the car ahead of us on the right (vehicle 24) is crossing our way."


@pytest.mark.parametrize("whom", ["them", "those people", "people", "the pedestrian"])
def test_stopping_for_people_is_what_we_did_for_people_last(whom: str) -> None:
    told = Talk("junction-0", 46.0).hear(f"why did we have to stop for {whom}?")
    assert told.startswith("I braked, because I had to let the pedestrian")
    cycled = Talk("junction-0", 46.0).hear("why did you stop for the cyclist?")
    assert cycled.startswith("I stopped at 0:29, because I had to let the green bicycle")


def test_stepping_on_the_road_is_crossing() -> None:
    told = Talk("junction-0", 42.0).hear("is somebody stepping on the road?")
    assert told.startswith("Yes, the pedestrian")
