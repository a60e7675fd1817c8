"""Networks and traffic by number."""

from pathlib import Path

from benchmarks.worlds.generated import FAMILIES, family_of, followers, write
from sim.roads.netfile import read_network
from sim.setup.routes import departures, parse


def test_a_number_makes_the_same_world_and_another_one_another(tmp_path: Path) -> None:
    once, again, other = (write(n, tmp_path / f"{k}") for k, n in enumerate((5, 5, 9)))
    assert once.routes.read_text() == again.routes.read_text()
    assert once.routes.read_text() != other.routes.read_text()
    assert (once.name, other.name) == ("blocks-5", "blocks-9")


def test_every_kind_of_network_has_traffic_that_turns(tmp_path: Path) -> None:
    for number, family in enumerate(FAMILIES):
        assert family_of(number) == family
        scenario = write(number, tmp_path / family)
        network = read_network(scenario.network)
        follow = followers(network)
        routes = [one.edges for one in departures(parse(scenario.routes))]
        assert len(routes) >= 10
        assert all(len(set(way)) == len(way) for way in routes)
        choices = [edge for way in routes for edge in way if len(follow.get(edge, ())) > 1]
        assert choices
