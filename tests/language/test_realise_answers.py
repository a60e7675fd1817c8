"""How, how sure, how to avoid, what it hangs on, when: the words for each."""

import pytest
from msgspec.structs import replace

from tests.language.realise_cases import CUT_AND_TURN, cause, effect, explanation
from xavi_dialogue.explain.details import (
    Avoidance,
    Certainty,
    Grounds,
    Pivot,
    Step,
    Suspect,
)
from xavi_dialogue.explain.explanation import Activity, Evidence, Mechanism
from xavi_dialogue.explain.query import Query
from xavi_dialogue.language.context import SpeechContext
from xavi_dialogue.language.realise import realise
from xavi_dialogue.language.suggestions import from_situation

SLOWS = Mechanism("leader", 9.4, 4.1, 5.0, 0.8)
SLOWER = effect("time", 4.2)
BARE = replace(explanation(()), outcome=None)
CONTRASTED = explanation(
    ("continue",), "done", 1.0, (SLOWER,), (cause(1, CUT_AND_TURN, 0.9, SLOWS),)
)


def said(found, now: float = 20.0, **query) -> str:
    return realise(Query(**query), found, SpeechContext(now=now)).text


def grounds(**changes) -> Grounds:
    known = Grounds(
        vehicle=1,
        actions=("exit-right",),
        done=False,
        probability=0.9,
        latest=0.9,
        since=3.0,
        start=2.0,
        end=3.0,
        before=0.45,
        after=0.9,
        deed="slow-down",
        speed_from=11.0,
        speed_to=5.5,
        rival=("continue",),
        fit=9.2,
    )
    return replace(known, **changes)


@pytest.mark.parametrize(
    ("changes", "answer"),
    [
        (
            {},
            "I put the chance that vehicle 1 will turn right at 90 %. It rose most between 0:02 "
            "and 0:03, from 45 to 90 %, when it went from 40 to 20 km/h. Its path fits that "
            "about 9 times better than going straight on.",
        ),
        (
            {"before": 0.001, "fit": 1.0},
            "I put the chance that vehicle 1 will turn right at 90 %. It rose most between 0:02 "
            "and 0:03, from under 5 to 90 %, when it went from 40 to 20 km/h.",
        ),
        (
            {"done": True, "deed": "change-right", "fit": None},
            "I put the chance that vehicle 1 would turn right at 90 %. It rose most between 0:02 "
            "and 0:03, from 45 to 90 %, when it changed to the right lane at 20 km/h. Its path "
            "hardly fits going straight on.",
        ),
        (
            {"since": None, "probability": 0.3, "after": 0.45, "fit": 1.0},
            "I do not know that: I put the chance that vehicle 1 will turn right at 30 %. That "
            "was my view from the time I first saw it.",
        ),
        (
            {"probability": 0.6, "latest": 0.1},
            "At 0:20 I put the chance that vehicle 1 would turn right at 60 %, but now at 10 %.",
        ),
    ],
)
def test_how_we_knew(changes, answer):
    found = replace(BARE, grounds=grounds(**changes), sim_time=20.0)
    assert said(found, type="how", actor="vehicle:1", tense="future") == answer


def test_how_we_decided():
    found = replace(
        CONTRASTED,
        causes=(),
        options=("change-left", "continue", "stop"),
        evidence=Evidence("tree", 84, 6, ("0",)),
    )
    assert said(found, type="how", factual=("change-left",)) == (
        "I simulated 84 drives in 6 situations: moving to the left lane, staying in my lane and "
        "stopping. I chose to move to the left lane: staying in my lane would have got us there "
        "about 4 seconds later."
    )
    alone = replace(BARE, options=("continue",), evidence=Evidence("tree", 1, 1, ("0",)))
    assert said(alone, type="how") == (
        "I simulated one drive. The only thing I could do was to go straight on."
    )


def test_how_we_will_go_about_it():
    steps = (Step("change-left", 20.2), Step("exit-left", 28.1))
    found = replace(BARE, steps=steps, arrival=15.2)
    assert said(found, type="how", tense="future") == (
        "I will move to the left lane, then turn left in about 8 seconds. "
        "We should be there in about 15 seconds."
    )


@pytest.mark.parametrize(
    ("certainty", "answer"),
    [
        (
            Certainty("choice", 1.0, 0.86, 12, 12),
            "I was quite sure: moving to the left lane did better than staying in my lane in all "
            "12 situations that I tried. As far as I can foresee, that makes the chance at least "
            "85 %.",
        ),
        (
            Certainty("choice", 0.8, 0.6, 9, 12),
            "I was only fairly sure: moving to the left lane did better than staying in my lane "
            "in 9 of the 12 situations that I tried. Those make up 80 % of what I expected, or "
            "60 % at the least.",
        ),
        (
            Certainty("plan", 1.0, 0.99, 30, 30),
            "I was almost certain: my plan worked out in all 30 situations that I tried. As far "
            "as I can foresee, that makes the chance over 95 %.",
        ),
        (
            Certainty("plan", 1.0, 0.88, 21, 21, 16),
            "I was quite sure: my plan worked out in all 21 situations that I tried, though it "
            "took longer than I looked ahead in 16. As far as I can foresee, that makes the "
            "chance at least 85 %.",
        ),
        (
            Certainty("plan", 0.0, 0.0, 0, 5),
            "I was not sure at all: my plan worked out in not one of the situations that I tried. "
            "I put the chance at under 5 %.",
        ),
    ],
)
def test_how_sure_we_are(certainty, answer):
    found = replace(explanation(("continue",)), certainty=certainty)
    assert said(found, type="confidence", factual=("change-left",)) == answer
    assert "100 %" not in answer


@pytest.mark.parametrize(
    ("avoidance", "outcome", "answer"),
    [
        (
            Avoidance("stop", True, 0.9, 0.0, 3, 4),
            "done",
            "At 0:12 I could have stayed in my lane: the chance of having to stop would then have "
            "been under 5 % instead of 90 %, going by my simulations. We would have got there "
            "about 4 seconds later.",
        ),
        (
            Avoidance("collision", False, 0.8, 0.6, 3, 4),
            "done",
            "No option that I looked at would have spared us that. Even staying in my "
            "lane at 0:12 left the chance of a collision at 60 %.",
        ),
        (
            Avoidance("hard-brake", False, 0.1, 0.05, 3, 4),
            "done",
            "Nothing that I could foresee: at 0:12 I put the chance of braking hard at 10 %.",
        ),
        (
            Avoidance("slow-down", False, 0.9, 0.1, 3, 4),
            "dead",
            "Only in a way that would not have taken us to our destination: at 0:12 I could have "
            "stayed in my lane.",
        ),
    ],
)
def test_how_it_could_have_been_avoided(avoidance, outcome, answer):
    found = replace(
        explanation(("continue",), outcome, 1.0, (SLOWER,)),
        avoidance=avoidance,
        sim_time=12.0,
        moment=15.0,
    )
    assert said(found, type="how_avoid") == answer
    none = replace(
        found, counterfactual=(), avoidance=replace(avoidance, possible=False, options=0)
    )
    assert said(none, type="how_avoid").startswith("I had no other option in the seconds before")


def test_what_a_decision_hangs_on():
    pivot = Pivot("conduct", 1, ("continue",), 0.2)
    assert said(replace(CONTRASTED, pivot=pivot), type="sensitivity") == (
        "If vehicle 1 had gone straight on, I would have stayed in my lane instead. "
        "I put the chance of that at 20 % beforehand."
    )
    gone = replace(CONTRASTED, pivot=Pivot("removal", 1))
    assert said(gone, type="sensitivity", tense="future") == (
        "If vehicle 1 were not there, I would stay in my lane instead."
    )
    way = replace(explanation(("exit-right",), "dead"), pivot=Pivot("none"))
    assert said(way, type="sensitivity", tense="future") == (
        "Nothing that the others might do: turning right would not take us to our destination."
    )
    most = replace(CONTRASTED, pivot=Pivot("factor", 1))
    assert said(most, type="sensitivity") == (
        "What mattered most is vehicle 1: I expected it to slow from 34 to 15 km/h and turn "
        "right. I expected to lose about 4 seconds by that."
    )


@pytest.mark.parametrize(
    ("deed", "changes", "answer"),
    [
        (
            "change-left",
            True,
            "If vehicle 1 had not been there, I would have stayed in my lane instead and got "
            "there about 4 seconds later.",
        ),
        ("stop", True, "If vehicle 1 had not been there, I would not have stopped."),
        (
            "stop",
            False,
            "If vehicle 1 had not been there, I would still have stopped and got there about 4 "
            "seconds later.",
        ),
    ],
)
def test_whether_we_would_still_have_done_it(deed, changes, answer):
    found = replace(CONTRASTED, causes=(cause(1, ("exit-right",), 0.8, None, changes),))
    words = "if vehicle 1 had not been there"
    assert said(found, type="sensitivity", factual=(deed,), condition=words) == answer


def test_when_something_will_happen():
    soon = replace(BARE, moment=25.0, span=(24.6, 25.4))
    turn = {"type": "when", "factual": ("exit-left",), "tense": "future"}
    assert said(soon, **turn) == "I expect to turn left in about 5 seconds."
    spread = replace(BARE, moment=25.0, span=(23.0, 29.0))
    assert said(spread, **turn) == (
        "I expect to turn left in about 5 seconds, between 3 and 9 seconds from now."
    )
    standing = replace(
        soon,
        activity=Activity(0, ("stop",), None, 0.0, "standing"),
        causes=(cause(2, ("continue",), 0.9, Mechanism("right-of-way", 8.0, 8.0, 3.0, 1.0)),),
    )
    waits = {"type": "when", "factual": ("stop",), "tense": "present"}
    assert said(standing, **waits) == (
        "I expect to move on in about 5 seconds. I am waiting for vehicle 2."
    )
    long = replace(standing, moment=None, span=None, least=29.8)
    assert said(long, **waits) == (
        "I cannot say: in most of the drives I simulated, we stood for more than 29 seconds."
    )
    slow = replace(explanation((), "termination"), least=28.7)
    assert said(slow, type="when", tense="future") == (
        "It will probably take more than 28 seconds to get there."
    )
    far = replace(BARE, least=20.9)
    assert said(far, type="when", tense="future") == (
        "Our destination is further away than I plan ahead. "
        "It will take more than 20 seconds to get there."
    )


@pytest.mark.parametrize(
    ("part", "opening"),
    [
        ("main", "Yes. I moved to the left lane"),
        ("some", "In part. I moved to the left lane"),
        ("none", "No, not because of vehicle 1. I moved to the left lane"),
    ],
)
def test_a_suspect_is_answered_first(part, opening):
    found = replace(CONTRASTED, suspect=Suspect(1, part))
    query = {"type": "why", "factual": ("change-left",), "hypothesised_cause": "vehicle:1"}
    assert said(found, **query).startswith(opening)


def test_a_vehicle_that_is_gone_is_spoken_of_in_the_past():
    found = replace(BARE, activity=Activity(1, ("exit-right",), 0.8, 9.4, "slowing"), seen=12.4)
    assert said(found, type="what", actor="vehicle:1", tense="present") == (
        "I last saw vehicle 1 at 0:12. It was slowing down, at 34 km/h. "
        "I expected it to turn right."
    )


def test_what_has_been_asked_is_not_suggested():
    why = Query(type="why", factual=("change-left",), counterfactual=("continue",))
    doing = Query(type="what", tense="present")
    fresh = from_situation(SpeechContext(done=("change-left",), asked=(why, doing)))
    assert "why" not in {query.type for query in fresh}
    assert Query(type="what", tense="future") in fresh
    plain = from_situation(SpeechContext(done=("change-left",)))
    assert plain[0] == Query(type="why", factual=("change-left",))
