"""Suspects: whether the vehicle that a question takes for the cause is one, and the only one."""

from collections.abc import Collection

from msgspec.structs import replace

from xavi_dialogue.domain.answers import Answer, ChoiceReason, MotionReason
from xavi_dialogue.domain.evidence import Causation
from xavi_dialogue.domain.reasons import Suspected

#: Parts of those that are no reason.
CLEARED = frozenset[Suspected](("none", "neither"))


def with_suspect(
    found: Answer, suspect: int | None, rival: int | None = None, *, alone: bool = False
) -> Answer:
    """Add whether the vehicle that the question takes for the cause is one.

    If it is, it comes first, so that the answer is about it; a light precedes it.

    Args:
        found: the reason.
        suspect: the vehicle.
        rival: another vehicle that the question names; the one that is more of a cause counts.
        alone: the question takes it for the only cause, so others are stated, too.
    """
    if suspect is None or not isinstance(found, ChoiceReason | MotionReason):
        return found
    named = blamed(found)
    besides: tuple[int, ...] = ()
    if rival is not None:
        asked = [vehicle for vehicle in named if vehicle in (suspect, rival)]
        asked.sort(key=lambda vehicle: _same_without(found, vehicle))
        suspect = asked[0] if asked else suspect
        part: Suspected = "either" if asked else "neither"
    elif suspect in named and _same_without(found, suspect):
        part = "same"
    else:
        part = _part(found, named, suspect)
        if alone and part != "none":
            besides = tuple(vehicle for vehicle in named if vehicle != suspect)
            others = besides or _road_too(found) or _unnamed(found)
            part = "beside" if others else _alone(found)
    if isinstance(found, ChoiceReason):
        ahead = found.ahead
        if part == "none" and ahead is not None and ahead.vehicle == suspect:
            ahead = None  # its place does not matter
        ranked = sorted(found.contrast.causes, key=lambda cause: cause.vehicle != suspect)
        against = replace(found.contrast, causes=tuple(ranked))
        told = replace(found, contrast=against, ahead=ahead)
        return replace(told, suspect=suspect, suspected=part, besides=besides)
    motive = sorted(found.causes, key=lambda c: (c.kind != "light", c.vehicle != suspect))
    return replace(found, causes=tuple(motive), suspect=suspect, suspected=part, besides=besides)


def with_suspects(
    found: Answer, suspects: tuple[int, ...], *, which: bool = False, together: bool = False
) -> Answer:
    """Add whether several vehicles that the question takes for the cause all are.

    Args:
        found: the reason.
        suspects: the vehicles.
        which: the question is which of them is, or is more of a cause.
        together: they are one group, as people who cross; those of them that are a cause count.
    """
    if not isinstance(found, ChoiceReason | MotionReason):
        return found
    reason: ChoiceReason | MotionReason = found
    counted = tuple(v for v in blamed(reason) if v in suspects)
    deciding = tuple(v for v in counted if not _same_without(reason, v))
    guilty = (deciding or counted) if which else counted
    if not guilty:
        told = with_suspect(found, suspects[0])
        assert isinstance(told, ChoiceReason | MotionReason)
        return replace(told, suspected="neither" if which else "none", besides=suspects[1:])
    told = with_suspect(found, guilty[0])
    assert isinstance(told, ChoiceReason | MotionReason)
    if together and len(guilty) < len(suspects):
        return told
    if len(guilty) == len(suspects):
        return replace(told, suspected="all-alike" if which else "all", besides=guilty[1:])
    besides = tuple(vehicle for vehicle in suspects if vehicle not in guilty)
    single = which and len(guilty) == 1
    return replace(told, suspected="which" if single else "some", besides=besides)


def meant_on_foot(
    found: Answer, named: tuple[int, ...], walkers: Collection[int]
) -> tuple[int, ...]:
    """Give the people whom a question suspects: a passenger does not know which of them it was.

    Args:
        found: the reason.
        named: those whom the question names.
        walkers: all who are on foot.
    """
    if not isinstance(found, ChoiceReason | MotionReason):
        return named
    guilty = tuple(vehicle for vehicle in blamed(found) if vehicle in walkers)
    return named if set(guilty) & set(named) else guilty or named


def or_road(found: Answer, kinds: Collection[str]) -> Answer:
    """State the reason alone where the question is whether it is somebody or the light or a bend.

    It names them, or both; where it is neither, that comes first.
    """
    if not isinstance(found, ChoiceReason | MotionReason) or found.suspected is None:
        return found
    road = isinstance(found, MotionReason) and any(one.kind in kinds for one in found.causes)
    if found.suspected not in CLEARED:
        return replace(found, suspected="either", besides=())
    return replace(found, suspected=None if road else "neither", besides=())


def blamed(found: ChoiceReason | MotionReason) -> list[int]:
    """List the vehicles that are causes, most important first."""
    if isinstance(found, MotionReason):
        named = [cause.vehicle for cause in found.causes if cause.vehicle is not None]
        return list(dict.fromkeys((*named, *_jointly(found))))
    against = found.contrast
    named = [cause.vehicle for cause in against.causes]
    if against.decisive == "collision" and against.collided_with is not None:
        named = [against.collided_with, *named]
    if found.ahead is not None and found.ahead.vehicle is not None and not _by_the_way(found):
        named = [found.ahead.vehicle, *named]
    return list(dict.fromkeys((*named, *_jointly(found))))


def _by_the_way(found: ChoiceReason) -> bool:
    """Check whether the vehicle in the lane we did not take had no part in the decision."""
    ahead, against = found.ahead, found.contrast
    if ahead is None or ahead.kind not in ("lane-beside", "lane-ahead"):
        return False
    caused = any(cause.vehicle == ahead.vehicle for cause in against.causes)
    return not caused and against.decisive not in (None, "time", "late", "collision")


def causation_of(found: ChoiceReason | MotionReason) -> Causation | None:
    """Return what was found about the vehicles that an action depends on."""
    return found.causation if isinstance(found, MotionReason) else found.contrast.causation


def _jointly(found: ChoiceReason | MotionReason) -> tuple[int, ...]:
    causation = causation_of(found)
    return () if causation is None else causation.jointly


def _unnamed(found: ChoiceReason | MotionReason) -> bool:
    """Check whether several are the cause together, but it is not known which are needed."""
    causation = causation_of(found)
    return causation is not None and not causation.minimal


def _same_without(found: ChoiceReason | MotionReason, suspect: int) -> bool:
    """Check whether we do the same without a vehicle that speaks against the alternative.

    For several that do so together, it is whether we do the same without all of them.
    """
    causation = causation_of(found)
    if not isinstance(found, ChoiceReason) or causation is None:
        return False
    if causation.kind in ("one", "both"):
        causes = found.contrast.causes
        return any(c.vehicle == suspect and c.decision_changes is False for c in causes)
    return suspect in causation.vehicles and not causation.decides


def _alone(found: ChoiceReason | MotionReason) -> Suspected:
    """Return "alone" for the only cause if planning again showed that, else "main"."""
    causation = causation_of(found)
    tried = causation is not None and causation.kind in ("one", "pre-empted")
    return "alone" if tried else "main"


def _road_too(found: ChoiceReason | MotionReason) -> bool:
    """Check whether something in the road is a reason besides a vehicle."""
    return isinstance(found, MotionReason) and any(
        cause.vehicle is None and cause.kind != "plan" for cause in found.causes
    )


def _part(found: ChoiceReason | MotionReason, named: list[int], suspect: int) -> Suspected:
    if suspect not in named:
        return "none"
    causation = causation_of(found)
    causes = found.causes if isinstance(found, MotionReason) else found.contrast.causes
    told = any(cause.vehicle == suspect for cause in causes)
    both = causation is not None and causation.kind == "both" and told
    lit = isinstance(found, MotionReason) and any(cause.kind == "light" for cause in found.causes)
    return "main" if (both or named[0] == suspect) and not lit else "part"
