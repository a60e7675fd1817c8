"""Salience: what the discourse update needs of grounding."""

from xavi_dialogue.domain.discourse import Discourse, GroundedAct, Span
from xavi_dialogue.domain.meaning import Ask, Why
from xavi_dialogue.domain.terms import Event, Happens, Vehicle, Vehicles
from xavi_dialogue.nlu.grounding import salience

OVERTAKING = Ask(Why(Happens(Event("overtake", Vehicle(2), object=Vehicle(5)))))


def test_an_actor_is_more_salient_than_an_object() -> None:
    found = salience.renewed((), salience.mentions_of(OVERTAKING, 1))
    assert [m.thing for m in found] == [Vehicle(2), Vehicle(5)]
    assert [m.role for m in found] == ["subject", "object"]


def test_mentions_fade_and_go() -> None:
    found = salience.mentions_of(OVERTAKING, 1)
    once = salience.decayed(found)
    assert all(a.salience < b.salience for a, b in zip(once, salience.ordered(found), strict=True))
    for _ in range(10):
        found = salience.decayed(found)
    assert found == ()


def test_what_is_said_again_is_salient_again() -> None:
    faded = salience.decayed(salience.mentions_of(OVERTAKING, 1))
    found = salience.renewed(faded, (salience.mention(Vehicle(5), 2, "subject", by_car=True),))
    assert found[0].thing == Vehicle(5)
    assert len(found) == 2


def test_those_of_a_group_are_less_salient_than_one_alone() -> None:
    group = salience.mention(Vehicles((1, 2)), 1, "subject")
    alone = salience.mention(Vehicle(3), 1, "subject")
    assert salience.vehicles_of((group, alone))[0][0] == 3
    assert salience.group((group, alone)) == (1, 2)


def test_an_act_leads_on_to_the_next_in_its_turn() -> None:
    done = GroundedAct(OVERTAKING, Span(begin=3.0, end=5.0))
    found = salience.after(Discourse(turn=1), done)
    assert found.question == OVERTAKING.question
    assert found.episode == (3.0, 5.0)
    assert found.mentions[0].thing == Vehicle(2)
