"""The ride that a car is on, told from those that are past and those that nobody has seen."""

from dataclasses import dataclass, field

from xavi_dialogue.bus.messages import SceneReport
from xavi_dialogue.dialogue.state.events import Input
from xavi_dialogue.service.reorder_buffer import Heard, Ledger

MAX_RIDES = 100  # whose names are known, so that what is late of them is
MAX_COMING = 2000  # reports of a ride that has not been seen yet


@dataclass
class Coming:
    """What was heard of a ride before it is seen."""

    ledger: Ledger
    inputs: list[Input] = field(default_factory=list)


@dataclass
class Rides:
    """The rides of one car."""

    ledger: Ledger | None = None  # of the present one
    _names: dict[str, None] = field(default_factory=dict)  # of those that were begun, in order
    _coming: Coming = field(default_factory=lambda: Coming(Ledger("")))

    def hear(self, report: Heard) -> tuple[bool, list[Input]]:
        """Take down a report; whether another ride begins, and what there is to tell then.

        A ride's first decision may be heard of before it is seen, and is kept until then. What is
        late of an earlier ride, or comes from who knows whom, ends no record.
        """
        if self.ledger is None:
            first = Ledger(report.ride)
            self._begin(first)
            return True, first.hear(report)
        if self.ledger.ride == report.ride:
            return False, self.ledger.hear(report)
        if report.ride in self._names:
            return False, []
        if self._coming.ledger.ride != report.ride:
            self._coming = Coming(Ledger(report.ride))
        coming = self._coming
        coming.inputs += coming.ledger.hear(report)
        del coming.inputs[:-MAX_COMING]
        if not isinstance(report, SceneReport):
            return False, []
        self._begin(coming.ledger)
        return True, coming.inputs

    def _begin(self, ledger: Ledger) -> None:
        self.ledger = ledger
        self._names[ledger.ride] = None
        if len(self._names) > MAX_RIDES:
            del self._names[next(iter(self._names))]
