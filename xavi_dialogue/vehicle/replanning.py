"""Planning again on request while the car drives: storage of decisions, and checks of requests.

The driving loop only stores its decisions here. Requests arrive on threads of the bus, are
checked, and go to workers (`worker_pool.py`). Each is answered by its deadline.
"""

import contextlib
import logging
import os
import sys
import time
from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Protocol

import msgspec

from planner.counterfactuals.whatif import WhatIfError, replan
from planner.record import trace as plan_trace
from planner.record.trace import PlanTrace, WhatIf
from sim.roads.network import Network
from xavi_dialogue.bus.errors import MessageError
from xavi_dialogue.bus.health import HealthReporter
from xavi_dialogue.bus.interface import Call, TransportError
from xavi_dialogue.bus.messages import Failure, WhatIfRequest, pack, unpack
from xavi_dialogue.process.subprocesses import TOP
from xavi_dialogue.runtime import system
from xavi_dialogue.vehicle.episode import Moment
from xavi_dialogue.vehicle.replan_worker import ReplanOrder
from xavi_dialogue.vehicle.worker_pool import WAITING, Job, WorkerPool

_LOG = logging.getLogger(__name__)
KEPT = 300  # latest decisions that can be planned again: five minutes of driving


class Planners(Protocol):
    """Workers that plan again; see WorkerPool."""

    def submit(self, job: Job) -> None: ...


def workers(network: Path, count: int = 1, waiting: int = WAITING) -> WorkerPool:
    """Start workers for a network file; see WorkerPool."""
    path = os.pathsep.join(filter(None, (str(TOP), os.environ.get("PYTHONPATH"))))
    # -P keeps the working directory off the path: it may hold packages with the same names.
    command = [
        sys.executable,
        "-P",
        "-m",
        "xavi_dialogue.vehicle.replan_worker",
        str(network.resolve()),
    ]
    environment = {**os.environ, "PYTHONPATH": path}
    return WorkerPool(command, environment=environment, count=count, waiting=waiting)


class Replanner:
    """A handler of requests to plan again from the latest decisions of this ride."""

    def __init__(
        self, planners: Planners, kept: int = KEPT, alive: HealthReporter | None = None
    ) -> None:
        """Begin without a decision.

        Args:
            planners: carry out requests.
            kept: number of decisions that are kept.
            alive: counts requests and their results.
        """
        self._planners, self._kept = planners, kept
        self._alive = HealthReporter("car") if alive is None else alive
        self._traces: dict[str, bytes] = {}

    def record(self, moment: Moment) -> None:
        """Store the decision of a moment, and drop the oldest if there are too many."""
        if moment.trace is None:
            return
        self._traces[moment.trace.trace_id] = plan_trace.encode(moment.trace)
        while len(self._traces) > self._kept:
            del self._traces[next(iter(self._traces))]

    def __call__(self, call: Call) -> None:
        """Pass a request on to a worker, or refuse it; returns at once."""
        came = system.monotonic()
        try:
            wanted = unpack(call.payload, WhatIfRequest)
        except MessageError as error:
            self._answer(call, Failure(reason="planner-failed", detail=str(error)))
            return
        trace = self._traces.get(wanted.trace_id)
        if trace is None:
            detail = f"no decision {wanted.trace_id} among the latest {self._kept}"
            self._answer(call, Failure(reason="outside-record", detail=detail))
            return
        what_if = msgspec.convert(msgspec.to_builtins(wanted), WhatIf)
        order = msgspec.json.encode(ReplanOrder(msgspec.Raw(trace), what_if))
        self._planners.submit(
            Job(order, came + wanted.deadline_ms / 1000.0, partial(self._answer, call))
        )
        known = {"request": wanted.request, "trace_id": wanted.trace_id}
        _LOG.info("a what-if was taken up", extra=known)

    def _answer(self, call: Call, outcome: bytes | Failure) -> None:
        reason = outcome.reason if isinstance(outcome, Failure) else "planned"
        self._alive.count("what_ifs")
        self._alive.count(f"what_ifs_{reason.replace('-', '_')}")
        _LOG.info("a what-if was answered", extra={"reason": reason})
        with contextlib.suppress(TransportError):  # the client that asked has disconnected
            if isinstance(outcome, Failure):
                call.refuse(pack(outcome))
            else:
                call.reply(outcome)


def durations(traces: Sequence[PlanTrace], network: Network) -> Mapping[str, tuple[float, ...]]:
    """Measure how long [s] planning again takes in this process, by kind of change."""
    taken: dict[str, list[float]] = {}
    for trace in traces:
        for name, what_if in _examples(trace):
            began = time.perf_counter()
            try:
                replan(trace, network, what_if)
            except WhatIfError:
                continue
            taken.setdefault(name, []).append(time.perf_counter() - began)
    return {name: tuple(values) for name, values in taken.items()}


def _examples(trace: PlanTrace) -> Iterator[tuple[str, WhatIf]]:
    """Yield one change of each kind; those of a vehicle are about the first one predicted."""
    if trace.plan:
        yield "actions forced", WhatIf((trace.plan[0].action,))
    for prediction in trace.predictions[:1]:
        vehicle = prediction.vehicle
        least = min(prediction.goals, key=lambda goal: goal.probability)
        yield "vehicle removed", WhatIf(removed=vehicle)
        yield "goal supposed", WhatIf(vehicle=vehicle, goal=least.edge or least.kind)
        yield "actions supposed", WhatIf(vehicle=vehicle, vehicle_actions=("stop",))
