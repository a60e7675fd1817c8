"""Who held us up on the way, and for whom we slowed down."""

from typing import Any

import pytest

from tests.explain.answers.stated import US, did, look, scene, they
from xavi_dialogue.domain.terms import Event, Vehicle
from xavi_dialogue.explain.answers.reference.moments import Window
from xavi_dialogue.explain.answers.ride.delays import for_whom, held_up

ONE, TWO = Vehicle(1), Vehicle(2)
LOOKS = {1: look(1), 2: look(2)}
ALL = Window(0.0, 20.0)
SLOW = {("speed", 1): 8.0, ("speed", 2): 13.0, ("limit", 0): 13.9}


def delayed(*told: Any, about: Window = ALL, **more: Any) -> Any:
    return held_up(scene(**({"looks": LOOKS, "episodes": told, "values": SLOW} | more)), about)


def test_whom_we_let_go_first_held_us_up() -> None:
    gave, waited = did("give-way", 2.0, 5.0, object=ONE), did("wait", 8.0, 10.0, object=TWO)
    found = delayed(gave, waited)
    assert (found.episodes, found.asked, found.form) == (
        (gave, waited), Event("block", object=US), "list",
    )  # fmt: skip
    assert [(one.vehicle, one.time) for one in found.looks] == [(1, 20.0), (2, 20.0)]
    assert (found.since, found.until, found.actor) == (0.0, 20.0, None)
    found = delayed(gave, waited, about=Window(6.0, 12.0))
    assert (found.episodes, [one.time for one in found.looks]) == ((waited,), [12.0])
    let = did("let-go", 2.0, 5.0, object=ONE)
    assert delayed(let).episodes == (let,)


def test_what_is_for_nobody_or_of_others_did_not() -> None:
    found = delayed(
        did("give-way", 2.0, 5.0), did("overtake", 6.0, 9.0, object=ONE),
        they(1, "give-way", 6.0, 9.0, object=US), did("brake", 10.0, 12.0, object=ONE),
    )  # fmt: skip
    assert (found.episodes, found.looks) == ((), ())


@pytest.mark.parametrize(
    ("follow", "holds"),
    [
        (did("follow", 2.0, 5.0, object=ONE), True),
        (did("follow", 2.0, 4.9, object=ONE), False),
        (did("follow", 17.0, object=ONE), True),
        (did("follow", 2.0, 9.0, object=TWO), False),  # 13 m/s are more than 9/10 of the limit
    ],
)
def test_who_drove_slowly_ahead_held_us_up(follow: Any, holds: bool) -> None:
    assert delayed(follow).episodes == ((follow,) if holds else ())


def test_how_slow_that_is() -> None:
    follow = did("follow", 2.0, 9.0, object=ONE)
    for speed, holds in ((8.9, True), (9.1, False), (None, False)):
        values = {("speed", 1): speed, ("limit", 0): 10.0}
        assert bool(delayed(follow, values=values).episodes) is holds
    assert delayed(follow, values={("speed", 1): 8.0}).episodes == ()
    middle = {("speed", 1): lambda t: 5.0 if t == 5.5 else 20.0, ("limit", 0): 10.0}
    assert delayed(follow, values=middle).episodes == (follow,)
    going = did("follow", 12.0, object=ONE)
    middle = {("speed", 1): lambda t: 5.0 if t == 16.0 else 20.0, ("limit", 0): 10.0}
    assert delayed(going, values=middle).episodes == (going,)


def test_what_runs_on_for_one_is_told_once() -> None:
    gave, waited = did("give-way", 2.0, 5.0, object=ONE), did("wait", 2.0, 4.0, object=ONE)
    again = did("wait", 5.0, 6.0, object=ONE)
    later = did("wait", 5.1, 6.0, object=ONE)
    assert delayed(waited, gave).episodes == (gave,)
    assert delayed(gave, again).episodes == (gave,)
    assert delayed(gave, later).episodes == (gave, later)
    other = did("wait", 3.0, 4.0, object=TWO)
    assert delayed(gave, other).episodes == (gave, other)
    going = did("give-way", 12.0, object=ONE)
    assert delayed(going, did("wait", 18.0, object=ONE)).episodes == (going,)


# --- for whom we slowed down --------------------------------------------------------------------

SPEEDS = {("speed", 0): 12.0}


def named(episode: Any, *around: Any, ahead: Any = None, **more: Any) -> Any:
    looks = {1: ahead or look(1, 30.0, speed=10.0), 2: look(2)}
    asked = scene(looks=looks, episodes=(episode, *around), **({"values": SPEEDS} | more))
    return for_whom(asked, episode).object


def test_whom_we_let_go_first_is_named() -> None:
    for action in ("brake", "slow-down", "stop"):
        slowed = did(action, 4.0, 6.0)
        assert named(slowed, did("give-way", 5.0, 9.0, object=TWO)) == TWO
    assert named(slowed, did("give-way", 6.5, 9.0, object=TWO)) is None
    assert named(slowed, did("give-way", 5.0, 9.0)) is None
    assert named(slowed, did("follow", 3.0, 9.0, object=ONE), did("wait", 5.0, object=TWO)) == TWO
    going = did("brake", 18.0)
    assert named(going, did("give-way", 19.5, object=TWO)) == TWO


def test_what_is_no_slowing_of_ours_stays_as_it_is() -> None:
    gave = did("give-way", 5.0, 9.0, object=TWO)
    assert named(did("overtake", 4.0, 6.0), gave) is None
    assert named(did("brake", 4.0, 6.0, object=ONE), gave) == ONE
    assert named(they(1, "brake", 4.0, 6.0), gave) is None


@pytest.mark.parametrize(
    ("ahead", "closes"),
    [
        (look(1, 30.0, speed=10.9), True),
        (look(1, 30.0, speed=11.1), False),
        (look(1, 50.0, speed=5.0), True),
        (look(1, 50.1, speed=5.0), False),
        (look(1, -1.0, speed=5.0), False),
        (look(1, 0.0, speed=5.0), False),
    ],
)
def test_somebody_slower_ahead_is_named(ahead: Any, closes: bool) -> None:
    follow = did("follow", 3.0, 9.0, object=ONE)
    assert named(did("brake", 4.0, 6.0), follow, ahead=ahead) == (ONE if closes else None)


def test_it_is_weighed_when_we_began_to_slow_down() -> None:
    follow = did("follow", 3.0, 9.0, object=ONE)
    braked = did("brake", 4.0, 6.0)
    speeds = {("speed", 0): lambda t: 12.0 if t == 4.0 else 5.0}
    assert named(braked, follow, values=speeds) == ONE
    assert named(braked, follow, values={}) is None
    unseen = lambda t: None  # noqa: E731
    assert named(braked, follow, ahead=unseen) is None
    assert named(braked, did("follow", 3.0, 9.0)) is None
    assert named(braked, did("overtake", 3.0, 9.0, object=ONE)) is None
