"""Outcomes: "change-left ends in a crash in all of its samples": whom an option would have hit.

Who reads the planner's own words for its options, and of collisions in what it imagined, asks
with whom these were, be it told or asked.
"""

import re
from itertools import pairwise
from typing import Final

from xavi_dialogue.domain.meaning import (
    Act,
    Ask,
    Elliptic,
    Identify,
    Reading,
    TokenShare,
    WhatIf,
    Whether,
    Which,
)
from xavi_dialogue.domain.terms import (
    At,
    AtDecision,
    Described,
    Event,
    Happens,
    Now,
    Pronoun,
    Related,
    Time,
    Unsaid,
    Vehicle,
    Wanted,
)
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.nlu.text.tokens import Typed

COST: Final = 0.4
_OPTIONS: Final[dict[str, ActionName]] = {
    "change-left": "change-left",
    "change-right": "change-right",
    "exit-left": "exit-left",
    "exit-right": "exit-right",
    "exit-straight": "exit-straight",
    "continue-next-exit": "continue-next-exit",
    "straight-on": "exit-straight",
    "give-way": "give-way",
    "continue": "continue",
    "stop": "stop",
}
_STRUCK: Final = frozenset(
    ("collision", "collisions", "collide", "collides", "colliding", "collided", "crash", "crashes",
     "crashed", "crashing", "hit", "hits", "hitting")
)  # fmt: skip
_IMAGINED: Final = frozenset(
    ("rollout", "rollouts", "sample", "samples", "simulation", "simulations", "runs", "decision",
     "visits", "imagined", "simulated")
)  # fmt: skip
_OF: Final = frozenset(("under", "of", "for", "in", "on", "with"))
#: What may stand between: the sentence is left to the grammar where any other word is in it.
_BETWEEN: Final = frozenset(
    ("a", "all", "an", "and", "any", "are", "at", "been", "both", "by", "came", "come", "comes",
     "could", "couple", "did", "do", "does", "end", "ended", "ending", "ends", "every", "few",
     "from", "had", "has", "have", "i", "if", "is", "it", "its", "many", "most", "now", "one",
     "out", "of", "see", "shows", "show", "some", "that", "the", "their", "there", "these", "this",
     "those", "to", "vehicle", "was", "we", "were", "what", "which", "who", "whom", "with",
     "would", "you", "your", "s", "car", "against", "option", "plain", "plan", "branch", "starts")
)  # fmt: skip
_NUMBER: Final = re.compile(r"#?v?\d+(?:\.\d+)?%?s?")
_REASON: Final = frozenset(("why", "how", "if", "suppose"))
_COLLIDE: Final = Event("collide", object=Wanted(), tense="present", modal="would")


def struck_by(typed: Typed) -> Reading | None:
    """Read a sentence about collisions of an option as the question with whom they were."""
    words = tuple(token.text for token in typed.tokens)
    named = [index for index, word in enumerate(words) if word in _OPTIONS]
    plain_if = words[-2:-1] == ("if",)  # "if any"
    reason = words[:-2] if plain_if else words
    if not named or _STRUCK.isdisjoint(words) or not _REASON.isdisjoint(reason):
        return None
    if not all(map(_is_known, words)):
        return None
    plain = _IMAGINED.isdisjoint(words)
    if plain and not any("-" in words[index] for index in named):
        return None
    governed = [index for index in named if index and words[index - 1] in _OF]
    first = (governed[-1:] or named)[0]
    event = Event(_OPTIONS[words[first]], time=_time(words), tense="present")
    asked = Ask(WhatIf(Happens(event), Which(Wanted(), Happens(_COLLIDE))))
    shares = tuple(TokenShare(word, word, "meaning", "outcome", 0) for word in words)
    return Reading((asked,), shares, COST)


def _is_known(word: str) -> bool:
    """Say whether a word has its part in such a sentence."""
    known = word in _OPTIONS or word in _STRUCK or word in _IMAGINED or word in _OF
    return known or word in _BETWEEN or _NUMBER.fullmatch(word) is not None


def _time(words: tuple[str, ...]) -> Time:
    """Give the decision or the time that is named last."""
    found: Time = Now() if "now" in words else Unsaid()
    for before, word in pairwise(words):
        if before == "decision" and word.isdecimal():
            found = AtDecision(int(word))
        elif before == "at" and word.replace(".", "", 1).isdecimal():
            found = At(float(word))
    return found


def asks_whom(act: Act, later: Act) -> bool:
    """Say whether an act asks no more than whom the option spoken of before it would hit."""
    question = act.question if isinstance(act, Ask) else None
    if not isinstance(question, WhatIf) or question.then != Which(Wanted(), Happens(_COLLIDE)):
        return False
    match later:
        case Elliptic(form="which") | Elliptic(thing=Vehicle(), event=None, form="same"):
            return True
        case Ask(question=Identify(thing=Pronoun() | Described(definite=True, kind="vehicle"))):
            return True
        case Ask(question=Which(such=such) | Whether(that=such)):
            hits = isinstance(such, Happens) and such.event.action == "collide"
            return hits or (isinstance(such, Related) and isinstance(such.thing, Pronoun))
    return False
