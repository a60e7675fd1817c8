"""Errors of the command line: messages and exit statuses."""

from dataclasses import dataclass

from planner.driving.driver import DriverError
from planner.record.trace import TraceError
from sim.roads.netconvert import NetconvertMissing
from sim.setup.scenario import ScenarioError
from sim.sumo import SimulationError
from xavi_dialogue.bus.access_control import BadName
from xavi_dialogue.bus.certificates import CertificateError
from xavi_dialogue.bus.interface import BadLink, BusError
from xavi_dialogue.bus.sanitize import one_line
from xavi_dialogue.chat.client import ServiceLost
from xavi_dialogue.chat.remote_backend import NotOnBus
from xavi_dialogue.cli.parse import ParseUsageError
from xavi_dialogue.cli.session_admin import SessionUsageError
from xavi_dialogue.dashboard.web import MISSING
from xavi_dialogue.dashboard.web.address import ListenError
from xavi_dialogue.inspection.search_tree import TreeError
from xavi_dialogue.inspection.trace_files import TraceFileError
from xavi_dialogue.process.config import SettingsError
from xavi_dialogue.process.exit_status import ExitStatus, RunFault, UsageFault
from xavi_dialogue.process.subprocesses import ChildFailed
from xavi_dialogue.security.client_token import IdentityError
from xavi_dialogue.security.provisioning import BadEndpoint, KeysError, KeysExist, NotOnlyKeys
from xavi_dialogue.storage.database import StoreError
from xavi_dialogue.storage.recording_format import (
    FileThere,
    NotARecording,
    NothingToPlay,
    RecordingError,
    TooMuch,
)
from xavi_dialogue.storage.ride_file import RideFileError
from xavi_dialogue.transcripts.transcript import TranscriptError

_STATUSES: tuple[tuple[tuple[type[Exception], ...], ExitStatus], ...] = (
    (
        (
            *(ScenarioError, ParseUsageError, TranscriptError, TraceFileError, RideFileError),
            *(TreeError, UsageFault, SessionUsageError, SettingsError, BadLink),
            *(KeysExist, NotOnlyKeys, BadEndpoint, BadName, CertificateError),
            *(FileThere, NotARecording, NothingToPlay, TooMuch, ListenError),
        ),
        ExitStatus.USAGE,
    ),
    (
        (
            *(SimulationError, DriverError, TraceError, BusError, ChildFailed, ServiceLost),
            *(RunFault, StoreError, KeysError, IdentityError, RecordingError),
            NetconvertMissing,
        ),
        ExitStatus.FAILED,
    ),
    ((NotOnBus,), ExitStatus.PLANNER_UNAVAILABLE),
)


@dataclass(frozen=True)
class ReportedError:
    """An error that is reported in one line."""

    message: str
    status: ExitStatus


def failure(error: Exception) -> ReportedError | None:
    """Return how to report an error; None for an internal error, which needs its traceback."""
    if isinstance(error, ImportError) and str(error) == MISSING:
        return ReportedError(MISSING, ExitStatus.FAILED)
    for kinds, status in _STATUSES:
        if isinstance(error, kinds):
            return ReportedError(one_line(str(error)), status)
    return None
