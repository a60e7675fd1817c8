"""What reports say against the record, read and computed by other ways."""

import hashlib
import math
from itertools import pairwise
from pathlib import Path
from typing import get_args

import msgspec
import pytest
from msgspec.structs import replace

import xavi_dialogue as xavi
from planner.record.events import RestraintKind
from planner.record.trace import SAMPLE_PERIOD, PlanTrace
from sim.boxes import overlap
from sim.scene import EGO, VehicleState
from tests.report.records import (
    BRAKING,
    LIGHT,
    STEADY,
    TOWN,
    UNHEEDED,
    figures,
    incident,
    looked_up,
    report,
    ride,
    sources,
    traces,
)
from xavi_dialogue.domain.answers import NeedRollout
from xavi_dialogue.report.content import DecisionRow, Incident, encode
from xavi_dialogue.report.decisions.jumps import FAR, jumps
from xavi_dialogue.report.figures import Figure
from xavi_dialogue.report.render.words import phrase
from xavi_dialogue.report.road_users.tracks import Tracks
from xavi_dialogue.service.in_process import NoPlan
from xavi_dialogue.storage import ride_file
from xavi_dialogue.storage.ride_file import RecordedRide

CASES = [(UNHEEDED, "collision"), (BRAKING, "hardest braking"), (LIGHT, "red light")]
every_case = pytest.mark.parametrize(("path", "at"), CASES, ids=lambda x: getattr(x, "stem", x))


def history(path: object, vehicle: int) -> dict[float, float]:
    """Return the speeds [m/s] of a road user by time, from all histories."""
    found: dict[float, float] = {}
    for trace in ride(path).record.traces:  # type: ignore[arg-type]
        track = trace.history.get(vehicle)
        for k, speed in enumerate(() if track is None else track.speed):
            assert track is not None
            found[round(track.start + k * SAMPLE_PERIOD, 3)] = speed
    return dict(sorted(found.items()))


# --- every figure ---------------------------------------------------------------------------------


@every_case
def test_what_is_stated_as_it_stands_in_a_decision_stands_there(path, at) -> None:
    known, plain = traces(path), 0
    for figure in figures(incident(path, at)):
        source = figure.source
        if source.place == "decision":
            assert source.number is not None
            trace = known[source.number]
            assert (source.time, source.trace) == (trace.sim_time, trace.trace_id)
            if not source.how:
                assert figure.value == looked_up(trace, source.field)
                plain += 1
    assert plain > 10


@every_case
def test_every_source_names_a_field_that_is_there(path, at) -> None:
    known = traces(path)
    for source in sources(incident(path, at)):
        assert source.field
        if source.place == "decision":
            assert source.number is not None
            if "*" not in source.field and source.field != "road.priority":
                looked_up(known[source.number], source.field)
        if source.place == "event":
            event = ride(path).events[source.number or 0]
            assert event.sim_time == source.time


@every_case
def test_intervals_hold_their_values_and_say_what_they_are(path, at) -> None:
    wide = 0
    for one in figures(incident(path, at)):
        assert math.isfinite(one.value)
        assert (one.low is None) == (one.high is None) == (not one.interval)
        if one.low is not None and one.high is not None:
            assert one.low <= one.value <= one.high
            wide += one.low < one.high
        if one.unit == "":
            assert 0.0 <= one.value <= 1.0
    assert wide > 3


def test_the_same_ride_and_moment_give_the_same_bytes() -> None:
    again = xavi.open(UNHEEDED, scenario=UNHEEDED.parent / "worlds" / "unheeded").report()
    assert again.json() == report(UNHEEDED).json()
    assert again.html() == report(UNHEEDED).html()


@every_case
def test_the_json_holds_the_whole_content(path, at) -> None:
    found = incident(path, at)
    assert msgspec.json.decode(encode(found), type=Incident) == found


# --- moments --------------------------------------------------------------------------------------


def test_a_collision_is_the_most_remarkable_moment() -> None:
    found = report(UNHEEDED)
    event = next(one for one in ride(UNHEEDED).events if one.kind == "collided")
    assert (found.kind, found.time) == ("collision", event.sim_time)
    assert found.content.moment.vehicle == event.vehicle == 1
    assert (found.content.since, found.content.until) == (event.sim_time - 7.0, event.sim_time)


def test_without_braking_the_closest_approach_is_the_most_remarkable_moment() -> None:
    found = report(STEADY).content
    assert all(one.kind != "collided" for one in ride(STEADY).events)
    assert found.moment.kind == "closest-approach"
    gap = found.moment.figures["gap"].value
    assert gap == min(one.nearest.value for one in found.involved if one.nearest is not None)


def test_the_hardest_braking_is_that_of_the_histories() -> None:
    rates = []
    for trace in ride(BRAKING).record.traces:  # each has samples at its own times
        track = trace.history[EGO]
        for k in range(1, len(track.speed) - 1):
            change = track.speed[k + 1] - track.speed[k - 1]
            rates.append((change / (2 * SAMPLE_PERIOD), track.start + k * SAMPLE_PERIOD))
    rate, time = min(rates)
    found = report(BRAKING, "hardest braking")
    assert found.time == pytest.approx(time, abs=SAMPLE_PERIOD)
    assert found.content.moment.figures["deceleration"].value == pytest.approx(-rate, abs=0.1)


def test_a_stop_at_a_light_is_found_by_its_event() -> None:
    event = next(one for one in ride(LIGHT).events if one.kind == "stopped-at-light")
    assert report(LIGHT, "red light").time == event.sim_time


@pytest.mark.parametrize(
    ("at", "told"),
    [
        ("tea", "'tea' names no moment; give a time .* collision"),
        ("collision", "the ride has no collision; give a time"),
        (1e6, "no moment 1e.06 s; give one from 0 to"),
        (-1, "no moment -1 s"),
        (math.nan, "nan names no moment; give a time"),
    ],
)
def test_a_moment_that_is_not_there_is_refused(at: object, told: str) -> None:
    with pytest.raises(xavi.XaviError, match=told):
        ride(BRAKING).report(at)  # type: ignore[arg-type]


# --- what was observed ----------------------------------------------------------------------------


@every_case
def test_speeds_are_those_of_the_histories(path, at) -> None:
    found = incident(path, at)
    for course in found.motions:
        known = history(path, course.vehicle)
        for time, speed in zip(course.time, course.speed, strict=True):
            assert speed == pytest.approx(known[time], abs=1e-3)
        steps = [b - a for a, b in zip(course.time, course.time[1:], strict=False)]
        assert max(steps) <= 1.6 * SAMPLE_PERIOD or course.vehicle != EGO
    assert found.motions[0].vehicle == EGO


def test_gaps_are_between_the_bodies() -> None:
    found = incident(UNHEEDED)
    gaps = found.gaps[0]
    assert gaps.vehicle == 1
    last = traces(UNHEEDED)[11].scene
    assert gaps.distance[gaps.time.index(11.0)] == pytest.approx(
        least(last[EGO], last[1]), abs=0.06
    )


def least(a: VehicleState, b: VehicleState) -> float:
    """Return the distance [m] between two bodies by points on their edges."""
    return min(math.dist(p, q) for p in edge(a) for q in edge(b))


def edge(state: VehicleState) -> list[tuple[float, float]]:
    x, y = state.position
    cos, sin = math.cos(state.heading), math.sin(state.heading)
    found = []
    for k in range(101):
        share = k / 100.0
        for along, aside in (
            (-state.length * share, state.width / 2),
            (-state.length * share, -state.width / 2),
            (0.0, state.width * (share - 0.5)),
            (-state.length, state.width * (share - 0.5)),
        ):
            found.append((x + along * cos - aside * sin, y + along * sin + aside * cos))
    return found


@every_case
def test_right_of_way_is_that_of_the_decisions(path, at) -> None:
    known, found = traces(path), incident(path, at)
    assert found.precedence
    for row in found.precedence:
        road = known[row.decision].road
        assert road is not None
        assert row.first == {fact.vehicle: fact.who for fact in road.priority}
        assert row.rule == (road.route[0].rule if road.route else None)


def test_the_light_is_told_as_decisions_saw_it() -> None:
    found = incident(LIGHT, "red light")
    assert [span.state for span in found.lights][:1] == ["r"]
    for span in found.lights:
        road = traces(LIGHT)[span.decision].road
        assert road is not None
        seen = road.lights[0]
        assert (span.controller, span.state, span.since) == (
            seen.controller, seen.state, seen.since,
        )  # fmt: skip
        assert span.until >= span.since
    moment = found.moment.time
    assert any(s.state == "r" and s.since <= moment <= s.until for s in found.lights)


@every_case
def test_events_of_the_window_are_in_the_timeline(path, at) -> None:
    found = incident(path, at)
    times = [one.time for one in found.timeline]
    assert times == sorted(times)
    told = {(one.kind, one.time) for one in found.timeline}
    for event in ride(path).events:
        inside = found.since <= event.sim_time <= found.until
        if inside and event.kind in ("collided", "stopped-at-light", "action-committed"):
            assert (event.kind, event.sim_time) in told


@every_case
def test_beliefs_of_a_decision_add_up(path, at) -> None:
    for known in incident(path, at).beliefs:
        sums: dict[float, float] = {}
        for goal in known.goals:
            for point in goal.points:
                sums[point.time] = sums.get(point.time, 0.0) + point.probability
        for total in sums.values():
            assert 0.9 < total <= 1.0 + 1e-4


def test_where_a_vehicle_went_in_the_end_is_told() -> None:
    goals = {g.edge: g.came for g in incident(TOWN, "hardest braking").beliefs[0].goals}
    assert goals["C3_D3"] is True
    assert goals["C3_C4"] is False  # another road was taken there
    assert goals["D3_E3"] is None  # the next junction was not reached


def test_who_is_still_in_the_junction_as_the_record_ends_has_not_taken_a_road() -> None:
    found = incident(UNHEEDED)
    assert {goal.came for goal in found.beliefs[0].goals} == {None}
    assert found.beliefs[0].vehicle == found.moment.vehicle


@every_case
def test_who_was_seen_to_cross_is_told_so(path, at) -> None:
    found = incident(path, at)
    episodes = [one for one in found.timeline if one.kind == "episode"]
    crossed = {one.vehicle for one in episodes if one.what == "cross"}
    for known in found.beliefs:
        for goal in known.goals:
            if goal.kind == "cross" and known.vehicle in crossed:
                assert goal.came is True


def test_maps_show_everybody_where_they_were() -> None:
    found = incident(UNHEEDED)
    assert found.map.roads
    frame = next(one for one in found.map.frames if one.time == found.moment.time - 1.0)
    before, after = (traces(UNHEEDED)[n].scene[1].position for n in (10, 11))
    (x, y) = next(body.position for body in frame.bodies if body.vehicle == 1)
    assert min(before[1], after[1]) <= y <= max(before[1], after[1])
    assert x == pytest.approx(before[0], abs=0.3)


# --- what was decided -----------------------------------------------------------------------------


@every_case
def test_options_are_valued_as_the_decision_did(path, at) -> None:
    for one in incident(path, at).decided:
        trace = traces(path)[one.number]
        for choice in one.choices:
            rows = [
                r
                for r in trace.rollouts
                if r.weight is not None and r.actions[0].action == choice.action
            ]
            if not one.by_weights:
                assert not any(r.weight is not None for r in trace.rollouts)
                continue
            value = sum((r.weight or 0.0) * r.reward for r in rows)
            assert choice.value.value == pytest.approx(value, abs=1e-3)
            assert sum(f.value for f in choice.terms.values()) == pytest.approx(-value, abs=0.02)
            assert sum(f.value for f in choice.chances.values()) == pytest.approx(1.0, abs=1e-3)
        assert [c.action for c in one.choices if c.chosen] == [one.plan[0]]


def test_the_decisions_that_matter_are_examined() -> None:
    found = incident(UNHEEDED)
    assert [(one.number, one.why) for one in found.decided] == [
        (8, ("changed",)),
        (9, ("last-change", "last-chance")),
        (10, ("last-way",)),
        (11, ("in-force",)),
    ]
    assert [case.decision for case in found.cases] == [9, 11]


@every_case
def test_every_change_of_what_to_do_next_is_shown_with_its_options(path, at) -> None:
    found = incident(path, at)
    shown = {one.number for one in found.decided}
    assert {row.number for row in found.decisions if row.changed} <= shown
    assert found.avoidability is None or {found.avoidability.last} - {None} <= shown


@every_case
def test_an_option_has_one_reward_and_one_collision_wherever_it_is_shown(path, at) -> None:
    found = incident(path, at)
    rows = {row.number: row for row in found.decisions}
    cases = {case.decision: case for case in found.cases}
    known = found.avoidability
    chances = {} if known is None else {chance.number: chance for chance in known.chances}
    for one in found.decided:
        for choice in one.choices:
            crash = choice.chances.get("collision")
            share = 0.0 if crash is None else crash.value
            told = [rows.get(one.number), cases.get(one.number)] if choice.chosen else []
            for row in told:
                if row is not None:
                    value = row.value if isinstance(row, DecisionRow) else row.reward
                    assert value is not None
                    assert value.value == choice.value.value
                    assert row.collision is not None
                    assert row.collision.value == pytest.approx(share, abs=1e-6)
            for way in chances[one.number].ways if one.number in chances else ():
                if way.action == choice.action and not way.planned:
                    assert way.collision is not None
                    assert way.collision.value == pytest.approx(share, abs=1e-6)


def test_what_a_decision_that_weighed_is_worth_is_what_it_went_by() -> None:
    weighed = 0
    for row in incident(LIGHT, "red light").decisions:
        trace = traces(LIGHT)[row.number]
        if any(one.weight is not None for one in trace.rollouts):
            assert row.value is not None
            assert row.value.value == pytest.approx(trace.plan[0].value, abs=0.02)
            weighed += 1
    assert weighed > 5


def test_who_may_cross_on_foot_is_told_beside_the_right_of_way() -> None:
    found = incident(LIGHT, "red light")
    crossing = {row.decision: row.crossing for row in found.precedence}
    for number, known in crossing.items():
        for who, figure in known.items():
            assert traces(LIGHT)[number].scene[who].kind == "pedestrian"
            goals = next(p.goals for p in traces(LIGHT)[number].predictions if p.vehicle == who)
            chance = sum(goal.probability for goal in goals if goal.kind == "cross")
            assert figure.value == pytest.approx(chance, abs=1e-3)
    assert not any("gave-way" in one.roles for one in found.involved)  # the light held us
    assert {8, 9, 10} <= {who for known in crossing.values() for who in known}


def test_removing_the_other_removes_the_collision() -> None:
    case = next(one for one in incident(UNHEEDED).cases if one.decision == 11)
    assert case.collision is not None
    assert case.collision.value == 1.0
    absent = next(one for one in case.tested if one.supposed.kind == "absent")
    assert absent.supposed.vehicle == 1
    assert absent.collision is not None
    assert absent.collision.value == 0.0


@every_case
def test_rides_of_this_program_are_planned_as_recorded(path, at) -> None:
    found = incident(path, at)
    assert found.cases
    assert all(case.reproduced for case in found.cases)
    assert "other-program" not in {one.kind for one in found.limits}


def test_a_ride_of_another_program_is_told() -> None:
    found = incident(TOWN, "hardest braking")
    assert [case.reproduced for case in found.cases] == [False, False]
    (told,) = (one for one in found.limits if one.kind == "other-program")
    assert told.decisions == (22, 23)
    bare_cases = bare().report("collision").content.cases
    assert {case.reproduced for case in bare_cases} == {None}


@every_case
def test_what_is_planned_again_is_what_the_planner_gives(path, at) -> None:
    tested = [one for case in incident(path, at).cases for one in case.tested if one.trace]
    absent = [one for one in tested if one.supposed.kind == "absent"]
    assert tested
    for one in absent[:1]:
        trace = traces(path)[one.decision]
        need = NeedRollout(trace_id=trace.trace_id, removed=one.supposed.vehicle)
        made = ride(path).again(trace, need)
        assert one.trace == made.trace_id
        assert one.plan == tuple(step.action for step in made.plan)
        assert one.same == (one.plan[:1] == (trace.plan[0].action,))


def test_a_light_that_is_green_instead_is_tested() -> None:
    found = incident(LIGHT, "red light")
    lit = [one for case in found.cases for one in case.tested if one.supposed.kind == "light"]
    assert {one.supposed.lights[0].state for one in lit} == {"G"}
    for case in found.cases:
        for one in case.tested:
            if one.supposed.kind == "light":
                assert one.reward is not None
                assert case.reward is not None
                assert one.reward.value > case.reward.value


# --- from when it could have been avoided ---------------------------------------------------------


def touches(trace: PlanTrace, rollout: int, vehicle: int, until: float) -> bool:
    """Check whether the line of a rollout touches a vehicle as it drove, sample by sample."""
    known = trace.rollouts[rollout]
    line = known if known.path else trace.rollouts[known.same_as or 0]
    assert line.path is not None
    where: dict[float, VehicleState] = {}
    for later in traces(UNHEEDED).values():
        if vehicle not in later.history:
            continue
        track, shape = later.history[vehicle], later.scene[vehicle]
        for k, place in enumerate(track.position):
            time = round(track.start + k * SAMPLE_PERIOD, 3)
            where[time] = placed(shape, place, track.heading[k])
    last = max(where)
    final, speed = where[last], traces(UNHEEDED)[11].scene[vehicle].speed
    for k in range(1, len(line.path)):
        time = round(trace.sim_time + k * SAMPLE_PERIOD, 3)
        there = where.get(time)
        if there is None and time > last:
            x, y = final.position
            way = speed * (time - last)
            place = (x + way * math.cos(final.heading), y + way * math.sin(final.heading))
            there = placed(final, place, final.heading)
        (x0, y0), (x1, y1) = line.path[k - 1], line.path[k]
        heading = math.atan2(y1 - y0, x1 - x0) if (x0, y0) != (x1, y1) else 0.0
        here = placed(trace.scene[EGO], line.path[k], heading)
        if there is not None and time <= until and overlap(here, there):
            return True
    return False


def placed(shape: VehicleState, place: tuple[float, float], heading: float) -> VehicleState:
    return VehicleState(place, heading, 0.0, 0.0, shape.length, shape.width)


def test_stopping_at_the_ninth_decision_would_have_avoided_it() -> None:
    known = incident(UNHEEDED).avoidability
    assert known is not None
    assert known.last_on_route == 9
    trace = traces(UNHEEDED)[9]
    first = {r.index: r.actions[0].action for r in trace.rollouts if r.actions}
    lined = [r.index for r in trace.rollouts if r.path or r.same_as is not None]
    stops = [touches(trace, k, 1, 15.1) for k in lined if first.get(k) == "stop"]
    goes = [touches(trace, k, 1, 15.1) for k in lined if first.get(k) == "continue"]
    assert stops
    assert not any(stops)
    assert goes
    assert all(goes)
    chance = next(one for one in known.chances if one.number == 9)
    ways = {way.action: way for way in chance.ways}
    assert (ways["stop"].avoids, ways["continue"].avoids) == (True, False)
    assert ways["continue"].chosen
    assert replay(ways["continue"].replayed) == 1.0
    assert replay(ways["stop"].replayed) == 0.0


def replay(figure: Figure | None) -> float:
    assert figure is not None
    return figure.value


def test_of_options_that_avoid_it_both_judgements_do() -> None:
    known = incident(UNHEEDED).avoidability
    assert known is not None
    for chance in known.chances:
        assert sum(way.chosen for way in chance.ways) <= 1
        for way in chance.ways:
            both = (way.believed, way.replayed)
            if None not in both:
                assert way.avoids == all(f is not None and f.value <= 0.25 for f in both)


def test_the_last_moment_to_brake_comes_before_that_of_braking_harder() -> None:
    known = incident(UNHEEDED).avoidability
    assert known is not None
    firm, emergency = known.emergency
    assert firm.rate < emergency.rate
    assert firm.latest is not None
    assert emergency.latest is not None
    assert firm.latest < emergency.latest < known.at
    assert emergency.before == pytest.approx(known.at - emergency.latest)


def test_braking_is_avoided_only_by_what_brakes_less_often() -> None:
    known = incident(BRAKING, "hardest braking").avoidability
    assert known is not None
    assert known.mishap == "brake"
    for chance in known.chances:
        own = next((way.believed for way in chance.ways if way.chosen), None)
        for way in chance.ways:
            if way.avoids:
                assert own is not None
                assert way.believed is not None
                assert own.value - way.believed.value >= 0.25


# --- what the record cannot show, and what it was made from ---------------------------------------


def test_the_hashes_are_those_of_file_and_traces() -> None:
    known = incident(UNHEEDED).hashes
    assert known.file == hashlib.sha256(UNHEEDED.read_bytes()).hexdigest()
    for one in known.traces:
        assert one.trace == traces(UNHEEDED)[one.number].trace_id
    assert len(known.program) == 64
    assert known.network == traces(UNHEEDED)[0].network


def test_the_end_of_the_record_is_named() -> None:
    kinds = {one.kind: one for one in incident(UNHEEDED).limits}
    assert kinds["ends-early"].time == 11.1
    assert kinds["no-scenes"].time == 11.0
    assert "no-roads" not in kinds


def test_without_its_roads_a_ride_is_reported_from_the_record_alone() -> None:
    found = bare().report("collision").content
    assert found.map.roads == ()
    assert "no-roads" in {one.kind for one in found.limits}
    tested = [one for case in found.cases for one in case.tested]
    assert tested
    assert all(one.trace is None and one.refused == "planner-unavailable" for one in tested)
    told = incident(UNHEEDED, "collision")
    assert found.timeline == told.timeline
    assert found.hashes.ride == told.hashes.ride


def bare() -> xavi.Ride:
    """Return the ride without its roads."""
    found = ride(UNHEEDED)
    record = RecordedRide(
        found.record.scenario,
        found.record.seed,
        found.record.halt,
        found.record.traces,
        found.record.events,
        found.record.ended,
    )

    def none(trace: PlanTrace, need: NeedRollout) -> PlanTrace:
        raise NoPlan("planner-unavailable")

    return xavi.Ride(record, found.scenes, found.known, none)


@every_case
def test_what_holds_of_every_report_is_said(path, at) -> None:
    kinds = {one.kind for one in incident(path, at).limits}
    assert kinds >= {"model", "others-inside", "perfect-sight", "simulated"}


def test_an_option_that_collides_avoids_no_braking() -> None:
    known = incident(TOWN, "hardest braking").avoidability
    assert known is not None
    chance = next(one for one in known.chances if one.number == 22)
    ways = {way.action: way for way in chance.ways}
    rows = [r for r in traces(TOWN)[22].rollouts if r.actions[0].action == "continue"]
    assert {r.outcome for r in rows} == {"collision"}
    assert ways["continue"].believed is not None
    assert ways["continue"].believed.value == 0.0
    assert ways["continue"].avoids is False
    assert known.last is None


def test_whom_another_option_would_have_hit_is_involved() -> None:
    found = incident(TOWN, "hardest braking")
    hit = {r.collided_with for r in traces(TOWN)[22].rollouts} - {None}
    assert hit == {5}
    assert [(p.vehicle, p.roles) for p in found.involved] == [(5, ("in-the-way",))]
    choices = {c.action: c for one in found.decided for c in one.choices if one.number == 22}
    assert {v: f.value for v, f in choices["continue"].hit.items()} == {5: 1.0}
    assert choices["exit-right"].hit == {}


@every_case
def test_speeds_expected_are_those_of_the_predictions(path, at) -> None:
    checked = 0
    for known in incident(path, at).beliefs:
        driven = history(path, known.vehicle)
        for one in known.speeds:
            trace = traces(path)[one.decision]
            goals = next(p.goals for p in trace.predictions if p.vehicle == known.vehicle)
            k = round((one.at - one.time) / SAMPLE_PERIOD)
            rows = [
                (goal.probability * way.probability, way.speed[k])
                for goal in goals
                for way in goal.trajectories
                if len(way.speed) > k
            ]
            mean = sum(p * v for p, v in rows) / sum(p for p, _ in rows)
            assert one.speed.value == pytest.approx(mean, abs=1e-3)
            if one.driven is not None:
                near = min(driven, key=lambda t, at=one.at: abs(t - at))  # type: ignore[misc]
                assert one.driven.value == pytest.approx(driven[near], abs=0.7)
            checked += 1
    assert checked or path == BRAKING


def test_two_are_removed_together() -> None:
    pairs = [
        one
        for case in incident(LIGHT, "red light").cases
        for one in case.tested
        if one.supposed.kind == "pair"
    ]
    assert {one.supposed.pair for one in pairs} == {(4, 8), (4, 9), (8, 9)}
    trace = traces(LIGHT)[pairs[0].decision]
    need = NeedRollout(trace_id=trace.trace_id, removed=pairs[0].supposed.pair)
    assert pairs[0].trace == ride(LIGHT).again(trace, need).trace_id


def test_how_a_light_could_have_been_passed_follows_from_its_changes() -> None:
    known = incident(LIGHT, "red light").avoidability
    assert known is not None
    assert known.light is not None
    lit = [t.road.lights[0] for t in traces(LIGHT).values() if t.road and t.road.lights]
    green = next(one for one in lit if one.state == "g")
    assert (known.mishap, known.light.again) == ("stop", green.since)
    assert known.light.turned is None  # it was red when it came into view
    for one in known.light.passing:
        road = traces(LIGHT)[one.number].road
        assert road is not None
        far = road.lights[0].distance
        assert one.before is None
        assert one.after is not None
        assert one.after.value == pytest.approx(far / (green.since - one.time), abs=1e-3)
    first = known.light.passing[0]
    assert first.time == min(t.sim_time for t in traces(LIGHT).values() if t.road and t.road.lights)


def test_a_light_holds_up_every_option_before_it() -> None:
    known = incident(LIGHT, "red light").avoidability
    assert known is not None
    for chance in known.chances:
        for way in chance.ways:
            if not way.planned:
                rows = [
                    r
                    for r in traces(LIGHT)[chance.number].rollouts
                    if r.actions and r.actions[0].action == way.action
                ]
                held = [bool(r.held_by_lights) for r in rows]
                assert way.believed is not None
                assert min(held) <= way.believed.value <= max(held)
    assert known.last is None


def test_what_restrained_the_car_is_in_the_timeline() -> None:
    found = incident(TOWN, "hardest braking")
    told = [(one.time, one.what) for one in found.timeline if one.kind == "restrained"]
    events = [one for one in ride(TOWN).events if one.kind == "restrained"]
    inside = [one for one in events if found.since <= one.sim_time <= found.until]
    before = [one for one in events if one.sim_time < found.since]
    assert told == [(one.sim_time, one.by) for one in (*before[-1:], *inside)]
    assert before
    assert "bend" in [what for _, what in told]


def test_every_restraint_has_words() -> None:
    for kind in get_args(RestraintKind):
        assert phrase("restraint", kind) != kind or kind == "nothing"


# --- what moved far from one decision to the next -------------------------------------------------


def test_a_collision_that_becomes_probable_at_once_is_told_with_what_was_seen() -> None:
    (jump,) = (one for one in incident(UNHEEDED).jumps if one.goal is None)
    assert (jump.vehicle, jump.before, jump.number) == (None, 9, 10)
    rows = {row.number: row for row in incident(UNHEEDED).decisions}
    assert (jump.was, jump.now) == (rows[9].collision, rows[10].collision)
    known = traces(UNHEEDED)
    kinds = [one.kind for one in jump.changes]
    assert kinds == ["signals", "moved", "speed", "expected"]
    assert {one.vehicle for one in jump.changes} == {1}
    lights, _, speed, expected = jump.changes
    assert lights.words == ("brake", "")
    assert speed.was is not None
    assert speed.was.value == known[9].scene[1].speed
    assert expected.was is not None
    assert expected.now is not None
    assert expected.now.value - expected.was.value > 1.0


def test_an_option_that_was_given_up_as_it_became_dangerous_is_told() -> None:
    found = incident(UNHEEDED)
    (jump,) = (one for one in found.jumps if one.vehicle is None and one.goal is not None)
    rows = {row.number: row for row in found.decisions}
    assert rows[jump.before].plan[0] == jump.goal != rows[jump.number].plan[0]
    assert jump.now is not None
    assert jump.now.value >= FAR
    chosen = next(one for one in found.decided if one.number == jump.number)
    option = next(one for one in chosen.choices if one.action == jump.goal)
    assert option.chances["collision"].value == pytest.approx(jump.now.value, abs=0.01)


@every_case
def test_every_belief_that_moves_far_is_told_once(path, at) -> None:
    report = incident(path, at)
    told = {(one.vehicle, one.goal, one.before, one.number) for one in report.jumps}
    assert len(told) == len(report.jumps)
    for known in report.beliefs:
        for goal in known.goals:
            for first, then in pairwise(goal.points):
                numbers = (first.source.number, then.source.number)
                in_a_row = (numbers[0] or 0) + 1 == numbers[1]
                if in_a_row and abs(then.probability - first.probability) >= FAR:
                    assert (known.vehicle, *numbers) in {(v, *n) for v, _, *n in told}


def test_a_belief_that_moves_without_anything_seen_is_told_without_a_reason() -> None:
    before = traces(TOWN)[22]
    at, known = next((k, one) for k, one in enumerate(before.predictions) if one.vehicle == 5)
    chances = sorted((goal.probability for goal in known.goals), reverse=True)
    turned = [replace(g, probability=p) for g, p in zip(known.goals, chances[::-1], strict=True)]
    others = (*before.predictions[:at], *before.predictions[at + 1 :])
    after = replace(
        before,
        decision=23,
        sim_time=22.1,
        predictions=(replace(known, goals=tuple(turned)), *others),
    )
    (jump,) = jumps([before, after], Tracks({}, {}, math.inf), [5])
    assert (jump.vehicle, jump.changes) == (5, ())


def test_a_collision_with_somebody_never_seen_is_reported_from_the_event(tmp_path: Path) -> None:
    known = ride_file.load(UNHEEDED.read_bytes())
    known.events = [
        replace(event, vehicle=99) if event.kind == "collided" else event for event in known.events
    ]
    ride_file.save(known, tmp_path / "mine.ride.jsonl.gz")
    told = xavi.open(tmp_path / "mine").report("collision")
    party = next(one for one in told.content.involved if one.vehicle == 99)
    assert (party.roles, party.length, party.nearest) == (("collided",), None, None)
    assert any(one.kind == "unseen" and one.vehicles == (99,) for one in told.content.limits)
    avoided = told.content.avoidability
    assert avoided is not None
    assert (avoided.last, avoided.emergency) == (None, ())
    assert all(way.avoids is None for chance in avoided.chances for way in chance.ways)
    page = told.html()
    assert "had an option that the record shows to avoid it" in page
    assert "This car and vehicle 99 touched at" in page
    assert "Vehicle 99 is named by an event alone" in page
