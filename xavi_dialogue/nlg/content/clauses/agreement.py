"""Agreement: verbs for the grammars, by tense and number."""

#: Verbs by their names in the grammars: present and past.
_WORDS = {
    "is": ("is", "was"),
    "was": ("is", "was"),
    "are": ("are", "were"),
    "were": ("are", "were"),
    "has": ("has", "had"),
    "has_to": ("has to", "had to"),
    "have_to": ("have to", "had to"),
    "bright": ("are", "were"),
    "gives": ("gives", "gave"),
    "comes": ("comes", "came"),
    "goes": ("goes", "went"),
    "go": ("go", "went"),
    "depends": ("depends", "depended"),
    "do_not": ("do not", "did not"),
    "did_not": ("do not", "did not"),
    "would": ("would be", "would have been"),
    "here": ("here", "there"),
    "there": ("here", "there"),
    "these": ("these", "those"),
}
#: Verbs that agree with the subject: present and past singular, present and past plural.
_AGREEING = {
    "be": ("is", "was", "are", "were"),
    "have": ("has", "had", "have", "had"),
    "were_not": ("is not", "was not", "are not", "were not"),
    "have_not": ("has not", "has not", "have not", "have not"),
}


def verbs(past: bool, many: bool) -> dict[str, str]:
    """Return the verbs for a tense, and for one thing or many; "we" counts as many."""
    words = {name: pair[past] for name, pair in _WORDS.items()}
    return words | {name: row[2 * many + past] for name, row in _AGREEING.items()}
