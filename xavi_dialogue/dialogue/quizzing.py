"""What is said to what was understood: an answer, a question of ours, or a verdict. Pure."""

from xavi_dialogue.dialogue.answering import answer
from xavi_dialogue.dialogue.mind import Said, Situation
from xavi_dialogue.dialogue.state import Understood
from xavi_dialogue.explain.explanation import NeedRollout


def respond(now: Situation, understood: Understood) -> Said | NeedRollout:
    """The reply to what was understood, or what it takes to find it."""
    return answer(now, understood)
