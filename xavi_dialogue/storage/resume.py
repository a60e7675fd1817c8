"""Resuming of a stored conversation: the search for its ride and the time it had reached."""

from dataclasses import dataclass
from datetime import datetime
from importlib.resources import files
from pathlib import Path

from sim.setup.scenario import Scenario
from sim.setup.scenario import place_of as find_place
from xavi_dialogue.nlg.narration import clock
from xavi_dialogue.storage.conversations import Store
from xavi_dialogue.storage.rows import Summary
from xavi_dialogue.storage.turn_log import Retention

DEFAULT_SCENARIO = "s1"


@dataclass(frozen=True)
class ResumePoint:
    """A conversation, with what was stored of it."""

    session: str
    before: Summary | None = None  # None: it is new

    def place(self, asked: str | None) -> str:
        """Return the scenario to drive: as asked, else as before, else the default."""
        known = None if self.before is None else self.before.scenario
        return asked or known or DEFAULT_SCENARIO

    def seed(self, asked: int | None, place: str) -> int | None:
        """Return the seed: as asked, else as before in the same scenario; None: the scenario's.

        Raises:
            SimError: there is no scenario at this place.
        """
        if asked is not None or self.before is None:
            return asked
        return self.before.seed if self.before.scenario == known_as(find_place(place)) else None

    def moment(self, scenario: Scenario) -> float | None:
        """Return the time [s] of the last question; None if it was about another ride."""
        return self.moment_in(known_as(scenario.place), scenario.seed)

    def moment_in(self, place: str | None, seed: int | None) -> float | None:
        """Return the same of a ride by its place, see `known_as`, and seed."""
        before = self.before
        same = before is not None and (before.scenario, before.seed) == (place, seed)
        return before.sim_time if before is not None and same else None

    def note(self, at: float | None, keeping: Retention | None) -> str:
        """Describe for the passenger how the conversation goes on.

        Args:
            at: see `moment`.
            keeping: the store of turns; None: none.
        """
        if keeping is None:
            return "nothing of this conversation is kept"
        if self.before is None:
            return f"this conversation is {self.session}: --session {self.session} goes on with it"
        turns = f"{self.before.turns} turn{'' if self.before.turns == 1 else 's'}"
        when = "of another ride" if at is None else f"at {clock(at)}"
        return f"going on with {self.session}: {turns}, {when}"


def find(keeping: Retention | None, session: str) -> ResumePoint:
    """Read what is stored of a conversation.

    Raises:
        StoreError: the file cannot be read.
    """
    if keeping is None or not keeping.path.exists():
        return ResumePoint(session)
    with Store(keeping.path) as store:
        return ResumePoint(session, next(iter(store.sessions(session)), None))


def fresh(now: datetime, salt: str) -> ResumePoint:
    """Begin a conversation with a new name, such as 20261121-164210-3f9c.

    Args:
        now: the time.
        salt: distinguishes two that begin in the same second.
    """
    return ResumePoint(f"{now:%Y%m%d-%H%M%S}-{salt}")


def known_as(place: str) -> str | None:
    """Return how to load the scenario at a place later: its name if it is built in, else its path.

    Args:
        place: as a scenario states it.
    """
    folder = Path(place).resolve()
    if folder.parent == Path(str(files("sim"))).resolve() / "scenarios":
        return folder.name
    # The name of a folder may not be valid text; then it cannot be sent.
    return place if place.encode(errors="replace").decode() == place else None
