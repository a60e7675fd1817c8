"""Answers about danger: who stops in time, why no collision is expected, what stirred us."""

from msgspec.structs import replace

from tests.nlg.scenery import BLUE, LORRY, NOW
from xavi_dialogue.domain.answers import (
    Answer,
    Beliefs,
    Bound,
    Closeness,
    PullingUp,
    Slowing,
    Sociable,
)
from xavi_dialogue.domain.facts import Belief, Episode, Expectation, Measure
from xavi_dialogue.domain.findings import Assurance
from xavi_dialogue.domain.hidden_areas import AllRound, Hider, SightTold
from xavi_dialogue.domain.terms import Ego, Event, Vehicle

E, V = Ego(), Vehicle(1)
FAR = Measure("distance", E, NOW, 14.0, to=V)
THEN = Measure("distance", E, 12.0, 14.0, to=V)
NEAREST = Measure("distance", E, 7.0, 1.5, to=V)
SPEED = Measure("speed", E, NOW, 9.0)
BRAKES = Episode(V, "brake", 17.0, speed_from=13.0, speed_to=8.0)
OURS = Episode(E, "brake", 17.0, speed_from=13.0, speed_to=9.0)
TURN = Event("turn", V, side="right")
TURNED = Episode(V, "exit-right", 8.5, 10.0)
LEFT = (Expectation(("exit-left",), 0.9),)
RIGHT = Belief(1, 19.0, (Expectation(("exit-right",), 0.97),))
ON = Belief(1, 19.0, (Expectation(("continue",), 0.97),))
TURNS = replace(TURN, tense="future")


def grounds(of: Assurance, vehicle: int | None = 1, risk: float | None = 0.008) -> Closeness:
    """Make the answer to how we know that nobody hits us."""
    near = None if vehicle is None else FAR
    return Closeness(vehicle, near, risk=risk, asked="grounds", past=False, grounds=of)


BUILDING = Hider(None, "ahead", 0.04)
LORRY_HIDES = Hider(1, "left", 0.1)
TALL = Hider(1, "ahead", None)

CASES: tuple[Answer, ...] = (
    PullingUp(1, "stands"),
    PullingUp(1, "brakes", behind=True, braking=BRAKES, distance=FAR, risk=0.008),
    PullingUp(1, "brakes", braking=BRAKES, distance=FAR, risk=0.008),
    PullingUp(1, "able", behind=True, distance=FAR, needed=8.0),
    PullingUp(1, "able", behind=True, distance=FAR, needed=0.0),
    PullingUp(1, "unable", behind=True, distance=FAR, needed=18.0, risk=0.3),
    PullingUp(1, "owes", distance=FAR, chance=0.9),
    PullingUp(1, "owes", braking=BRAKES, distance=FAR),
    PullingUp(1, "goes-first", distance=FAR),
    PullingUp(1, "goes-first", braking=BRAKES, distance=FAR),
    PullingUp(1, "apart", distance=FAR),
    PullingUp(1, "apart"),
    PullingUp(1, "able", ours=True, braking=OURS, distance=FAR, speed=SPEED, needed=8.0),
    PullingUp(1, "able", ours=True, distance=FAR, speed=SPEED, needed=8.0),
    PullingUp(1, "unable", ours=True, distance=FAR, speed=SPEED, needed=18.0),
    grounds(Assurance(12, belief=RIGHT, yields="we")),
    grounds(Assurance(12, 1, stands=True, yields="they"), risk=0.08),
    grounds(Assurance(1, belief=RIGHT, behind=True)),
    grounds(Assurance(7), vehicle=None),
    grounds(Assurance(1), vehicle=None),
    grounds(Assurance(), risk=None),
    grounds(Assurance(12, decided=8.0)),
    grounds(Assurance(12, 3, decided=8.0), vehicle=None, risk=0.3),
    grounds(Assurance(1, decided=8.0)),
    grounds(Assurance(1, 1, decided=8.0), vehicle=None, risk=0.9),
    grounds(Assurance(12, decided=8.0), vehicle=None),
    grounds(Assurance(1, decided=8.0), vehicle=None),
    *(Beliefs(1, TURN, (RIGHT,), share, 19.0, knew=True) for share in (0.97, 0.8, 0.5, 0.1)),
    *(Beliefs(1, TURN, (RIGHT,), share, 8.0, knew=True) for share in (0.8, 0.5)),
    Beliefs(1, TURN, (RIGHT,), 0.97, 8.0, came=TURNED, knew=True, since=7.0, before=0.3),
    Beliefs(1, TURN, (RIGHT,), 0.1, 8.0, came=TURNED, besides=LEFT, knew=True),
    Sociable("feelings"),
    Sociable("feelings", Closeness(1, Measure("distance", E, 17.0, 4.2, to=V))),
    *(
        SightTold(asked, hiders, past, slowed)
        for asked in ("past", "what", "there", "chance", "came", "known")
        for hiders, past, slowed in (
            ((BUILDING,), False, True),
            ((LORRY_HIDES, BUILDING), True, False),
            ((), False, False),
        )
    ),
    *(
        SightTold("if", (LORRY_HIDES,), past, slowed)
        for past in (False, True)
        for slowed in (False, True)
    ),
    SightTold("there", (TALL,)),
    SightTold("beyond", (TALL,)),
    SightTold("past", (TALL,)),
    Slowing((1,), stops=True, held=0.8, time=25.0),
    Slowing((1,), stops=True, held=0.8, time=25.0, share=0.7),
    Slowing((2,), stops=True, held=0.0, time=20.5),
    Slowing((2,), stops=True, held=0.0, time=20.5, share=0.7),
    Slowing((1,), stops=False, held=0.7, slow=5.0),
    Slowing((1,), stops=False, held=0.2, slow=5.0),
    Slowing((1,), stops=False, held=0.7),
    Slowing((1,), stops=False, held=0.0, slows=True, slow=5.0),
    Slowing((1,), stops=False, held=0.0, slows=True),
    *(Slowing((2,), False, 0.0, order=first) for first in ("they", "we", "nobody")),
    Slowing((), stops=False, held=0.0, slow=5.0),
    Slowing((), stops=False, held=0.0, slow=5.0, yields=True),
    Bound(V, ON, unconsidered=TURNS),
    Bound(V, ON, unconsidered=TURNS, signal=Episode(V, "signal", 17.0, side="left")),
    Bound(V, replace(ON, time=5.0), unconsidered=TURNS),
    Bound(V, ON, unconsidered=TURN),
    Closeness(None, None, risk=0.008, asked="safe", past=False, giving=(2,)),
    Closeness(1, THEN, risk=0.008, asked="dangerous", ever=NEAREST),
    Closeness(1, THEN, risk=0.008, asked="safe", braked=(replace(BRAKES, peak=4.5),)),
    Closeness(1, THEN, asked="dangerous", braked=(replace(OURS, peak=6.0),)),
    Closeness(1, THEN, asked="dangerous", braked=(replace(OURS, peak=6.0, object=V),)),
    Closeness(1, Measure("distance", E, 17.0, 4.2, to=V), risk=0.008, degree=True),
    Closeness(None, None, risk=0.12, past=False, degree=True),
    AllRound((), NOW),
    AllRound((), 12.0, past=True),
    AllRound((BLUE,), NOW),
    AllRound((BLUE, LORRY), NOW),
    AllRound((BLUE,), 12.0, past=True),
    AllRound((BLUE, LORRY), 12.0, past=True),
)
