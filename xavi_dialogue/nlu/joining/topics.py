"""Topics: "this red lorry, he has to wait": what is named first is what the pronoun means."""

from msgspec import structs

from xavi_dialogue.domain.meaning import (
    Act,
    Ask,
    Claim,
    Elliptic,
    Fault,
    HowKnow,
    HowMuch,
    Peak,
    Repair,
)
from xavi_dialogue.domain.rewriting import rewrite
from xavi_dialogue.domain.terms import (
    Described,
    Destination,
    Exit,
    Feature,
    Junction,
    Lane,
    Measured,
    Pronoun,
    Road,
    That,
    Thing,
    Unknown,
    Unsaid,
    Vehicle,
    WholeRide,
)
from xavi_dialogue.nlu.joining.alternatives import one_of
from xavi_dialogue.nlu.joining.apposition import apposed
from xavi_dialogue.nlu.joining.merging import grounds, merged

_FORMS = frozenset({"it", "he", "she", "that"})
_SEVERAL = frozenset({"they", "them-all", "those"})
_NEAREST = tuple(Peak("closeness", time) for time in (Unsaid(), WholeRide()))
_PLACES = (Junction, Exit, Lane, Road, Feature, Destination)
Owners = list[int | None]


def fold(acts: list[Act], owners: Owners) -> tuple[list[Act], Owners]:
    """Put a thing that is named by itself into the next act, where a pronoun stands for it."""
    for index in range(len(acts) - 1):
        act, later = acts[index : index + 2]
        one = merged(act, later) or apposed(act, later) or one_of(act, later)
        if one is None and _told_already(act, later):
            one = act
        if one is None:
            one = _spoken_of(act, later)
        if one is not None or _is_idle(act, later):
            owner = None if one is None else index
            moved = [
                owner if o == index else o - 1 if o is not None and o > index else o for o in owners
            ]
            rest = [*acts[:index], later if one is None else one, *acts[index + 2 :]]
            return fold(rest, moved)
        why = grounds(act, later)
        if why is not None:
            return fold([*acts[: index + 1], why, *acts[index + 2 :]], owners)
    return acts, owners


def _is_idle(act: Act, later: Act) -> bool:
    """Say whether an act says nothing that the next one needs."""
    if _is_opinion(act):
        return isinstance(later, Claim | Ask)
    spoken = getattr(act, "thing", None)
    place = isinstance(spoken, _PLACES) and isinstance(later, Ask)
    return (place or isinstance(spoken, Unknown)) and _topic_only(act)


def _spoken_of(act: Act, later: Act) -> Act | None:
    """Put a thing that is named by itself in the place of a pronoun; None where there is none."""
    topic = _topic(act)
    if topic is None or not isinstance(later, Ask | Claim):
        return None
    plural = isinstance(topic, Described) and topic.plural
    forms = _SEVERAL if plural else _FORMS
    told = rewrite(later, lambda part: topic if _is_form(part, forms) else part)
    return None if told is later else told


def _is_form(part: object, forms: frozenset[str]) -> bool:
    return isinstance(part, Pronoun) and part.form in forms


def _told_already(act: Act, later: Act) -> bool:
    """Say whether a bare "and why", or an opinion, asks what the answer before it tells anyway."""
    if isinstance(act, Claim) and _is_opinion(later):
        return True
    nearest = isinstance(act, Ask) and act.question in _NEAREST
    if nearest and later == Ask(HowMuch(Measured("distance", Pronoun("it")))):
        return True
    bare = later in (
        Repair(kind="why"), Elliptic(form="why"), Elliptic(form="when"), Ask(HowKnow())
    )  # fmt: skip
    return bare and isinstance(act, Ask) and isinstance(act.question, Peak | HowKnow)


def _is_opinion(act: Act) -> bool:
    """Say whether it is only said that what happened was unfair, rude or silly."""
    return isinstance(act, Ask) and act.question == Fault(That())


def _topic_only(act: Act) -> bool:
    """Say whether a thing without a sense is named and nothing more."""
    return isinstance(act, Elliptic) and act.event is None and act.form == "same"


def _topic(act: Act) -> Thing | None:
    match act:
        case Elliptic(thing=Feature(kind="light") as light, event=None, form="same", negated=False):
            return light
        case Elliptic(thing=Vehicle() | Described() as thing, event=None, time=Unsaid(),
                      negated=False, form="same", besides=False):  # fmt: skip
            return structs.replace(thing, definite=True) if isinstance(thing, Described) else thing
    return None
