"""Random sentences: forms of questions, filled with the predicates of the lexicon."""

from collections.abc import Iterable, Mapping
from functools import cache
from random import Random

from xavi_dialogue.nlu.grammar.inflect import verb_forms
from xavi_dialogue.nlu.text.tables import load, phrases

#: Forms of questions; names in braces are slots.
FORMS = (
    *("why did {we} {base}", "why didn't {we} {base} {tail}", "why did {it} {base} {tail}"),
    *("why are {we} {ing}", "why is {it} {ing} {tail}", "why not {base} {tail}"),
    *("what if {we} had {part} {tail}", "what if {it} had not {part}"),
    *("what if {it} were not there", "what would have happened if {we} had {part}"),
    *("would {we} have {part} without {it}", "would you still have {part} if {it} had {part}"),
    *("did {it} {base} {tail}", "is {it} {ing}", "when did {it} {base}"),
    *("when will {we} {base} {tail}", "how often did {we} {base}", "how long did {it} {base}"),
    *("how long have {we} been {ing}", "where did {we} {base}", "who {past} {tail}"),
    *("which {kind} {past}", "which {kind} is {adjective}", "who is {it}"),
    *("how {grade} is {it}", "how {grade} were {we} {time}", "what is {it} doing"),
    *("what is {it}", "what {colour} is {it}", "where is {it}", "where is {it} going"),
    *("how many {kind}s are there", "is {it} {bearing} us", "was {it} {adjective}"),
    *("was it {adjective} to {base} {tail}", "did you see {it} {time}"),
    *("how do you know that {it} will {base}", "how sure are you that {it} {past}"),
    *("is {it} {compare} than {it}", "who was {compare}", "do {we} have to {base} {tail}"),
    *("should {we} have {part} {tail}", "could {we} {base} {tail}", "{we} {past} {tail}, right"),
    *("{it} {past} {tail}", "that is not true, {it} was {ing}", "please {base} {tail}"),
    *("{base} {tail}", "and {it}", "what about {it}", "and if {it} had not {part}"),
    *("I feel {feeling} because of {it}", "tell me what happened {time}"),
    *("what did {we} do {time}", "whose fault was it that {we} {past}"),
)  # fmt: skip
TIMES = (
    *("", "", "now", "just now", "at 0:04", "five seconds ago", "then", "before the junction"),
    *("when we stopped", "after that", "at the beginning", "so far", "the first time"),
)
ACTORS = ("you", "we", "the car", "our car", "you and I")
BEARINGS = ("behind", "ahead of", "next to", "in front of", "to the left of", "near", "faster than")


def sentence(rng: Random) -> str:
    """Draw a sentence."""
    form = rng.choice(FORMS)
    while "{" in form:
        before, _, rest = form.partition("{")
        slot, _, behind = rest.partition("}")
        form = f"{before}{_filled(slot, rng)}{behind}"
    return " ".join(form.split())


def _filled(slot: str, rng: Random) -> str:
    """Draw the words for a slot."""
    match slot:
        case "base" | "past" | "part" | "ing":
            return _verb(slot, rng)
        case "we":
            return rng.choice(ACTORS)
        case "it":
            return _thing(rng)
        case "tail":
            place = rng.choice(_words("PLACEN"))
            return rng.choice(("", "", _thing(rng), f"to the {place}", _time(rng)))
        case "time":
            return _time(rng)
        case "bearing":
            return rng.choice(BEARINGS)
    return rng.choice(_words(CLASSES[slot]))


#: Slots that are filled with any word of a class.
CLASSES: Mapping[str, str] = {
    "kind": "KIND",
    "colour": "COLOUR",
    "adjective": "ADJ",
    "grade": "GRADE",
    "compare": "COMPAR",
    "feeling": "FEELADJ",
}


def _time(rng: Random) -> str:
    return rng.choice(TIMES)


def _thing(rng: Random) -> str:
    """Draw a phrase for another road user, by number or description."""
    kind, colour = rng.choice(_words("KIND")), rng.choice(_words("COLOUR"))
    bearing = rng.choice(_words("BEARADJ"))
    return rng.choice(
        (
            *(f"vehicle {rng.randrange(6)}", "it", "he", "they", "somebody"),
            *(f"the {kind}", f"that {colour} {kind}", f"the {kind} {bearing}"),
            *(f"the other {kind}", f"a {colour} {kind}"),
        )
    )


def _verb(form: str, rng: Random) -> str:
    return rng.choice(_verbs()[form])


@cache
def _verbs() -> Mapping[str, tuple[str, ...]]:
    """Return the forms of all verbs that have a sense."""
    table = load("nlu_verbs.toml")
    found: dict[str, list[str]] = {}
    forms = table["forms"]
    for lemma in table["senses"]:
        verb, _, rest = lemma.partition(" ")
        for form, word in verb_forms(verb, forms.get(lemma, forms.get(verb))):
            found.setdefault(form, []).append(f"{word} {rest}".strip())
    return {form: tuple(words) for form, words in found.items()}


@cache
def _words(name: str) -> tuple[str, ...]:
    """Return the phrases of a word class, without those that are unusual."""
    listed: Iterable[str] = load("nlu_words.toml")[name].values()
    return tuple(
        " ".join(words) for row in listed for words in phrases(row) if not words[0].startswith("*")
    )
