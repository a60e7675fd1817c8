"""Besides: what stands beside a question in the same breath, and is no question of its own.

What is named or told there is the setting: it becomes a claim, which says who and when is meant
and is not replied to. "Do you know?" behind a question asks nothing more.
"""

from collections.abc import Sequence

from msgspec import structs

from xavi_dialogue.domain.meaning import (
    Act,
    Ask,
    Claim,
    Elliptic,
    HowKnow,
    HowMany,
    HowMuch,
    Identify,
    Listing,
    Peak,
    Repair,
    Request,
    WhatIf,
    When,
    Where,
    Whether,
    Which,
    Whither,
    Why,
)
from xavi_dialogue.domain.rewriting import first
from xavi_dialogue.domain.terms import (
    Ago,
    At,
    AtDecision,
    Back,
    Believed,
    Both,
    Caused,
    Compares,
    Described,
    Ego,
    Event,
    Exists,
    Exit,
    Happens,
    Has,
    Is,
    Measured,
    Not,
    Pronoun,
    Proposition,
    Relative,
    Road,
    That,
    Unsaid,
    Vehicle,
    Wanted,
    WholeRide,
)
from xavi_dialogue.nlu.compose.clauses.times import relative
from xavi_dialogue.nlu.compose.verbs.trends import changed
from xavi_dialogue.nlu.honesty import is_well_typed
from xavi_dialogue.nlu.joining.halves import halved
from xavi_dialogue.nlu.joining.outcomes import asks_whom
from xavi_dialogue.nlu.joining.recalling import of_deeds
from xavi_dialogue.nlu.joining.there import to_lane
from xavi_dialogue.nlu.joining.unchanged import as_it_is

_MOMENTARY = frozenset({"speed", "distance", "gap", "clearance", "limit", "acceleration",
                        "headway"})  # fmt: skip
_OVER = (Ago, At, AtDecision, Back, WholeRide)  # times at which nothing can be bidden


def settled(acts: Sequence[Act | None], asked: list[bool], stated: list[bool]) -> list[Act | None]:
    """Read each act as it stands beside the others; None: it says nothing of its own.

    Args:
        acts: of an utterance.
        asked: whether each is the last of a sentence that ends with a question mark.
        stated: whether each stands in a sentence that ends otherwise, where another one asks.
    """
    acts = [_left(act and as_it_is(act), acts[:k]) for k, act in enumerate(acts)]
    if any(isinstance(act, Ask) and not told for act, told in zip(acts, stated, strict=True)):
        last = max(k for k, told in enumerate(stated) if isinstance(acts[k], Ask) and not told)
        acts = [_told(a, k < last) if stated[k] else a for k, a in enumerate(acts)]
    acts = acts if any(asked[:-1]) else _why_so(acts)
    questions = [index for index, act in enumerate(acts) if isinstance(act, Ask | Request)]
    if not questions:
        return list(acts)
    found: list[Act | None] = []
    for index, act in enumerate(acts):
        before = next((one for one in reversed(found) if one is not None), None)
        known = (act == Ask(HowKnow()) and any(map(_asks_grounds, found))) or act in found
        if act is None or known or (before is not None and _is_told(before, act)):
            found.append(None)
            continue
        if before is not None:
            act = _at_limit(before, _of_each(before, _than_it(before, act)))
            act = of_deeds(before, halved(before, act))
            act = _of_trend(before, _of_ours(before, _of_exits(before, _linked(before, act))))
        alone = asked[index] and isinstance(act, Elliptic)  # "and the bus?"
        found.append(_setting(act) if index < questions[-1] and not alone else act)
    return found


def _why_so(acts: Sequence[Act | None]) -> list[Act | None]:
    """Read "on a motorway, behind a lorry. Why?" as the question why we drive as we do."""
    named = [act for act in acts[:-1] if act is not None]
    things = [act.thing for act in named if isinstance(act, Elliptic) and act.form == "same"]
    vague = any(isinstance(t, Road) or not getattr(t, "definite", True) for t in things)
    if not vague or len(things) < len(named) or acts[-1] != Elliptic(form="why"):
        return list(acts)
    return [*acts[:-1], Ask(Why(That()))]


def _left(act: Act | None, before: Sequence[Act | None]) -> Act | None:
    """Read "how far off is it still" of the vehicle spoken of, else of the way to go."""
    match act:
        case Ask(question=HowMuch(of=Measured("distance-to-go", Pronoun()) as of) as question):
            spoken = any(first(one, kind) for one in before for kind in (Vehicle, Described))
            of = (
                structs.replace(of, attribute="distance")
                if spoken
                else (structs.replace(of, thing=Ego()))
            )
            return Ask(structs.replace(question, of=of))
    return act


def _told(act: Act | None, sooner: bool) -> Act | None:
    """Take what reads as a question without its mark for what is stated beside the question."""
    if not isinstance(act, Ask):
        return act
    if not is_well_typed(act):
        return None
    if not sooner:
        return act
    return Claim(act.question.that) if isinstance(act.question, Whether) else None


def _setting(act: Act) -> Act | None:
    """Read what comes before a question: what is named there, and noted of the past."""
    match act:
        case Elliptic(form="same", negated=False, besides=False, event=None, thing=thing):
            return Claim(Exists(thing)) if isinstance(thing, Described | Vehicle) else None
        case Elliptic(form="same", negated=False, besides=False, event=event) if event is not None:
            return Claim(Happens(event))
        case Request(event=event, negated=False) if isinstance(event.time, _OVER):
            of: Proposition = Happens(structs.replace(event, tense="past"))
            return Claim(of)
        case Repair(kind="pick" | "repeat") | Ask(question=Listing(of="beliefs", about=None)):
            return None  # "what do you think, is he angry?"
    return act


def _linked(before: Act, act: Act) -> Act:
    """Put an amount to what was told or asked just before: "we braked, how fast were we?"."""
    event = first(before, Event)
    if (there := to_lane(before, act)) is not None or event is None:
        return there or act
    match before, act:
        case Ask(question=WhatIf(supposed=Happens(event=option), then=Which())), Ask(
            question=Why(of=That() | Happens(event=Event(action="do")))
        ):  # "four of its rollouts collide. Why was it kept?"
            return Ask(Why(Happens(structs.replace(option, tense="present", time=Unsaid()))))
        case Ask() | Claim(), Ask(
            question=HowMuch(of=Measured(attribute="deceleration") as of) as question
        ):
            said = isinstance(before, Claim) and event.action in ("brake", "slow-down")
            if of.event is None and (isinstance(of.thing, Pronoun) or said):
                of = structs.replace(of, thing=event.actor, event=event)
        case _, Ask(
            question=HowMuch(
                of=Measured(time=Relative(anchor=Event(action="do", actor=Pronoun())) as time) as of
            ) as question
        ):  # "he has gone past. How close was it when he did?"
            done = structs.replace(time, anchor=structs.replace(event, tense="past"))
            of = structs.replace(of, time=done)
        case Claim(that=Happens()), Ask(question=HowMuch(of=of, extreme=None) as question):
            momentary = of.attribute in _MOMENTARY and isinstance(of.time, Unsaid)
            if momentary and of.tense == "past" and event.action == "approach":
                of = structs.replace(of, time=relative("during", event))
            elif momentary and of.tense == "past" and event.tense in ("past", "perfect"):
                of = structs.replace(of, time=Relative("during", event))
        case _:
            return act
    return Ask(structs.replace(question, of=of))


def _of_each(before: Act, act: Act) -> Act:
    """Ask for the reason of each: "how often did you brake, and why each time?"."""
    match act:
        case (
            Repair(kind="why")
            | Elliptic(form="why", thing=None, event=None)
            | Ask(question=Why(of=That() | Caused(cause=Pronoun("them-all"), effect=None)))
            | Ask(question=Listing(of="reasons", event=None))
        ):
            pass
        case _:
            return act
    match before:
        case (
            Ask(question=HowMany(of=Event(actor=Ego(), time=time) as event))
            | Ask(question=Listing(of="events", event=Event(actor=Ego()) as event, time=time))
            | Ask(question=Which(such=Happens(event=Event(actor=Ego(), time=time) as event)))
        ) if event.tense in ("past", "perfect"):
            whom = None if isinstance(event.object, Wanted) else event.object
            event = structs.replace(event, object=whom, time=Unsaid())
        case Ask(question=Listing(of="stops", time=time)):
            event = Event("stop")
        case Ask(question=Listing(of="decisions", event=None, time=time)):
            event = Event("do")
        case _:
            return act
    return Ask(Listing("reasons", time=time, event=event))


def _of_trend(before: Act, act: Act) -> Act:
    """Read "tell me the gap, and whether it has been shrinking or growing" of that measure."""
    match before, act:
        case Ask(question=HowMuch(of=of)), Ask(
            question=Whether(
                that=Both(
                    contents=(
                        Happens(event=Event("change-plan", Pronoun(), time=first_time)),
                        Happens(event=Event("change-plan", Pronoun(), time=time, tense=tense)),
                    )
                )
            )
        ) if of.attribute in _MOMENTARY:
            spoken = first_time if isinstance(time, Unsaid) else time
            return Ask(Whether(changed(of, tense, spoken)))
    return act


def _than_it(before: Act, act: Act) -> Act:
    """Compare with who was asked about: "how fast is the bus, and are we faster?"."""
    match before, act:
        case Ask(question=HowMuch(of=of, extreme=None)), Ask(
            question=Whether(that=Compares(left=left, right=None) as that) as question
        ) if of.thing != Ego() and left == structs.replace(of, thing=Ego()):
            return Ask(structs.replace(question, that=structs.replace(that, right=of)))
    return act


def _at_limit(before: Act, act: Act) -> Act:
    """Read "what is the limit, and what keeps you from driving it?" as of that speed."""
    match before, act:
        case Ask(question=HowMuch(of=Measured(attribute="limit" | "speed") as of)), Ask(
            question=Why(
                of=Not(
                    content=Has(attribute="occupant", thing=Pronoun("it"))
                    | Happens(event=Event(action="do" | "move" | "go", object=Pronoun("it")))
                )
            )
        ):
            return Ask(Why(Not(Compares(Measured("speed"), "same", of))))
    return act


def _of_exits(before: Act, act: Act) -> Act:
    """Count exits where exits were asked for: "which is ours, and how many have we passed?".

    What we take where an exit was spoken of is that exit: "where is it, and are we taking it?".
    """
    match before, act:
        case Ask(question=Where() | Whether() as asked), Ask(
            question=Whether(that=Happens(event=Event(action="move", actor=Ego()) as event))
        ) if (place := first(asked, Exit)) is not None and event == _taking(event):
            return Ask(Whether(Happens(structs.replace(event, action="leave", object=place))))
        case Ask(question=HowMuch(of=Measured(attribute="exit-number"))), Ask(
            question=HowMany(
                of=Described(doing=Event(action="overtake" | "pass", actor=Ego(), tense=tense))
            )
        ):
            return Ask(HowMany(Event("pass", object=Exit(), tense=tense)))
    return act


def _taking(event: Event) -> Event:
    """Give the bare move that "take it" is read as."""
    return Event("move", time=event.time, tense=event.tense)


def _of_ours(before: Act, act: Act) -> Act:
    """Ask for our lane where lanes were counted: "how many are there, and which one are we in?"."""
    match before, act:
        case Ask(question=HowMuch(of=Measured(attribute="lane-count"))), Ask(
            question=Which(thing=Described(), such=Happens(event=Event(actor=Ego())))
            | Identify(thing=Described() | Pronoun() | Ego())
        ):
            return Ask(HowMuch(Measured("lane")))
    return act


def _asks_grounds(act: Act | None) -> bool:
    """Say whether it is asked on what something rests: "explain that" behind it adds nothing."""
    return isinstance(act, Ask) and isinstance(act.question, HowKnow)


def _is_told(before: Act, act: Act) -> bool:
    """Say whether an act asks no more than the question before it."""
    if asks_whom(before, act):
        return True
    match before, act:
        case Ask(), Ask(
            question=Whether(
                that=Believed(content=That(), tense="present")
                | Not(content=Believed(content=That(), tense="present"))
            )
        ):
            return True  # "do you know?", "say so if you can't tell"
        case Ask(question=WhatIf(then=None)), Ask(
            question=Where(of=Pronoun(form="that"))
            | Identify(thing=Described(doing=Event(action="do", modal="would")))
        ):
            return True  # "where would that have left us?", "what would that have done to us?"
        case Ask(question=HowMuch(extreme=extreme)), Elliptic(form="when", thing=None, event=None):
            return extreme is not None
        case Ask(question=Whether(that=Is(state="close"))), Ask(
            question=HowMuch(of=Measured(attribute="distance", thing=Ego(), to=None))
        ):
            return True  # "was that close? how many metres?"
        case Ask(
            question=HowMuch(of=Measured(attribute="exit-number" | "turn")) | Whither(actor=Ego())
        ), Ask(question=HowMuch(of=Measured("distance", Pronoun("it") | Ego(), None))):
            return True  # "which exit, and how far is it?", "where do we turn, in how many metres?"
        case Ask(question=HowMuch(extreme="highest" | "lowest")), Ask(
            question=Where(of=Pronoun()) | When(of=That())
        ):
            return True  # "what was our top speed, and where was that?"
        case Ask(question=Peak()), Ask(
            question=Identify(thing=Pronoun(form="it" | "that"))
            | Why(of=That(), suspect=None)
            | Which(such=Happens(event=Event(object=Wanted())))
            | When(of=That())
            | Where(of=Pronoun())
        ):
            return True  # "what was the hardest braking, and who was it for?"
        case Ask(question=Peak()), Repair(kind="why" | "continue") | Elliptic(
            thing=Pronoun(form="who")
        ):
            return True  # "what were the longest stops, and what caused each?"
        case Ask(question=Which(among=())), Elliptic(form="same", event=None, besides=False):
            return act.thing is not None  # "who is he waiting for? us?"
    return False
