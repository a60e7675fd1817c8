"""Morphology: tokens to words. Verb phrases, references, quantities, times, lists.

References are resolved from left to right: a vehicle is named in full at first, and then "it" as
long as no other vehicle has been named.

Errors:
    FormError    a grammar asks for a form that a value does not have
"""

import re
from dataclasses import replace

from xavi_dialogue.domain.terms import Described, Ego, Everyone, Thing, Vehicle, Vehicles
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.chances import chance
from xavi_dialogue.nlg.surface.generator import Slot, Token
from xavi_dialogue.nlg.surface.ordinals import ordinal
from xavi_dialogue.nlg.surface.quantities import moment, number, quantity, span
from xavi_dialogue.nlg.surface.referring import ReferringContext, listed
from xavi_dialogue.nlg.surface.rules import GrammarError, Word
from xavi_dialogue.nlg.surface.tables import afoot
from xavi_dialogue.nlg.surface.values import (
    Bare,
    Chance,
    Clause,
    Moment,
    Number,
    Owned,
    Quantity,
    Range,
    Who,
    Without,
)
from xavi_dialogue.nlg.surface.verbs import Person, conjugate
from xavi_dialogue.nlg.surface.verbs import inflect as inflect_verb


class FormError(GrammarError):
    """A slot whose value has no such form."""


def inflect(
    tokens: tuple[Token, ...], context: SpeechContext, speaker: ReferringContext | None = None
) -> tuple[tuple[str, ...], tuple[int, ...]]:
    """Return the words of the tokens, and the vehicles that they name in order of first mention.

    Raises:
        FormError: a slot's value has no such form.
    """
    speaker = ReferringContext(context) if speaker is None else speaker
    words = tuple(t.text if isinstance(t, Word) else fill(t, speaker) for t in tokens)
    if speaker.passenger:
        words = tuple(re.sub(r"\bmy\b", "your", one) for one in words)
    return words, tuple(speaker.mentioned)


def fill(slot: Slot, speaker: ReferringContext) -> str:
    """Return the words for a value in the form that the slot asks for.

    Raises:
        FormError: the value has no such form.
    """
    value, form = slot.value, slot.form
    match value:
        case Who():
            return speaker.refer(value, form)
        case Clause():
            return clause(value, form, speaker)
        case Bare():
            return bare(value.clause, speaker)
        case Without():
            words = speaker.refer(Who(value.described, indefinite=True), "full")
            return f"no {re.sub('^(an?|any|another) ', '', words)}"
        case Owned():
            return _owned(value, speaker)
        case Quantity():
            return quantity(value, form)
        case Range():
            return span(value, form)
        case Chance():
            return chance(value.value, form)
        case Moment():
            return moment(value.time, speaker.context.now, form)
        case Number():
            return number(value, form)
        case tuple():
            joint = form if form in ("or", "and") else "and"
            inner = form if any(isinstance(v, Clause) for v in value) else "plain"
            if len(value) > 1 and all(isinstance(v, Who) for v in value):
                inner = "full"
            return listed([fill(Slot(v, inner), speaker) for v in value], joint)
        case str():
            return _string(value, form)
        case int() | float():
            return ordinal(int(value)) if form == "ordinal" else f"{value:g}"
    raise FormError(f"no form {form!r} of {value!r}")


def clause(value: Clause, form: str, speaker: ReferringContext) -> str:
    """Return a clause ("I did not turn right"), its question, or its verb phrase in a form.

    Raises:
        FormError: a clause has no such form.
    """
    who = value.subject
    if isinstance(who, Who) and isinstance(who.thing, Vehicle) and speaker.on_foot(who.thing, who):
        value = replace(value, verb=afoot(value.verb))
    if form in ("gerund", "base", "participle", "past"):
        verb = inflect_verb(value.verb, form)  # type: ignore[arg-type]
        return " ".join(f"{verb} {_rest(value, speaker)}".split())
    if form not in ("plain", "short", "question", "predicate"):
        raise FormError(f"a clause has no form {form!r}")
    subject = _subject(value, speaker) if form != "predicate" else ""
    parts = conjugate(
        value.verb,
        value.tense,
        _person(value, speaker),
        progressive=value.progressive,
        modal=value.modal,
    )
    adverb = value.adverb
    adverb = chance(adverb.value, "adverb") if isinstance(adverb, Chance) else adverb
    deny = "not" if value.negated else ""
    if value.lead and form == "plain":
        subject = f"{value.lead} {subject}"
    if form == "short":
        return f"{subject} {parts.support} {deny}".strip()
    if form == "question":
        words = f"{parts.support} {subject} {deny} {adverb} {parts.verbs} {_rest(value, speaker)}"
    elif value.negated and subject == "everybody":
        words = f"not {subject} {parts.auxiliary} {adverb} {parts.plain} {_rest(value, speaker)}"
    elif value.negated:
        words = f"{subject} {parts.support} {adverb} not {parts.verbs} {_rest(value, speaker)}"
    else:
        words = f"{subject} {parts.auxiliary} {adverb} {parts.plain} {_rest(value, speaker)}"
    return " ".join(words.split()).replace("can not ", "cannot ")


def bare(value: Clause, speaker: ReferringContext) -> str:
    """Return the verb phrase in the form that goes with the auxiliary of the clause before."""
    simple = value.tense in ("past", "present") and value.modal is None
    if value.progressive:
        return clause(value, "gerund", speaker)
    if simple and not value.negated:
        return clause(value, "predicate", speaker)
    perfect = value.tense in ("perfect", "past-perfect", "conditional-perfect")
    return clause(value, "participle" if perfect else "base", speaker)


def _subject(value: Clause, speaker: ReferringContext) -> str:
    subject = value.subject
    if isinstance(subject, str):
        return subject
    if isinstance(subject, Who):
        return speaker.refer(subject, "plain")
    return fill(Slot(subject, "gerund" if isinstance(subject, Clause) else "plain"), speaker)


def _owned(value: Owned, speaker: ReferringContext) -> str:
    """Return a noun with its owner: "its speed", but "the speed of the blue car ahead of us"."""
    owner = speaker.refer(value.owner, "possessive")
    if " " not in owner:
        return f"{owner} {value.noun}"
    words = owner.removesuffix("'s").removesuffix("'")
    return f"the {value.noun} of {words}"


def _person(value: Clause, speaker: ReferringContext) -> Person:
    subject = value.subject
    if isinstance(subject, str):
        return "we" if value.plural or subject in ("we", "you", "they") else "it"
    if isinstance(subject, Owned):
        return "we" if subject.noun.endswith(("lights", "lanes")) else "it"
    if isinstance(subject, Clause):
        return "it"
    if isinstance(subject.thing, Ego):
        return "we" if subject.ride or speaker.passenger else "I"
    return "we" if _is_plural(subject.thing) else "it"


def _is_plural(thing: Thing) -> bool:
    """Check whether a noun phrase of a thing is plural: "all bicycles", but "everybody"."""
    match thing:
        case Vehicles(numbers=numbers):
            return len(numbers) > 1
        case Everyone(kind=kind):
            return kind != "vehicle"
        case Described(plural=plural):
            return plural
    return False


def _rest(value: Clause, speaker: ReferringContext) -> str:
    return " ".join(
        part
        if isinstance(part, str)
        else fill(Slot(part, "object" if isinstance(part, Who) else "plain"), speaker)
        for part in value.rest
    )


def _string(value: str, form: str) -> str:
    """Return a text unchanged, as a quotation, or as a clause within a sentence."""
    text = " ".join(value.split())
    if form == "quoted":
        return f'"{text}"'
    if form == "clause":
        text = text.rstrip(".!? ")
        return text if text[:2] == "I " or text[1:2].isupper() else text[:1].lower() + text[1:]
    if form in ("plain", "full", "object"):
        return text
    raise FormError(f"text has no form {form!r}: plain, quoted or clause")
