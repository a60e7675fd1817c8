"""What only a dialogue says; texts stand in the same lines of golden/dialogue.txt."""

from tests.nlg.scenery import BLUE, NOW, OTHER_BLUE
from xavi_dialogue.domain.answers import (
    Judged,
    Measures,
    NothingToAsk,
    Posed,
    TakenAs,
    Unfamiliar,
    WhichOne,
)
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.meaning import (
    Act,
    Ask,
    Claim,
    Compare,
    Doing,
    Fault,
    Feel,
    HowAvoid,
    HowDecide,
    HowKnow,
    HowLong,
    HowMany,
    HowMuch,
    HowSure,
    Identify,
    Listing,
    Question,
    Request,
    Summarise,
    WhatIf,
    WhatWouldChange,
    When,
    Where,
    Whether,
    Which,
    Whither,
    Why,
)
from xavi_dialogue.domain.terms import (
    At,
    Described,
    Ego,
    Event,
    Exists,
    Exit,
    Happens,
    Is,
    Lane,
    Measured,
    Not,
    Related,
    Vehicle,
    Wanted,
)

CAR, BLUE_CAR = Vehicle(2), Vehicle(3)
STOPPED = Happens(Event("stop", time=At(12.0)))
CHANGED = Happens(Event("change-lane", time=At(2.0)))
REPLANNED = Happens(Event("change-plan", time=At(2.0)))
TURNS = Happens(Event("turn", CAR, tense="present"))
GONE = Not(Exists(CAR, tense="past"))
SPEED = Measures((Measure("speed", Ego(), NOW, 13.0, reference=13.9),))


def between(*acts: Act | Question) -> WhichOne:
    whole = tuple(a if isinstance(a, Claim | Request | Feel | Ask) else Ask(a) for a in acts)
    return WhichOne((CHANGED,), between="meanings", acts=whole)


CLARIFICATIONS = (
    WhichOne((CAR, BLUE_CAR), (BLUE, OTHER_BLUE)),
    WhichOne((Happens(Event("stop")), Happens(Event("stop", CAR))), between="meanings"),
    WhichOne((Exit(1), Lane("left")), between="meanings"),
    WhichOne(
        (Happens(Event("exit-left", time=At(5.0))), Happens(Event("exit-left", time=At(12.0)))),
        between="times",
    ),
    WhichOne((), between="meanings"),
    between(Why(CHANGED), Why(REPLANNED)),
    between(Why(STOPPED), Whether(STOPPED)),
    between(Why(STOPPED, instead=CHANGED), When(STOPPED)),
    between(Why(CHANGED), Why(Happens(Event("change-lane", time=At(9.0))))),
    between(Why(CHANGED), Why(CHANGED)),
    between(WhatIf(CHANGED), WhatIf(GONE)),
    between(
        WhatIf(Happens(Event("stop", modal="would", tense="present"))),
        WhatIf(Not(Exists(CAR))),
    ),
    between(Which(Wanted(), Happens(Event("cut-in", Wanted()))), Identify(CAR)),
    between(
        Which(Wanted(), Happens(Event("wait", object=Wanted()))),
        Which(Wanted("bus"), Related("behind", Wanted("bus"))),
    ),
    between(Which(Described("car", "red")), HowMany(Described("bus", plural=True))),
    between(Which(Described("car"), Happens(Event("stop", CAR))), HowMany(Event("stop"))),
    between(HowMuch(Measured("speed", tense="past")), HowMuch(Measured("speed", CAR), "highest")),
    between(HowLong(Event("wait")), Where(Event("stop"))),
    between(Where(CAR), Whither(CAR)),
    between(Doing(CAR), Doing(None, At(2.0), "past"), Doing(Ego(), tense="future")),
    between(
        Compare((STOPPED, CHANGED), "safety"),
        Compare((Ego(), CAR), "speed"),
    ),
    between(*(Listing(of) for of in ("events", "vehicles", "options", "beliefs", "causes"))),
    between(*(Listing(of) for of in ("stops", "decisions", "wrong-predictions", "capabilities"))),
    between(Summarise(), Fault(), Fault(legal=True)),
    between(HowKnow(TURNS), HowKnow(), HowSure(TURNS), HowSure()),
    between(HowDecide(), HowAvoid(), WhatWouldChange(), WhatWouldChange(most=True)),
    between(Request(Event("slow-down", tense="present")), Claim(Is("slow", Ego()))),
    between(Feel("nervous", CAR), Why(STOPPED)),
    between(Feel("curious"), Whether(Exists(Described("bus", bearing="behind", definite=False)))),
)
QUIZZES = (
    Posed("vehicle", Why(Happens(Event("slow-down")))),
    Posed("vehicle", Why(Happens(Event("slow-down", tense="present"))), again=True),
    Posed("deed", WhatIf(GONE)),
    Posed("deed", WhatIf(Not(Exists(CAR)))),
    Posed("deed", WhatIf(Happens(Event("exit-straight", CAR, modal="would")))),
    Posed("deed", WhatIf(Happens(Event("exit-straight", CAR, tense="present", modal="would")))),
    Posed("sooner", WhatIf(Happens(Event("continue", modal="would")))),
    Posed("sooner", WhatIf(Happens(Event("change-left", tense="present", modal="would")))),
    Posed("sooner", Summarise()),
    *(Judged(how, Posed("vehicle", Why(STOPPED)), SPEED) for how in ("right", "wrong", "passed")),
    NothingToAsk(),
    NothingToAsk(asked=True),
    TakenAs("Why did we brake?"),
    Unfamiliar(("blorb",)),
    Unfamiliar(("blorb", "flim")),
    Unfamiliar(("for a sec",), known=True),
)
CASES = (*CLARIFICATIONS, *QUIZZES)
