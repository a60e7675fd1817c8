"""Trips: questions of the ride and our way whose words name what is asked for otherwise.

"Why are we late?" asks who held us up; "what time did that cost us?" how much; "how many times did
we brake and for whom?" for a list; "anything else coming up?" what comes next.
"""

from typing import Any, Final

from msgspec.structs import replace

from xavi_dialogue.domain.meaning import (
    Doing,
    HowMany,
    HowMuch,
    HowSure,
    Listing,
    Peak,
    Question,
    Summarise,
    When,
    Whether,
    Which,
    Why,
)
from xavi_dialogue.domain.terms import (
    Compares,
    Described,
    Destination,
    Ego,
    Event,
    Everyone,
    Exists,
    Exit,
    Feature,
    Happens,
    Has,
    Is,
    Junction,
    Measured,
    Not,
    Passenger,
    Pronoun,
    Proposition,
    Related,
    Road,
    Unsaid,
    Wanted,
    WholeRide,
)
from xavi_dialogue.nlu.grounding.context import Context

SIDES: Final = {"left-of": "exit-left", "right-of": "exit-right", "ahead-of": "exit-straight"}
_DELAYED: Final = Which(Wanted(), Happens(Event("block", Wanted(), Ego(), time=WholeRide())))
_ANYTHING: Final = Described(definite=False)
_ANYBODY: Final = (_ANYTHING, Described(kind="car", definite=False))
_GOING: Final = frozenset(("go", "move", "turn"))
_LETTING_GO: Final = frozenset(("give-way", "let-go"))
_LISTED: Final = frozenset(("change-lane", "brake", "stop"))


def _is_long_turn(spoken: Question) -> bool:
    """Tell whether it is asked why a turn of ours took long."""
    match spoken:
        case Why(
            of=Compares(
                left=Measured(
                    "duration" | "delay",
                    event=Event(action="turn" | "exit-left" | "exit-right", actor=Ego()),
                    tense="past" | "perfect",
                ),
                comparator="more",
                right=None,
            ),
            suspect=None,
        ):
            return True
    return False


def of_trip(spoken: Question) -> Question | None:
    """Put the question of the ride or our way that is meant; None where it is another one."""
    return Peak("delay") if _is_long_turn(spoken) else _of_way(spoken)


def _of_way(spoken: Question) -> Question | None:
    match spoken:
        case Whether(that=that) if (way := right_way(that)) is not None:
            return replace(spoken, that=way)
        case HowSure(of=of) if of is not None and (way := right_way(of)) is not None:
            return Whether(way)
        case Whether(
            that=Compares(
                left=Measured(attribute="delay", thing=Described() as who, tense="present") as loss,
                comparator="more",
                right=None,
            )
        ) if who in _ANYBODY:  # "is something holding us up?": whatever it is
            return Which(Wanted(), Compares(replace(loss, thing=Wanted()), "more"))
        case Whether(that=Is(state="far" | "close", thing=Feature(kind="light") as light)):
            return HowMuch(Measured("distance", light))  # "is it far to the light?"
        case Whether(that=Is(state="present", thing=Destination(), tense="present" | "future")):
            return Whether(Happens(Event("arrive", Ego(), tense="perfect")))  # "is the end soon?"
        case Whether(that=Happens(event=of)) if _let_anybody(of):
            of = replace(of, object=Wanted(), time=WholeRide())
            return Which(Wanted(), Happens(of))  # "did you let anyone go first?"
        case Whether(that=that):
            meant = _whether(that)
            return meant if not isinstance(meant, Happens) else replace(spoken, that=meant)
        case Why(of=Is(state="late", thing=Ego() | Passenger() | None)):
            return _DELAYED
        case Which(
            thing=Wanted(),
            such=Happens(
                event=Event(action="go", actor=Wanted(), object=Ego(), manner=("first",)) as of
            ),
        ) if of.tense == "past" and of.modal is None:
            return _DELAYED  # "who went before us?"
        case Which(thing=Described() | Wanted() as whom, such=such) if _met(whom, such):
            return Listing("vehicles", Everyone(whom.kind), _ridden(such))
        case Which(thing=Described() | Wanted() as whom, such=Happens(event=of)) if _all_of(
            whom, of
        ):
            return Which(Wanted(whom.kind), Happens(replace(of, time=WholeRide())))
        case HowMany(of=Described(doing=Event(actor=Wanted(), tense="future") as to_come) as whom):
            among = () if whom.among is None else (whom.among,)  # whom we expect to do so
            return Which(Wanted(whom.kind), Happens(to_come), among)
        case HowMany(of=Described(doing=Event() as met, such=None) as whom) if _met(
            whom, Happens(met)
        ):
            return Listing("vehicles", Everyone(whom.kind), _ridden(Happens(met)))
        case HowMany(of=Described(doing=None, such=Related() as seen) as whom) if _met(
            replace(whom, such=None), seen
        ):
            return Listing("vehicles", Everyone(whom.kind), _ridden(seen))
        case When(of=Happens(event=Event(actor=Ego(), object=Described() as whom) as of)) if (
            whom in _ANYBODY and of.tense in ("past", "perfect")
        ):
            return When(Happens(replace(of, object=None)))  # "gave way to somebody"
        case When(of=Compares(left=Measured(attribute="delay") as left)):
            return HowMuch(left)  # "what time did that cost us?"
    return _listed(spoken)


def right_way(of: Proposition) -> Proposition | None:
    """Read "are we lost", "did you take a wrong turn" as whether we are on the way we should be."""
    right = Related("on", Ego(), Road("fitting"))
    match of:
        case Not(content=content) if (way := right_way(content)) is not None:
            return way.content if isinstance(way, Not) else Not(way, lexical=True)
        case (
            Related(thing=Ego(), to=Road(which="fitting"))
            | Related(relation="same-as", thing=Ego(), to=Road())
        ):
            return right
        case (
            Is(state="lost" | "astray", thing=Ego() | Passenger())
            | Related(thing=Ego(), to=Road(which="wrong"))
            | Happens(event=Event(actor=Ego(), object=Road(which="wrong")))
            | Happens(
                event=Event(
                    action="continue-next-exit",
                    actor=Ego(),
                    object=Exit() | Junction(form="junction"),
                    tense="past" | "perfect" | "future",
                )
            )
        ):
            return Not(right, lexical=True)
    return None


def _let_anybody(of: Event) -> bool:
    """Check whether an event is that we let just anybody go first, at any time of the ride."""
    anybody = of.object == _ANYTHING and isinstance(of.time, Unsaid | WholeRide)
    ours = of.actor == Ego() and of.action in _LETTING_GO and of.tense in ("past", "perfect")
    return anybody and ours


def _met(whom: Described | Wanted, such: Any) -> bool:
    """Say whether it is asked whom we met or saw on the way, of no place or colour."""
    if isinstance(whom, Described) and (whom.colour or whom.bearing or whom.extreme or whom.such):
        return False
    match such:
        case (
            Happens(event=Event(action="approach", actor=Ego(), object=Wanted(), tense=tense))
            | Related(relation="can-see", thing=Ego(), to=Wanted(), tense=tense)
        ):
            return tense in ("past", "perfect")
    return False


def _all_of(whom: Described | Wanted, of: Event) -> bool:
    """Say whether it is asked of all of a kind who ever did something: "which pedestrians".

    People cross one after another, so that who crossed may be several, too.
    """
    many = isinstance(whom, Described) and whom == Described(
        whom.kind, plural=True, definite=whom.definite
    )
    plain = many or (isinstance(whom, Wanted) and of.action == "cross")
    wanted = isinstance(of.actor, Wanted) or isinstance(of.object, Wanted)
    past = of.tense in ("past", "perfect") and of.modal is None
    return plain and wanted and past and of.time == Unsaid()


def _ridden(such: Any) -> Any:
    """Give the stretch in which somebody was met: all of the ride, where none is said."""
    time = such.event.time if isinstance(such, Happens) else such.time
    return WholeRide() if isinstance(time, Unsaid) else time


def _whether(that: Any) -> Question | Happens | None:
    """Give the question, or what is asked of our way, behind a yes or no question."""
    match that:
        case Happens(event=Event(actor=Ego(), where=Related(to=Ego()) as aside) as of):
            if aside.relation not in SIDES or of.action not in _GOING:
                return None
            action: Any = SIDES[aside.relation]  # "we go on the right side here, yes?"
            return Happens(replace(of, action=action, where=None))
        case (
            Happens(event=Event(action="head", actor=Ego(), object=None))
            | Not(content=Happens(event=Event(action="head", actor=Ego(), object=None)))
        ):
            return HowMuch(Measured("turn"))  # "is that where we are going?"
        case Related(relation="same-as", thing=Junction() as place, to=Described(kind="vehicle")):
            # "is this our turning, the one on the right?"
            return Whether(Related("same-as", place, Junction(rank=1)))
        case Compares(
            left=Measured(attribute="occupant") as who, right=Measured(attribute="occupant")
        ):
            return HowMuch(who)  # "is he a robber?"
        case Is(state="over", thing=Described(doing=Event(action="come"))):
            return Doing(tense="future")  # "anything else coming up?"
        case Is(state="over", thing=Ego(), event=None):
            return Whether(Happens(Event("arrive", tense="perfect")))  # "are we done?"
        case Happens(event=Event(action="come", actor=Junction() as place)):
            return Whether(Exists(place))  # "is that a roundabout coming?"
        case (
            Exists(
                thing=Described(
                    kind="vehicle", doing=Event(action="do", actor=Ego(), object=Wanted())
                )
                | Described(kind="vehicle", such=Is(state="wrong", thing=Wanted()))
            )
            | Happens(event=Event(action="do", actor=Ego(), object=Described()))
        ) if isinstance(that, Exists) or that.event.object == _ANYTHING:
            # "is there anything you'd do differently?"
            return Whether(Is("wrong", _ANYTHING, time=WholeRide(), tense="past"))
        case Happens(event=Event(action="happen", tense="future", object=None)):
            return Doing(tense="future")
    return None


def _listed(spoken: Question) -> Question | None:
    """Give the list that is asked for: each time, with when and for whom."""
    match spoken:
        case Summarise(about=Event(action=action) as of) if action in _LISTED:
            whole = WholeRide() if isinstance(spoken.time, Unsaid) else spoken.time
            return Listing("events", time=whole, event=replace(of, time=Unsaid()))
        case (
            Summarise(about=Described(doing=Event(actor=Wanted()) as of), time=time)
            | Listing(of="vehicles", about=Described(doing=Event(actor=Wanted()) as of), time=time)
        ) if of.tense != "present":  # who does something now is in view
            said = of.time if isinstance(time, Unsaid) else time
            return Listing("events", time=said, event=replace(of, time=Unsaid()))
        case HowMany(of=Event(actor=Ego(), object=Pronoun(form="who") | Wanted()) as of):
            return Listing("events", time=WholeRide(), event=replace(of, object=None))
        case When(of=Happens(event=Event(actor=Ego(), object=Wanted()) as of)):
            return Listing("events", time=of.time, event=replace(of, object=None, time=Unsaid()))
        case HowMany(
            of=Described(doing=Event(action="wait", actor=Ego(), object=Wanted()) as deed) as of
        ) if deed.tense == "past":
            let = replace(deed, action="give-way", modal=None)
            return replace(spoken, of=replace(of, doing=let))
    return None


def is_plain_to_see(of: Proposition) -> bool:
    """Say whether something is so or not, and no matter of what is expected."""
    while isinstance(of, Not):
        of = of.content
    match of:
        case Related(relation=relation, tense="present" | "perfect"):
            return relation != "has-priority-over"
        case Exists(tense="present") | Has(tense="present") | Compares(left=Measured()):
            return True
        case Is(state=state, tense="present"):
            return state != "sure"
    return of_trip(Whether(of)) is not None


def about_arriving(context: Context) -> bool:
    """Tell whether it was asked just now whether or when we arrive."""
    match context.discourse.question:
        case HowMuch(of=Measured(attribute="time-to-go" | "distance-to-go" | "arrival-time")):
            return True
        case Whether(that=Happens(event=Event(action="arrive"))):
            return True
        case When(of=Happens(event=Event(action="arrive"))):
            return True
    return False
