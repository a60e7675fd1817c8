"""The rows of the paper's Tables 1 to 3, for comparison only; no answer is made from them.

Source: Gyevnar, Tamborski, Wang, Lucas, Cohen and Albrecht, "A Human-Centric Method for Generating
Causal Explanations in Natural Language for Autonomous Vehicle Motion Planning", 2022, section
"Experiments". Table 1 is of scenario S1 with one cause and one effect; Table 2 of S2 likewise;
Table 3 of S1 with growing numbers of both.
"""

import msgspec

from benchmarks.reproduce.claims import Change, Claim, Doing
from planner.record.trace import Action


class Foil(msgspec.Struct, frozen=True):
    """An action of the ego instead of the manoeuvre of the story."""

    scenario: str
    action: Action
    question: str  # a passenger's question about it


class Row(msgspec.Struct, frozen=True):
    """One sentence of the paper."""

    table: int
    foil: Foil
    text: str
    claim: Claim
    effects: int = 1  # number of effects that were requested
    causes: int = 1


STRAIGHT_ON = Foil("s1", "continue", "Why did you change left instead of continuing straight?")
RIGHT = Foil("s1", "exit-right", "Why did you change left instead of turning right?")
ACROSS = Foil("s2", "exit-straight", "Why did you turn right instead of going straight?")
LEFT = Foil("s2", "exit-left", "Why did you turn right instead of turning left?")
FOILS = (STRAIGHT_ON, RIGHT, ACROSS, LEFT)

_STRAIGHT = "If ego had gone straight then it would have "
_TURNED_RIGHT = "If ego had turned right then it would have "
_TURNED_LEFT = "If ego had turned left then it would have "

_CUTS_IN = Doing(1, ("change-right", "exit-right"))
_TURNS_LEFT = Doing(1, ("exit-left",))
_SECOND_TURNS = Doing(2, ("exit-right",))
_SLOWER = Change("time", "more")
_JERKIER = Change("jerk", "more")
_STEADIER = Change("angular-acceleration", "less")

_BECAUSE_1 = "because vehicle 1 probably changes right then exits right"
_LATER = Claim("done", effects=(_SLOWER,), causes=(_CUTS_IN,))
_MISSED = Claim("not-reached")
_MISSED_BECAUSE = Claim("not-reached", causes=(_TURNS_LEFT,))
_HIT = Claim("collision", 1, causes=(_CUTS_IN,))

ROWS = (
    Row(1, STRAIGHT_ON, f"{_STRAIGHT}likely reached the goal slower {_BECAUSE_1}.", _LATER),
    Row(1, STRAIGHT_ON, f"{_STRAIGHT}likely collided with vehicle 1 {_BECAUSE_1}.", _HIT),
    Row(1, RIGHT, f"{_TURNED_RIGHT}not reached the goal.", _MISSED),
    Row(
        1,
        RIGHT,
        f"{_TURNED_RIGHT}collided with vehicle 1"
        " because vehicle 1 probably changes right and exits right.",
        _HIT,
    ),
    Row(2, ACROSS, f"{_STRAIGHT}not reached the goal.", _MISSED),
    Row(
        2,
        ACROSS,
        f"{_STRAIGHT}not reached the goal because vehicle 1 likely turns left.",
        _MISSED_BECAUSE,
    ),
    Row(2, LEFT, f"{_TURNED_LEFT}not reached the goal.", _MISSED),
    Row(
        2,
        LEFT,
        f"{_TURNED_LEFT}not reached the goal because vehicle 1 likely turns left.",
        _MISSED_BECAUSE,
    ),
    Row(3, STRAIGHT_ON, f"{_STRAIGHT}likely reached the goal slower {_BECAUSE_1}.", _LATER),
    Row(
        3,
        STRAIGHT_ON,
        f"{_STRAIGHT}likely reached the goal slower {_BECAUSE_1} and vehicle 2 exits right.",
        Claim("done", effects=(_SLOWER,), causes=(_CUTS_IN, _SECOND_TURNS)),
        causes=2,
    ),
    Row(
        3,
        STRAIGHT_ON,
        f"{_STRAIGHT}likely reached the goal slower and with more jerk {_BECAUSE_1}.",
        Claim("done", effects=(_SLOWER, _JERKIER), causes=(_CUTS_IN,)),
        effects=2,
    ),
    Row(
        3,
        STRAIGHT_ON,
        f"{_STRAIGHT}likely reached the goal slower and with more jerk"
        f" and with less angular acceleration {_BECAUSE_1}.",
        Claim("done", effects=(_SLOWER, _JERKIER, _STEADIER), causes=(_CUTS_IN,)),
        effects=3,
    ),
)


def rows_of(foil: Foil) -> tuple[Row, ...]:
    """Return the rows of a foil, those of all tables."""
    return tuple(row for row in ROWS if row.foil == foil)
