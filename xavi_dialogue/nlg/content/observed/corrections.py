"""Corrections: what did not happen, and what happened instead."""

from xavi_dialogue.domain.answers import DidNotHappen
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego, Event
from xavi_dialogue.nlg.content.clauses.clauses import episode_clause, event_clause
from xavi_dialogue.nlg.content.clauses.plan import Part, Plan
from xavi_dialogue.nlg.content.clauses.tenses import PRESENT
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.message import Message
from xavi_dialogue.nlg.surface.values import Clause, Moment, Tense, Who

OPEN = frozenset(("do", "happen"))


def plan_did_not_happen(answer: DidNotHappen, context: SpeechContext) -> Plan:
    """Plan that what the question presupposes did not happen, and what did."""
    event = answer.asked
    ego = isinstance(event.actor, Ego)
    instead = answer.instead[-1] if answer.instead else None
    same = instead is not None and _same(event, instead, context)
    slots: dict[str, object] = {
        "ego": ego,
        "who": Who(event.actor),
        "open": event.action in OPEN,
        "denied": _denied(event, context),
        "verb": _bare(event, context),
        "ahead": event.tense == "future" or event.modal == "will",
        "planned": answer.planned is not None and ego,
        "same": same,
        "elsewhen": answer.elsewhen is not None,
        "instead": None if instead is None else episode_clause(instead, context.now),
        "when": None if instead is None else Moment(instead.begin),
        "underway": instead is not None and (instead.end is None or _recent(instead, context)),
        "told": answer.answer is not None,
    }
    core: list[Part] = [Message("DID_NOT_HAPPEN", slots)]
    if answer.answer is not None:
        core.append(answer.answer)
    return Plan(tuple(core))


def _recent(episode: Episode, context: SpeechContext) -> bool:
    return episode.end is not None and context.now - episode.end <= PRESENT


def _denied(event: Event, context: SpeechContext) -> Clause:
    """Return the denial: in the past tense, or in the present if it goes on."""
    tense: Tense = "present" if event.tense == "present" and event.modal is None else "past"
    return event_clause(event, context.now, tense=tense, negated=True)


def _bare(event: Event, context: SpeechContext) -> Clause:
    clause = event_clause(event, context.now)
    return Clause(clause.subject, clause.verb, clause.rest, "perfect", negated=True)


def _turns(event: Event, episode: Episode) -> bool:
    """Check whether the question is about any turn, and one was made."""
    sides = ("left", "right") if event.side is None else (event.side,)
    return event.action == "turn" and episode.action in [f"exit-{side}" for side in sides]


def _same(event: Event, episode: Episode, context: SpeechContext) -> bool:
    """Check whether an episode is the event that was asked about, but at another time."""
    if event.actor != episode.actor:
        return False
    if event.action == episode.action or _turns(event, episode):
        return True
    one, two = event_clause(event, context.now), episode_clause(episode, context.now)
    return one.verb.split(" for ")[0] == two.verb.split(" for ")[0]
