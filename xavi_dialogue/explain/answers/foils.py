"""Foils: what the ego did not do, as a question names it, and where it could have done it."""

from planner.trace import Action as MacroAction
from xavi_dialogue.domain.answers import DidNotHappen
from xavi_dialogue.domain.terms import Event, Exit
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reading import check_able, is_past, subject
from xavi_dialogue.explain.causes.actions import (
    CHANGES,
    DRIVING,
    STRAIGHT,
    TURNS,
    means,
    names_of,
    sequence,
    to_macros,
)
from xavi_dialogue.explain.causes.premise import (
    Premise,
    Subject,
    about_foil,
    episode_of,
    happened,
    is_open,
    options_known,
    premise,
)

#: Ways to leave a roundabout at an exit, the usual one first.
LEAVING: tuple[MacroAction, ...] = ("exit-right", "exit-straight", "exit-left")
MANOEUVRES = frozenset[ActionName]((*CHANGES, *TURNS, "stop", "overtake", "exit-straight"))


def foil_at(
    event: Event, scene: Asked, deed: Event | None = None
) -> tuple[Premise, tuple[MacroAction, ...]]:
    """Find the decision at which something could have been done, and what that is to the planner.

    Raises:
        Unanswered: it is what was done; or it cannot be done at all.
    """
    check_able(event)
    names = settled(scene, event)
    names = tuple("stop" if name in DRIVING - {"speed-up"} else name for name in names)
    if deed is None:
        check_undone(scene, event, names)
    past = is_past(scene, event)
    ring = earlier_exit(event, scene)
    if ring is not None:
        return ring
    about = subject(scene, deed) if deed is not None else Subject(None, (), past, scene.span)
    if len(names) > 1 or deed is None:
        found = about_foil(scene.ride, about, names[:1])
    else:
        found = premise(scene.ride, about)
    steps = (name for step in sequence(event)[1:] for name in settled(scene, step)[:1])
    later = tuple(name for name in steps if means(name))
    foil = to_macros(scene.ride.model(found.trace), (names[0], *later), found.node)
    return found, foil


def earlier_exit(event: Event, scene: Asked) -> tuple[Premise, tuple[MacroAction, ...]] | None:
    """Find the decision to go past an exit of a roundabout, where that exit is asked about."""
    if event.action == "continue-next-exit":  # the exit named is the one that it goes on to
        return None
    named = isinstance(event.object, Exit) and event.object.rank is not None
    if not named and not (event.action == "leave" and event.side is None):
        return None
    passed = [d for d in scene.ride.deeds if d.action == "continue-next-exit"]
    if not passed:
        return None
    rank = event.object.rank if isinstance(event.object, Exit) else None
    last = scene.pick(passed, lambda d: d.span) or passed[-1]
    deed = passed[rank - 1] if rank is not None and 0 < rank <= len(passed) else last
    trace = scene.ride.choice_of(deed)
    here = [exit_ for exit_ in LEAVING if is_open(scene.ride, trace, (exit_,))]
    return (Premise(trace, deed), (here[0],)) if here else None


def settled(scene: Asked, event: Event) -> tuple[ActionName, ...]:
    """Name what is asked about, with the side that the record settles where none is said.

    A foil is to the side that was possible; both where both were.
    """
    names = names_of(event)
    if names == ("overtake",):
        return options_known(scene.ride, CHANGES) or CHANGES
    if len(names) == 1:
        return names
    macros = tuple(m for name in names for m in means(name))
    trace = scene.ride.at(scene.moment)
    here = [] if trace is None else [m for m in macros if is_open(scene.ride, trace, (m,))]
    return tuple(here) or options_known(scene.ride, macros) or names


def check_undone(scene: Asked, event: Event, names: tuple[ActionName, ...]) -> None:
    """Decline to say why not, where it is what we did; driving on is not held against it.

    Raises:
        Unanswered: we did it.
    """
    if event.then is not None or event.object is not None or not set(names) <= MANOEUVRES:
        return
    if not is_past(scene, event):
        return
    deed = happened(scene.ride, names, scene.span)
    if deed is not None and deed.action not in STRAIGHT:
        raise Unanswered(DidNotHappen(event, (episode_of(deed),), elsewhen=None))


def named_foil(
    scene: Asked, instead: Event | None, found: Premise
) -> tuple[MacroAction, ...] | None:
    """Express the contrast that a question draws in what the planner chooses from."""
    if instead is None:
        return None
    names = tuple(name for step in sequence(instead) for name in settled(scene, step)[:1])
    return to_macros(scene.ride.model(found.trace), names, found.node)
