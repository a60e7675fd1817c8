"""Ranking: the readings of the grammar, and the plain questions of likely intents, by cost.

What the grammar reads clearly, word for word, stays as it is. Where it leaves words unread, or
reads them at a high cost, the plain questions of likely intents stand beside its readings.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from dataclasses import replace as replaced
from typing import Final

from msgspec.structs import replace

from xavi_dialogue.domain.meaning import (
    Act,
    Ask,
    Elliptic,
    HowMany,
    HowMuch,
    Reading,
    TokenShare,
    Whether,
    Which,
    Why,
)
from xavi_dialogue.domain.rewriting import first
from xavi_dialogue.domain.terms import (
    Both,
    Ego,
    Event,
    Feature,
    Happens,
    Proposition,
    Quantity,
    Related,
    Thing,
)
from xavi_dialogue.nlu.demands import default, demanded, is_met
from xavi_dialogue.nlu.grounding.doubts import SMALL
from xavi_dialogue.nlu.intents.classifier import Intent, judge
from xavi_dialogue.nlu.intents.features import asking, features
from xavi_dialogue.nlu.intents.frames import Plain, is_of, plain, spoken
from xavi_dialogue.nlu.intents.mentions import at_time_of, mentioned
from xavi_dialogue.nlu.intents.signature import asking_acts
from xavi_dialogue.nlu.joining.sentences import sentences
from xavi_dialogue.nlu.text.tokens import tokenise
from xavi_dialogue.nlu.unread import unread_cost

CLEAR: Final = 0.75  # cost of each act up to which the grammar is trusted
OFFERED: Final = 3  # intents of which the plain question is offered, at most
LIKELY: Final = 0.33  # probability from which on it is, where the grammar leaves words unread ...
CERTAIN: Final = 0.7  # ... and where it leaves none
UNMET: Final = 1.0  # cost of each demand of a sentence that a reading leaves unmet
BARE: Final = 0.3  # cost of a bare "why" where another reading names a deed of ours
LOOKED: Final = 8  # intents that are looked at for one that meets it
FITTING: Final = 0.05  # least probability of those that do
DEFAULT: Final = 0.6  # what a plain question of unmet demands is taken for as a probability
FITTED: Final = 0.9  # ... where its words name what it is of
SURE: Final = 0.5  # probability from which on it need not be said how a text was understood


def ranked(text: str, readings: Sequence[Reading]) -> tuple[Reading, ...]:
    """Give the readings of a text and the plain questions that it may come to, likeliest first."""
    wanted = _demands(text, readings[0])
    told = any(_names_deed(one) for one in readings)
    whole = any(one.acts and not one.unread and not _lost(one) for one in readings)
    readings = [_timed(_charged(one, wanted, told=told)) for one in readings]
    readings = [one for one in readings if one.acts or not whole]  # "wait!" asks us to
    readings.sort(key=lambda one: one.cost)
    best = readings[0]
    unmet = _unmet(best, wanted)
    asked = asking(text, best.shares)
    incomplete = bool(unmet) or _is_incomplete(best, asked)
    cheap = _cost(best) <= CLEAR * len(best.acts)
    clear = not incomplete and (cheap or _of_light(best) or _of_rivals(best))
    if clear or _of_several(best) or any(share.strange for share in asked):
        return tuple(readings)
    thing = mentioned(best)
    offered = [
        (intent, question)
        for intent in _likely(features(text, best), unmet, thing)
        if intent.probability >= (LIKELY if incomplete else CERTAIN)
        and _leaves_open(best, intent, incomplete)
        and (question := plain(intent, thing)) is not None
        and (incomplete or not question.vague)
        and not _is_less(best.acts, question.acts)
        and (incomplete or not _is_vaguer(best.acts, question.acts))
        and _counts(best.acts) <= _counts(question.acts)
        and (incomplete or not _opens(best.acts, question.acts))
    ]
    found = [_reading(best, [pair]) for pair in (*offered, *_defaults(best, unmet))]
    if len(offered) > 1:
        found.append(_reading(best, offered[:2]))
    return tuple(sorted([*readings, *found], key=lambda reading: reading.cost))


@dataclass(frozen=True, slots=True)
class _Demand:
    """What a sentence demands, by its words."""

    kind: str
    words: tuple[str, ...]

    def is_met(self, acts: Sequence[Act]) -> bool:
        return is_met(self.kind, acts)


def _demands(text: str, best: Reading) -> list[_Demand]:
    """List what the sentences of a text demand, each by its words as far as they were corrected."""
    found: list[_Demand] = []
    at = 0
    for sentence in sentences(tokenise(text)):
        shares = best.shares[at : at + len(sentence.tokens)]
        words = tuple(s.read if s.read.isalpha() else s.text for s in shares)
        found += [_Demand(kind, words) for kind in demanded(words)]
        at += len(sentence.tokens)
    return found


def _unmet(reading: Reading, wanted: Sequence[_Demand]) -> list[_Demand]:
    return [demand for demand in wanted if not demand.is_met(reading.acts)]


def _charged(reading: Reading, wanted: Sequence[_Demand], *, told: bool) -> Reading:
    """Let a reading cost more that leaves unmet what a sentence demands.

    One without acts owns up to it. So does a bare "why" cost more where another reading says of
    which deed of ours (`told`).
    """
    unmet = len(_unmet(reading, wanted)) if reading.acts else 0
    more = UNMET * unmet + (BARE if told and Elliptic(form="why") in reading.acts else 0.0)
    return replace(reading, cost=round(reading.cost + more, 3)) if more else reading


def _timed(reading: Reading) -> Reading:
    """Let a question be of the time that its text names, where no act took it up."""
    acts = at_time_of(reading.acts, reading)
    return reading if acts == reading.acts else replace(reading, acts=acts)


def _lost(reading: Reading) -> bool:
    """Tell whether a reading leaves a word unread."""
    return any(share.share == "unknown" for share in reading.shares)


def _names_deed(reading: Reading) -> bool:
    """Tell whether a reading asks for the reason of something that we did."""
    whys = (act.question for act in reading.acts if isinstance(act, Ask))
    return any(isinstance(one, Why) and _is_past(one.of) for one in whys)


def _is_past(of: Proposition) -> bool:
    match of:
        case Happens(event=Event(actor=Ego(), tense="past", action=action)):
            return action != "do"
    return False


def _defaults(reading: Reading, unmet: Sequence[_Demand]) -> Iterator[tuple[Intent, Plain]]:
    """Give the plain questions that unmet demands come to."""
    for demand in unmet[:1]:
        found = default(demand.kind, demand.words)
        question = None if found is None else spoken(found.plain, mentioned(reading))
        if found is not None and question is not None:
            chance = FITTED if found.fitted else DEFAULT
            yield Intent(demand.kind, "any", "none", chance), question


def _likely(found: frozenset[str], unmet: Sequence[_Demand], thing: Thing | None) -> list[Intent]:
    """Judge what is asked; where a demand is unmet, among what meets it."""
    every = judge(found)
    if not unmet:
        return list(every[:OFFERED])
    plains = ((one, plain(one, thing)) for one in every[:LOOKED])
    fit = [one for one, question in plains if question and unmet[0].is_met(question.acts)]
    whole = sum(one.probability for one in fit)
    if whole < FITTING:
        return list(every[:OFFERED])
    return [replaced(one, probability=one.probability / whole) for one in fit[:OFFERED]]


def _is_incomplete(best: Reading, asked: Sequence[TokenShare]) -> bool:
    """Tell whether words of what is asked are unread, whatever is told beside it."""
    lost = any(share.share == "unknown" and share.read not in SMALL for share in asked)
    return lost or any(unread.asks for unread in best.unread) or not best.acts


def _cost(best: Reading) -> float:
    """Give what a reading costs without what is told beside and was not read."""
    return best.cost - sum(unread_cost(len(one.words)) for one in best.unread if not one.asks)


def _of_light(best: Reading) -> bool:
    """Tell whether a reading is of a traffic light, of which no plain question is."""
    light = first(best.acts, Feature)
    return light is not None and light.kind == "light"


def _of_several(best: Reading) -> bool:
    """Tell whether several things are supposed or asked after: a plain question is of one."""
    asked = (act.question for act in best.acts if isinstance(act, Ask))
    said = (getattr(one, "supposed", None) or getattr(one, "that", None) for one in asked)
    return any(isinstance(of, Both) for of in said)


def _of_rivals(best: Reading) -> bool:
    """Tell whether it is asked which of those named it is: a plain question names none."""
    asked = (act.question for act in best.acts if isinstance(act, Ask))
    return any(getattr(one, "rival", None) or getattr(one, "among", ()) for one in asked)


def _is_less(acts: Sequence[Act], plain: Sequence[Act]) -> bool:
    """Tell whether a plain question asks less than is asked word for word, or not of what."""
    asked = [act for act in acts if isinstance(act, Ask | Elliptic)]
    open_ = {type(a.question) for a in plain if isinstance(a, Ask) and _of(a) is None}
    told = {type(a.question) for a in asked if isinstance(a, Ask) and _of(a) is not None}
    return len(asked) > len(plain) or not open_.isdisjoint(told)


def _is_vaguer(acts: Sequence[Act], plain: Sequence[Act]) -> bool:
    """Tell whether a plain question leaves out an amount that is named, or the deed."""
    if first(acts, Quantity) is not None and first(plain, Quantity) is None:
        return True
    vague = {kind for kind, action in _deeds(plain) if action == "do"}
    named = {kind for kind, action in _deeds(acts) if action != "do"}
    return not vague.isdisjoint(named)


def _opens(acts: Sequence[Act], plain: Sequence[Act]) -> bool:
    """Tell whether a plain question asks who has right of way, where it is asked of somebody."""
    asked = (act.question for act in acts if isinstance(act, Ask))
    said = any(isinstance(one, Whether) and _is_rule(one.that) for one in asked)
    openly = (act.question for act in plain if isinstance(act, Ask))
    return said and any(isinstance(one, Which) and _is_rule(one.such) for one in openly)


def _is_rule(of: Proposition | None) -> bool:
    return isinstance(of, Related) and of.relation in ("has-priority-over", "must-yield-to")


def _deeds(acts: Sequence[Act]) -> Iterator[tuple[type, str]]:
    """Give what sort of question is asked of which deed."""
    for act in acts:
        event = first(act, Event) if isinstance(act, Ask) else None
        if isinstance(act, Ask) and event is not None:
            yield type(act.question), event.action


def _of(act: Ask) -> object:
    return getattr(act.question, "of", act.question)


def _counts(acts: Sequence[Act]) -> bool:
    """Tell whether it is asked how many, or how much at most: nothing else answers that."""
    asked = (act.question for act in acts if isinstance(act, Ask))
    return any(
        isinstance(one, HowMany) or (isinstance(one, HowMuch) and one.extreme is not None)
        for one in asked
    )


def _leaves_open(best: Reading, intent: Intent, incomplete: bool) -> bool:
    """Tell whether a reading does not ask what a text asks, or not without unread words."""
    if incomplete and intent.probability >= CERTAIN:
        return True
    return not any(is_of(act, intent.name) for act in asking_acts(best.acts))


def _beside(best: Reading, plain: tuple[Act, ...]) -> tuple[list[Act], list[Act]]:
    """Give what else is asked and was read, before and behind what a plain question stands for."""
    lost = {share.act for share in best.shares if share.share == "unknown"}
    at = next((rank for rank, _ in enumerate(best.acts) if rank in lost), None)
    kinds = {type(act.question) for act in plain if isinstance(act, Ask)}
    kept = [
        (rank, act)
        for rank, act in enumerate(best.acts)
        if at is not None and rank not in lost
        if isinstance(act, Ask) and type(act.question) not in kinds
    ]
    return [act for rank, act in kept if rank < (at or 0)], [
        act for rank, act in kept if rank > (at or 0)
    ]


def _reading(best: Reading, pairs: Sequence[tuple[Intent, Plain]]) -> Reading:
    """Give the reading of a text as the plain questions of intents.

    Words that are in no vocabulary have no part in it.
    """
    names = " ".join(f"intent:{intent.name}" for intent, _ in pairs)
    shares = tuple(
        TokenShare(one.text, one.read, "idle" if one.strange else "meaning", names, 0, one.strange)
        for one in best.shares
    )
    probability = sum(intent.probability for intent, _ in pairs)
    acts = at_time_of(tuple(act for _, question in pairs for act in question.acts), best)
    if len(pairs) == 1:
        before, behind = _beside(best, acts)
        acts = (*before, *acts, *behind)
    unsure = probability < SURE and len(pairs) == 1
    said = pairs[0][1].text if unsure else ""
    return Reading(acts, shares, round(best.cost - probability, 3), paraphrase=said)
