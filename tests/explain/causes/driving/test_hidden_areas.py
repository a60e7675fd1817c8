"""What could not be seen as a reason: a ride to a house at a corner."""

import re
from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import takewhile
from pathlib import Path

import pytest

from sim.roads.network import Network
from tests.planner.corner import at_the_corner
from xavi_dialogue.service.in_process import Conversation, make_pipeline, planner_for
from xavi_dialogue.vehicle.episode import Moment, clock, network_of, start

pytestmark = pytest.mark.slow

#: A lorry stands on the other lane of our road, on the left, before the junction.
LORRY = """
    <vType id="lorry" vClass="truck" length="16" width="2.5" height="3.8"/>
    <vehicle id="9" type="lorry" depart="0" departPos="18" departSpeed="0" color="blue">
        <route edges="south_out"/><stop lane="south_out_0" endPos="20" duration="200"/>
    </vehicle>
    <vehicle id="ego" depart="0" departPos="40" departSpeed="12">
        <route edges="south_in north_out"/>
    </vehicle>
"""


LONGEST = 14.0  # [s] that is driven


@dataclass(frozen=True)
class Rides:
    """Rides over the same crossroads, each driven once."""

    made: Callable[[], Path]  # makes a folder
    driven: dict[tuple[bool, str], tuple[Network, tuple[Moment, ...]]] = field(default_factory=dict)

    def told(self, at: float, text: str, *, house: bool = True, routes: str = "") -> str:
        """Ask at a moment [s] of a ride."""
        if (house, routes) not in self.driven:
            scenario = at_the_corner(self.made(), house=house, routes=routes)
            network = network_of(scenario)
            with start(scenario, network) as ride:
                seen = takewhile(lambda moment: clock(moment) <= LONGEST + 1e-6, ride)
                self.driven[house, routes] = network, tuple(seen)
        network, moments = self.driven[house, routes]
        passenger = Conversation(make_pipeline(), planner_for(network))
        for moment in moments:
            if clock(moment) <= at + 1e-6:
                passenger.record(moment)
        return passenger.ask(text, at).text


@pytest.fixture(scope="module")
def rides(tmp_path_factory: pytest.TempPathFactory) -> Rides:
    return Rides(lambda: tmp_path_factory.mktemp("corner"))


def test_the_car_says_what_it_cannot_see_past(rides: Rides) -> None:
    said = rides.told(9.0, "Why are you slowing down?")
    assert "cannot see past the building on the left" in said
    assert "right of way could come from there" in said


def test_afterwards_it_says_so_in_the_past(rides: Rides) -> None:
    said = rides.told(14.0, "Why did you slow down?")
    assert "could not see past the building on the left" in said
    assert "could have come from there" in said


def test_in_an_open_field_it_says_nothing_of_that(rides: Rides) -> None:
    assert "see past" not in rides.told(9.0, "Why did you slow down?", house=False)


@pytest.mark.parametrize(
    "text", ["What could be behind that building?", "Is there anybody behind the building?"]
)
def test_what_is_behind_a_building_is_not_known(rides: Rides, text: str) -> None:
    said = rides.told(9.0, text)
    assert said.startswith("I cannot see what is behind the building")
    assert "obody" not in said
    assert ", so somebody may be there" in said


def test_being_there_and_coming_from_there_have_the_same_chance(rides: Rides) -> None:
    there = rides.told(9.0, "Is there anybody behind the building?")
    comes = rides.told(9.0, "Could somebody come from behind the building?")
    assert comes.startswith("Somebody could come from there")
    chances = [re.findall(r"at (\d+ %)\.$", one) for one in (there, comes)]
    assert len(chances[0]) == 1
    assert chances[0] == chances[1]


def test_the_lorry_that_hides_the_road_is_named(rides: Rides) -> None:
    said = rides.told(10.0, "Why did you slow down?", house=False, routes=LORRY)
    assert "could not see past the blue lorry" in said
    said = rides.told(8.5, "What could be behind that lorry?", house=False, routes=LORRY)
    assert said.startswith("I cannot see what is behind the blue lorry")
    assert re.search(r", so somebody may be there: I put the chance at \d+ %\.$", said)


def test_seeing_past_it_would_have_saved_time(rides: Rides) -> None:
    said = rides.told(14.0, "What if you had been able to see past the building?")
    assert said.startswith("With a clear view past the building on the left, and nobody there")
    assert "would have saved about" in said


@pytest.mark.parametrize(
    "text", ["Can you see past that building?", "What can you not see?", "Is there a blind corner?"]
)
def test_what_hides_the_road_is_told_with_its_side(rides: Rides, text: str) -> None:
    said = rides.told(9.0, text)
    assert said.startswith("I cannot see past the building on the left")
    assert "cannot" not in rides.told(9.0, "What can you not see?", house=False)
