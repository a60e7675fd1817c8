"""Ground: readings, world and discourse to the acts that are meant.

Each reading costs what its words cost, and what speaks against it in the world: references that
fit nobody, events that it takes for granted and that never happened. The cheapest is taken; the
car asks back where two are as cheap and lead to different answers that are sensible both, or
where a reference stays open; else it takes the better one.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

from msgspec.structs import replace

from xavi_dialogue.domain.answers import NoSuchVehicle, NotUnderstood
from xavi_dialogue.domain.discourse import Discourse, GroundedAct
from xavi_dialogue.domain.meaning import (
    Act,
    Ask,
    Beyond,
    Claim,
    Listing,
    Question,
    Reading,
    Repair,
    Request,
    Social,
    Unread,
    Whether,
    Which,
)
from xavi_dialogue.domain.rewriting import first, substitute
from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Everyone,
    Exists,
    Nobody,
    Related,
    Unsaid,
    Vehicle,
    Wanted,
)
from xavi_dialogue.nlu.grounding import clarify, doubts, quoting
from xavi_dialogue.nlu.grounding.acts.acts import act as ground_act
from xavi_dialogue.nlu.grounding.acts.acts import completed
from xavi_dialogue.nlu.grounding.completion.discussion import proposition_of
from xavi_dialogue.nlu.grounding.completion.ranking import anchor_of
from xavi_dialogue.nlu.grounding.context import Context, Notes
from xavi_dialogue.nlu.grounding.events.holding import holder
from xavi_dialogue.nlu.grounding.grounder import TermGrounder
from xavi_dialogue.nlu.grounding.result import Failure, Grounding
from xavi_dialogue.nlu.grounding.salience import after, named_time, naming
from xavi_dialogue.nlu.grounding.soundness import is_sound
from xavi_dialogue.nlu.grounding.world import World

READINGS: Final = 8  # looked at, at most
SEVERAL: Final = 0.1  # by which one act of the same words is preferred to two
DEAF: Final = 1.0  # cost of an act of which the main word is unknown
#: Of whom the next act speaks where it is asked who is in that place.
_NEIGHBOURS: Final = ("behind", "ahead-of")
_IN_LINE: Final = ("behind", "ahead")  # who is there rather than in another lane


@dataclass(frozen=True, slots=True)
class Part:
    """One act of a reading, grounded as far as it could be."""

    act: GroundedAct
    complete: Act  # as read, a fragment completed
    notes: Notes
    context: Context  # in which it was grounded
    failure: Failure | None = None
    quote: str = ""  # its words

    @property
    def answerable(self) -> bool:
        """Whether it can be answered, be it about a vehicle that was described wrongly."""
        if self.notes.unclear:
            return False
        failure = self.failure
        return failure is None or (
            isinstance(failure, NoSuchVehicle) and failure.misdescribed is not None
        )


@dataclass(frozen=True, slots=True)
class Trial:
    """A reading, grounded."""

    reading: Reading
    parts: tuple[Part, ...]
    cost: float

    @property
    def acts(self) -> tuple[Act, ...]:
        """The acts as grounded."""
        return tuple(part.act.act for part in self.parts)

    @property
    def complete(self) -> bool:
        """Whether every word was understood, and all that is taken for granted is so."""
        return not self.reading.unknown and all(
            part.answerable and part.notes.presupposed for part in self.parts
        )


def ground(readings: tuple[Reading, ...], world: World, discourse: Discourse) -> Grounding:
    """Choose among readings by words and world, and ground the acts of the one chosen."""
    context = Context(world, discourse)
    trials: list[Trial] = []
    for reading in readings[:READINGS]:
        best = min((trial.cost for trial in trials), default=None)
        if best is not None and reading.cost > best + clarify.CLOSE:
            continue
        trials.append(_try(reading, context))
    if not trials:
        return Grounding(refusal=NotUnderstood())
    trials.sort(key=lambda trial: trial.cost + SEVERAL * len(trial.parts))
    return _decided(trials, context)


def _try(reading: Reading, context: Context) -> Trial:
    judged = doubts.judge(reading)
    parts: list[Part] = []
    cost = reading.cost
    for index in range(len(reading.acts)):
        part = _part(reading, index, judged, context)
        parts.append(part)
        cost += part.notes.cost
        told = _discussed(after(context.discourse, part.act), part.act, context)
        context = context.within(_anchored(told, part.complete, context))
    return Trial(reading, tuple(parts), cost)


def _discussed(discourse: Discourse, done: GroundedAct, context: Context) -> Discourse:
    """Let "and why?" in the same breath be about the question just asked, and its time."""
    named = named_time(done, context.now)
    if named is not None:
        discourse = replace(discourse, named=named)
    if isinstance(done.act, Request):
        discourse = replace(discourse, option=done.act.event, last_acts=(done.act,))
    of = proposition_of(done.act.question) if isinstance(done.act, Ask) else None
    return replace(discourse, propositions=(of, *discourse.propositions)) if of else discourse


def _anchored(discourse: Discourse, spoken: Act, context: Context) -> Discourse:
    """Let "it" behind "is there anyone in front of the lorry?" be the lorry."""
    several = first(spoken, Everyone)
    if isinstance(spoken, Ask) and isinstance(spoken.question, Listing) and several is not None:
        g = TermGrounder(context)  # "who are all those people, and where do they go?"
        those = Described(several.kind, plural=True)
        return naming(discourse, g.thing(those, g.window(Unsaid(), "present")))
    if isinstance(spoken, Ask) and (near := _neighbour(spoken.question, context)) is not None:
        return naming(discourse, near)  # "who is behind us, and is he too close?"
    if isinstance(spoken, Ask) and (holds := holder(spoken.question, context)) is not None:
        return naming(discourse, holds)  # "is something holding us up, and how far off is it?"
    sought = first(spoken, Exists)
    thing = None if sought is None else sought.thing
    thing = thing.described if isinstance(thing, Nobody) else thing
    if not isinstance(thing, Described) or thing.definite or thing.of is None:
        return discourse
    g = TermGrounder(context)
    return naming(discourse, g.thing(thing.of, g.window(Unsaid(), "present")))


def _neighbour(question: Question, context: Context) -> Vehicle | None:
    """Give the nearest of whom "who is behind us", "is somebody in front of us" is about."""
    of = question.such if isinstance(question, Which) else None
    of = question.that if isinstance(question, Whether) else of
    if not isinstance(of, Related) or of.relation not in _NEIGHBOURS or of.tense != "present":
        return None
    if of.thing not in (Wanted(), Described(definite=False)) or of.to != Ego():
        return None
    world, now = context.world, context.now
    looks = [look for v in world.in_view(now) if (look := world.look(v, now)) is not None]
    there = [
        look for look in looks if world.relation(of.relation, Vehicle(look.vehicle), Ego(), now)
    ]
    nearest = min(there, key=lambda x: (x.bearing not in _IN_LINE, x.distance), default=None)
    return None if nearest is None else Vehicle(nearest.vehicle)


def _part(reading: Reading, index: int, judged: doubts.Doubts, context: Context) -> Part:
    spoken, g = reading.acts[index], TermGrounder(context)
    fatal, left = judged.kills(index), judged.leaves(index)
    complete = completed(spoken, g)
    grounded = spoken if complete is None else ground_act(complete, g)
    notes = g.notes
    failure: Failure | None = notes.missing[0] if notes.missing else None
    unknown = (*fatal, *notes.unknown)
    senseless = not isinstance(spoken, Beyond | Social) and (unknown or not is_sound(grounded))
    if complete is None or senseless:
        failure = quoting.missed(reading, index, fatal)
        notes.cost += DEAF
    done = GroundedAct(
        act=grounded,
        span=notes.span,
        leaned=notes.leaned,
        doubts=quoting.phrases(reading, index, left),
        strange=tuple(word for word in left if word in reading.strange),
        presupposed=notes.presupposed,
        anchor=anchor_of(complete),
    )
    quote = quoting.words_of(reading, index)
    return Part(done, complete or spoken, notes, context, failure, quote)


def _decided(trials: Sequence[Trial], context: Context) -> Grounding:
    best = trials[0]
    if not best.parts:
        return Grounding(reading=best.reading, refusal=NotUnderstood(words=best.reading.strange))
    asked = _unclear(best) or _torn(trials)
    told, refusal = _told(best)
    acts, quotes = tuple(part.act for part in told), tuple(part.quote for part in told)
    if asked is None:
        named = _named(best) if isinstance(refusal, NotUnderstood) else None
        return Grounding(acts, reading=best.reading, refusal=refusal, quotes=quotes, named=named)
    found, pending = asked
    if found.which.between == "meanings":
        acts = tuple(a for a in acts if a.act not in found.offers)
    return Grounding(
        acts=acts,
        clarify=found.which,
        reading=best.reading,
        refusal=refusal,
        offers=found.offers,
        offered_things=found.things,
        pending=pending,
    )


def _named(best: Trial) -> Vehicle | None:
    """Give who was named, so that the next turn may speak of him as "he"."""
    acts = (part.act.act for part in best.parts)
    return next((v for act in acts if (v := first(act, Vehicle)) is not None), None)


def _told(best: Trial) -> tuple[list[Part], Failure | None]:
    """Give the acts that are replied to, and what is owned up to beside them.

    Beside a question, what else was said is context: of that, nothing is owned up to. Where it
    is the question of which nothing was made, what else was said is not replied to, either.
    """
    parts = _without_picks(best)
    asking = [part for part in parts if isinstance(part.complete, Ask | Request)]
    answered = any(part.answerable for part in asking)
    lost = [part.failure for part in asking if part.failure is not None]
    unread = [one for one in best.reading.unread if one.asks]
    lost += [quoting.unread(best.reading, one) for one in unread]
    lost += [quoting.unread(best.reading, Unread(words)) for words in best.reading.ignored]
    if not lost and not answered:
        lost = [part.failure for part in parts if part.failure is not None]
    heard = asking if answered else parts
    misdescribed = [p.failure for p in heard if p.answerable and p.failure is not None]
    refusal = next(iter((*misdescribed, *lost)), None)
    told = [part for part in parts if part.answerable]
    if (asking or unread) and not answered and not misdescribed:
        told = [part for part in told if not isinstance(part.complete, Claim | Social)]
    if told and isinstance(refusal, NotUnderstood):
        refusal = replace(refusal, rest=True) if refusal.quote or refusal.words else None
    return told, refusal


def _without_picks(best: Trial) -> list[Part]:
    """Leave out numbers beside a question, which pick nobody: "in my country, 50 is allowed"."""
    spoken = zip(best.reading.acts, best.parts, strict=True)
    rest = [p for act, p in spoken if not isinstance(act, Repair) or act.kind != "pick"]
    return rest if any(isinstance(p.complete, Ask | Request) for p in rest) else list(best.parts)


def _unclear(trial: Trial) -> tuple[clarify.Clarification, Act] | None:
    """Ask which vehicle is meant, in the first act where that stays open.

    Beside a question that can be answered, a remark is context, and is not asked about.
    """
    asking = [part for part in trial.parts if isinstance(part.complete, Ask | Request)]
    clear = any(part.answerable for part in asking)
    for part in asking if clear else trial.parts:
        if part.notes.unclear and part.failure is None:
            unclear = part.notes.unclear[0]
            offers = []
            for number in unclear.options:
                chosen = substitute(part.complete, unclear.thing, Vehicle(number))
                offers.append(ground_act(chosen, TermGrounder(part.context)))
            if len({*clarify.essence(offers)}) < 2:
                continue
            return clarify.between_vehicles(unclear, offers, part.context), part.complete
    return None


def _torn(trials: Sequence[Trial]) -> tuple[clarify.Clarification, Act] | None:
    """Ask which reading is meant, where two are complete, as good, and lead to other answers."""
    best = trials[0]
    for other in trials[1:]:
        if other.cost - best.cost > clarify.LEVEL:
            break
        if not (best.complete and other.complete and clarify.apart(best.acts, other.acts)):
            continue
        found = clarify.between_meanings(best.acts, other.acts)
        if found is not None:
            return found, found.offers[0]
    return None
