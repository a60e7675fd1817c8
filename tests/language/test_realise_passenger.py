"""Style `passenger`: purpose, contrast, cause, in the tense of the question."""

import msgspec
import pytest

from planner.trace import HoldUp, Outcome
from tests.language.realise_cases import CUT_AND_TURN, cause, effect, explanation, watching
from xavi_dialogue.explain.explanation import Activity, Destination, Mechanism
from xavi_dialogue.explain.query import Detail, Query, QueryAction, Tense
from xavi_dialogue.language.content import select
from xavi_dialogue.language.context import SpeechContext, VehicleWords
from xavi_dialogue.language.points import Budget, Contrast
from xavi_dialogue.language.realise import realise, stages

SLOWS = Mechanism("leader", 9.4, 4.1, 4.0, 0.8)
AHEAD = SpeechContext(vehicles={1: VehicleWords("car", "the car ahead")})
SLOWER = effect("time", 4.2)
SLOWED = explanation(("continue",), "done", 0.8, (SLOWER,), (cause(1, CUT_AND_TURN, 0.85, SLOWS),))


def why(tense: Tense = "past", detail: Detail | None = None) -> Query:
    return Query(
        type="why",
        factual=("change-left",),
        counterfactual=("continue",),
        tense=tense,
        detail=detail,
    )


@pytest.mark.parametrize(
    ("tense", "answer"),
    [
        (
            "past",
            "I moved to the left lane to get us there sooner. Staying in my lane would very "
            "likely have got us there about 4 seconds later, because I expected the car ahead "
            "(vehicle 1) to slow from 34 to 15 km/h and turn right.",
        ),
        (
            "present",
            "I am moving to the left lane to get us there sooner. Staying in my lane would very "
            "likely get us there about 4 seconds later, because I expect the car ahead "
            "(vehicle 1) to slow from 34 to 15 km/h and turn right.",
        ),
        (
            "future",
            "I will move to the left lane to get us there sooner. Staying in my lane would very "
            "likely get us there about 4 seconds later, because I expect the car ahead "
            "(vehicle 1) to slow from 34 to 15 km/h and turn right.",
        ),
    ],
)
def test_why_in_every_tense(tense: Tense, answer: str) -> None:
    said = realise(why(tense), SLOWED, AHEAD)
    assert said.text == answer
    assert said.mentioned == (1,)


def test_what_if_is_hypothetical() -> None:
    query = Query(type="what_if", counterfactual=("continue",))
    assert realise(query, SLOWED, SpeechContext()).text == (
        "If I had stayed in my lane, we would very likely have got there about 4 seconds later, "
        "because I expected vehicle 1 to slow from 34 to 15 km/h and turn right."
    )


@pytest.mark.parametrize(
    ("outcome", "answer"),
    [
        ("dead", "If I had gone straight on, that would not have taken us to our destination."),
        (
            "termination",
            "If I had gone straight on, we would not have got there in the time I looked ahead.",
        ),
        (
            "collision",
            "If I had gone straight on, we would have collided with vehicle 2, "
            "going by my simulations.",
        ),
        ("done", "If I had gone straight on, we would have got there just as well."),
    ],
)
def test_outcomes(outcome: Outcome, answer: str) -> None:
    query = Query(type="what_if", counterfactual=("exit-straight",))
    found = explanation(("exit-straight",), outcome, fact=("exit-right",), hit=2)
    assert realise(query, found, SpeechContext()).text == answer


@pytest.mark.parametrize("outcome", ["collision", "dead", "termination", "done"])
def test_the_outcome_gives_the_purpose(outcome: Outcome) -> None:
    purposes = {
        "collision": "to keep clear of vehicle 1.",
        "dead": "to take us to our destination.",
        "termination": "to get us to our destination in good time.",
        "done": "to get us there sooner.",
    }
    found = explanation(("continue",), outcome, 0.9, (SLOWER,), hit=1)
    text = realise(why(), found, SpeechContext()).text
    assert text.startswith(f"I moved to the left lane {purposes[outcome]}")


def test_a_collision_is_what_simulations_show() -> None:
    found = explanation(
        ("continue",), "collision", 1.0, (), (cause(1, ("change-right",), 0.9),), hit=1
    )
    text = realise(why(), found, SpeechContext()).text
    assert "In my simulations, staying in my lane would have ended in a collision" in text
    assert text.endswith("because I expected it to change to the right lane.")


@pytest.mark.parametrize(
    ("how", "reason"),
    [
        ("leader", "to slow from 34 to 15 km/h and turn right."),
        ("cut-in", "to cut in ahead of me and turn right."),
        ("blocked", "to block my way and turn right."),
        (
            "right-of-way",
            "give way to vehicle 1, which I expected to change to the right lane and turn right.",
        ),
    ],
)
def test_mechanisms(how: HoldUp, reason: str) -> None:
    held_up = cause(1, CUT_AND_TURN, 0.85, Mechanism(how, 9.4, 4.1, 2.0, 0.7))
    found = explanation(("continue",), "done", 1.0, (SLOWER,), (held_up,))
    query = Query(type="what_if", counterfactual=("continue",))
    assert realise(query, found, SpeechContext()).text.endswith(reason)


@pytest.mark.parametrize(
    ("speeds", "phrase"),
    [
        ((9.4, 0.2), "slow from 34 km/h to a stop and turn right"),
        ((5.0, 5.0), "hold me up at about 18 km/h and turn right"),
        ((None, None), "hold me up and turn right"),
    ],
)
def test_speeds_of_a_leader(speeds: tuple[float | None, float | None], phrase: str) -> None:
    held_up = cause(1, CUT_AND_TURN, 0.85, Mechanism("leader", *speeds, 2.0, 0.7))
    found = explanation(("continue",), "done", 1.0, (SLOWER,), (held_up,))
    assert phrase in realise(why(), found, SpeechContext()).text


@pytest.mark.parametrize(
    ("probability", "words"),
    [
        (1.0, "would have got"),
        (1 - 1e-12, "would have got"),
        (0.96, "would almost certainly have got"),
        (0.8, "would very likely have got"),
        (0.5, "would probably have got"),
        (0.2, "would possibly have got"),
    ],
)
def test_probability_of_the_outcome(probability: float, words: str) -> None:
    found = explanation(("continue",), "done", probability, (SLOWER,))
    assert words in realise(why(), found, SpeechContext()).text


@pytest.mark.parametrize(
    ("probability", "words"),
    [
        (0.2, "because there was a chance that vehicle 1 would turn left."),
        (0.5, "because I thought vehicle 1 would probably turn left."),
        (0.9, "because I expected vehicle 1 to turn left."),
    ],
)
def test_probability_of_a_cause(probability: float, words: str) -> None:
    found = explanation(
        ("continue",), "done", 1.0, (SLOWER,), (cause(1, ("exit-left",), probability),)
    )
    assert realise(why(), found, SpeechContext()).text.endswith(words)


@pytest.mark.parametrize(
    ("delta", "words"),
    [
        (0.5, "about half a second later"),
        (1.1, "about 1 second later"),
        (1.6, "about 1.5 seconds later"),
        (3.4, "about 3 seconds later"),
        (-2.0, "about 2 seconds sooner"),
    ],
)
def test_time_differences_are_rounded(delta: float, words: str) -> None:
    found = explanation(("continue",), effects=(effect("time", delta),))
    assert words in realise(why(), found, SpeechContext()).text


def test_a_difference_whose_range_includes_none_is_on_average() -> None:
    found = explanation(("continue",), effects=(effect("time", 2.0, spread=3.0),))
    assert "on average 2 seconds later" in realise(why(), found, SpeechContext()).text


def test_negligible_differences_are_not_named() -> None:
    found = explanation(("continue",), effects=(effect("time", 0.1), effect("jerk", 0.01)))
    assert realise(why(), found, SpeechContext()).text == (
        "I moved to the left lane. Staying in my lane would have got us there just as well."
    )


def test_what_speaks_against_the_fact_is_not_kept_back() -> None:
    found = explanation(
        ("continue",), effects=(effect("angular-acceleration", -0.3), effect("time", 1.0))
    )
    assert "about 1 second later, but with gentler steering" in (
        realise(why(), found, SpeechContext()).text
    )


def test_a_foil_that_is_quicker_has_no_cause_but_something_taken_into_account() -> None:
    found = explanation(
        ("continue",), effects=(effect("time", -2.0),), causes=(cause(1, ("exit-left",), 0.9),)
    )
    text = realise(why(), found, SpeechContext()).text
    assert "because" not in text
    assert "I also took into account vehicle 1, which I expected to turn left." in text


def test_names_come_first_and_pronouns_after() -> None:
    found = explanation(("continue",), "collision", 0.9, (), (cause(1, CUT_AND_TURN, 0.9),), hit=1)
    text = realise(why(), found, AHEAD).text
    assert text.count("the car ahead (vehicle 1)") == 1
    assert text.count("vehicle 1") == 1
    assert "collision with it" in text


def test_two_vehicles_keep_their_names() -> None:
    found = explanation(("continue",), "collision", 0.9, (), (cause(2, ("stop",), 0.9),), hit=1)
    text = realise(why(), found, SpeechContext(max_causes=2)).text
    assert "vehicle 1" in text
    assert "vehicle 2" in text


def test_a_vehicle_named_before_is_not_described_again() -> None:
    named = SpeechContext(vehicles=AHEAD.vehicles, named=frozenset({1}))
    text = realise(why(), SLOWED, named).text
    assert "the car ahead" not in text
    assert "vehicle 1" in text


def test_less_is_one_sentence_and_more_says_what_it_rests_on() -> None:
    less = realise(why(detail="less"), SLOWED, AHEAD).text
    more = realise(why(detail="more"), SLOWED, AHEAD).text
    assert less.count(".") == 1
    assert "vehicle 1" in less
    assert "I tried 120 drives in 32 situations" in more
    assert "85 %" in more


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        (True, "Without it I would have decided otherwise."),
        (False, "Even without it I would have done the same."),
    ],
)
def test_planning_again_without_the_vehicle(changes: bool, sentence: str) -> None:
    found = explanation(
        ("continue",), "done", 0.8, (SLOWER,), (cause(1, CUT_AND_TURN, 0.8, SLOWS, changes),)
    )
    assert sentence in realise(why(detail="more"), found, AHEAD).text


@pytest.mark.parametrize(
    ("tense", "answer"),
    [
        ("past", "I turned right at 34 km/h."),
        ("present", "I am turning right at 34 km/h. After that I will move to the left lane."),
        ("future", "Next I will turn right, and then I will move to the left lane."),
    ],
)
def test_what_we_do(tense: Tense, answer: str) -> None:
    found = watching(Activity(0, ("exit-right", "change-left"), None, 9.4, "steady"))
    assert realise(Query(type="what", tense=tense), found, SpeechContext()).text == answer


@pytest.mark.parametrize(
    ("tense", "answer"),
    [
        (
            "past",
            "The car ahead (vehicle 1) was slowing down, at 34 km/h. I expected it to turn right.",
        ),
        (
            "present",
            "The car ahead (vehicle 1) is slowing down, at 34 km/h. I expect it to turn right.",
        ),
        ("future", "I expect the car ahead (vehicle 1) to turn right."),
    ],
)
def test_what_another_vehicle_does(tense: Tense, answer: str) -> None:
    found = watching(Activity(1, ("exit-right",), 0.8, 9.4, "slowing"))
    assert realise(Query(type="what", actor="vehicle:1", tense=tense), found, AHEAD).text == answer


@pytest.mark.parametrize(
    ("deed", "answer"),
    [
        (
            "slow-down",
            "Vehicle 1 most likely slowed down in order to change to the right lane "
            "and turn right.",
        ),
        ("change-right", "Vehicle 1 most likely changed to the right lane in order to turn right."),
        (
            "exit-right",
            "I cannot see its plans, but I saw it coming: to turn right is what I expected of "
            "vehicle 1.",
        ),
    ],
)
def test_why_another_vehicle_did_it(deed: QueryAction, answer: str) -> None:
    query = Query(type="why", actor="vehicle:1", factual=(deed,))
    found = watching(Activity(1, CUT_AND_TURN, 0.8, 9.4, "slowing"))
    assert realise(query, found, SpeechContext()).text == answer


def test_where_we_are_going() -> None:
    found = watching(Activity(0, ("continue",), None, 9.4, "steady"), arrival=12.3)
    assert realise(Query(type="where_goal"), found, SpeechContext()).text == (
        "We are on our way to our destination, and should be there in about 12 seconds."
    )


def test_what_if_another_vehicle_had_done_otherwise() -> None:
    query = Query(type="what_if", actor="vehicle:1", counterfactual=("change-right",), negated=True)
    found = explanation(("continue",), effects=(effect("time", -2.0),))
    assert realise(query, found, SpeechContext()).text == (
        "If vehicle 1 had not changed to the right lane, I would have stayed in my lane instead "
        "and got there about 2 seconds sooner."
    )


@pytest.mark.parametrize(
    ("changes", "answer"),
    [
        (True, "If vehicle 1 had stopped, I would have moved to the left lane instead."),
        (False, "If vehicle 1 had stopped, I would still have moved to the left lane."),
    ],
)
def test_planning_again_decides_whether_we_would_have_done_the_same(
    changes: bool, answer: str
) -> None:
    query = Query(type="what_if", actor="vehicle:1", counterfactual=("stop",))
    supposed = cause(1, ("stop",), 0.1, None, changes)
    found = explanation(("change-left",), causes=(supposed,), fact=("change-left",))
    assert realise(query, found, SpeechContext()).text == answer


@pytest.mark.parametrize(
    ("deed", "how", "answer"),
    [
        (
            "slow-down",
            "leader",
            "I slowed down, because I expected vehicle 1 to slow from 34 to 15 km/h and turn left.",
        ),
        (
            "stop",
            "right-of-way",
            "I stopped, because I had to give way to vehicle 1, which I expected to turn left.",
        ),
        ("give-way", "right-of-way", "I gave way to vehicle 1, which I expected to turn left."),
    ],
)
def test_who_was_in_our_way(deed: QueryAction, how: HoldUp, answer: str) -> None:
    held_up = cause(1, ("exit-left",), 0.9, Mechanism(how, 9.4, 4.1, 2.0, 0.9))
    found = msgspec.structs.replace(explanation((), causes=(held_up,)), outcome=None)
    assert realise(Query(type="why", factual=(deed,)), found, SpeechContext()).text == answer


@pytest.mark.parametrize(
    ("moment", "answer"),
    [
        (12.0, "I turned left at 0:12, about 8 seconds ago."),
        (25.0, "I will turn left at 0:25, in about 5 seconds."),
        (20.0, "I turned left at 0:20."),
    ],
)
def test_when(moment: float, answer: str) -> None:
    found = msgspec.structs.replace(explanation(()), moment=moment)
    query = Query(type="when", factual=("exit-left",))
    assert realise(query, found, SpeechContext(now=20.0)).text == answer


def test_where_another_vehicle_is_going() -> None:
    goal = Destination(1, "south", "exit-right", "the road to the right", 0.8)
    found = msgspec.structs.replace(explanation(()), destination=goal, outcome=None)
    query = Query(type="where_goal", actor="vehicle:1", tense="present")
    assert realise(query, found, AHEAD).text == "I expect the car ahead (vehicle 1) to turn right."


def test_what_a_track_shows_and_the_goal_behind_it() -> None:
    shown = Activity(1, ("change-right",), None, 9.4, "slowing")
    goal = Destination(1, "south", "exit-right", "the road to the right", 0.8)
    found = msgspec.structs.replace(watching(shown), destination=goal)
    query = Query(type="what", actor="vehicle:1")
    assert realise(query, found, SpeechContext()).text == (
        "Vehicle 1 changed to the right lane. I expected it to turn right."
    )
    why_it = Query(type="why", actor="vehicle:1", factual=("change-right",))
    assert realise(why_it, found, SpeechContext()).text == (
        "Vehicle 1 most likely changed to the right lane in order to turn right."
    )


@pytest.mark.parametrize(
    ("probability", "sure", "chance"),
    [
        (1.0, "almost certain", "over 95 %"),
        (0.999, "almost certain", "over 95 %"),
        (0.8, "quite sure", "80 %"),
        (0.5, "not sure", "50 %"),
        (0.6, "only fairly sure", "60 %"),
        (0.1, "not sure at all", "10 %"),
    ],
)
def test_how_sure(probability: float, sure: str, chance: str) -> None:
    found = watching(Activity(1, ("exit-left",), probability, 9.4, "steady"))
    query = Query(type="confidence", actor="vehicle:1", tense="present")
    assert realise(query, found, SpeechContext()).text == (
        f"I am {sure}: I put the chance that vehicle 1 will turn left at {chance}."
    )


def test_a_range_keeps_its_halves() -> None:
    found = explanation(("continue",), effects=(effect("time", 1.6, spread=1.0),))
    assert "ranged from 0.5 to 2.5 seconds" in realise(why(detail="more"), found, AHEAD).text


def test_the_stages_can_be_looked_at() -> None:
    made = stages(why(), SLOWED, AHEAD)
    content = made.content
    assert isinstance(content, Contrast)
    assert content.purpose == "time"
    assert content.because is not None
    assert content.because.vehicle.number == 1
    assert len(made.words) == len(made.tokens)
    assert select(why(), SLOWED, Budget(1, 1), now=0.0) == content


def test_an_answer_suggests_what_to_ask_next() -> None:
    suggestions = realise(why(), SLOWED, AHEAD).suggestions
    assert "What if vehicle 1 had not been there?" in suggestions
