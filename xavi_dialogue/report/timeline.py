"""The timeline: events, decisions, what was done, lights and beliefs, in order of time."""

from collections.abc import Iterator, Sequence

import msgspec

from planner.record.trace import PlanTrace
from sim.scene import EGO
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.facts.actions import somebody
from xavi_dialogue.explain.history.ride import planned
from xavi_dialogue.report.content import Beliefs, Chosen, Entry, LightSpan
from xavi_dialogue.report.figures import Figure, Source, rounded
from xavi_dialogue.report.ridden import Inquiry, Ridden
from xavi_dialogue.report.road_users.parties import of_trace
from xavi_dialogue.report.road_users.tracks import Tracks

#: What is told of those involved, as it was seen.
SEEN: tuple[ActionName, ...] = (
    "brake", "slow-down", "speed-up", "stop", "go", "change-left", "change-right", "exit-left",
    "exit-right", "exit-straight", "cut-in", "pull-out", "cross", "overtake", "signal", "appear",
    "disappear",
)  # fmt: skip
AGAIN = 3.0  # [s] after giving way to somebody for which that is not told again
SOON = 0.6  # [s] between the beginnings of two accounts of one thing
FROM_EVENTS = (
    "action-committed", "gave-way", "restrained", "stopped-at-light", "arrived", "collided",
    "ended",
)  # fmt: skip


def timeline(
    inquiry: Inquiry,
    tracks: Tracks,
    moment: Chosen,
    window: tuple[float, float],
    lights: Sequence[LightSpan],
    beliefs: Sequence[Beliefs],
) -> tuple[Entry, ...]:
    """Return what happened in a window [s], in order of time.

    Args:
        inquiry: the record.
        tracks: where everybody was.
        moment: what the report is about.
        window: [s] begin and end.
        lights: what lights on the car's way showed.
        beliefs: of those involved.
    """
    involved = [known.vehicle for known in beliefs]
    found = [
        *_events(inquiry.ridden, window),
        *_decisions(inquiry.ridden, window),
        *_episodes(inquiry, tracks, window, involved),
        *_lights(lights, window[0]),
        *(entry for known in beliefs for entry in _beliefs(known)),
        *_moment(moment),
    ]
    return tuple(sorted(found, key=lambda one: one.time))


def _moment(moment: Chosen) -> Iterator[Entry]:
    if moment.kind in ("hardest-braking", "closest-approach"):
        name = "deceleration" if moment.kind == "hardest-braking" else "gap"
        figure = moment.figures[name]
        yield Entry(
            time=moment.time,
            kind="peak",
            source=figure.source,
            vehicle=EGO,
            what=moment.kind,
            other=moment.vehicle,
            figures={name: figure},
        )


def _events(ridden: Ridden, window: tuple[float, float]) -> Iterator[Entry]:
    waited: dict[int | None, float] = {}
    told = ridden.record.events
    earlier = [
        k for k, one in enumerate(told) if one.kind == "restrained" and one.sim_time < window[0]
    ]
    in_force = earlier[-1] if earlier else None  # as the window begins
    for k, event in enumerate(told):
        inside = window[0] <= event.sim_time <= window[1]
        if (inside or k == in_force) and event.kind in FROM_EVENTS:
            if event.kind == "gave-way":
                before = waited.get(event.vehicle, -AGAIN)
                waited[event.vehicle] = event.sim_time
                if event.sim_time - before < AGAIN:
                    continue
            source = Source("event", "kind", k, event.sim_time)
            what: str = event.action or ""
            lit = False
            if event.kind == "restrained":
                what = "" if event.by is msgspec.UNSET else event.by
                lit = event.light is not msgspec.UNSET and what != "light"
            found = Entry(event.sim_time, event.kind, source, EGO, what, other=event.vehicle)
            yield msgspec.structs.replace(found, lit=lit)


def _decisions(ridden: Ridden, window: tuple[float, float]) -> Iterator[Entry]:
    """Yield the decisions that chose another first action than the one before."""
    traces = ridden.record.traces
    for k, trace in enumerate(traces):
        inside = window[0] <= trace.sim_time <= window[1]
        before = planned(traces[k - 1])[:1] if k else ()
        if inside and planned(trace)[:1] != before and trace.under_way is None:
            yield Entry(
                time=trace.sim_time,
                kind="decision",
                source=of_trace(trace, "plan"),
                vehicle=EGO,
                plan=planned(trace),
                figures=_value(trace),
            )


def _value(trace: PlanTrace) -> dict[str, Figure]:
    if not trace.plan:
        return {}
    return {"value": Figure(trace.plan[0].value, "s", of_trace(trace, "plan[0].value"))}


def _episodes(
    inquiry: Inquiry, tracks: Tracks, window: tuple[float, float], involved: Sequence[int]
) -> Iterator[Entry]:
    """Yield what the car and those involved were seen to do."""
    seen = inquiry.world.episodes((EGO, *involved), SEEN, *window)
    for episode in seen:
        if episode.action == "speed-up" and any(_sets_off(other, episode) for other in seen):
            continue
        who = somebody(episode.actor)
        known = who is not None and len(who) == 1
        if not known or not window[0] <= episode.begin <= window[1]:
            continue
        vehicle = next(iter(who or ()))
        whom = somebody(episode.object)
        if vehicle not in (EGO, *involved) or _is_event(inquiry, vehicle, episode):
            continue
        yield Entry(
            time=rounded(episode.begin, 2),
            kind="episode",
            source=tracks.source("speed", vehicle, how="seen in the motion"),
            vehicle=vehicle,
            what=episode.action,
            other=next(iter(whom)) if whom is not None and len(whom) == 1 else None,
            until=None if episode.end is None else rounded(episode.end, 2),
            figures=_figures(tracks, vehicle, episode),
        )


def _sets_off(other: Episode, episode: Episode) -> bool:
    """Check whether speeding up is also told as setting off."""
    near = abs(other.begin - episode.begin) <= SOON
    return other.action == "go" and other.actor == episode.actor and near


def _is_event(inquiry: Inquiry, vehicle: int, episode: Episode) -> bool:
    """Check whether the events tell of an action of the car."""
    named = episode.action.startswith(("change-", "exit-"))
    told = inquiry.ridden.record.events
    return vehicle == EGO and named and any(event.action == episode.action for event in told)


def _figures(tracks: Tracks, vehicle: int, episode: Episode) -> dict[str, Figure]:
    """Return the speeds and the deceleration of an episode."""
    source = tracks.source("speed", vehicle, how=f"from {episode.begin:.1f} s")
    known = (
        ("from", episode.speed_from, "m/s"),
        ("to", episode.speed_to, "m/s"),
        ("peak", episode.peak, "m/s2"),
    )
    return {
        name: Figure(rounded(value), unit, source)
        for name, value, unit in known
        if value is not None
    }


def _lights(lights: Sequence[LightSpan], since: float) -> Iterator[Entry]:
    for span in lights:
        begun = span.change_seen and span.since >= since
        far = {} if begun else {"distance": span.distance}
        time = max(span.since, since)
        yield Entry(time, "light", span.distance.source, what=span.state, figures=far)


def _beliefs(known: Beliefs) -> Iterator[Entry]:
    """Yield when the likeliest goal of a road user changed."""
    times = sorted({point.time for goal in known.goals for point in goal.points})
    last: tuple[str, str] | None = None
    for time in times:
        rows = [
            (point.probability, goal, point)
            for goal in known.goals
            for point in goal.points
            if point.time == time
        ]
        chance, goal, point = max(rows, key=lambda row: row[0])
        if (goal.kind, goal.place) != last:
            last = (goal.kind, goal.place)
            yield Entry(time, "belief", point.source, known.vehicle, goal.kind, goal.place,
                        figures={"probability": Figure(chance, "", point.source)})  # fmt: skip
