"""A ride of four decisions: we go on, change lanes to the left, and go on again."""

from typing import Any

from msgspec.structs import replace

from planner.record.events import Event as RideEvent
from tests.explain.answers.stated import decision, driven, look, place, roads, scene
from tests.traces import End
from xavi_dialogue.explain.answers.reference.asked import Asked

STAY: Any = ("continue",)
LEFT: Any = ("change-left", "continue")
RIGHT: Any = ("change-right", "continue")
STOP: Any = ("stop", "continue")
TURN: Any = ("exit-right",)


def deeds(*done: tuple[str, float, float, float | None]) -> list[RideEvent]:
    """Events of what was carried out: name, start, when for good, end."""
    found: list[RideEvent] = []
    for name, start, firm, end in done:
        found.append(RideEvent("action-started", start, name, int(start)))  # type: ignore[arg-type]
        if name != "continue":
            found.append(RideEvent("action-committed", firm, name, int(start)))  # type: ignore[arg-type]
        if end is not None:
            found.append(RideEvent("action-ended", end, name, int(start)))  # type: ignore[arg-type]
    return found


#: On 10 s each; what else there was takes longer.
TRACES = [
    decision(2.0, STAY, ends={LEFT: End(time=14.0), STOP: End(time=20.0)}),
    decision(6.0, LEFT, ends={STAY: End(time=15.0), STOP: End(time=20.0)}),
    decision(7.0, LEFT, under_way="change-left"),
    decision(12.0, STAY, ends={LEFT: End(time=11.0), RIGHT: End(time=12.0), STOP: End(time=20.0)}),
]
EVENTS = deeds(("continue", 0.0, 0.0, 6.0), ("change-left", 6.0, 6.5, 9.0),
               ("continue", 9.0, 9.0, None))  # fmt: skip


def chosen(span: Any = None, **facts: Any) -> Asked:
    """The setting of a question about this ride, which goes on until 20 s."""
    given: dict[str, Any] = {"traces": TRACES, "events": EVENTS}
    return scene(span, **(given | facts))


def beside(lane: int, ahead: float, speed: float = 10.0, **more: Any) -> dict[str, Any]:
    """Somebody in a lane of ours: where he is, and the decisions that know the road."""
    road = roads(places={0: place(lane=0), 1: place(lane=lane)})
    traces = [replace(trace, road=road) for trace in TRACES]
    return {
        "looks": {1: look(1, ahead, 3.5 * lane, speed=speed, **more)},
        "traces": traces,
        "motions": {0: driven([10.0 * k for k in range(21)])},
        "road": road,
    }
