"""What is said of a traffic light agrees with the programme that SUMO runs: a slow test."""

import xml.etree.ElementTree as ET
from dataclasses import dataclass
from pathlib import Path

import pytest

from sim.setup.scenario import load
from tests.sim.crossroads import signalled
from xavi_dialogue.domain.traffic_lights import COLOURS, LightPassed, LightTold, Shown
from xavi_dialogue.service.in_process import Conversation, make_pipeline, planner_for
from xavi_dialogue.vehicle.episode import Moment, clock, network_of, start

pytestmark = pytest.mark.slow
SLACK = 0.25  # [s] by which what was seen may lag behind


@dataclass(frozen=True)
class Programme:
    """The phases of a controller, as the network file has them."""

    phases: tuple[tuple[float, str], ...]  # duration [s] and letters

    def shows(self, time: float, place: int) -> str:
        """The letter of a place at a time [s]."""
        left = time % sum(lasting for lasting, _ in self.phases)
        for lasting, letters in self.phases:
            if left < lasting:
                return letters[place]
            left -= lasting
        return self.phases[-1][1][place]


@pytest.fixture(scope="module")
def ride(tmp_path_factory: pytest.TempPathFactory):
    """A ride that stops at red: its moments, network, and the programme of the light."""
    folder: Path = signalled(tmp_path_factory.mktemp("truth"))
    scenario = load(folder)
    network = network_of(scenario)
    with start(scenario, network) as driving:
        moments = list(driving)
    logic = ET.parse(folder / "cross.net.xml").getroot().find("tlLogic")
    assert logic is not None
    phases = tuple((float(p.get("duration")), p.get("state")) for p in logic.findall("phase"))
    return moments, network, Programme(phases)


def talk(ride, at: float) -> Conversation:
    """A conversation about the ride up to a moment [s]."""
    moments, network, _ = ride
    found = Conversation(make_pipeline(), planner_for(network))
    for moment in moments:
        if clock(moment) <= at + 1e-6:
            found.record(moment)
    return found


def told(conversation: Conversation, text: str, at: float):
    """The answer to a question as a value, and its words."""
    reply = conversation.ask(text, at)
    turn = next(iter(conversation.dialogue.sessions.values())).turns[-1]
    return turn.parts[-1].result, reply.text


def place_of(moments: list[Moment]) -> int:
    return next(m.trace.road.lights[0].place for m in moments if m.trace and m.trace.road.lights)


@pytest.mark.parametrize("at", [4.0, 12.5, 30.0, 44.5, 45.5])
def test_the_colour_is_the_one_that_sumo_shows(ride, at):
    moments, _, programme = ride
    shown = COLOURS[programme.shows(at, place_of(moments))]
    known = talk(ride, at)
    for colour in ("red", "green", "amber"):
        result, text = told(known, f"Is the light {colour}?", at)
        assert isinstance(result, LightTold)
        assert result.holds is (colour == shown)
        assert text.startswith("Yes" if colour == shown else "No")
        assert shown in text


def test_changes_are_told_when_they_came(ride):
    moments, _, programme = ride
    place, at = place_of(moments), 46.5
    result, _ = told(talk(ride, at), "When did the light turn green?", at)
    assert isinstance(result, LightTold)
    assert isinstance(result.shown, Shown)
    begin = result.shown.begin
    assert COLOURS[programme.shows(begin + SLACK, place)] == "green"
    assert COLOURS[programme.shows(begin - SLACK, place)] != "green"


def test_the_line_is_passed_at_what_sumo_shows_then(ride):
    moments, _, programme = ride
    at = clock(moments[-1])
    for text in ("You ran the red light!", "Why did you drive through the red light?"):
        result, words = told(talk(ride, at), text, at)
        assert isinstance(result, LightPassed)
        assert result.crossed is not None
        shown = COLOURS[programme.shows(result.crossed.time, place_of(moments))]
        assert result.crossed.shown.colour == shown == "green"
        assert result.holds is False
        assert "green" in words


def test_the_wait_is_as_long_as_red_held_us(ride):
    moments, _, programme = ride
    place, at = place_of(moments), clock(moments[-1])
    _, words = told(talk(ride, at), "How long did we wait at the light?", at)
    stood = [m for m in moments if m.scene.ego.speed < 0.1 and m.scene.lights]
    red = [m for m in stood if COLOURS[programme.shows(clock(m), place)] == "red"]
    seconds = int(next(word for word in words.split() if word.isdigit()))
    assert seconds == pytest.approx(clock(red[-1]) - clock(red[0]), abs=2.5)


def test_with_green_we_would_have_been_past_it_sooner(ride):
    moments, _, _ = ride
    at = clock(moments[-1])
    result, words = told(talk(ride, at), "What if the light had been green?", at)
    assert result.passing < result.passed
    assert "sooner" in words
    free = 130.0 / 13.89  # [s] for the way to the line
    assert result.passing == pytest.approx(free, abs=3.0)
