"""Times that were counted, each with the vehicles whose part began in it."""

from xavi_dialogue.domain.answers import Counted
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego, Event, Vehicle
from xavi_dialogue.nlg.content.observed.occasions import occasions_counted

ONE, TWO = Vehicle(1), Vehicle(2)


def gave_way(begin: float, end: float, whom: Vehicle) -> Episode:
    return Episode(Ego(), "give-way", begin, end, whom)


def whom(*facts: Episode, times: tuple[float, ...]) -> list[list[object]]:
    found = occasions_counted(Counted(Event("give-way"), len(times), facts, times=times))
    assert found is not None
    return [[who.thing for who in row.slots.get("whom", ())] for row in found]


def test_a_vehicle_stands_at_the_time_in_which_its_part_began() -> None:
    early, within, late = gave_way(2.0, 5.0, ONE), gave_way(3.0, 4.0, TWO), gave_way(9.0, 9.5, ONE)
    assert whom(early, within, late, times=(2.0, 9.0)) == [[ONE, TWO], [ONE]]
    assert whom(early, late, times=(2.0, 9.0)) == [[ONE], [ONE]]
    assert whom(early, within, times=(2.0,)) == [[ONE, TWO]]
