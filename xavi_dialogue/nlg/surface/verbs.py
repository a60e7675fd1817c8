"""Verbs: conjugation of verb phrases whose first word is the verb."""

from dataclasses import dataclass
from typing import Literal

from xavi_dialogue.nlg.surface.tables import table
from xavi_dialogue.nlg.surface.values import Tense

Form = Literal["base", "past", "participle", "gerund", "third"]
Person = Literal["I", "we", "it"]  # first singular; plural; third singular
_COLUMNS: dict[Form, int] = {"past": 0, "participle": 1, "gerund": 2, "third": 3}
_BE: dict[tuple[str, Person], str] = {
    ("present", "I"): "am",
    ("present", "we"): "are",
    ("present", "it"): "is",
    ("past", "I"): "was",
    ("past", "we"): "were",
    ("past", "it"): "was",
}


@dataclass(frozen=True, slots=True)
class Conjugated:
    """A verb phrase in its parts; `auxiliary` is the word that is inverted or negated."""

    auxiliary: str  # "" for a simple tense: "turned"
    support: str  # the auxiliary in a negation or question: "did"
    verbs: str  # without the auxiliary: "have been turning"
    plain: str  # the main verb and what precedes it in an affirmative clause


def inflect(phrase: str, form: Form) -> str:
    """Return the phrase with its verb, the first word, in a form."""
    verb, _, rest = phrase.partition(" ")
    return f"{_form(verb, form)} {rest}".strip()


def conjugate(
    phrase: str, tense: Tense, person: Person, *, progressive: bool, modal: str | None
) -> Conjugated:
    """Return the parts of a verb phrase in a tense, for a person."""
    head, tail = _auxiliaries(tense, person, modal)
    form: Form = "base"
    if tail == "have":
        form = "participle"
    chain = [] if tail in ("", "simple") else [tail]
    if progressive:
        chain.append({"participle": "been", "base": "be"}[form])
        form = "gerund"
    if tail != "simple":
        if head.startswith("have-"):
            head, form = head.removeprefix("have-"), form
            chain = chain[1:] if chain[:1] == ["have"] else chain
        return _with(head, [*chain, inflect(phrase, form)])
    return _simple(phrase, tense, person, progressive)


def _auxiliaries(tense: Tense, person: Person, modal: str | None) -> tuple[str, str]:
    """Return the first auxiliary, and the form that follows: "" (base), "have" or "simple"."""
    if modal is not None:
        return modal, "have" if tense in ("past", "perfect", "conditional-perfect") else ""
    match tense:
        case "future":
            return "will", ""
        case "conditional":
            return "would", ""
        case "conditional-perfect":
            return "would", "have"
        case "perfect":
            return f"have-{'has' if person == 'it' else 'have'}", "have"
        case "past-perfect":
            return "have-had", "have"
        case "past" | "present":
            return "", "simple"


def _simple(phrase: str, tense: str, person: Person, progressive: bool) -> Conjugated:
    past = tense == "past"
    be = _BE["past" if past else "present", person]
    if progressive:
        return _with(be, [inflect(phrase, "gerund")])
    verb, _, rest = phrase.partition(" ")
    if verb == "be":
        return _with(be, [rest] if rest else [])
    do = "did" if past else "does" if person == "it" else "do"
    form: Form = "past" if past else "third" if person == "it" else "base"
    return Conjugated("", do, phrase, inflect(phrase, form))


def _with(auxiliary: str, verbs: list[str]) -> Conjugated:
    rest = " ".join(verbs)
    return Conjugated(auxiliary, auxiliary, rest, rest)


def _form(verb: str, form: Form) -> str:
    if form == "base":
        return verb
    known = table("verbs")["irregular"].get(verb)
    if known is not None and form != "third":
        return str(known[_COLUMNS[form]])
    if form == "third":
        return _third(verb)
    stem = verb[:-1] if verb.endswith("e") else verb
    if verb[-2:-1] not in "aeiou" and verb.endswith("y") and form != "gerund":
        stem = f"{verb[:-1]}i"
    if form == "gerund":
        return f"{verb if verb.endswith('ee') else stem}ing"
    return f"{stem}ed"


def _third(verb: str) -> str:
    special = {"be": "is", "have": "has", "do": "does", "go": "goes"}
    if verb in special:
        return special[verb]
    if verb.endswith(("s", "sh", "ch", "x", "z")):
        return f"{verb}es"
    if verb.endswith("y") and verb[-2] not in "aeiou":
        return f"{verb[:-1]}ies"
    return f"{verb}s"
