"""Denials of several: neither holds, so both clauses are joined by "and"."""

from xavi_dialogue.domain.answers import Verdict
from xavi_dialogue.domain.terms import Both, Described, Ego, Event, Exists, Happens, Vehicle
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.say import say

CONTEXT = SpeechContext(now=10.0, looks=lambda vehicle, time: None)


def test_neither_is_told_with_and() -> None:
    there = tuple(Exists(Described(bearing=side, definite=False)) for side in ("behind", "beside"))
    text = say(Verdict(Both(there, "or"), False), CONTEXT).text
    assert " or " not in text
    assert " and " in text


def test_what_is_not_both_is_told_with_or() -> None:
    deeds = (Happens(Event("stop", Ego())), Happens(Event("stop", Vehicle(1))))
    text = say(Verdict(Both(deeds, "and"), False), CONTEXT).text
    assert " or " in text
