"""Swapped: "do we have right of way or does he" asks the same of another, the other way round."""

from msgspec.structs import replace

from xavi_dialogue.domain.terms import Both, Everyone, Happens, Is, Proposition, Related


def swapped(of: Proposition) -> Proposition:
    """Put the two whom "or does he" names to each other: he has right of way over us, not him."""
    match of:
        case Both(contents=(Is() as one, other), join="or") if one == other:
            return one  # "are we late or on time?"
        case Both(
            contents=(Is(state="normal" | "right") as one, Is(state="wrong" | "at-fault")),
            join="or",
        ):
            return one  # "is that normal or a mistake?"
        case Both(
            contents=(Related(thing=one, to=to) as first, Related(thing=other) as later), join="or"
        ) if later == replace(first, thing=other) and to in (other, Everyone()):
            return replace(of, contents=(replace(first, to=other), replace(later, to=one)))
        case Both(contents=(Happens(event=first) as told, Happens(event=later)), join="or") if (
            later == replace(first, actor=later.actor) and later.object == later.actor
        ):  # "did you wait for him or did he?"
            return replace(of, contents=(told, Happens(replace(later, object=first.actor))))
    return of
