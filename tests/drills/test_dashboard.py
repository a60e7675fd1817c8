"""Service, car and hub are killed under a dashboard; it is told to end while browsers look on."""

import os
import signal
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.drills.page import NOTE, Page, healthy, show
from tests.drills.processes import ENDED, Crew, Process, free_endpoint, until
from tests.drills.stage import WHERE, staged

FAST = "How fast are we going?"
SLOW = "0.3"  # simulated seconds per second, so that the ride lasts
LEAVING = 1001  # RFC 6455, 7.4.1: going away


@pytest.fixture
def dashboards(crew: Crew) -> Iterator[list[Process]]:
    """Those that are shown; in the end they have said nothing but notes."""
    shown: list[Process] = []
    yield shown
    for one in shown:
        if one.popen.poll() is None:
            assert one.end() == 0, one.said
        assert all(line.startswith(NOTE) for line in one.said.splitlines()), one.said


def test_service_and_hub_are_killed_and_the_conversation_goes_on(
    crew: Crew, tmp_path: Path, dashboards: list[Process]
) -> None:
    serve = ("--store", str(tmp_path / "dialogue.sqlite3"))
    with staged(crew, serve=serve) as stage:
        dashboards.append(show(crew, "--connect", stage.endpoint, "--session", "ada"))
        page = Page(dashboards[0])
        assert page.sees()
        first = page.ask(WHERE)
        assert (first["n"], first["kind"]) == (0, "answer")
        known = set(page.decisions)
        assert known
        stage.service.kill()
        assert page.sees(hub="gone", car="gone", service="gone"), page.status
        nobody = page.ask(WHERE)
        assert (nobody["n"], nobody["reason"]) == (None, "planner-unavailable")
        assert healthy(dashboards[0])
        crew.serve(stage.endpoint, *serve)
        assert page.sees(), page.status
        second = page.ask(FAST)
        assert (second["n"], second["kind"]) == (1, "answer")
        assert page.turns[0]["text"] == WHERE
        assert (page.resets, page.closed, len(page.rides)) == (1, None, 1)
        assert page.decisions == known
        late = Page(dashboards[0])
        assert until(lambda: set(late.turns) == {0, 1})
        assert until(lambda: late.decisions == known)


def test_a_car_is_killed_and_another_one_comes(crew: Crew, dashboards: list[Process]) -> None:
    with staged(crew) as stage:
        dashboards.append(show(crew, "--connect", stage.endpoint, "--session", "ada"))
        page = Page(dashboards[0])
        assert page.sees()
        assert until(lambda: len(page.rides) == 1)
        stage.car.kill()
        assert page.sees(car="gone"), page.status
        assert page.ask(WHERE)["kind"] == "answer"  # from the record
        other = crew.drive(stage.endpoint, "--scenario", "s2", "--control")
        assert until(lambda: len(page.rides) == 2), other.said
        assert page.sees(), page.status
        other.order("until 3.0")
        assert until(lambda: page.now >= 3.0)
        again = page.ask(WHERE)
        assert (again["n"], again["kind"]) == (1, "answer")
        assert (page.resets, page.closed) == (1, None)


def test_a_dashboard_is_there_before_its_hub(crew: Crew, dashboards: list[Process]) -> None:
    endpoint = free_endpoint()
    dashboards.append(show(crew, "--connect", endpoint))
    page = Page(dashboards[0])
    assert page.sees(hub="awaited", car="awaited", service="awaited"), page.status
    assert page.ask(WHERE)["reason"] == "planner-unavailable"
    crew.serve(endpoint, "--keep-days", "0")
    assert page.sees(car="awaited"), page.status
    car = crew.drive(endpoint, "--scenario", "s1", "--control")
    assert page.sees(), page.status
    car.order("until 2.0")
    assert until(lambda: page.now >= 2.0)
    assert page.ask(WHERE)["kind"] == "answer"
    assert page.closed is None


@pytest.mark.parametrize("killed", ["serve", "drive"])
def test_a_ride_of_ones_own_goes_on(crew: Crew, dashboards: list[Process], killed: str) -> None:
    dashboards.append(show(crew, "--scenario", "s1", "--speed", SLOW, "--session", "ada"))
    page = Page(dashboards[0])
    assert page.sees(), dashboards[0].said
    assert until(lambda: page.now >= 1.0)
    assert page.ask(WHERE)["kind"] == "answer"
    reached, rides = page.now, len(page.rides)
    [victim] = crew.pids(f"xavi_dialogue {killed}")
    os.kill(victim, signal.SIGKILL)
    gone = {"serve": "service", "drive": "car"}[killed]
    assert until(lambda: gone in page.lost), page.status
    assert page.sees(), page.status
    assert until(lambda: page.now > reached + 0.5)
    if killed == "drive":
        assert len(page.rides) == rides + 1
        assert dashboards[0].says("started again; the ride goes on")
    second = page.ask(FAST)
    assert (second["n"], second["kind"]) == (1, "answer")
    assert page.turns[0]["text"] == WHERE
    assert page.closed is None


@pytest.mark.parametrize(
    ("own", "number"), [(True, signal.SIGTERM), (True, signal.SIGINT), (False, signal.SIGTERM)]
)
def test_it_ends_with_all_its_browsers(
    crew: Crew, dashboards: list[Process], own: bool, number: signal.Signals
) -> None:
    if own:
        dashboards.append(show(crew, "--scenario", "s1", "--speed", SLOW))
    else:
        endpoint = free_endpoint()
        crew.serve(endpoint, "--keep-days", "0")
        dashboards.append(show(crew, "--connect", endpoint))
    pages = [Page(dashboards[0]) for _ in range(4)]
    assert pages[0].sees() if own else pages[0].sees(car="awaited")
    assert until(lambda: all(page.status for page in pages))
    pages[1].ask(WHERE)
    assert dashboards[0].end(number) == 0, dashboards[0].said
    assert until(lambda: all(page.closed == LEAVING for page in pages))
    if own:
        assert until(lambda: not crew.there(), ENDED), crew.there()
