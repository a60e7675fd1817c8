"""Tracking of a car's present ride, as distinct from earlier rides and those not seen yet."""

from dataclasses import dataclass, field

from xavi_dialogue.bus.messages import SceneReport
from xavi_dialogue.dialogue.state.events import Input
from xavi_dialogue.service.reorder_buffer import ReportOfRide, RideReports

MAX_RIDES = 100  # rides whose names are kept, to recognise their late reports
MAX_COMING = 2000  # inputs kept of a ride without a scene yet


@dataclass
class UnseenRide:
    """Reports of a ride that arrived before its first scene."""

    reports: RideReports
    inputs: list[Input] = field(default_factory=list)


@dataclass
class RideTracker:
    """The rides of one car."""

    reports: RideReports | None = None  # of the present ride
    _names: dict[str, None] = field(default_factory=dict)  # of rides that have begun, in order
    _coming: UnseenRide = field(default_factory=lambda: UnseenRide(RideReports("")))

    def hear(self, report: ReportOfRide) -> tuple[bool, list[Input]]:
        """Record a report; return whether another ride begins, and the inputs for the dialogue.

        A ride's first decision may arrive before its first scene and is kept until then. Late
        reports of an earlier ride, or of an unknown sender, do not end the present ride.
        """
        if self.reports is None:
            first = RideReports(report.ride)
            self._begin(first)
            return True, first.hear(report)
        if self.reports.ride == report.ride:
            return False, self.reports.hear(report)
        if report.ride in self._names:
            return False, []
        if self._coming.reports.ride != report.ride:
            self._coming = UnseenRide(RideReports(report.ride))
        coming = self._coming
        coming.inputs += coming.reports.hear(report)
        del coming.inputs[:-MAX_COMING]
        if not isinstance(report, SceneReport):
            return False, []
        self._begin(coming.reports)
        return True, coming.inputs

    def _begin(self, reports: RideReports) -> None:
        self.reports = reports
        self._names[reports.ride] = None
        if len(self._names) > MAX_RIDES:
            del self._names[next(iter(self._names))]
