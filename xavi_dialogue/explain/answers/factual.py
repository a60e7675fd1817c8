"""Factual: the explainers for facts and expectations, by type of question or act."""

from collections.abc import Callable, Mapping
from typing import Any, TypeAlias

from msgspec.structs import replace

from xavi_dialogue.domain.answers import Answer
from xavi_dialogue.domain.meaning import (
    Changed,
    Claim,
    Compare,
    Doing,
    Fault,
    Feel,
    HowLong,
    HowMany,
    HowMuch,
    HowSure,
    Identify,
    Listing,
    Peak,
    Request,
    Social,
    Summarise,
    When,
    Where,
    Whether,
    Which,
    Whither,
)
from xavi_dialogue.domain.terms import Event, Happens
from xavi_dialogue.explain.answers.events.accounts import listing, summarise
from xavi_dialogue.explain.answers.events.beliefs import how_sure
from xavi_dialogue.explain.answers.events.decisions import changed
from xavi_dialogue.explain.answers.measuring.peak_moments import peak
from xavi_dialogue.explain.answers.measuring.rivals import rivals
from xavi_dialogue.explain.answers.propositions.blame import blamed
from xavi_dialogue.explain.answers.propositions.happenings import doing, when
from xavi_dialogue.explain.answers.propositions.identify import identify
from xavi_dialogue.explain.answers.propositions.lasting import how_long
from xavi_dialogue.explain.answers.propositions.verdicts import claim, whether
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.requests import advises, request
from xavi_dialogue.explain.answers.ride.places import where, whither
from xavi_dialogue.explain.answers.talk import feel, social
from xavi_dialogue.explain.answers.turns import how_many, how_much, who

Explainer: TypeAlias = Callable[[Any, Asked], Answer]

#: Explainers by type of question; `causal` has those for reasons, suppositions and decisions.
QUESTIONS: Mapping[type, Explainer] = {
    Whether: whether,
    Which: who,
    Identify: identify,
    HowMuch: how_much,
    HowMany: how_many,
    HowLong: how_long,
    When: when,
    Where: where,
    Whither: whither,
    Doing: doing,
    Listing: listing,
    Peak: peak,
    Changed: changed,
    Summarise: summarise,
    HowSure: how_sure,
    Fault: blamed,
    Compare: rivals,
}
#: Explainers by type of act, except `Ask`.


def _claim(act: Claim, asked: Asked) -> Answer:
    """Check a claim; how fast, how far off and where we should drive counts as a request."""
    match act.that:
        case Happens(event=Event() as event) if advises(event):  # "you should keep more distance"
            return request(Request(replace(event, modal=None)), asked)
    return claim(act, asked)


ACTS: Mapping[type, Explainer] = {Claim: _claim, Request: request, Feel: feel, Social: social}
