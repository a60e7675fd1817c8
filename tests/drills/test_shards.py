"""Four services share forty cars over three routers; one of them is killed, and comes back."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from tests.drills.bus_clients import Answer, Passenger, on_bus
from tests.drills.processes import Crew, Process, free_endpoint, until
from tests.drills.stage import WHERE
from xavi_dialogue.bus.interface import Bus, vehicle_in
from xavi_dialogue.bus.link import Link
from xavi_dialogue.bus.shards import home
from xavi_dialogue.cli.bus_checks import on_the_bus
from xavi_dialogue.cli.host_checks import Finding

SHARDS = (1, 2, 3, 4)
CARS = tuple(f"shuttle-{number}" for number in range(40))
KILLED = 2


@dataclass
class Fleet:
    """Routers, shards and cars that are up."""

    crew: Crew
    folder: Path
    routers: list[str]
    shards: dict[int, Process]
    buses: list[Bus]
    shown: set[str]  # keys under which services show themselves

    def passenger(self, car: str) -> Passenger:
        """Somebody who is joined to another router than the car."""
        bus = self.buses[(CARS.index(car) + 1) % len(self.buses)]
        return Passenger(bus, f"of-{car}", car)

    def ask_all(self, text: str = WHERE) -> dict[str, Answer]:
        """What each car's passenger is answered."""
        begun = {car: self.passenger(car).begin(text) for car in CARS}
        return {car: queue.get(timeout=90.0) for car, queue in begun.items()}

    def start(self, number: int, name: str = "") -> Process:
        store = self.folder / f"shard-{number}{name}.sqlite3"
        return self.crew.xavi(
            *("serve", "--shard", f"{number}/{len(SHARDS)}", "--mode", "client"),
            *("--connect", self.routers[number % len(self.routers)], "--store", str(store)),
        )

    def answered(self) -> set[str | None]:
        """The cars at which a service shows itself."""
        return {vehicle_in(key) for key in tuple(self.shown)} - {"car"}

    def diagnosis(self) -> Finding:
        """What `xavi doctor` finds of the shards."""
        found = {one.check: one for one in on_the_bus(Link.to_hub(self.routers[0]))}
        return found["shards"]


def routed(crew: Crew) -> list[str]:
    """The endpoints of three routers, each linked to those before it."""
    endpoints: list[str] = []
    for _ in range(3):
        endpoint = free_endpoint()
        router = crew.python("-m", "tests.drills.router", endpoint, *endpoints)
        router.hear(1)
        endpoints.append(endpoint)
    return endpoints


@contextmanager
def gathered(crew: Crew, folder: Path) -> Iterator[Fleet]:
    routers = routed(crew)
    with on_bus(routers[0]) as one, on_bus(routers[1]) as two, on_bus(routers[2]) as three:
        fleet = Fleet(crew, folder, routers, {}, [one, two, three], set())

        def see(key: str, alive: bool) -> None:
            (fleet.shown.add if alive else fleet.shown.discard)(key)

        one.watch("xavi/v1/*/alive/service", see)
        fleet.shards = {number: fleet.start(number) for number in SHARDS}
        for process in fleet.shards.values():
            assert process.says("serving through"), process.said
        crew.python("-m", "tests.drills.cars", ",".join(routers), ",".join(CARS)).hear(1)
        assert until(lambda: fleet.answered() == {*CARS})
        yield fleet


def kinds(answers: dict[str, Answer]) -> dict[str, str | None]:
    return {car: answer.kind if answer.reply else answer.reason for car, answer in answers.items()}


def test_a_shard_is_killed_and_comes_back(crew: Crew, tmp_path: Path) -> None:
    theirs = {car for car in CARS if home(car, len(SHARDS)) == KILLED}
    assert 0 < len(theirs) < len(CARS)
    with gathered(crew, tmp_path) as fleet:
        assert set(kinds(fleet.ask_all()).values()) == {"answer"}
        assert fleet.diagnosis().verdict == "ok"
        fleet.shards[KILLED].kill()
        assert until(lambda: fleet.answered() == {*CARS} - theirs)
        told = kinds(fleet.ask_all())
        assert {car for car, kind in told.items() if kind == "NobodyThere"} == theirs
        assert {kind for car, kind in told.items() if car not in theirs} == {"answer"}
        gap = fleet.diagnosis()
        assert gap.verdict == "fault"
        assert f"nobody for {KILLED}/{len(SHARDS)}" in gap.found
        fleet.shards[KILLED] = fleet.start(KILLED)
        assert until(lambda: fleet.answered() == {*CARS})
        assert until(lambda: set(kinds(fleet.ask_all()).values()) == {"answer"})
        assert fleet.diagnosis().verdict == "ok"
        for car in sorted(theirs):  # what was said before is remembered
            assert fleet.passenger(car).history()[0] == WHERE
            assert len(fleet.passenger(car).history()) >= 2


def test_a_second_service_of_a_shard_waits_until_the_first_is_gone(
    crew: Crew, tmp_path: Path
) -> None:
    theirs = sorted(car for car in CARS if home(car, len(SHARDS)) == KILLED)
    with gathered(crew, tmp_path) as fleet:
        second = fleet.start(KILLED, "-standby")
        assert second.says("is silent about the same cars")
        assert set(kinds(fleet.ask_all()).values()) == {"answer"}
        assert "more than once" in fleet.diagnosis().found
        assert fleet.passenger(theirs[0]).history() == (WHERE,)
        fleet.shards[KILLED].kill()
        assert second.says("is gone: this one answers")
        assert until(lambda: set(kinds(fleet.ask_all()).values()) == {"answer"})
        assert fleet.diagnosis().verdict == "ok"
