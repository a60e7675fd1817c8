"""Questions that ask for more than their terms say, in wordings, tenses and forms of each kind."""

import pytest

from xavi_dialogue.nlu.notation import compact
from xavi_dialogue.nlu.parse import Parser

TURNS = "Ask(HowMany(Event(turn, tense=future)))"
FITS = "Ask(Whether(Is(right, Lane)))"
UNFIT = "Ask(Whether(Not(Is(right, Lane))))"
LATE = "Ask(Why(Not(Happens(Event(go, time=Within)))))"
FASTEST = "Ask(HowMuch(Measured(speed, Everyone{}, time=WholeRide, tense=past), {}))"
QUEUE = "Ask(Which(Wanted, Related(on, Wanted, Feature(queue))))"


@pytest.mark.parametrize(
    ("text", "acts"),
    [
        ("is that our last turn?", TURNS),
        ("will there be any more turns?", TURNS),
        ("are any turns still to come?", TURNS),
        ("how many more turns until we are there?", TURNS),
        ("are there any right turns left?", "Ask(HowMany(Event(exit-right, tense=future)))"),
        ("is this the correct lane for the turn?", FITS),
        ("are we on the proper lane?", FITS),
        ("are you in the best lane?", FITS),
        ("is this the wrong lane?", UNFIT),
        ("aren't we in the wrong lane?", FITS),
        ("what's the fastest car ever?", FASTEST.format("(car)", "highest")),
        ("who was the slowest of all?", FASTEST.format("", "lowest")),
        ("which car was the fastest?", FASTEST.format("(car)", "highest")),
        ("what was the slowest bus?", FASTEST.format("(bus)", "lowest")),
        ("what would have been safer?", "Ask(Listing(options))"),
        ("what could be quicker?", "Ask(Listing(options))"),
        ("what might have been faster?", "Ask(Listing(options))"),
        ("who's first in line?", QUEUE),
        ("who is first in the jam?", QUEUE),
        ("was that our only stop?", "Ask(HowMany(Event(stop, time=WholeRide)))"),
        ("is this the only stop?", "Ask(HowMany(Event(stop, time=WholeRide)))"),
        ("which light is he showing?", "Ask(HowMuch(Measured(indicator, Pronoun(he))))"),
        ("what signal does it show?", "Ask(HowMuch(Measured(indicator, Pronoun(it))))"),
        ("what must happen before we can go?",
         "Ask(When(Happens(Event(go, tense=future, modal=can))))"),
        ("how long until we're standing?", "Ask(When(Happens(Event(stand, tense=future))))"),
        ("what speed did you use?", "Ask(HowMuch(Measured(speed, tense=past)))"),
        ("why were we so slow pulling away?", LATE),
        ("why did it take ages to move off?", LATE),
        ("why did you start so slowly?", LATE),
        ("which wait was the longest?", "Ask(Peak(waiting))"),
        ("which braking was the hardest?", "Ask(Peak(braking))"),
        ("which curve was the sharpest?", "Ask(Peak(tightness, deed=Event(turn)))"),
        ("which overtake was the fastest?", "Ask(Peak(speed, deed=Event(overtake)))"),
    ],
)  # fmt: skip
def test_asks_for_what_its_clause_says(text: str, acts: str) -> None:
    assert "; ".join(map(compact, Parser().read(text)[0].acts)) == acts


@pytest.mark.parametrize(
    "text",
    [
        "what delayed us longer, the bus or the light?",
        "which held us up longer, the bus or the light?",
        "what cost you more time, the bus or the light?",
    ],
)
def test_waits_are_compared(text: str) -> None:
    acts = list(map(compact, Parser().read(text)[0].acts))
    assert acts == [
        "Ask(HowLong(Event(wait, object=Described(bus))))",
        "Ask(HowLong(Event(wait, object=Feature(light))))",
    ]


@pytest.mark.parametrize(
    ("text", "acts"),
    [
        ("what is the fastest car?", "Ask(Identify(Described(car, extreme=fastest)))"),
        ("which one was the slowest?", "Ask(Identify(Described(extreme=slowest)))"),
        ("are we in the other lane?", "Ask(Whether(Related(on, Ego, Lane(other))))"),
        ("are we in the right lane?", "Ask(Whether(Related(on, Ego, Lane(right))))"),
        ("how many crossings are there?", "Ask(HowMany(Junction))"),
        ("why are you going so slowly?", "Ask(Why(Is(slow, Ego)))"),
        ("are we allowed to overtake?",
         "Ask(Whether(Is(allowed, event=Event(overtake, tense=present))))"),
    ],
)  # fmt: skip
def test_says_no_more_than_its_clause(text: str, acts: str) -> None:
    assert "; ".join(map(compact, Parser().read(text)[0].acts)) == acts
