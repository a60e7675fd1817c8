"""Chances: words for probabilities, by the table `grammars/chances.toml`."""

import math

from xavi_dialogue.nlg.surface.tables import WordingError, table

LEAST = 0.01 - 1e-9  # from which a probability is stated in whole percent


def chance(probability: float, form: str) -> str:
    """Return a probability in words, or in percent with the form "percent".

    Raises:
        WordingError: the table has no words of that form.
    """
    if form in ("percent", "plain"):
        return percent(probability)
    for band in table("chances")["band"]:
        if probability >= band["from"] - 1e-9:
            if form not in band:
                raise WordingError(f"chances.toml has no form {form!r}")
            return str(band[form])
    raise WordingError(f"chances.toml has no band for {probability}")


def percent(probability: float) -> str:
    """Return a probability in whole percent, but never 0 % or 100 %; below 1 % in fixed words."""
    bounds = table("chances")["bounds"]
    whole = math.floor(probability * 100 + 0.5)
    if whole >= 100:
        return str(bounds["high"])
    return str(bounds["low"]) if probability < LEAST else f"{whole} %"
