"""Inflection: the forms of verbs and the plurals of nouns."""

_VOWELS = frozenset("aeiou")
FORMS = ("base", "third", "past", "part", "ing")


def verb_forms(lemma: str, irregular: str | None) -> list[tuple[str, str]]:
    """List (form, word) of a verb; `irregular` names all forms but the base."""
    if irregular is None:
        third, past, ing = _third(lemma), _past(lemma), _ing(lemma)
        return [("base", lemma), ("third", third), ("past", past), ("part", past), ("ing", ing)]
    found = [("base", lemma)]
    for form, words in zip(FORMS[1:], irregular.split(), strict=True):
        found += [(form, word) for word in words.split(",")]
    return found


def plural(noun: str) -> str:
    """Form the regular plural of a noun."""
    if noun.endswith(("s", "x", "ch", "sh", "z")):
        return noun + "es"
    if noun.endswith("y") and noun[-2:-1] not in _VOWELS:
        return noun[:-1] + "ies"
    return noun + "s"


def past_forms(lemma: str, pair: str | None) -> list[tuple[str, str]]:
    """List the forms of a verb of which past and participle alone are irregular."""
    if pair is None:
        return verb_forms(lemma, None)
    past, part = pair.split()
    return [
        ("base", lemma), ("third", _third(lemma)), ("past", past), ("part", part),
        ("ing", _ing(lemma)),
    ]  # fmt: skip


def _third(lemma: str) -> str:
    return plural(lemma) if not lemma.endswith("o") else lemma + "es"


def _past(lemma: str) -> str:
    if lemma.endswith("e"):
        return lemma + "d"
    if lemma.endswith("y") and lemma[-2:-1] not in _VOWELS:
        return lemma[:-1] + "ied"
    return lemma + "ed"


def _ing(lemma: str) -> str:
    if lemma.endswith("e") and not lemma.endswith("ee"):
        return lemma[:-1] + "ing"
    return lemma + "ing"
