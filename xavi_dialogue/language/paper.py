"""Content of the paper's style: what its grammar is given (Gyevnar et al. 2022, section 3.4)."""

from dataclasses import dataclass

from xavi_dialogue.explain.explanation import Explanation
from xavi_dialogue.language.doings import plain
from xavi_dialogue.language.morphology import Term, Vehicle


@dataclass(frozen=True, slots=True)
class PaperScenario:
    """s: the counterfactual actions, their likeliest outcome and its probability."""

    actions: tuple[Term, ...]
    outcome: str
    probability: float
    collided_with: Vehicle | None


@dataclass(frozen=True, slots=True)
class PaperEffect:
    """One of e: how much a component of the reward would differ."""

    delta: float
    component: Term


@dataclass(frozen=True, slots=True)
class PaperCause:
    """One of c: what a vehicle does, and how probably."""

    vehicle: Vehicle
    actions: tuple[Term, ...]
    probability: float


@dataclass(frozen=True, slots=True)
class PaperContent:
    """What the start rule of the grammar takes."""

    scenario: PaperScenario
    effects: tuple[PaperEffect, ...]
    causes: tuple[PaperCause, ...]


def select_paper(found: Explanation, max_effects: int, max_causes: int) -> PaperContent:
    """The counterfactual, its largest effects and its first causes.

    Effects are differences between journeys that arrive: other outcomes have none. The paper
    puts them "in decreasing order by the absolute value" (below Equation 8), in their own units.
    """
    assert found.outcome is not None
    largest = sorted(found.effects, key=lambda effect: -abs(effect.delta))
    outcome = found.outcome
    struck = outcome.collided_with
    return PaperContent(
        scenario=PaperScenario(
            actions=_terms(found.counterfactual),
            outcome=outcome.name,
            probability=outcome.probability,
            collided_with=None if struck is None else Vehicle(struck),
        ),
        effects=tuple(
            PaperEffect(effect.delta, Term("component", effect.component))
            for effect in (largest[:max_effects] if outcome.name == "done" else ())
        ),
        causes=tuple(
            PaperCause(Vehicle(cause.vehicle), _terms(cause.actions), cause.probability)
            for cause in found.causes[:max_causes]
            if cause.actions
        ),
    )


def _terms(actions: tuple[str, ...]) -> tuple[Term, ...]:
    return tuple(Term("action", action) for action in plain(actions))
