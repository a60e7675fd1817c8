"""Focus: what a question says about when, found in the record of the ride."""

from collections.abc import Sequence
from dataclasses import replace
from typing import TypeAlias

import msgspec

from sim.scene import EGO
from xavi_dialogue.explain.actions import same
from xavi_dialogue.explain.deeds import Span, occurrences
from xavi_dialogue.explain.explanation import NoExplanation
from xavi_dialogue.explain.landmarks import crossing_ahead, junctions, roundabouts
from xavi_dialogue.explain.present import upcoming
from xavi_dialogue.explain.query import Query
from xavi_dialogue.explain.record import Record
from xavi_dialogue.explain.ride import ROUNDING, Ride, Unanswered, decline
from xavi_dialogue.explain.vehicles import check_known, number_of
from xavi_dialogue.explain.when import Focus, When

TOLERANCE = (1.5, 0.2)  # [s] by which passengers misjudge a moment, and its share of the time since
AROUND = 2.0  # [s] before and after what somebody did that are "when" it was done
APPROACH = 8.0  # [s] before a turn that are "at the junction"
EDGE = 5.0  # [s] at either end of the ride that are "at the start" and "at the end"
BEFORE = 1.0  # [s] before something at which it was not yet begun
WHAT = Query(type="what")
#: What was done, where its side is left open.
SIDELESS: dict[str, str] = {"change-left": "change-lanes", "exit-left": "turn"}

Resolved: TypeAlias = Focus | NoExplanation | None


def resolve(when: When, record: Record, query: Query = WHAT) -> Resolved:
    """The part of the ride that a question is about; None where its words restrict nothing.

    Pure. To be put into `Record.focus`, and the query through `tensed`.

    Args:
        when: what the question says. A deed of a vehicle that is only described is looked for
            among those of all vehicles.
        record: the ride so far.
        query: the question; its tense tells whether "after the junction" is to come.

    Returns:
        Or a refusal: outside-record, with the time [s] and since and until when there is a record;
        did-not-happen, where what it is measured by was not; unknown-vehicle; ambiguous.
    """
    ride = Ride(replace(record, focus=None))
    if not ride.traces:
        return None
    try:
        return _Resolver(ride, when, query).focus()
    except Unanswered as unanswered:
        found = unanswered.result
        return found if isinstance(found, NoExplanation) else None


def tensed(query: Query, focus: Focus) -> Query:
    """The query in the tense of the time that it is about."""
    tense = "future" if focus.ahead else "past"
    return msgspec.structs.replace(query, tense=tense)


class _Resolver:
    """One search for what is meant, in a ride of which something is known."""

    def __init__(self, ride: Ride, when: When, query: Query) -> None:
        self.ride, self.when, self.query = ride, when, query
        self.now = ride.now
        track = ride.traces[0].history.get(EGO)
        begun = ride.traces[0].sim_time
        over = [e.sim_time for e in ride.events if e.kind in ("arrived", "collided", "ended")]
        self.last = min([self.now, *over])  # [s] up to which there is a record
        self.first = min(begun if track is None else min(begun, track.start), self.last)
        self.done = ride.ended or ride.arrived

    def focus(self) -> Focus | None:
        """What is meant.

        Raises:
            Unanswered: there is no such time.
        """
        when = self.when
        if when.landmark is None:
            return self._window(self.first, self.last, self.last)
        if when.landmark == "now":
            return self._from_now()
        if when.landmark == "clock":
            return self._by_clock(when.clock or 0.0)
        future = self.query.tense == "future"
        if when.landmark == "end" and not self.done:
            if future or when.ahead:
                return None
            raise self._outside(None)
        spans = [] if when.ahead else self._spans()
        if when.ahead or (future and when.landmark != "start") or not spans:
            if self.done and (future or when.ahead):
                return None
            ahead = self._ahead() if self.query.tense != "past" or when.ahead else None
            if ahead is not None:
                return ahead
        if not spans and when.relation == "before" and self._ahead() is not None:
            return self._window(self.first, self.last, self.last)
        if not spans:
            self._check_missing()
            return None
        if self.query.tense == "present" and self._is_place and when.relation == "at":
            return None
        if future and self._is_place and when.relation != "after":
            self._check_missing()
        if future:
            return None
        return self._around(*self._which(spans))

    def _from_now(self) -> Focus | None:
        when, now = self.when, self.now
        if when.ahead:
            if self.query.tense == "past":
                return None
            return self._in(now + (when.seconds or 0.0), lasting=when.relation == "within")
        if when.seconds is None:
            return self._window(self.first, self.last, self.last, rough=True)
        if when.rough or when.relation == "within":
            back = when.seconds if when.relation == "within" else 2.0 * when.seconds
            moment = now - when.seconds / 2.0 if when.relation == "within" else now - when.seconds
            return self._window(now - back, now, moment, rough=when.rough)
        return self._instant(now - when.seconds)

    def _by_clock(self, clock: float) -> Focus | None:
        when = self.when
        if clock > self.now + ROUNDING and self.query.tense != "past":
            return self._in(clock, lasting=False)
        self._check_inside(clock)
        if when.relation == "at":
            return self._instant(clock)
        if when.relation == "within":
            until = max(clock, when.until or clock)
            return self._window(clock, until, (clock + until) / 2.0)
        return self._beside(clock, clock)

    def _in(self, moment: float, *, lasting: bool) -> Focus | None:
        """What is to come at a time, or up to it; None where nothing is."""
        if self.done:
            return None
        start = self.now if lasting else moment
        return Focus(start=start, end=moment, moment=moment, instant=not lasting, ahead=True)

    # --- In the past ------------------------------------------------------------------------------

    def _instant(self, time: float) -> Focus:
        self._check_inside(time)
        near = max(TOLERANCE[0], TOLERANCE[1] * (self.now - time))
        return self._window(time - near, time + near, time, instant=True)

    def _around(self, start: float, end: float) -> Focus:
        """What is meant by something that went on from `start` to `end` [s]."""
        if self.when.relation in ("before", "after"):
            return self._beside(start, end)
        if self.when.landmark in ("start", "end"):
            return self._window(start, end, start)
        before = APPROACH if self._is_place else AROUND
        middle = (start + end) / 2.0
        return self._window(start - before, end + AROUND, middle, instant=not self._is_place)

    def _beside(self, start: float, end: float) -> Focus:
        """What is before or after something."""
        before, seconds = self.when.relation == "before", self.when.seconds
        if seconds is not None and not self.when.rough:
            return self._instant(start - seconds if before else end + seconds)
        reach = None if seconds is None else 2.0 * seconds
        if before:
            low = self.first if reach is None else start - reach
            return self._window(low, start, start - BEFORE)
        high = self.last if reach is None else end + reach
        return self._window(end, high, end, nth=1)

    def _window(
        self,
        start: float,
        end: float,
        moment: float,
        *,
        instant: bool = False,
        nth: int | None = None,
        rough: bool = False,
    ) -> Focus:
        def kept(time: float) -> float:
            return min(max(time, self.first), self.last)

        said = self.when.nth
        return Focus(
            start=kept(start),
            end=kept(end),
            moment=kept(moment),
            instant=instant,
            nth=nth if said is None else said,
            counted=said is not None,
            rough=rough,
        )

    # --- What it is measured by -------------------------------------------------------------------

    def _spans(self) -> Sequence[Span]:
        """When that was [s], oldest first."""
        match self.when.landmark:
            case "start":
                return [(self.first, min(self.first + EDGE, self.last))]
            case "end":
                return [(max(self.last - EDGE, self.first), self.last)]
            case "junction":
                return junctions(self.ride, self.last)
            case "roundabout":
                return roundabouts(self.ride, self.last)
        return self._deeds()

    def _deeds(self) -> list[Span]:
        """When the vehicle did so; one that is only described is any that did.

        Raises:
            Unanswered: it is unknown, or several of those may be meant.
        """
        actor = self.when.actor or self.query.actor
        vehicle = EGO if actor == "ego" else number_of(actor)
        ride = self.ride
        if vehicle is not None:
            if vehicle != EGO:
                check_known(ride, vehicle)
            return self._done_by(vehicle)
        done = [spans for other in ride.vehicles if (spans := self._done_by(other))]
        if not done:
            known = tuple(str(name) for name in ride.vehicles)
            raise decline("unknown-vehicle", asked=actor.partition(":")[2], known=known)
        if len(done) > 1:
            raise decline("ambiguous", vehicle=actor)
        return done[0]

    def _done_by(self, vehicle: int) -> list[Span]:
        deeds = self.when.deeds
        found = {s for action in deeds for s in occurrences(self.ride, vehicle, action)}
        if not found and "stop" in deeds:  # who says brake may mean either
            found = set(occurrences(self.ride, vehicle, "slow-down"))
        return sorted(found)

    def _which(self, spans: Sequence[Span]) -> Span:
        """The one of several that is meant: the last, where that is not said.

        Raises:
            Unanswered: there were not as many.
        """
        which = -1 if self.when.which is None else self.when.which
        place = which - 1 if which > 0 else which
        if not -len(spans) <= place < len(spans):
            raise self._never(times=len(spans), time=spans[-1][0])
        return spans[place]

    # --- To come ----------------------------------------------------------------------------------

    def _ahead(self) -> Focus | None:
        """What the plan leads to at, before or after that; None where it is not in the plan."""
        if self.when.actor not in (None, "ego"):
            return None
        steps = upcoming(self.ride)
        if self._is_place:
            span = crossing_ahead(self.ride, ring=self.when.landmark == "roundabout")
        else:
            named = [s for s in steps if any(same(deed, s.action) for deed in self.when.deeds)]
            span = (named[0].moment, named[0].moment) if named else None
        if span is None:
            return None
        start, end = span
        if self.when.relation == "before":
            moment = max(start - BEFORE, self.now)
            return Focus(start=self.now, end=moment, moment=moment, ahead=True)
        if self.when.relation == "after":
            start, end = end + ROUNDING * 10, max(step.moment for step in steps) + BEFORE
        return Focus(start=start, end=end, moment=start, ahead=True)

    # --- Refusals ---------------------------------------------------------------------------------

    def _check_missing(self) -> None:
        """That there was no such thing; but a place may be just part of what is asked about.

        Raises:
            Unanswered: the question is about a time that it is measured by.
        """
        if self._is_place and self.when.relation == "at" and self._named:
            return
        if self.query.tense == "future" and (self._named or self.when.actor not in (None, "ego")):
            return
        raise self._never()

    @property
    def _is_place(self) -> bool:
        return self.when.landmark in ("junction", "roundabout")

    @property
    def _named(self) -> bool:
        """Whether the question says what was done."""
        return bool(self.query.factual or self.query.counterfactual)

    def _never(self, times: int | None = None, time: float | None = None) -> Unanswered:
        actor = self.when.actor or self.query.actor
        vehicle = EGO if actor == "ego" else number_of(actor)
        if self.when.landmark != "deed":
            seldom = True if times else None
            return decline("did-not-happen", what=self.when.landmark, seldom=seldom, time=time)
        sides = len(self.when.deeds) > 1
        asked = tuple(SIDELESS.get(a, a) if sides else a for a in self.when.deeds[:1])
        happened = None if times is None else asked
        return decline(
            "did-not-happen",
            vehicle=vehicle,
            asked=asked,
            did=False,
            happened=happened,
            times=times,
            time=time,
        )

    def _check_inside(self, time: float) -> None:
        """Decline a time that is not in the record.

        Raises:
            Unanswered: it is not.
        """
        if not self.first - TOLERANCE[0] <= time <= self.last + TOLERANCE[0]:
            raise self._outside(time)

    def _outside(self, time: float | None) -> Unanswered:
        return decline("outside-record", time=time, since=self.first, until=self.last)
