"""The names that the root package offers, loaded together."""

from planner.record.events import Event
from sim.scene import Scene
from xavi_dialogue.domain.evidence import Evidence
from xavi_dialogue.errors import XaviError
from xavi_dialogue.inspection.comparison import Option
from xavi_dialogue.library.answers import Answer
from xavi_dialogue.library.decisions import Belief, Decision
from xavi_dialogue.library.ride import Conversation, Ride
from xavi_dialogue.library.sources import drive
from xavi_dialogue.library.sources import open_ride as open  # noqa: A004 - as in PIL.Image
from xavi_dialogue.library.trajectories import Trajectory

__all__ = [
    "Answer",
    "Belief",
    "Conversation",
    "Decision",
    "Event",
    "Evidence",
    "Option",
    "Ride",
    "Scene",
    "Trajectory",
    "XaviError",
    "drive",
    "open",
]
