"""Who is in front, behind or at a side: told from the scene of now, or of the time named."""

import pytest

from sim.scene import EGO
from tests.dialogue.talking import MIND, Talk
from xavi_dialogue.explain.bearings import bearing, place
from xavi_dialogue.explain.query import Query

FRONT = Query(type="what", actor="vehicle:front", tense="present")


@pytest.mark.parametrize(
    ("text", "actor", "tense"),
    [
        ("is anyone in front of us?", "front", "present"),
        ("Is there a car ahead of us right now?", "front", "present"),
        ("is the road ahead clear", "front", "present"),
        ("anybody in front?", "front", "present"),
        ("who's driving right in front of you", "front", "present"),
        ("were there any cars in front of us?", "front", "past"),
        ("which car was ahead of us before you turned?", "front", "past"),
        ("is anyone following us?", "behind", "present"),
        ("was anybody behind us when you changed lanes?", "behind", "past"),
        ("who is beside us", "beside", "present"),
        ("is there someone on our left?", "left", "present"),
        ("what is on the right", "right", "present"),
        ("is anything coming towards us?", "oncoming", "present"),
    ],
)
@pytest.mark.parametrize("before", [None, FRONT, Query(type="why", factual=("change-left",))])
def test_who_is_there_is_one_question_in_many_words(
    text: str, actor: str, tense: str, before: Query | None
) -> None:
    query = MIND.parse(text, frozenset(range(6)), before)
    assert isinstance(query, Query)
    assert (query.type, query.actor, query.tense) == ("what", f"vehicle:{actor}", tense)
    assert query.factual is None


@pytest.mark.parametrize("at", [11.0, 12.0, 16.0])
@pytest.mark.parametrize("text", ["Who is in front of you?", "Is anyone in front of us?"])
def test_nobody_is_ahead_once_we_have_passed(text: str, at: float) -> None:
    talk = Talk(at=at)
    reply = talk.say(text).reply
    assert (reply.kind, reply.reason) == ("answer", None)
    assert reply.text.startswith("I see nobody driving ahead of us. The nearest to us is ")
    found = reply.explanation
    assert found is not None
    assert found.sight is not None
    assert found.sight.others == tuple(
        sorted(found.sight.others, key=lambda name: _distance(talk, name, at))
    )


def _distance(talk: Talk, vehicle: int, at: float) -> float:
    scene = [trace.scene for trace in talk.ride.traces if trace.sim_time <= at][-1]
    return bearing(scene[EGO], scene[vehicle]).distance


def test_of_the_past_it_is_told_as_it_was() -> None:
    turn = Talk(at=12.0).say("Who was in front of us when you changed lanes?")
    then = turn.reply.explanation
    assert then is not None
    assert then.activity is not None
    assert then.moment == pytest.approx(4.55)
    scene = next(trace.scene for trace in Talk().ride.traces if trace.sim_time >= 4.55)
    assert place(bearing(scene[EGO], scene[then.activity.vehicle])).startswith("ahead")
    assert turn.reply.text.startswith("At 0:04")


def test_nobody_was_there_at_that_time_though_somebody_was_later() -> None:
    talk = Talk(at=12.0)
    assert "(vehicle 1)" in talk.hear("Is anyone behind us?")
    for text in ("Was anyone behind us when you changed lanes?", "Who was behind us then?"):
        assert talk.hear(text).startswith(("I saw nobody driving behind us", "As I said, I saw"))


@pytest.mark.parametrize(
    "text",
    [
        "Why is the car in front braking?",
        "How fast is the car in front?",
        "Where is the car in front going?",
        "Are you slowing down because of the car in front?",
    ],
)
def test_what_somebody_ahead_does_is_declined_where_nobody_is(text: str) -> None:
    reply = Talk(at=12.0).say(text).reply
    assert (reply.kind, reply.reason) == ("refusal", "unknown-vehicle")
    assert reply.text.startswith("I see nobody driving ahead of us.")


def test_who_is_there_goes_on_from_place_to_place() -> None:
    talk = Talk(at=12.0)
    talk.hear("Who is in front of us?")
    assert "(vehicle 1)" in talk.hear("And behind us?")
    assert talk.hear("How about in front?").startswith("As I said, I see nobody driving ahead")


def test_whether_a_vehicle_is_there_is_answered_by_where_it_is() -> None:
    reply = Talk(at=12.0).say("Is vehicle 1 in front of us?").reply
    assert reply.text.startswith("The car behind us on the right (vehicle 1) is behind us") or (
        reply.text.startswith("Vehicle 1 is behind us on the right, about 19 metres away")
    )
