"""What is loaded is spared from collections while a ride goes on."""

import gc
from collections.abc import Callable, Iterator

import pytest

from xavi_dialogue.process import garbage
from xavi_dialogue.process.garbage import QUIET, REVISED_EVERY, YOUNG, Sweeper, settled


@pytest.fixture(autouse=True)
def as_in_a_ride(unfreeze: Callable[[], None]) -> Iterator[None]:
    """Nothing is excluded from collections beforehand, and all can be included again."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(gc, "unfreeze", unfreeze)
        unfreeze()
        yield
    gc.freeze()


def test_what_is_loaded_is_spared_until_the_ride_is_over() -> None:
    with settled():
        assert gc.get_freeze_count() > 1000
    assert gc.get_freeze_count() == 0


def test_it_is_gone_through_again_after_a_failure() -> None:
    with pytest.raises(ValueError), settled():
        raise ValueError
    assert gc.get_freeze_count() == 0


def test_what_is_new_is_collected_once_and_then_spared(monkeypatch: pytest.MonkeyPatch) -> None:
    now = 100.0
    monkeypatch.setattr(garbage.time, "monotonic", lambda: now)
    done: list[str] = []
    counts = (YOUNG + 1, 0, 0)
    for name in ("collect", "freeze", "unfreeze"):
        monkeypatch.setattr(garbage.gc, name, lambda name=name: done.append(name))
    monkeypatch.setattr(garbage.gc, "get_count", lambda: counts)
    sweeper = Sweeper()
    sweeper.sweep()
    sweeper.sweep()  # too early for another
    assert done == ["collect", "freeze"]
    now += 2.0
    sweeper.sweep()
    assert done == ["collect", "freeze"] * 2
    counts = (0, 0, 0)
    now += QUIET - 1.0
    sweeper.sweep()
    assert len(done) == 4
    now += REVISED_EVERY
    sweeper.sweep()
    sweeper.sweep()
    assert done[4:] == ["unfreeze", "collect", "freeze"]
