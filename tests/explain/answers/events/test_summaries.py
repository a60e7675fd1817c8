"""What is summed up of a ride, a stretch of it, a vehicle or an episode."""

from typing import Any

from planner.record.events import Event as RideEvent
from tests.explain.answers.events.test_accounts import ONE, TWO
from tests.explain.answers.stated import US, did, look, result, scene, they
from xavi_dialogue.domain.answers import (
    DidNotHappen,
    Happenings,
)
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.meaning import Summarise
from xavi_dialogue.domain.terms import (
    Between,
    Event,
    Junction,
    WholeRide,
)
from xavi_dialogue.explain.answers.events.accounts import (
    summarise,
    summary,
    taking_part,
)
from xavi_dialogue.explain.answers.reference.moments import Window

# --- summaries ----------------------------------------------------------------------------------


def summed(about: Any = None, time: Any = None, span: Any = None, **facts: Any) -> Any:
    question = Summarise(about) if time is None else Summarise(about, time)
    return result(summarise, question, scene(span, **facts))


def actions(found: Any) -> list[str]:
    return [e.action for e in found.episodes]


NAMES: tuple[Any, ...] = (
    "enter", "overtake", "change-left", "stop", "exit-left", "pull-out", "wait", "leave",
    "give-way",
)  # fmt: skip
MANY = tuple(did(name, 2.0 * k, 2.0 * k + 1.0) for k, name in enumerate(NAMES, 1))


def test_a_summary_tells_eight_episodes_in_order_and_leaves_the_least_out() -> None:
    found = summed(episodes=MANY)
    assert actions(found) == [episode.action for episode in MANY if episode.action != "enter"]
    assert (found.form, found.actor, found.since, found.until) == ("summary", None, 0.0, 20.0)


def test_a_summary_of_the_ride_has_its_length_way_and_speed() -> None:
    values = {
        ("distance-driven", 0): lambda t: 10.0 * t,
        ("speed", 0): lambda t: 14.0 if t == 7.0 else 9.0,
        ("time-to-go", 0): 33.0,
    }
    found = summed(time=WholeRide(), values=values)
    assert [(m.attribute, m.value) for m in found.measures] == [
        ("duration", 20.0), ("distance-driven", 200.0), ("speed", 14.0), ("time-to-go", 33.0),
    ]  # fmt: skip
    length = found.measures[0]
    assert (length.time, length.until, length.extreme) == (0.0, 20.0, "total")
    assert found.measures[2].time == 7.0
    found = summed(span=Span(3.0, 20.0, said=True), values=values)
    assert (found.measures[0].time, found.measures[0].value) == (3.0, 17.0)


def test_of_a_stretch_or_a_vehicle_the_length_of_the_ride_is_not_told() -> None:
    assert summed(time=Between(2.0, 9.0)).measures == ()
    assert summed(ONE, WholeRide(), looks={1: look(1)}).measures == ()


def test_a_said_span_is_summed_up_alone() -> None:
    found = summed(span=Span(3.5, 8.5, said=True), episodes=MANY)
    assert actions(found) == ["overtake", "change-left", "stop"]
    assert (found.since, found.until) == (3.5, 8.5)
    found = summed(span=Span(10.9, 10.9, said=True), episodes=MANY)  # 2 s to either side
    assert actions(found) == ["stop", "exit-left", "pull-out"]
    assert summed(span=Span(30.0, 30.0, said=True), episodes=MANY).episodes == ()


def test_where_nothing_happened_then_what_happened_last_is_told() -> None:
    told = (did("overtake", 2.0, 3.0), did("change-left", 5.0, 6.0), did("stop", 10.0, 11.0))
    about = Window(16.0, 18.0)
    found = summary(scene(Span(16.0, 18.0), episodes=told), None, about)
    assert actions(found) == ["change-left", "stop"]  # up to 5 s before the last one
    assert (found.since, found.until) == (5.0, 18.0)
    said = summary(scene(Span(16.0, 18.0, said=True), episodes=told), None, about)
    assert said.episodes == ()
    said = summary(scene(episodes=told), None, Window(16.0, 18.0, said=True))
    assert said.episodes == ()
    later = summary(scene(Span(8.0, 8.5), episodes=told), None, Window(7.9, 7.9 + 1.6))
    assert actions(later) == ["overtake", "change-left"]  # nothing of what came after


def test_braking_that_goes_on_is_left_out_of_a_ride_only() -> None:
    told = (did("stop", 4.0, 8.0), did("brake", 18.0, peak=2.0))
    assert actions(summed(episodes=told)) == ["stop"]
    assert actions(summed(span=Span(3.0, 20.0, said=True), episodes=told)) == ["stop"]
    assert actions(summed(span=Span(3.0, 19.0, said=True), episodes=told)) == ["stop", "brake"]
    assert actions(summed(time=Between(3.0, 20.0), episodes=told)) == ["stop", "brake"]
    ended = (did("stop", 4.0, 8.0), did("brake", 16.0, 18.0, peak=2.0))
    assert actions(summed(episodes=ended)) == ["stop", "brake"]


def test_a_vehicle_is_summed_up_by_its_deeds_and_ours_towards_it() -> None:
    told = (
        they(1, "cut-in", 4.0, 6.0, object=US),
        they(1, "speed-up", 7.0, 9.0),
        they(2, "cut-in", 8.0, 9.0, object=US),
        did("overtake", 10.0, 13.0, object=ONE),
        did("give-way", 15.0, 16.0, object=TWO),
    )
    found = summed(ONE, WholeRide(), episodes=told, looks={1: look(1), 2: look(2)})
    assert actions(found) == ["cut-in", "overtake"]
    assert found.actor == ONE
    assert [one.vehicle for one in found.looks] == [1]


def test_a_vehicle_of_which_nothing_matters_is_summed_up_by_all_it_did() -> None:
    told = (they(1, "speed-up", 7.0, 9.0), they(1, "pass", 10.0, 12.0))
    found = summed(ONE, WholeRide(), episodes=told, looks={1: look(1)})
    assert actions(found) == ["pass"]
    found = summed(ONE, WholeRide(), episodes=told[:1], looks={1: look(1)})
    assert actions(found) == ["speed-up"]
    assert summed(ONE, Between(1.0, 5.0), episodes=told, looks={1: look(1)}).episodes == ()


def test_a_vehicle_that_did_nothing_is_shown_all_the_same() -> None:
    found = summed(ONE, WholeRide(), looks={1: look(1), 2: look(2)})
    assert [one.vehicle for one in found.looks] == [1]
    told = (did("overtake", 4.0, 6.0, object=ONE),)
    found = summed(ONE, WholeRide(), episodes=told, looks={1: look(1)})
    assert [(one.vehicle, one.time) for one in found.looks] == [(1, 4.0)]


def test_of_a_vehicle_out_of_view_it_is_told_where_it_went() -> None:
    lost = {1: look(1, in_view=False)}
    turned = (they(1, "exit-left", 5.0, 8.0),)
    found = summed(ONE, looks=lost, episodes=turned)
    assert found.went == turned[0]
    assert isinstance(summed(ONE, WholeRide(), looks=lost, episodes=turned), Happenings)
    assert isinstance(summed(ONE, looks={1: look(1)}, episodes=turned), Happenings)
    at = summed(ONE, span=Span(4.0, 9.0, said=True), looks=lost, episodes=turned)
    assert actions(at) == ["exit-left"]


def test_an_episode_is_summed_up_with_what_was_around_it() -> None:
    told = (did("overtake", 3.0, 4.5), did("stop", 6.0, 8.0), did("leave", 9.5, 9.5),
            did("exit-left", 10.5, 12.0), did("enter", 2.0, 2.0))  # fmt: skip
    found = summed(Event("stop"), episodes=told)
    assert actions(found) == ["overtake", "stop", "leave"]
    assert found.measures == ()
    assert isinstance(summed(Event("change-left"), episodes=told), DidNotHappen)


def test_a_junction_is_summed_up_with_how_we_came_to_it() -> None:
    told = (did("brake", 1.0, 2.0, peak=2.0), did("wait", 4.0, 6.0), did("exit-left", 9.0, 12.0))
    about = Between(9.5, 12.0)
    found = summed(Junction(), about, episodes=told)
    assert actions(found) == ["brake", "wait", "exit-left"]
    assert (found.since, found.until) == (1.0, 12.0)
    far = (did("brake", 1.0, 1.9, peak=2.0), did("wait", 6.0, 7.0), did("exit-left", 9.0, 12.0))
    assert actions(summed(Junction(), about, episodes=far)) == ["wait", "exit-left"]
    assert actions(summed(time=about, episodes=told)) == ["exit-left"]


def test_of_all_that_happened_what_concerns_us_is_told() -> None:
    told = (they(1, "cut-in", 3.0, 4.0, object=US), did("stop", 6.0, 8.0))
    assert actions(summed(episodes=told)) == ["cut-in", "stop"]


def test_those_who_take_part_are_shown_as_they_were_first() -> None:
    told = [did("give-way", 4.0, 6.0, object=TWO), they(1, "cut-in", 8.0, 9.0, object=US),
            they(2, "brake", 9.0, 9.5)]  # fmt: skip
    found = taking_part(scene(looks={1: look(1), 2: look(2), 3: look(3)}), told)
    assert [(one.vehicle, one.time) for one in found] == [(2, 4.0), (1, 8.0)]
    assert taking_part(scene(looks={}), told) == ()


def test_nothing_goes_on_after_the_arrival() -> None:
    told = (did("give-way", 4.0, None, object=ONE), did("arrive", 18.0, 18.0))
    arrived = (RideEvent("arrived", 18.0),)
    found = summed(time=WholeRide(), episodes=told, events=arrived)
    assert [(e.action, e.end) for e in found.episodes] == [("give-way", 18.0), ("arrive", 18.0)]
