"""The names that the root package offers, loaded together."""

from planner.record.events import Event
from sim.scene import Scene
from xavi_dialogue.domain.evidence import Evidence
from xavi_dialogue.errors import XaviError
from xavi_dialogue.inspection.comparison import Option
from xavi_dialogue.library.answers import Answer
from xavi_dialogue.library.connection import Car, connect, connect_async
from xavi_dialogue.library.curves import Curves
from xavi_dialogue.library.decisions import Belief, Decision
from xavi_dialogue.library.pictures import Picture
from xavi_dialogue.library.reports import Report
from xavi_dialogue.library.ride import Conversation, Ride
from xavi_dialogue.library.sources import drive
from xavi_dialogue.library.sources import open_ride as open  # noqa: A004 - as in PIL.Image
from xavi_dialogue.library.trajectories import Trajectory

__all__ = [
    "Answer",
    "Belief",
    "Car",
    "Conversation",
    "Curves",
    "Decision",
    "Event",
    "Evidence",
    "Option",
    "Picture",
    "Report",
    "Ride",
    "Scene",
    "Trajectory",
    "XaviError",
    "connect",
    "connect_async",
    "drive",
    "open",
]
