"""Content of answers to what else could be done, whether it had to be, and why in this lane."""

from dataclasses import dataclass
from dataclasses import replace as changed
from typing import TypeAlias

from msgspec.structs import replace

from xavi_dialogue.explain.details import Choices, Need, Option, Staying
from xavi_dialogue.explain.explanation import Explanation
from xavi_dialogue.explain.query import Query, Tense
from xavi_dialogue.language.contrast import constraint, contrast
from xavi_dialogue.language.doings import LANE_CHANGES
from xavi_dialogue.language.morphology import EGO, Doing, Vehicle
from xavi_dialogue.language.points import Budget, Constraint, Contrast
from xavi_dialogue.language.quantities import Quantity
from xavi_dialogue.language.sights import SightPoint, sight_point
from xavi_dialogue.language.wording import lexicon

LISTED = 3  # options that are told one by one
RECENT = 2.0  # [s] up to which a decision is spoken of as made now


@dataclass(frozen=True, slots=True)
class OptionPoint:
    """Something else that could be done, and what would come of it."""

    doing: Doing
    past: bool
    outcome: str
    probability: float
    size: Quantity | None  # how much longer or shorter it takes; None where that is no matter
    more: bool
    struck: Vehicle | None


@dataclass(frozen=True, slots=True)
class OptionsPoint:
    """Answers to what else could be done, and what was the best or the worst of it."""

    about: str
    past: bool
    fact: Doing
    others: tuple[OptionPoint, ...]  # best first
    only: bool  # there was but one
    left: Quantity | None  # how many are not told
    worst: OptionPoint | None


@dataclass(frozen=True, slots=True)
class NeedPoint:
    """Answers to whether we had to."""

    asked: str
    kind: str
    past: bool
    foil: Doing | None
    dearer: bool  # the alternative has nothing for it
    contrast: Contrast | None
    constraint: Constraint | None


@dataclass(frozen=True, slots=True)
class StayPoint:
    """Answers to why we are in this lane."""

    moved: Doing | None  # the change of lane that brought us there, as it was done
    moving: Doing | None  # or is being done
    turned: Doing | None  # the turn after which we were in it
    since: Quantity | None
    only: bool
    same: bool
    reason: str | None
    contrast: Contrast | None


#: What is said of what a question asks for beyond its type.
Aspect: TypeAlias = SightPoint | OptionsPoint | NeedPoint | StayPoint


def aspect(query: Query, found: Explanation, budget: Budget, now: float) -> Aspect | None:
    """What to say of what is asked for beyond the type; None where nothing is."""
    if found.sight is not None:
        return sight_point(query, found, found.sight)
    if found.choices is not None:
        return options_point(query, found, found.choices, budget, now)
    if found.need is not None:
        return need_point(query, found, found.need, budget, now)
    if found.staying is not None:
        return stay_point(found, found.staying, budget)
    return None


def options_point(
    query: Query, found: Explanation, choices: Choices, budget: Budget, now: float
) -> OptionsPoint:
    """What to say of the other options."""
    tense = _tense(query, found, now)
    actions = (choices.chosen, *(option.action for option in choices.others))
    in_lane = any(action in LANE_CHANGES for action in actions)
    told = choices.others[: _listed(budget, len(choices.others))]
    left = len(choices.others) - len(told)
    return OptionsPoint(
        about=choices.about,
        past=tense == "past",
        fact=Doing(EGO, (choices.chosen,), tense, in_lane),
        others=tuple(_option(option, tense, in_lane) for option in told),
        only=len(choices.others) == 1,
        left=Quantity(left, "count") if left else None,
        worst=_option(choices.others[-1], tense, in_lane) if choices.others else None,
    )


def need_point(
    query: Query, found: Explanation, need: Need, budget: Budget, now: float
) -> NeedPoint:
    """What to say of whether we had to."""
    tense = _tense(query, found, now)
    deed = query.factual or query.counterfactual or ()
    drove = need.kind == "driving" and deed
    in_lane = any(a in LANE_CHANGES for a in (*found.factual[:1], need.foil or ""))
    against = _against(query, found, budget, tense)
    foil = (need.foil,) if need.foil is not None else ()
    return NeedPoint(
        asked=need.asked,
        kind=need.kind,
        past=tense == "past",
        foil=Doing(EGO, foil, tense, in_lane) if foil else None,
        dearer=against is not None and all(e.more for e in against.effects),
        contrast=against,
        constraint=constraint(query, deed, found, budget) if drove else None,
    )


def stay_point(found: Explanation, staying: Staying, budget: Budget) -> StayPoint:
    """What to say of why we are in our lane."""
    changed_lane = staying.deed in LANE_CHANGES
    tense: Tense = "past" if changed_lane else "present"
    asked = Query(type="why", tense=tense)
    if staying.deed is not None and changed_lane:
        asked = replace(asked, factual=(staying.deed,))
    deed = None if staying.deed is None else Doing(EGO, (staying.deed,), "past", True)
    reason = staying.reason
    return StayPoint(
        moved=deed if changed_lane and not staying.under_way else None,
        moving=changed(deed, tense="present") if deed and staying.under_way else None,
        turned=deed if not changed_lane else None,
        since=None if staying.since is None else Quantity(staying.since, "clock"),
        only=staying.only,
        same=staying.same,
        reason=reason,
        contrast=contrast(asked, found, budget)
        if found.counterfactual and found.outcome is not None and budget.purpose
        else None,
    )


def _listed(budget: Budget, count: int) -> int:
    """How many of the options are told one by one."""
    if budget.more:
        return count
    return LISTED if budget.particulars else LISTED - 1 if budget.purpose else 1


def _tense(query: Query, found: Explanation, now: float) -> Tense:
    past = query.tense == "past" or now - found.sim_time > RECENT
    return "past" if past else "present"


def _against(query: Query, found: Explanation, budget: Budget, tense: Tense) -> Contrast | None:
    """The contrast with the option that is named, by itself."""
    if not found.counterfactual or found.outcome is None:
        return None
    asked = replace(query, type="why", factual=None, tense=tense)
    return changed(contrast(asked, found, budget), fact=None)


def _option(option: Option, tense: Tense, in_lane: bool) -> OptionPoint:
    delta = option.delta
    matters = delta is not None and abs(delta) > lexicon().negligible["time"]
    return OptionPoint(
        doing=Doing(EGO, (option.action,), tense, in_lane),
        past=tense == "past",
        outcome=option.outcome,
        probability=option.probability,
        size=Quantity(abs(delta), "s") if delta is not None and matters else None,
        more=delta is not None and delta > 0.0,
        struck=None if option.collided_with is None else Vehicle(option.collided_with),
    )
