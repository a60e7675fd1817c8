"""Timers: in their order, each once, and not at all where they were cancelled."""

import queue
import threading

from xavi_dialogue.bus.timers import SPENT, Timers

PATIENCE = 30.0  # [s] before a test gives up on what never comes


def test_timers_ring_in_the_order_of_their_times() -> None:
    timers, rung = Timers(), queue.SimpleQueue[str]()
    timers.after(0.2, lambda: rung.put("late"))
    timers.after(0.1, lambda: rung.put("early"))
    timers.after(0.0, lambda: rung.put("now"))
    assert [rung.get(timeout=PATIENCE) for _ in range(3)] == ["now", "early", "late"]


def test_what_is_cancelled_does_not_ring() -> None:
    timers, rung = Timers(), queue.SimpleQueue[str]()
    cancel = timers.after(0.05, lambda: rung.put("cancelled"))
    done = timers.after(0.1, lambda: rung.put("wanted"))
    cancel()
    cancel()
    assert rung.get(timeout=PATIENCE) == "wanted"
    done()  # too late, and harmless
    assert rung.empty()


def test_many_timers_take_one_thread_and_no_room_once_cancelled() -> None:
    timers, before = Timers(), threading.active_count()
    cancels = [timers.after(600.0, lambda: None) for _ in range(3 * SPENT)]
    assert threading.active_count() <= before + 1
    for cancel in cancels:
        cancel()
    assert len(timers._timers) <= SPENT
    rung = threading.Event()
    timers.after(0.0, rung.set)
    assert rung.wait(PATIENCE)
