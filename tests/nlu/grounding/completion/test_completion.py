"""Fragments: what they take from the question before."""

from typing import Any

import pytest
from msgspec.structs import replace

from tests.nlu.grounding.completion.test_discussed import BRAKED, SLOWED, grounder
from tests.nlu.grounding.fakes import did, talk
from xavi_dialogue.domain.meaning import (
    Ask,
    Compare,
    Doing,
    Elliptic,
    HowDecide,
    HowMuch,
    HowSure,
    Identify,
    Listing,
    Peak,
    Question,
    Summarise,
    WhatIf,
    When,
    Where,
    Whether,
    Which,
    Whither,
    Why,
)
from xavi_dialogue.domain.terms import (
    At,
    Compares,
    Described,
    Ego,
    Event,
    Exists,
    Exit,
    Feature,
    Happens,
    Has,
    Junction,
    Measured,
    Not,
    Now,
    Pronoun,
    Related,
    Vehicle,
    Wanted,
)
from xavi_dialogue.nlu.grounding.completion.ellipsis import complete


def completed(spoken: Elliptic, question: Question | None = None, **fields: Any) -> Any:
    found = complete(spoken, grounder(talk(question=question, **fields)))
    return found.question if isinstance(found, Ask) else found


WHY = Why(Happens(SLOWED))
BUS = Described(kind="bus")
DELAY = HowMuch(Measured("delay"))
GONE = Not(Exists(Vehicle(1)))
LEFT = Event("change-left", tense="present", modal="would")
FASTER = Compares(Measured("speed"), "more", Measured("speed", Vehicle(1)))
SPEEDING = Compares(Measured("speed"), "more", Measured("limit"))


@pytest.mark.parametrize(
    ("fragment", "question", "found"),
    [
        # Another question word.
        (Elliptic(form="which"), Which(Wanted(), Happens(SLOWED)),
         Which(Wanted(), Happens(SLOWED))),
        (Elliptic(form="which"), Whether(Happens(Event("wait"))),
         Which(Wanted(), Happens(Event("wait", object=Wanted())))),
        (Elliptic(form="which"), Whether(Happens(Event("turn"))), Identify(Pronoun("it"))),
        (Elliptic(form="which"), WHY, Identify(Pronoun("it"))),
        (Elliptic(thing=BUS, form="which"), Whether(Happens(Event("wait"))), Identify(BUS)),
        (Elliptic(form="where"), HowMuch(Measured("turn")), Whither()),
        (Elliptic(form="where"), HowMuch(Measured("speed")), Where(Pronoun("it"))),
        (Elliptic(form="where"), HowMuch(Measured("speed"), extreme="highest"),
         HowMuch(Measured("speed"), extreme="highest")),
        (Elliptic(form="where"), Whither(Vehicle(1)), Whither(Vehicle(1))),
        (Elliptic(form="where"), Identify(Vehicle(2)), Where(Vehicle(2))),
        (Elliptic(thing=BUS, form="where"), WHY, Where(BUS)),
        (Elliptic(form="where"), Whether(Happens(Event("turn", tense="future"))), Whither()),
        (Elliptic(form="where"), WHY, Where(SLOWED)),
        (Elliptic(form="when"), WHY, When(Happens(SLOWED))),
        (Elliptic(form="when"), Why(Not(Happens(SLOWED))), When(Not(Happens(SLOWED)))),
        (Elliptic(form="how"), WHY, HowDecide(Happens(SLOWED))),
        (Elliptic(form="sure"), WHY, HowSure(Happens(SLOWED))),
        # How much, and until when.
        (Elliptic(form="how-much"), Whether(FASTER), HowMuch(Measured("speed", to=Vehicle(1)))),
        (Elliptic(form="how-much"), Whether(SPEEDING), HowMuch(Measured("excess"))),
        (Elliptic(form="how-much"), HowMuch(Measured("gap")), HowMuch(Measured("gap"))),
        (Elliptic(form="how-much"), WhatIf(GONE, Whether(Happens(SLOWED))), WhatIf(GONE, DELAY)),
        (Elliptic(form="how-much"), Compare((Happens(LEFT),), "time"),
         WhatIf(Happens(replace(LEFT, modal=None)), DELAY)),
        (Elliptic(form="how-much"), Compare((Vehicle(1), Vehicle(2)), "speed"),
         HowMuch(Measured("speed", Vehicle(1), Vehicle(2)))),
        (Elliptic(form="how-much"), WHY, Whether(Happens(SLOWED))),
        (Elliptic(form="how-much"), Identify(Vehicle(1)), None),
        (Elliptic(form="how-much"), None, None),
        (Elliptic(form="until"), Why(Happens(Event("stand", tense="present"))),
         When(Happens(Event("go", tense="future")))),
        (Elliptic(form="until"), WHY, When(Happens(SLOWED), "end")),
        (Elliptic(form="until"), Whether(Has("colour", "red", Feature("light"))),
         When(Happens(Event("turn-colour", Feature("light"), tense="future")))),
        (Elliptic(form="when"), HowMuch(Measured("lane")), None),
        # Why, and why not.
        (Elliptic(form="why"), Whether(Happens(SLOWED)), Why(Happens(SLOWED))),
        (Elliptic(form="why-not"), Whether(Not(Happens(SLOWED))), Why(Not(Happens(SLOWED)))),
        (Elliptic(form="why", negated=True), Why(Happens(SLOWED), suspect=Vehicle(1)),
         Why(Happens(SLOWED), suspect=Vehicle(1))),
        (Elliptic(form="why", negated=True), WHY, Why(Not(Happens(SLOWED)))),
        (Elliptic(form="why", event=Event("stop")), WHY, Why(Happens(Event("stop")))),
        (Elliptic(form="why", thing=Exit(2)), WHY, Why(Happens(Event("leave", object=Exit(2))))),
        # What else.
        (Elliptic(besides=True), WHY, Listing("reasons")),
        (Elliptic(besides=True), Listing("events"), Listing("events")),
        (Elliptic(besides=True), Which(Wanted(), Related("can-see", Ego(), Wanted())),
         Listing("vehicles")),
        (Elliptic(besides=True), Whether(Happens(SLOWED)), Doing(besides=Happens(SLOWED))),
        # The same, negated, of another event or thing.
        (Elliptic(negated=True), WhatIf(Happens(SLOWED)), WhatIf(Not(Happens(SLOWED)))),
        (Elliptic(negated=True), WhatIf(Not(Happens(SLOWED))), WhatIf(Happens(SLOWED))),
        (Elliptic(negated=True), WHY, Why(Not(Happens(SLOWED)))),
        (Elliptic(negated=True), Whether(Not(Happens(SLOWED))), Whether(Not(Happens(SLOWED)))),
        (Elliptic(event=Event("stop")), WHY, Why(Happens(Event("stop")))),
        (Elliptic(event=Event("stop")), Identify(Vehicle(1)), Whether(Happens(Event("stop")))),
        (Elliptic(thing=Ego()), Which(Wanted(), Happens(Event("wait", Vehicle(1), Wanted()))),
         Whether(Happens(Event("wait", Vehicle(1), Ego())))),
        (Elliptic(thing=Described(extreme="nearest")), Listing("vehicles"),
         Identify(Described(extreme="nearest"))),
        (Elliptic(thing=Vehicle(1)), Summarise(), Doing(Vehicle(1))),
        (Elliptic(thing=Vehicle(1)), Peak("danger"), Doing(Vehicle(1))),
        (Elliptic(thing=Vehicle(1)), Whether(Happens(Event("stop", modal="should"))),
         Doing(Vehicle(1))),
        (Elliptic(thing=Vehicle(1)), Whether(Happens(Event("stop"))),
         Whether(Happens(Event("stop", Vehicle(1))))),
        (Elliptic(thing=Vehicle(2)), WHY, Why(Happens(SLOWED), suspect=Vehicle(2))),
        (Elliptic(thing=Vehicle(3)), Why(Happens(Event("brake", time=At(14.0)))),
         Why(Happens(Event("brake", Vehicle(3), time=At(14.0))))),
        (Elliptic(thing=Vehicle(1)), Why(Happens(Event("give-way", object=Vehicle(2)))),
         Why(Happens(Event("give-way", object=Vehicle(1))))),
        (Elliptic(thing=Vehicle(3)), Why(Happens(Event("give-way", object=Vehicle(2)))),
         Doing(Vehicle(3))),
        # Nothing before it.
        (Elliptic(event=Event("stop")), None, Whether(Happens(Event("stop")))),
        (Elliptic(thing=BUS), None, Identify(BUS)),
        (Elliptic(thing=Exit(1)), None, Where(Exit(1))),
        (Elliptic(time=Now()), None, None),
    ],
)  # fmt: skip
def test_a_fragment_takes_its_frame_from_the_question(
    fragment: Elliptic, question: Question | None, found: Any
) -> None:
    assert completed(fragment, question) == found


def test_a_further_question_what_it_does_leaves_out_what_was_told() -> None:
    told = (Happens(BRAKED),)
    assert completed(Elliptic(besides=True), Doing(), propositions=told) == Doing(
        besides=Happens(BRAKED)
    )


@pytest.mark.parametrize(
    ("place", "rank"),
    [(Exit(1), Exit(2)), (Junction("roundabout"), Junction("roundabout", 2)), (None, None)],
)
def test_a_count_is_of_what_was_spoken_of(place: Any, rank: Any) -> None:
    second = Described(rank=2)
    question = Where(Vehicle(1) if place is None else place)
    found = completed(Elliptic(thing=second, form="where"), question)
    assert found == Where(second if rank is None else rank)
    named = Described(colour="red", rank=2)
    assert completed(Elliptic(thing=named, form="where"), question) == Where(named)


def test_left_again_is_the_lane_change_we_are_at() -> None:
    left = Event("exit-left", tense="present")
    changing = replace(left, action="change-left")
    assert completed(Elliptic(event=left)) == Whether(Happens(changing))
    right = replace(left, action="exit-right")
    assert completed(Elliptic(event=right)) == Whether(Happens(right))
    theirs = replace(left, actor=Vehicle(1))
    assert completed(Elliptic(event=theirs)) == Whether(Happens(theirs))
    long_ago = grounder(None, did("change-left", 12.0, 15.9))
    assert complete(Elliptic(event=left), long_ago) == Ask(Whether(Happens(left)))
