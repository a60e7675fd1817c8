"""Paper: contrasts in the sentences of Gyevnar et al. 2022, by the grammar of its appendix.

The grammar gives a raw sentence, which the rules of `grammars/paper.toml` smooth. Only contrasts
have such sentences; all other answers are worded for passengers in this style too.
"""

import re
from dataclasses import dataclass
from functools import cache

from xavi_dialogue.domain.answers import (
    Again,
    Answer,
    ChoiceReason,
    Contrast,
    Judged,
    Refusal,
    SupposedOfUs,
)
from xavi_dialogue.nlg.content.clauses.manoeuvres import plain
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.generator import expand
from xavi_dialogue.nlg.surface.orthography import capitalise, join
from xavi_dialogue.nlg.surface.rules import Word, load_grammar
from xavi_dialogue.nlg.surface.tables import table, word


@dataclass(frozen=True, slots=True)
class Scenario:
    """s: the counterfactual actions, their likeliest outcome and its probability."""

    actions: tuple[str, ...]
    outcome: str
    probability: float
    collided_with: str | None


@dataclass(frozen=True, slots=True)
class PaperEffect:
    """One of e: a difference in a component of the reward."""

    delta: float
    component: str


@dataclass(frozen=True, slots=True)
class PaperCause:
    """One of c: the actions of a vehicle, and their probability."""

    vehicle: str
    actions: tuple[str, ...]
    probability: float


def paper_text(answer: Answer | Refusal, context: SpeechContext) -> str | None:
    """Return the sentence of a contrast in the paper's words; None for all other answers."""
    contrast = contrast_of(answer)
    if contrast is None:
        return None
    return capitalise(smoothed(join(raw_words(contrast, context))))


def contrast_of(answer: Answer | Refusal) -> Contrast | None:
    """Return the contrast that the paper has a sentence for."""
    if isinstance(answer, Again | Judged) and answer.answer is not None:
        return contrast_of(answer.answer)
    if isinstance(answer, ChoiceReason | SupposedOfUs):
        contrast = answer.contrast
        return contrast if contrast.foil and contrast.outcome is not None else None
    return None


def raw_words(contrast: Contrast, context: SpeechContext) -> tuple[str, ...]:
    """Return the words that the grammar gives, before they are smoothed.

    Effects are differences between rollouts that arrive; other outcomes have none. The paper
    puts them "in decreasing order by the absolute value" (below Equation 8), in their own units.
    """
    outcome = contrast.outcome
    assert outcome is not None
    struck = outcome.collided_with
    named = None if struck is None else _vehicle(struck)
    scenario = Scenario(_actions(contrast.foil), outcome.name, outcome.probability, named)
    largest = sorted(contrast.effects, key=lambda effect: -abs(effect.delta))
    kept = largest[: context.max_effects] if outcome.name == "done" else []
    effects = tuple(
        PaperEffect(effect.delta, word("paper", "components", effect.component)) for effect in kept
    )
    causes = tuple(
        PaperCause(_vehicle(cause.vehicle), _actions(cause.actions), cause.probability)
        for cause in contrast.causes[: context.max_causes]
        if cause.actions
    )
    tokens = expand(load_grammar("answer_paper"), "S", scenario, effects, causes)
    return tuple(t.text if isinstance(t, Word) else str(t.value) for t in tokens)


def mentioned(text: str) -> tuple[int, ...]:
    """Return the vehicles that a sentence names, in order of first mention."""
    found = re.findall(r"\bvehicle (\d+)\b", text)
    return tuple(dict.fromkeys(int(number) for number in found))


def smoothed(text: str) -> str:
    """Apply the rules of the file, each of them until it no longer matches."""
    present = table("paper")["present"]
    for find, put in _rules():
        for _ in range(len(text)):  # a rule whose result matches again is cut off
            match = find.search(text)
            if match is None:
                break
            past = match.groupdict().get("past") or ""
            new = match.expand(put.replace("<present>", present.get(past, "")))
            text = text[: match.start()] + new + text[match.end() :]
    return text


@cache
def _rules() -> tuple[tuple[re.Pattern[str], str], ...]:
    section = table("paper")
    past = "|".join(map(re.escape, section["present"]))
    adverb = "|".join(section["adverbs"])
    made = []
    for rule in section["rule"]:
        find = rule["find"].replace("<adverb>", f" (?:{adverb})")
        made.append((re.compile(find.replace("<past>", f"(?P<past>{past})")), rule["put"]))
    return tuple(made)


def _vehicle(number: int) -> str:
    return f"vehicle {number}"


def _actions(actions: tuple[str, ...]) -> tuple[str, ...]:
    return tuple(word("paper", "actions", action) for action in plain(actions))
