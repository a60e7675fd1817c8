"""Morphology: tokens to words. Verb forms, references to vehicles, quantities, lists.

Each kind of value that an answer grammar may put into a slot has its dataclass here, and its
function below that gives its forms. References are resolved from left to right: a vehicle is
named in full once, and is "it" afterwards as long as no other has been named.

Errors:
    FormError    a grammar asks for a form that a value does not have
"""

from dataclasses import dataclass, field
from typing import Literal

from xavi_dialogue.explain.query import Tense
from xavi_dialogue.language.context import SpeechContext, VehicleWords
from xavi_dialogue.language.generator import Slot, Token
from xavi_dialogue.language.quantities import Quantity, Span, bare, quantity, span
from xavi_dialogue.language.rules import GrammarError, Word
from xavi_dialogue.language.wording import Lexicon, VerbForm, lexicon

EGO = 0
YOU = -1  # the ego, spoken to: in questions that the passenger may ask


class FormError(GrammarError):
    """A slot whose value has no such form."""


@dataclass(frozen=True, slots=True)
class Vehicle:
    """A vehicle to be referred to."""

    number: int


@dataclass(frozen=True, slots=True)
class Doing:
    """Actions of one vehicle, in order; at least one."""

    actor: int
    actions: tuple[str, ...]
    tense: Tense = "past"
    in_lane: bool = False  # going on is seen against a change of lane


@dataclass(frozen=True, slots=True)
class Term:
    """A name from the lexicon that only the paper's style uses."""

    kind: Literal["action", "component"]
    name: str


def inflect(
    tokens: tuple[Token, ...], context: SpeechContext, *, describe: bool = True
) -> tuple[tuple[str, ...], tuple[int, ...]]:
    """The words of the tokens in order, and the vehicles they name in order of first mention.

    With `describe`, a vehicle new to the conversation is described as well as named.

    Raises:
        FormError: a slot's value has no such form.
    """
    speaker = _Speaker(context, describe)
    words = tuple(t.text if isinstance(t, Word) else speaker.fill(t) for t in tokens)
    return words, tuple(speaker.mentioned)


@dataclass(slots=True)
class _Speaker:
    """One pass over the tokens of an utterance: the vehicles named so far."""

    context: SpeechContext
    describe: bool
    mentioned: list[int] = field(default_factory=list)
    words: Lexicon = field(default_factory=lexicon)

    def fill(self, slot: Slot) -> str:
        value, form = slot.value, slot.form
        if isinstance(value, Vehicle):
            return self._refer(value, form)
        if isinstance(value, Doing):
            return self._doing(value, form)
        if isinstance(value, Quantity):
            return bare(value) if form == "number" else quantity(value)
        if isinstance(value, Span):
            return span(value, form)
        if isinstance(value, Term):
            return self._term(value)
        if isinstance(value, tuple) and all(isinstance(v, Vehicle) for v in value):
            return listed([self._refer(v, "full") for v in value])
        if isinstance(value, str):
            return _string(value, form)
        raise FormError(f"no form {form!r} of {value!r}")

    def _refer(self, vehicle: Vehicle, form: str) -> str:
        if form not in ("plain", "full", "paper"):
            raise FormError(f"a vehicle has no form {form!r}: plain, full or paper")
        name = f"vehicle {vehicle.number}"
        if form == "plain" and self.mentioned == [vehicle.number]:
            return "it"
        if vehicle.number in self.mentioned:
            return name
        self.mentioned.append(vehicle.number)
        description = self._description(vehicle) if form == "plain" else None
        return f"{description} ({name})" if description else name

    def _description(self, vehicle: Vehicle) -> str | None:
        known = self.context.vehicles.get(vehicle.number, VehicleWords())
        if not self.describe or vehicle.number in self.context.named:
            return None
        return known.description or ("the truck" if known.kind == "truck" else None)

    def _term(self, term: Term) -> str:
        if term.kind == "component":
            return self.words.components[term.name]
        return self.words.action(term.name, "paper")

    def _doing(self, doing: Doing, form: str) -> str:
        """A verb phrase: finite in its tense (plain, not), supposed (had, had-not), or bare."""
        past = doing.tense == "past"
        match form:
            case "plain":
                return self._finite(doing)
            case "not":
                return self._denied(doing)
            case "had" if past:
                return f"had {self._verbs(doing, 'participle')}"
            case "had":
                return self._verbs(doing, "past")
            case "had-not" if past:
                return f"had not {self._verbs(doing, 'participle')}"
            case "had-not":
                return f"did not {self._verbs(doing, 'base')}"
            case "base" | "past" | "participle" | "gerund":
                return self._verbs(doing, form)
        raise FormError(f"actions have no form {form!r}")

    def _finite(self, doing: Doing) -> str:
        match doing.tense:
            case "past":
                return self._verbs(doing, "past")
            case "present":
                return f"{_be(doing)} {self._verbs(doing, 'gerund')}"
            case "future":
                return f"will {self._verbs(doing, 'base')}"

    def _denied(self, doing: Doing) -> str:
        match doing.tense:
            case "past":
                return f"did not {self._verbs(doing, 'base')}"
            case "present":
                return f"{_be(doing)} not {self._verbs(doing, 'gerund')}"
            case "future":
                return f"will not {self._verbs(doing, 'base')}"

    def _verbs(self, doing: Doing, form: VerbForm) -> str:
        own = {EGO: "my", YOU: "your"}.get(doing.actor, "its")
        variants = ["in-lane"] if doing.in_lane else []
        if doing.actor in (EGO, YOU):
            variants.append("ego")
        phrases = [
            self.words.inflect(self.words.action(a, *variants), form).format(own=own)
            for a in doing.actions
        ]
        return listed(phrases)


def _be(doing: Doing) -> str:
    return "am" if doing.actor == EGO else "is"


def _string(value: str, form: str) -> str:
    """Text from elsewhere: as it is, as a quotation, or as a clause within a sentence."""
    text = " ".join(value.split())
    if form == "quoted":
        return f'"{text}"'
    if form == "clause":
        text = text.rstrip(".!? ")
        return text if text[:2] == "I " or text[1:2].isupper() else text[:1].lower() + text[1:]
    if form in ("plain", "full"):
        return text
    raise FormError(f"text has no form {form!r}: plain, quoted or clause")


def listed(parts: list[str]) -> str:
    """The parts as people list them: a, b and c."""
    if len(parts) < 2:
        return "".join(parts)
    return f"{', '.join(parts[:-1])} and {parts[-1]}"
