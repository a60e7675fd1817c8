"""What follows from a decision alone is worked out once."""

from planner.record.trace import PlanTrace
from tests.explain.facts.scenes import Actor, made, straight
from xavi_dialogue.explain.history.kept import of_decision
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.explain.history.ride import Ride


def decision() -> PlanTrace:
    return made({0: Actor(straight(0.0, 0.0, 10.0))}, 3.0).latest


def test_what_follows_from_a_decision_is_worked_out_once() -> None:
    worked_out: list[str] = []

    def length(name: str) -> int:
        worked_out.append(name)
        return len(name)

    one, other = decision(), decision()
    assert of_decision(one, "a", lambda: length("first")) == 5
    assert of_decision(one, "a", lambda: length("again")) == 5
    assert of_decision(one, "b", lambda: length("two")) == 3
    assert of_decision(other, "a", lambda: length("third")) == 5
    assert worked_out == ["first", "two", "third"]
    assert one == other


def test_rides_share_the_causal_model_of_a_decision() -> None:
    one, other = decision(), decision()
    model = Ride(Record(9.0, (one,))).model(one)
    assert Ride(Record(10.0, (one, other))).model(one) is model
    assert Ride(Record(10.0, (other,))).model(other) is not model
