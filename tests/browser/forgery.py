"""A car and a service that mean no good: markup wherever the bus lets them put text."""

import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field

import msgspec

from planner.record.events import Event
from planner.record.trace import PlanTrace
from sim.scene import VehicleState
from tests.traces import s1_ride
from xavi_dialogue.bus.health import HealthReporter
from xavi_dialogue.bus.interface import Bus, Call, Keys, TransportError
from xavi_dialogue.bus.messages import (
    AskReply,
    AskRequest,
    HistoryReply,
    PastTurn,
    Reason,
    pack,
    unpack,
)
from xavi_dialogue.dialogue.reply import Reply

MARKUP = (
    "<img class=forged src=x onerror=\"window.__pwned='img'\">",
    "<script class=forged>window.__pwned='script'</script>",
    "\"'><svg class=forged onload=window.__pwned='svg'>",
    "</textarea></section><iframe class=forged srcdoc='<script>parent.__pwned=1</script>'>",
    "javascript:window.__pwned='link'//",
    "{{constructor.constructor('window.__pwned=1')()}} ${window.__pwned=2}",
)
ALL = " ".join(MARKUP)


def traffic() -> dict[int, VehicleState]:
    """Vehicles whose kinds, colours and lights are markup."""
    return {
        k: VehicleState((12.0 * k, 3.2 * (k % 2)), 0.0, 9.0, 0.0, 4.5, 1.8, text, text, (text,))
        for k, text in enumerate(("car", *MARKUP))
    }


def decisions() -> list[PlanTrace]:
    """Decisions of a made-up ride whose places, reasons and identifiers are markup."""
    return [_marked(trace, k) for k, trace in enumerate(s1_ride().traces)]


def _marked(trace: PlanTrace, k: int) -> PlanTrace:
    data = msgspec.to_builtins(trace)
    text = MARKUP[k % len(MARKUP)]
    data["vehicle"] = data["network"] = text
    for vehicle in data["scene"].values():
        vehicle["kind"] = vehicle["colour"] = text
    for prediction in data["predictions"]:
        for goal in prediction["goals"]:
            goal["place"] = goal["edge"] = text
    for refused in data["not_applicable"]:
        refused["reason"] = text
    return msgspec.convert(data, PlanTrace, str_keys=True)


def events() -> tuple[Event, ...]:
    return s1_ride().events


def answer(text: str, kind: str = "answer", reason: Reason | None = None) -> Reply:
    """A reply that is nothing but markup."""
    return Reply(
        text=f"{text} Vehicle 1 {ALL}",
        kind=kind,  # type: ignore[arg-type]
        reason=reason,
        choices=MARKUP if kind == "clarification" else (),
        suggestions=MARKUP,
        trace_id=MARKUP[0],
        sim_time=4.0,
        timing_ms=1.0,
    )


@dataclass
class ForgedService:
    """Answers everything with markup."""

    bus: Bus
    keys: Keys = field(default_factory=Keys)
    turns: list[PastTurn] = field(default_factory=list)

    def open(self) -> None:
        self.turns += [
            PastTurn(f"{text} {n}", answer(f"<b class=forged>{n}</b>"))
            for n, text in enumerate(MARKUP)
        ]
        HealthReporter("service").serve(self.bus, self.keys)
        for name, handle in (("ask", self._ask), ("history", self._history)):
            self.bus.serve(self.keys.of(f"@rpc/{name}"), self._answering(handle))

    def _answering(self, handle: Callable[[Call], None]) -> Callable[[Call], None]:
        def on_call(call: Call) -> None:
            with suppress(TransportError):  # who asked is gone
                handle(call)

        return on_call

    def _ask(self, call: Call) -> None:
        asked = unpack(call.payload, AskRequest)
        kinds = {"clarify": ("clarification", "ambiguous"), "refuse": ("refusal", "out-of-scope")}
        reply = answer("<i class=forged>here</i>", *kinds.get(asked.text, ("answer", None)))  # type: ignore[arg-type]
        self.turns.append(PastTurn(asked.text, reply))
        fields = {name: getattr(reply, name) for name in Reply.__struct_fields__}
        head = {"request": asked.request, "seq": len(self.turns), "wall_time": time.time()}
        call.reply(pack(AskReply(**fields, **head)))

    def _history(self, call: Call) -> None:
        told = HistoryReply(
            session="any",
            seq=len(self.turns),
            sim_time=4.0,
            wall_time=time.time(),
            turns=tuple(self.turns[-100:]),
        )
        call.reply(pack(told))
