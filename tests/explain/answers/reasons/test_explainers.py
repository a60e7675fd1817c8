"""Which question of reasons a causal question comes to."""

from typing import Any

import pytest

from tests.explain.answers.stated import US, did, look, scene
from xavi_dialogue.domain.answers import (
    DidNotHappen,
    Happenings,
    Measures,
    NeedRollout,
)
from xavi_dialogue.domain.meaning import (
    HowKnow,
    Listing,
    Whether,
    Which,
    Why,
)
from xavi_dialogue.domain.terms import (
    At,
    Between,
    Caused,
    Compares,
    Event,
    Happens,
    Is,
    Measured,
    Not,
    Vehicle,
    Vehicles,
    Wanted,
    WholeRide,
)
from xavi_dialogue.explain.answers import causal
from xavi_dialogue.explain.answers.propositions import reasons
from xavi_dialogue.explain.answers.reasons import choices, knowing
from xavi_dialogue.explain.answers.reference.asked import Unanswered
from xavi_dialogue.explain.answers.suppositions import deciding, possible

ONE, TWO = Vehicle(1), Vehicle(2)
STOP, GO = Event("stop"), Event("go", tense="present")


def of(question: Any, **facts: Any) -> Any:
    return causal.explainer(question, scene(**({"looks": {1: look(1), 2: look(2)}} | facts)))


@pytest.fixture
def whys(monkeypatch: pytest.MonkeyPatch) -> list[Why]:
    """The questions of reasons that are asked, all of which are answered."""
    asked: list[Why] = []

    def why(question: Why, _: Any) -> Any:
        asked.append(question)
        return Measures(())

    monkeypatch.setattr(reasons, "why", why)
    return asked


def told_to(asked: list[Any]) -> Any:
    """An explainer that notes what it is asked."""

    def explain(question: Any, _: Any) -> Measures:
        asked.append(question)
        return Measures(())

    return explain


def asked_why(question: Any, whys: list[Why], **facts: Any) -> Why:
    """The question of reasons that another one comes to."""
    explainer = of(question, **facts)
    assert explainer(question, scene(**({"looks": {1: look(1)}} | facts))) == Measures(())
    return whys[-1]


# --- who held us up, and for what we wait -------------------------------------------------------


def for_whom(action: Any, **more: Any) -> Any:
    return Which(Wanted(), Happens(Event(action, US, Wanted(), **more)))


def blocks(**more: Any) -> Any:
    return Happens(Event("block", Wanted(), US, **more))


@pytest.mark.parametrize(
    "action", ["wait", "slow-down", "brake", "stop", "stand", "give-way", "let-go"]
)
def test_for_whom_we_do_it_is_its_reason(whys: list[Why], action: Any) -> None:
    assert asked_why(for_whom(action), whys) == Why(Happens(Event(action)))
    timed = for_whom(action, time=At(3.0))
    assert asked_why(timed, whys) == Why(Happens(Event(action, time=At(3.0))))


def test_that_we_do_not_go_on_now_is_its_reason(whys: list[Why]) -> None:
    not_going = Why(Not(Happens(GO)))
    for action in ("stop", "stand", "wait"):
        assert asked_why(for_whom(action, tense="present"), whys) == not_going
    brake = Event("brake", tense="present")
    assert asked_why(for_whom("brake", tense="present"), whys) == Why(Happens(brake))
    assert asked_why(Which(Wanted(), Is("stuck")), whys) == not_going
    assert asked_why(Which(Wanted(), Is("stationary", US)), whys) == not_going
    past = Is("stuck", tense="past", time=At(3.0))
    stood = Why(Happens(Event("stand", time=At(3.0))))
    assert asked_why(Which(Wanted(), past), whys) == stood
    assert asked_why(Which(Wanted(), blocks(tense="present")), whys) == not_going
    assert asked_why(Which(Wanted(), blocks()), whys) == Why(Happens(Event("wait")))


def test_who_delays_us_is_who_makes_us_wait(whys: list[Why]) -> None:
    left = Measured("delay", Wanted(), time=At(3.0), tense="past")
    found = asked_why(Which(Wanted(), Compares(left, "more")), whys)
    assert found == Why(Happens(Event("wait", time=At(3.0))))
    now = Measured("delay", Wanted())
    assert asked_why(Which(Wanted(), Compares(now, "more")), whys) == Why(Not(Happens(GO)))


@pytest.mark.parametrize(
    "such",
    [
        None,
        Not(Is("stuck")),
        Is("stuck", ONE),
        Is("fast"),
        Compares(Measured("delay", ONE), "more"),
        Compares(Measured("speed", Wanted()), "more"),
        Happens(Event("give-way", US, Wanted(), tense="present", modal="must")),
        Happens(Event("let-go", US, Wanted(), tense="present", modal="must")),
        Happens(Event("wait", US, Wanted(), tense="present", modal="must")),
        Happens(Event("wait", ONE, Wanted())),
        Happens(Event("wait", US, ONE)),
        Happens(Event("overtake", US, Wanted())),
        Happens(Event("block", ONE, US)),
        Happens(Event("block", Wanted(), ONE)),
        Not(Happens(Event("wait", US, Wanted()))),
    ],
)
def test_what_is_not_asked_of_our_waiting(such: Any) -> None:
    assert of(Which(Wanted(), such)) is None


def test_what_we_had_to_do_may_be_waiting(whys: list[Why]) -> None:
    had = for_whom("give-way", modal="must")
    assert asked_why(had, whys) == Why(Happens(Event("give-way", modal="must")))


GAVE = (did("give-way", 3.0, 5.0, object=ONE), did("give-way", 12.0, 14.0, object=TWO))


@pytest.mark.parametrize(
    ("thing", "such", "told"),
    [
        (Vehicles((1, 2)), blocks(), GAVE),
        (Wanted(), blocks(time=WholeRide()), GAVE),
        (Vehicles((1, 2)), blocks(time=Between(2.0, 6.0)), GAVE[:1]),
        (Wanted(), Compares(Measured("delay", Wanted(), time=WholeRide(), tense="past"), "more"),
         GAVE),
    ],
)  # fmt: skip
def test_who_held_us_up_over_the_ride(thing: Any, such: Any, told: Any) -> None:
    question = Which(thing, such)
    looks = {1: look(1), 2: look(2)}
    found = of(question)(question, scene(episodes=GAVE, looks=looks))
    assert isinstance(found, Happenings)
    assert found.episodes == told


def test_which_of_two_cost_more_counts_only_the_time_named():
    slow = (
        did("give-way", 3.0, 5.0, object=ONE),
        did("give-way", 12.0, 14.0, object=TWO),
        did("give-way", 30.0, 33.0, object=ONE),
    )
    looks = {1: look(1), 2: look(2)}
    delay = Measured("delay", Wanted(), time=Between(10.0, 15.0), tense="past")
    question = Which(Vehicles((1, 2)), Compares(delay, "more"))
    found = of(question)(question, scene(episodes=slow, looks=looks, delays={"give-way": 3.0}))
    assert isinstance(found, Measures)
    assert [(one.to, one.count) for one in found.measures] == [(TWO, 1), (ONE, 0)]


def test_who_blocks_us_now_is_a_reason(whys: list[Why]) -> None:
    several = Which(Vehicles((1, 2)), blocks(tense="present"))
    assert asked_why(several, whys) == Why(Not(Happens(GO)))
    ride = Which(Vehicles((1, 2)), Happens(Event("wait", US, Wanted(), time=WholeRide())))
    assert asked_why(ride, whys) == Why(Happens(Event("wait", time=WholeRide())))
    assert of(Which(ONE, blocks())) is None


# --- causes -------------------------------------------------------------------------------------


def test_causes_are_reasons(whys: list[Why], monkeypatch: pytest.MonkeyPatch) -> None:
    caused = Caused(ONE, Happens(STOP))
    assert asked_why(Whether(caused), whys) == Why(caused)
    assert asked_why(Whether(Not(caused)), whys) == Why(Not(caused))
    wanted = Caused(Wanted(), Happens(STOP))
    assert asked_why(Which(Wanted(), wanted), whys) == Why(wanted)
    safe = Is("safe", event=STOP)
    assert asked_why(HowKnow(safe), whys) == Why(safe)
    assert asked_why(HowKnow(Is("possible", event=STOP)), whys).of == Is("possible", event=STOP)
    for other in (Is("safe", event=Event("stop", ONE)), Is("safe"), Is("fast", event=STOP)):
        assert of(HowKnow(other)) is knowing.how_know
    asked: list[Any] = []
    monkeypatch.setattr(choices, "why", told_to(asked))
    for kind in ("causes", "reasons"):
        question = Listing(kind)
        assert of(question)(question, scene()) == Measures(())
    assert asked == [None, None]


# --- yes or no ----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("that", "explainer"),
    [
        (Happens(Event("stop", modal="could")), possible.could),
        (Happens(Event("stop", modal="must")), possible.must),
        (Happens(Event("turn", tense="present", modal="must")), None),  # our way tells
        (Happens(Event("exit-left", tense="present", modal="must")), None),
        (Happens(Event("exit-right", tense="present", modal="must")), None),
        (Happens(Event("exit-straight", tense="present", modal="must")), None),
        (Happens(Event("turn", object=ONE, tense="present", modal="must")), possible.must),
        (Happens(Event("turn", modal="must")), possible.must),
        (Happens(Event("stop", tense="present", modal="must")), possible.must),
        (Is("necessary", event=STOP), deciding.needed),
        (Is("worth-it"), deciding.needed),
        (Is("better", event=STOP), deciding.needed),
        (Is("necessary", event=Event("stop", ONE)), None),
        (Is("better", ONE), None),
        (Is("safe", event=STOP), None),
    ],
)
def test_whether_something_could_had_to_or_was_needed(that: Any, explainer: Any) -> None:
    assert of(Whether(that)) is explainer


def test_what_was_worth_it_of_another_is_what_we_did(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[Any] = []
    monkeypatch.setattr(deciding, "needed", told_to(asked))
    question = Whether(Is("worth-it", event=Event("stop", ONE), tense="perfect"))
    of(question)(question, scene())
    assert asked == [Whether(Is("worth-it", tense="perfect"))]


@pytest.mark.parametrize("action", ["brake", "slow-down", "stop"])
def test_slowing_down_for_somebody_is_a_reason_where_we_did(
    whys: list[Why], action: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    question = Whether(Happens(Event(action, US, ONE, time=At(3.0))))
    found = asked_why(question, whys)
    assert found == Why(Happens(Event(action, time=At(3.0))), suspect=ONE)
    for other in (
        Not(question.that),
        Happens(Event(action, ONE, TWO)),
        Happens(Event(action)),
        Happens(Event("overtake", US, ONE)),
        Is("slow"),
    ):
        assert of(Whether(other)) is None

    def refused(result: Any) -> Any:
        def why(_: Any, __: Any) -> Any:
            raise Unanswered(result)

        return why

    monkeypatch.setattr(reasons, "why", refused(DidNotHappen(STOP)))
    assert of(question) is None
    monkeypatch.setattr(reasons, "why", refused(NeedRollout(trace_id="x")))
    assert of(question) is not None
