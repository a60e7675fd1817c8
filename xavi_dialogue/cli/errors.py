"""Errors of the command line: messages and exit statuses."""

from dataclasses import dataclass

from planner.driving.driver import DriverError
from planner.errors import TraceError
from sim.roads.netconvert import NetconvertMissing
from sim.setup.scenario import ScenarioError
from sim.sumo import SimulationError
from xavi_dialogue import viewers
from xavi_dialogue.bus.access_control import BadName
from xavi_dialogue.bus.certificates import CertificateError
from xavi_dialogue.bus.interface import BadLink, TransportError
from xavi_dialogue.bus.sanitize import one_line
from xavi_dialogue.chat.remote_backend import NotOnBus
from xavi_dialogue.dashboard.web import MISSING
from xavi_dialogue.library.errors import LibraryError
from xavi_dialogue.process.exit_status import ExitStatus, RunFault, UsageFault

#: The status of each error: the first kind that fits. Packages that may import `process` derive
#: their errors from `UsageFault` and `RunFault`.
_STATUSES: tuple[tuple[tuple[type[Exception], ...], ExitStatus], ...] = (
    (
        (UsageFault, ScenarioError, BadLink, BadName, CertificateError, LibraryError),
        ExitStatus.USAGE,
    ),
    ((NotOnBus,), ExitStatus.PLANNER_UNAVAILABLE),
    ((RunFault, TransportError, SimulationError, DriverError, TraceError), ExitStatus.FAILED),
    ((NetconvertMissing,), ExitStatus.FAILED),
)


@dataclass(frozen=True)
class ReportedError:
    """An error that is reported in one line."""

    message: str
    status: ExitStatus


def failure(error: Exception) -> ReportedError | None:
    """Return how to report an error; None for an internal error, which needs its traceback."""
    if isinstance(error, ImportError) and str(error) in (MISSING, viewers.MISSING):
        return ReportedError(str(error), ExitStatus.FAILED)
    for kinds, status in _STATUSES:
        if isinstance(error, kinds):
            return ReportedError(one_line(str(error)), status)
    return None
