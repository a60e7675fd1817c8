"""Possible courses of a traffic light, from its cycle as seen, or otherwise from a prior.

`planner.traffic_lights.greens` has the prior of how long a green lasts. Amber lasts as by the
formula of the Institute of Transportation Engineers in the Traffic Signal Timing Manual (FHWA 2008,
FHWA-HOP-08-024, Chapter 5): a second to react, and braking at 3.05 m/s2. Arms that face each other
are assumed to be green together, and the arm that has been held longest to be next, mostly.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from statistics import NormalDist

from planner.record.light_record import GREENS, UNSEEN, LightCourse, LightPrediction, Showing
from planner.roads.trajectory import Roads
from planner.traffic_lights.greens import residual
from planner.traffic_lights.observations import Watched, alike, phases
from sim.roads.network import Link, angle_between, point_at
from sim.scene import LightState, Signal

REACTION, BRAKING = 1.0, 3.05  # [s], [m/s2] of drivers who see amber
#: Median [s] of the time for which all are red, and the deviation of its logarithm; assumed.
CLEARANCE, CLEARANCE_SIGMA = 1.5, 0.7
RED_AMBER = 1.0  # [s] of red and amber
LEAST = 0.2  # [s] minimum duration of a state
#: Quantiles of the time that a green has left, with their assumed probabilities.
SPREAD: tuple[tuple[float, float], ...] = ((0.15, 0.3), (0.5, 0.4), (0.85, 0.3))
MIDDLE = ((0.5, 1.0),)
OUT_OF_TURN = len(SPREAD) - 1  # index of the course in which an arm goes out of turn
AGAIN = 0.8  # probability that a light goes on as it was seen to do before
PARALLEL = math.pi / 4  # [rad] greatest angle between arms that are green together

RED, AMBER = LightState.RED.value, LightState.AMBER.value
ABOUT_TO_GO = LightState.RED_AMBER.value
DEAD = (LightState.OFF.value, LightState.FLASHING.value, UNSEEN)

_NORMAL = NormalDist()


@dataclass(frozen=True, slots=True)
class _Lasted:
    """How long [s] a state has lasted, and the greens in it; and whether each was seen to begin."""

    state: float
    begun: bool
    green: float
    green_begun: bool
    people: bool  # whether people on foot have a green that began after that of vehicles


def foresee(
    roads: Roads, watched: Watched, time: float, horizon: float, *, closely: bool
) -> LightPrediction:
    """Return the possible courses of a controller.

    Args:
        roads: the road network.
        watched: the observations of it.
        time: [s] now.
        horizon: [s] for which courses are needed.
        closely: whether to distinguish several courses of the prior; otherwise the middle one.
    """
    cycle = _Cycle(roads, watched, time, time + horizon)
    spread = SPREAD if closely else MIDDLE
    if all(letter in DEAD for letter in watched.seen[-1].states):
        ways: list[tuple[float, tuple[Showing, ...]]] = [(1.0, (cycle.here,))]
    else:
        again = cycle.again()
        ways = [(share, cycle.reckoned(q, k)) for k, (q, share) in enumerate(spread)]
        if again is not None and closely:
            ends = [(share, way) for share, way in (ways[0], ways[-1])]
            total = sum(share for share, _ in ends)
            ways = [(AGAIN, again), *(((1.0 - AGAIN) * p / total, way) for p, way in ends)]
        elif again is not None:
            ways = [(1.0, again)]
    shares: dict[tuple[Showing, ...], float] = {}
    for share, way in ways:
        within = tuple(showing for showing in way if showing.time < time + horizon)
        shares[within] = shares.get(within, 0.0) + share
    courses = tuple(LightCourse(round(share, 6), way) for way, share in shares.items())
    return LightPrediction(watched.controller, watched.places, watched.seen, courses)


def supposed(
    roads: Roads, known: LightPrediction, place: int, state: str, time: float
) -> LightPrediction:
    """Return a controller with one place that is supposed to show a state permanently.

    If the state is green, the lights of conflicting ways are red. All others stay as they are.
    """
    at = known.places.index(place)
    letters = list(known.courses[known.likeliest].showings[0].states)
    if state in GREENS:
        mine = roads.network.signalled(Signal(known.controller, place))
        for k, other in enumerate(known.places):
            theirs = roads.network.signalled(Signal(known.controller, other))
            if any(_meet(a, b) and not _parallel(roads, a, b) for a in mine for b in theirs):
                letters[k] = RED
    letters[at] = state
    course = LightCourse(1.0, (Showing(time, "".join(letters)),))
    return LightPrediction(known.controller, known.places, known.seen, (course,))


class _Cycle:
    """One controller, and the courses that it may take."""

    def __init__(self, roads: Roads, watched: Watched, time: float, until: float) -> None:
        self._roads, self._watched = roads, watched
        self._time, self._until = time, until
        self.here = Showing(time, watched.seen[-1].states)
        self._phases = phases(watched.seen)
        network = roads.network
        self._links = [
            network.signalled(Signal(watched.controller, place)) for place in watched.places
        ]
        places = {place: k for k, place in enumerate(watched.places)}
        self._crossings = {
            places[crossing.control.index]: crossing
            for crossing in network.crossings
            if isinstance(crossing.control, Signal)
            and crossing.control.controller == watched.controller
            and crossing.control.index in places
        }

    def again(self) -> tuple[Showing, ...] | None:
        """Return its course after the last time that it showed its last two states, if it did.

        Return None also if it then changed sooner than it has now.
        """
        seen, last = self._phases, len(self._phases) - 1
        for j in range(last - 2, 0, -1):
            if all(alike(seen[j - k].states, seen[last - k].states) for k in (0, 1)):
                break  # after another state, all red leads to other greens
        else:
            return None
        left = seen[j + 1].time - seen[j].time - (self._time - seen[-1].time)
        if left < LEAST:
            return None
        found, at, k = [self.here], self._time + left, j + 1
        while at < self._until:
            found.append(Showing(round(at, 3), seen[k].states))
            at += seen[k + 1].time - seen[k].time
            k = k + 1 if k + 1 < last else j
        return tuple(found)

    def reckoned(self, quantile: float, turn: int) -> tuple[Showing, ...]:
        """Return its course by the prior.

        Args:
            quantile: of the time that greens last.
            turn: which of the arms that may be next is next.
        """
        found = [self.here]
        held = self._held_since()
        at, letters = self._time, self.here.states
        lasted = self._lasted()
        while at < self._until:
            lasting, after = self._next(letters, held, quantile, turn, lasted)
            lasting = max(lasting, LEAST)
            at += lasting
            for k, letter in enumerate(after):
                if letter == RED and letters[k] != RED:
                    held[k] = at
            lasted = self._later(lasted, lasting, letters, after)
            letters = after
            found.append(Showing(round(at, 3), letters))
        return tuple(found)

    def _driving(self, letters: str) -> list[int]:
        """Return the places at which vehicles have green."""
        return [k for k, links in enumerate(self._links) if links and letters[k] in GREENS]

    def _walking(self, letters: str) -> list[int]:
        """Return the places at which people on foot have green."""
        return [k for k in self._crossings if letters[k] in GREENS]

    def _lasted(self) -> _Lasted:
        """Return how long its state has lasted, and the greens in it."""
        seen, now = self._phases, self.here.states
        last = len(seen) - 1
        going = self._driving(now)
        first, kept = last, going or self._walking(now)
        while first and all(seen[first - 1].states[k] in GREENS for k in kept):
            first -= 1
        alone = not self._driving(seen[first].states)
        state = self._time - seen[last].time
        green = self._time - seen[first].time
        return _Lasted(state, last > 0, green, first > 0, alone and bool(kept) and not going)

    def _later(self, lasted: _Lasted, lasting: float, before: str, now: str) -> _Lasted:
        """Return how long a state has lasted that begins after another one."""
        going = self._driving(now)
        kept = any(before[k] in GREENS for k in going or self._walking(now))
        green, begun = (lasted.green + lasting, lasted.green_begun) if kept else (0.0, True)
        people = not going and bool(self._walking(now)) and (lasted.people or not kept)
        return _Lasted(0.0, True, green, begun, people)

    def _held_since(self) -> dict[int, float]:
        """Return since when [s] each place has been red, by its position."""
        found: dict[int, float] = {}
        for showing in self._watched.seen:
            for k, letter in enumerate(showing.states):
                if letter in (*GREENS, AMBER):
                    found.pop(k, None)
                elif letter != UNSEEN:
                    found.setdefault(k, showing.time)
        return {k: found.get(k, self._time) for k in range(len(self._links))}

    def _next(
        self,
        letters: str,
        held: Mapping[int, float],
        quantile: float,
        turn: int,
        lasted: _Lasted,
    ) -> tuple[float, str]:
        """Return how long [s] a state still lasts, and the state after it.

        Args:
            letters: the state.
            held: since when [s] each place has been red.
            quantile: of the time that a green has left.
            turn: which of the arms that may be next is next.
            lasted: how long the state has lasted.
        """
        if AMBER in letters or ABOUT_TO_GO in letters:
            lasting = self._amber(letters) if AMBER in letters else RED_AMBER
            after = letters.replace(AMBER, RED)
            going = {k for k, letter in enumerate(letters) if letter == ABOUT_TO_GO}
            return lasting - lasted.state, self._with_green(after, going) if going else after
        if self._driving(letters) or lasted.people:
            left = residual(quantile, lasted.green, begun=lasted.green_begun)
            return left, "".join(AMBER if letter in GREENS else letter for letter in letters)
        clearance = CLEARANCE * math.exp(CLEARANCE_SIGMA * _NORMAL.inv_cdf(quantile))
        left = clearance - lasted.state
        if not lasted.begun:  # an arm out of view has green
            left = residual(quantile, lasted.state, begun=False) + REACTION + clearance
        return left, self._with_green(letters, self._stage(letters, held, turn))

    def _amber(self, letters: str) -> float:
        """Return how long [s] amber lasts."""
        lanes = self._roads.network.lanes
        limits = [
            lanes[link.from_lane].speed_limit
            for letter, links in zip(letters, self._links, strict=True)
            for link in links
            if letter == AMBER
        ]
        return REACTION + max(limits, default=self._roads.fastest) / (2.0 * BRAKING)

    def _stage(self, letters: str, held: Mapping[int, float], turn: int) -> set[int]:
        """Return the next arms with green: the one held longest, and those beside and opposite.

        Of several that have been held equally long, `turn` counts out one; for OUT_OF_TURN it is
        the one after them, if there is any. The arms held last are green with the next only if it
        was held no longer. If a crossing has been held longer than any arm, an arm is next with
        which it can be green. If there is none, only people on foot have green.
        """
        waiting = [k for k, links in enumerate(self._links) if links and letters[k] not in DEAD]
        order = sorted(waiting, key=lambda k: (round(held[k], 1), k))
        people = [k for k in self._crossings if letters[k] == RED]
        longest = min(people, key=lambda k: (round(held[k], 1), k), default=None)
        if order and longest is not None and held[longest] < held[order[0]] - LEAST:
            stages = (self._with(first, waiting, held) for first in order)
            fitting = (x for x in stages if self._with_green(letters, x)[longest] != RED)
            return next(fitting, set())
        equal: list[set[int]] = []
        for first in order:
            later = held[first] > held[order[0]] + LEAST
            if later and (turn < OUT_OF_TURN or held[first] >= held[order[-1]] - LEAST):
                break
            if any(first in known for known in equal):
                continue
            stage = self._with(first, waiting, held)
            if later:
                return stage
            equal.append(stage)
        return equal[turn % len(equal)] if equal else set()

    def _with(self, first: int, waiting: Sequence[int], held: Mapping[int, float]) -> set[int]:
        """Return an arm that has green, and those beside and opposite that have it too."""
        latest = max(held[k] for k in waiting)
        own = self._links[first][0]
        return {
            k
            for k in waiting
            if _parallel(self._roads, own, self._links[k][0])
            and (held[k] < latest - LEAST or held[first] >= latest - LEAST)
        }

    def _with_green(self, letters: str, going: set[int]) -> str:
        """Return a state in which some places are green, with the junction's rules between them."""
        ours = [link for k in sorted(going) for link in self._links[k]]
        keys = {(link.junction, link.index) for link in ours}

        def shown(k: int) -> str:
            yields = any((x.junction, i) in keys for x in self._links[k] for i in x.yields_to)
            return LightState.GREEN_YIELD.value if yields else LightState.GREEN.value

        now = "".join(shown(k) if k in going else letter for k, letter in enumerate(letters))
        return self._with_people(now, ours)

    def _with_people(self, letters: str, going: Sequence[Link]) -> str:
        """Return the state with crossings green over which all green links turn and give way."""
        found = list(letters)
        for k, crossing in self._crossings.items():
            met = [x for x in going if x.junction == crossing.junction]
            over = [x for x in met if crossing.index in x.other_foes]
            turning = all(x.direction != "straight" for x in over)
            yielding = all(crossing.index in x.other_yields_to for x in over)
            if letters[k] == RED and turning and yielding:
                found[k] = LightState.GREEN.value
            elif letters[k] in GREENS and not (turning and yielding):
                found[k] = RED
        return "".join(found)


def _meet(one: Link, other: Link) -> bool:
    return one.junction == other.junction and (other.index in one.foes or one.index in other.foes)


def _parallel(roads: Roads, one: Link, other: Link) -> bool:
    """Check whether two links come from the same side of a junction, or from opposite ones."""
    headings = []
    for link in (one, other):
        lane = roads.network.lanes[link.from_lane]
        headings.append(point_at(lane.centreline, lane.length)[1])
    apart = abs(angle_between(*headings))
    return min(apart, math.pi - apart) <= PARALLEL
