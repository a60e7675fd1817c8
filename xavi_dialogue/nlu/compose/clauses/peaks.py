"""Peaks: "the hardest moment", "when were we slowest": what was at its most, and when."""

from dataclasses import replace
from typing import Any, cast

from msgspec import structs

from xavi_dialogue.domain.meaning import HowMuch, Peak
from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Event,
    Feature,
    Measured,
    Pronoun,
    Quantity,
    Time,
    Unknown,
    Unsaid,
    Vehicle,
    Wanted,
)
from xavi_dialogue.domain.vocabulary import Extreme
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.extents import extreme_of
from xavi_dialogue.nlu.compose.clauses.risks import is_danger
from xavi_dialogue.nlu.compose.clauses.sem import Measure, Moment, Noun, Sem, as_thing
from xavi_dialogue.nlu.compose.clauses.traits import Traits
from xavi_dialogue.nlu.compose.clauses.tree import leaves_of
from xavi_dialogue.nlu.grammar.chart import Node
from xavi_dialogue.nlu.grammar.lexicon import Leaf

#: What is at its most at a moment, by superlatives and adjectives.
_QUALITIES = {
    "nearest": "closeness", "slowest": "slowness", "fastest": "speed", "difficult": "difficulty",
    "dangerous": "danger", "highest": "difficulty", "lowest": "closeness", "important": "danger",
    "hard": "difficulty", "uncomfortable": "difficulty", "tightest": "closeness",
}  # fmt: skip


def quality_of(extreme: str | None, adjectives: list[str], words: tuple[str, ...] = ()) -> str:
    """Name what is at its most at a moment, or in a decision, as the noun says; "" for nothing."""
    named = [name for name in (extreme, *adjectives) if name in _QUALITIES]
    return of_choice(_QUALITIES[named[0] or ""], words) if named else ""


_CHOICES = frozenset({"decision", "choice", "call"})


def of_choice(quality: str, words: tuple[str, ...]) -> str:
    """Name what is at its most in a decision: the closest is that with a rival as good."""
    close = quality in ("closeness", "difficulty") and words[-1:] and words[-1] in _CHOICES
    return "choice" if close else quality


def most_of(clause: Clause) -> str:
    """Name what "which bit was hardest", "which was the trickiest" ask for; "" for nothing."""
    if "hardest" in clause.focus:
        return "difficulty"
    said = (leaf for _, node in clause.objects for leaf in leaves_of(node))
    return next((quality_of(leaf.key, []) for leaf in said if leaf.category == "SUPER"), "")


def standing_out(clause: Clause) -> str | None:
    """Return by what one of several deeds stands out: "the hardest", "the longest"."""
    return "hardest" if "hardest" in clause.focus else extreme_of(clause)


_PACES = {"slowest": "slowness", "fastest": "speed"}
_TURNS = frozenset({"turn", "exit-left", "exit-right"})
_PACED = _TURNS | {"change-lane", "change-left", "change-right", "overtake", "merge", "pass"}
_HARD = frozenset({"highest", "difficult", "biggest", "sharpest"})
_TIGHT = frozenset({"tightest", "sharpest"})


def outstanding(deed: Event, said: str | None) -> Peak | None:
    """Ask which time a deed of ours was most so: the slowest turn, the longest stop."""
    if not isinstance(deed.actor, Ego) or said is None:
        return None
    if deed.action in ("brake", "slow-down"):
        return Peak("braking", deed.time) if said in _HARD or said == "hardest" else None
    if deed.action in _DEEDS:
        return Peak("waiting", deed.time) if said in _HARD else None
    tight = said in _TIGHT and deed.action in _TURNS
    quality = "tightness" if tight else _PACES.get(said, "")
    paced = bool(quality) and deed.action in _PACED
    return Peak(cast(Any, quality), deed.time, deed=deed) if paced else None


def _most(sem: Sem) -> bool:
    """Say whether a noun phrase is "the most time"."""
    return getattr(sem, "extreme", None) == "highest" or getattr(sem, "unit", "") in ("s", "time")


_EXTREMES = {"slowest": "slowness", "fastest": "speed", "nearest": "closeness",
             "closest": "closeness", "longest": "waiting"}  # fmt: skip


#: What we do or meet with the most, by the verb.
_DONE = {"brake": "slowing", "slow down": "slowing", "slow": "slowing", "wait": "waiting",
         "spend": "waiting", "lose": "delay", "waste": "delay", "cost": "delay"}  # fmt: skip
_HOLDING = frozenset({"hold", "hold up", "delay", "slow", "slow down", "keep"})


def _done_most(verb: str, clause: Clause) -> str:
    """Name what is done the most: "lost the most time", "braked the most"; "" for nothing."""
    sems = [sem for sem, _ in clause.objects]
    time = any(isinstance(s, (Noun, Measure, Moment)) and _most(s) for s in sems)
    if time:
        return _DONE.get(verb, "") if _DONE.get(verb) != "slowing" else ""
    if Unknown("highest") not in [*sems, *(c.sem for c in clause.complements)]:
        return ""
    if verb in _HOLDING and Ego() in sems:
        return "delay"  # "what held us up the most"
    return _DONE.get(verb, "") if isinstance(clause.subject, Ego) else ""


def done_most(event: Event, relative: Node | None, extreme: str | None) -> str:
    """Name the peak of "where we had to brake the most", "the longest bit we stood still"."""
    if not isinstance(event.actor, Ego):
        return ""
    most = relative is not None and any(leaf.category == "SUPER" for leaf in leaves_of(relative))
    return _DEEDS.get(event.action, "") if most else deed_peak(event.action, extreme)


#: What a deed of ours is the most of: "the hardest braking", "the longest stop".
_DEEDS = {"brake": "slowing", "slow-down": "slowing", "stop": "waiting", "wait": "waiting",
          "stand": "waiting", "give-way": "waiting", "let-go": "waiting"}  # fmt: skip
PEAKS = 3  # of "the hardest brakings" that are stated
_CURVES = frozenset({"corner", "turning", "bend", "curve", "hairpin"})  # where one turns
_RISKIEST = frozenset({"highest", "biggest", "dangerous", "worst", "difficult"})


def most_risk(extreme: str | None) -> Extreme | None:
    """Read "the worst risk", "the biggest risk" as the highest one."""
    return "highest" if extreme in _RISKIEST else None


def deed_peak(action: str, extreme: str | None) -> str:
    """Name what "the hardest braking", "the longest stop" are the peak of; "" for nothing."""
    peak = outstanding(Event(cast(Any, action)), extreme)
    return peak.of if peak is not None and peak.deed is None else ""


def deed_ranked(sem: Sem, extreme: str | None) -> Noun | None:
    """Read "the slowest turn", "the fastest lane change" as the deed of its kind that is that."""
    if not isinstance(sem, Event) or sem.tense == "future" or sem.object is not None:
        return None
    peak = outstanding(sem, extreme) if isinstance(sem.time, Unsaid) else None
    ranked = peak is not None and peak.deed is not None
    return Noun("peak", of=sem, quality=peak.of) if ranked and peak is not None else None


def curve_ranked(words: tuple[str, ...], extreme: str | None) -> Noun | None:
    """Read "the tightest bend", "the slowest corner" as the turn that is that."""
    return deed_ranked(Event("turn"), extreme) if _CURVES.intersection(words) else None


def braked_most(sem: Sem | None, extreme: str | None) -> str:
    """Name what "the hardest bit of braking" is the peak of; "" for nothing."""
    return deed_peak(sem.action, extreme) if isinstance(sem, Event) else ""


def deed_asked(clause: Clause, sem: Sem, words: tuple[str, ...]) -> Peak | None:
    """Read "which turn was the tightest", "which lane change did you make fastest"."""
    bent = isinstance(sem, Feature) and sem.kind == "bend"
    deed = Event("turn") if bent or _CURVES.intersection(words) else sem
    if not isinstance(deed, Event):
        return None
    said = (leaf.key for _, node in clause.objects for leaf in leaves_of(node))
    extremes = (*said, *sorted(clause.focus), standing_out(clause))
    peaks = (outstanding(deed, extreme) for extreme in extremes)
    most = next((peak for peak in peaks if peak is not None), None)
    told = most is None or isinstance(clause.time, Unsaid)
    return most if told or most is None else structs.replace(most, time=clause.time)


def peak_named(noun: Noun, time: Time) -> Peak:
    """Ask for the peak that a noun names."""
    deed = noun.of if isinstance(noun.of, Event) else None
    return Peak(cast(Any, noun.quality), time, noun.number, deed)


def peaks_of(head: Leaf, traits: Traits, quality: str) -> Noun:
    """Name the moments at which something was at its most: "the three hardest brakings"."""
    number = traits.fields.get("number", PEAKS if head.form == "plural" else 1)
    return Noun("peak", word=head.words[-1], quality=quality, number=number)


def extreme_told(clause: Clause) -> HowMuch | None:
    """Read "the peak deceleration was about five" as asking for the peak, whatever it was."""
    subject = clause.subject
    if not isinstance(subject, Measure) or subject.extreme is None or clause.verb is not None:
        return None
    if not any(isinstance(sem, Quantity) for sem, _ in clause.objects):
        return None
    of = structs.replace(subject.of, time=clause.time, tense=cast(Any, clause.tense))
    return HowMuch(of, subject.extreme)


def nearest_of(clause: Clause) -> HowMuch | None:
    """Read "when was it closest?" of another vehicle; the answer tells when."""
    thing = as_thing(clause.subject)
    still = clause.verb is None or clause.verb.key in ("come", "get")
    if not still or not isinstance(thing, Pronoun | Described | Vehicle):
        return None
    if isinstance(thing, Described) and not thing.definite:
        return None  # "when did anyone come closest?"
    if not clause.focus & {"closest", "nearest"}:
        return None
    of = Measured("distance", thing, Ego(), time=clause.time, tense=cast(Any, clause.tense))
    return HowMuch(of, "lowest")


def longest_of(clause: Clause) -> Peak | None:
    """Read "what took the longest?" as where most time was lost."""
    took = clause.verb is not None and clause.verb.key == "take"
    things = [as_thing(sem) for sem, _ in clause.objects]
    longest = any(isinstance(one, Described) and one.extreme == "biggest" for one in things)
    return Peak("delay", clause.time) if took and longest else None


def peak_of(clause: Clause) -> Peak | None:
    """Read "when were we slowest", "who came closest to us", "where did you brake hardest"."""
    verb = None if clause.verb is None else clause.verb.key
    subject = clause.subject
    if verb is None and isinstance(subject, Noun) and subject.key == "peak" and subject.quality:
        braked = any(braked_most(c.sem, "highest") for c in clause.complements if c.key == "of")
        hard = braked and subject.quality == "difficulty"  # "the hardest bit of braking"
        return peak_named(replace(subject, quality="braking") if hard else subject, clause.time)
    if verb is None and is_danger(subject) and most_of(clause) == "difficulty":
        return Peak("risk", clause.time)  # "when was the risk highest?"
    if verb is not None and (most := _done_most(verb, clause)):
        return Peak(cast(Any, most), clause.time)
    words = clause.focus & {*_EXTREMES, "hardest"}
    if words and (verb is not None or isinstance(clause.subject, (Ego, Wanted))):
        of = "braking" if "hardest" in words else _EXTREMES[min(words)]
        return Peak(cast(Any, of), clause.time)
    objects = [as_thing(sem) for sem, _ in clause.objects]
    thing = objects[0] if verb is None and objects else None
    if not isinstance(thing, Described) or thing.extreme not in _EXTREMES:
        return None
    bare = thing == Described(extreme=thing.extreme, definite=thing.definite)
    ours = isinstance(clause.subject, Ego) and clause.tense != "present"
    return Peak(cast(Any, _EXTREMES[thing.extreme]), clause.time) if bare and ours else None
