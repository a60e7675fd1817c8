"""Asking: what the last of several texts on a recorded ride was taken for."""

from tests.dialogue.talking import Talk
from xavi_dialogue.nlu.notation import acts_line


def asked(ride: str, at: float, *texts: str) -> str:
    """Say texts at a time [s] of a ride; the acts that the last was grounded to, in one line."""
    talk = Talk(ride, at, planner=False)
    return acts_line(tuple(act.act for act in [talk.say(text) for text in texts][-1].acts))


def told(ride: str, at: float, *texts: str) -> str:
    """Say texts at a time [s] of a ride; the reply to the last."""
    return Talk(ride, at).hear(*texts)
