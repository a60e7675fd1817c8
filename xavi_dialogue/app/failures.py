"""What can go wrong, by whose fault: messages and exit statuses of the command line."""

from dataclasses import dataclass

from planner.driver import DriverError
from planner.trace import TraceError
from sim.netconvert import NetconvertMissing
from sim.scenario import ScenarioError
from sim.sumo import SimulationError
from xavi_dialogue.app.bench.browser import NoBrowser
from xavi_dialogue.app.bench.errors import FaultFound, ForeignUnusable, QuestionFileError
from xavi_dialogue.app.children import ChildFailed
from xavi_dialogue.app.client import ServiceLost
from xavi_dialogue.app.debug.files import TraceFileError
from xavi_dialogue.app.debug.tree import TreeError
from xavi_dialogue.app.exit_status import ExitStatus
from xavi_dialogue.app.identity import IdentityError
from xavi_dialogue.app.keys import BadEndpoint, KeysError, KeysExist, NotOnlyKeys
from xavi_dialogue.app.parsing import ParseUsageError
from xavi_dialogue.app.remote import Missing
from xavi_dialogue.app.sessions import SessionUsageError
from xavi_dialogue.app.settings import SettingsError
from xavi_dialogue.transports.bus import BadLink, BusError
from xavi_dialogue.transports.certificates import CertificateError
from xavi_dialogue.transports.database import StoreError
from xavi_dialogue.transports.recording import (
    FileThere,
    NotARecording,
    NothingToPlay,
    RecordingError,
    TooMuch,
)
from xavi_dialogue.transports.ride_file import RideFileError
from xavi_dialogue.transports.roles import BadName
from xavi_dialogue.transports.text import one_line
from xavi_dialogue.transports.transcript import TranscriptError
from xavi_dialogue.transports.web import MISSING
from xavi_dialogue.transports.web.listen import ListenError

_STATUSES: tuple[tuple[tuple[type[Exception], ...], ExitStatus], ...] = (
    (
        (
            *(ScenarioError, ParseUsageError, TranscriptError, TraceFileError, RideFileError),
            *(TreeError, QuestionFileError, SessionUsageError, SettingsError, BadLink),
            *(KeysExist, NotOnlyKeys, BadEndpoint, BadName, CertificateError),
            *(FileThere, NotARecording, NothingToPlay, TooMuch, ListenError, ForeignUnusable),
        ),
        ExitStatus.USAGE,
    ),
    (
        (
            *(SimulationError, DriverError, TraceError, BusError, ChildFailed, ServiceLost),
            *(FaultFound, NoBrowser, StoreError, KeysError, IdentityError, RecordingError),
            NetconvertMissing,
        ),
        ExitStatus.FAILED,
    ),
    ((Missing,), ExitStatus.PLANNER_UNAVAILABLE),
)


@dataclass(frozen=True)
class Known:
    """An error that is told in one line."""

    message: str
    status: ExitStatus


def failure(error: Exception) -> Known | None:
    """How to tell an error; None for a fault of our own, which deserves its traceback."""
    if isinstance(error, ImportError) and str(error) == MISSING:
        return Known(MISSING, ExitStatus.FAILED)
    for kinds, status in _STATUSES:
        if isinstance(error, kinds):
            return Known(one_line(str(error)), status)
    return None
