"""The summary: what the figures of a report come to, each sentence with its source."""

from collections.abc import Iterator

from xavi_dialogue.report.content import Choice
from xavi_dialogue.report.decisions.alternatives import Cases, Tested
from xavi_dialogue.report.figures import Figure, Source
from xavi_dialogue.report.render.avoidance import emergencies, last_chance, light_told
from xavi_dialogue.report.render.jumps import told_jump
from xavi_dialogue.report.render.markup import Markup, Part, joined, listed
from xavi_dialogue.report.render.notes import KMH, number, percent
from xavi_dialogue.report.render.observations import Page
from xavi_dialogue.report.render.reasons import reasons_why
from xavi_dialogue.report.render.words import (
    action_words,
    capital,
    chain,
    goal,
    phrase,
    restraint,
    seconds,
    supposed_words,
)

SHIFT = 0.1  # probability of a collision by which a change counts
BRAKES = 1.0  # [m/s2] of the hardest braking by which a change counts
FASTER = 2.0  # [m/s] between the speeds expected and driven from which they are told
COUNTS = 2.0  # [s] of the expected reward by which a change counts


def summary(page: Page) -> Markup:
    """Return what the figures of a report come to."""
    return listed(
        [
            *_what(page),
            *_speeds(page),
            *_priority(page),
            *_light(page),
            *_believed(page),
            *_decided(page),
            *_moved(page),
            *_restrained(page),
            *_expected_speeds(page),
            *_held(page),
            *_hangs_on(page),
            *_avoidable(page),
        ]
    )


def _what(page: Page) -> Iterator[Markup]:
    moment, names = page.report.moment, page.names
    if moment.kind == "collision":
        when = page.notes.figure(moment.figures["time"])
        yield joined(("This car and ", names.of(moment.vehicle), " touched at ", when, "."))
    elif moment.kind == "red-light":
        when = page.notes.figure(moment.figures["time"])
        text = "This car stopped at a traffic light, or in the queue before it, at "
        yield joined((text, when, "."))
    braking = _peak_braking(page)
    if moment.kind == "hardest-braking":
        value = page.notes.figure(moment.figures["deceleration"])
        yield joined((f"At {seconds(moment.time)} this car braked with ", value, "."))
    elif braking is not None:
        rate, time, course = braking
        note = page.notes.ref(course)
        yield joined((f"The hardest braking of this car in these seconds was {rate:.1f} m/s², at "
                      f"{time:.1f} s", note, "."))  # fmt: skip
    if moment.kind == "closest-approach":
        value = page.notes.figure(moment.figures["gap"])
        who = capital(names.of(moment.vehicle))
        yield joined((f"{who} came as close as ", value, f" at {moment.time:.1f} s."))


def _peak_braking(page: Page) -> tuple[float, float, Source] | None:
    own = page.report.motions[0]
    if len(own.rate) < 3:
        return None
    k = min(range(len(own.rate)), key=lambda j: own.rate[j])
    return None if own.rate[k] > -0.5 else (-own.rate[k], own.time[k], own.source)


def _speeds(page: Page) -> Iterator[Markup]:
    """Yield the speeds at the moment of this car, and of the first of those involved."""
    moment = at = page.report.moment.time
    parts: list[Part] = []
    for course in page.report.motions[:3]:
        known = [k for k, t in enumerate(course.time) if abs(t - moment) <= 0.25]
        if known:
            near = min(known, key=lambda k: (abs(course.time[k] - moment), k))
            at = course.time[near] if not parts else at
            who = page.names.of(course.vehicle)
            speed = f"{who} {course.speed[near] * KMH:.1f} km/h"
            parts += [", " if parts else None, speed, page.notes.ref(course.source)]
    if parts:
        yield joined((f"Speeds at {seconds(at)}: ", *parts, "."))


def _priority(page: Page) -> Iterator[Markup]:
    """Yield who was to go first, of those involved, by the last decision that says so."""
    moment = page.report.moment.time
    for party in page.report.involved:
        rows = [
            row
            for row in page.report.precedence
            if party.vehicle in row.first and row.time <= moment + 1e-6
        ]
        if rows:
            row = rows[-1]
            first = phrase("first", row.first[party.vehicle])
            who = page.names.of(party.vehicle)
            text = f"Right of way between this car and {who}: {first} (decision {row.decision})"
            yield joined((text, page.notes.ref(row.source), "."))


def _light(page: Page) -> Iterator[Markup]:
    moment = page.report.moment.time
    for span in page.report.lights:
        if span.since <= moment + 1e-6 and span.until >= moment - 1.0:
            state = phrase("light", span.state)
            seen = "seen to change" if span.change_seen else "came into view so"
            later = span.until >= page.report.decisions[-1].time - 1e-6
            last = "at least until" if later else "to"
            yield joined((f"The light ahead showed {state} from {seconds(span.since)} ({seen}) "
                          f"{last} {seconds(span.until)}", page.notes.ref(span.distance.source),
                          "."))  # fmt: skip


def _believed(page: Page) -> Iterator[Markup]:
    """Yield what was last believed of those involved before the moment."""
    moment = page.report.moment.time
    for known in page.report.beliefs:
        rows = [
            (point.time, point.probability, one, point)
            for one in known.goals
            for point in one.points
            if point.time <= moment + 1e-6
        ]
        if not rows:
            continue
        last = max(time for time, *_ in rows)
        now = [row for row in rows if row[0] == last]
        _, chance, one, point = max(now, key=lambda row: row[1])
        came = {True: "; it did so", False: "; it did not do so", None: ""}[one.came]
        who = page.names.of(known.vehicle)
        text = f"Last belief about {who}: {goal(one.kind, one.place)}, {percent(chance)}"
        note = page.notes.ref(point.source)
        yield joined((f"{text} (decision {point.source.number}){came}", note, "."))


def _decided(page: Page) -> Iterator[Markup]:
    """Yield what was decided up to the moment by the decisions that are shown in full."""
    for one in page.report.decided:
        if one.time > page.report.moment.time + 1e-6:
            continue
        chosen = next((choice for choice in one.choices if choice.chosen), None)
        other = next((choice for choice in one.choices if not choice.chosen), None)
        at = f"Decision {one.number} ({page.by(one.time)}, {reasons_why(one)})"
        parts: list[Part] = [f"{at} was to {chain(one.plan)}"]
        if chosen is not None:
            parts += [", with ", _expected(page, chosen)]
        if other is not None:
            parts += [f"; the best other option, to {action_words(other.action)}, with "]
            parts += [_expected(page, other)]
        elif chosen is not None:
            parts.append("; there was no other option")
        yield joined((*parts, "."))


def _expected(page: Page, choice: Choice) -> Markup:
    """Return what was expected of an option."""
    crash = choice.chances.get("collision")
    parts: list[Part] = ["an expected reward of ", page.notes.figure(choice.value)]
    if crash is None:
        parts.append(" and a collision in none of the rollouts")
    else:
        whom = " or ".join(page.names.of(vehicle) for vehicle in choice.hit)
        with_whom = f" with {whom}" if whom else ""
        share = page.notes.figure(crash)
        parts += [f" and a collision{with_whom} in ", share, " of the rollouts"]
    return joined(parts)


def _moved(page: Page) -> Iterator[Markup]:
    """Yield where the probability of a collision moved far before the moment."""
    times = {row.number: row.time for row in page.report.decisions}
    for jump in page.report.jumps:
        if jump.vehicle is None and times[jump.number] <= page.report.moment.time + 1e-6:
            yield told_jump(page, jump)


def _restrained(page: Page) -> Iterator[Markup]:
    """Yield what kept the car from driving faster at the moment."""
    moment = page.report.moment.time
    told = [one for one in page.report.timeline if one.kind == "restrained"]
    known = [one for one in told if one.time <= moment + 1e-6]
    if known and known[-1].what != "nothing":
        last = known[-1]
        why = restraint(last, page.names.of(last.other)).rstrip(",")
        text = f"What kept this car from driving faster from {seconds(last.time)} on: {why}"
        yield joined((text, page.notes.ref(last.source), "."))


def _expected_speeds(page: Page) -> Iterator[Markup]:
    """Yield where another drove otherwise than the decisions that are examined expected it to."""
    for known in page.report.beliefs:
        seen = [one for one in known.speeds if one.at <= page.report.moment.time + 1e-6]
        pairs = [(abs(one.speed.value - one.driven.value), one) for one in seen if one.driven]
        apart, one = max(pairs, key=lambda pair: pair[0], default=(0.0, None))
        if one is not None and apart >= FASTER:
            who = page.names.of(known.vehicle)
            yield joined((f"Decision {one.decision} ({page.by(one.time)}) expected {who} to drive ",
                          page.notes.figure(one.speed), f" at {seconds(one.at)}; it drove ",
                          page.notes.figure(one.driven), "."))  # fmt: skip


def _held(page: Page) -> Iterator[Markup]:
    """Yield what the decision in force expected to hold the car up."""
    in_force = {one.number for one in page.report.decided if "in-force" in one.why}
    for case in page.report.cases:
        if case.decision in in_force and case.held:
            parts: list[Part] = []
            for one in case.held:
                name = "" if one.vehicle is None else f"{page.names.of(one.vehicle)}, "
                told = [f"{name}{phrase('held', one.how)}, ", page.notes.figure(one.expected)]
                parts += ["; " if parts else None, *told, " in the mean"]
            text = f"Decision {case.decision} expected this car to be held up by: "
            yield joined((text, *parts, "."))


def _hangs_on(page: Page) -> Iterator[Markup]:
    """Yield the changes that make a difference to the decisions that were examined."""
    for case in page.report.cases:
        told = [
            f"{supposed_words(page.names, one.supposed)}{_prior(one)}: {effect}"
            for one in case.tested
            if (effect := _effect(one, case)) is not None
        ]
        at = f"decision {case.decision} ({page.by(case.time)})"
        if case.reproduced is False:
            yield joined((f"{capital(at)} is planned otherwise by this program with nothing "
                          "changed, so what it hangs on is not certain.",))  # fmt: skip
        elif told:
            yield joined((f"Changes that alter {at}: {'. '.join(map(capital, told))}.",))
        elif case.tested:
            yield joined((f"None of the changes that were tested alters {at}.",))


def _prior(one: Tested) -> str:
    prior = one.supposed.prior
    return "" if prior is None else f" (believed {percent(prior.value)})"


def _effect(one: Tested, case: Cases) -> str | None:
    """Return what a change makes of a decision, if it makes a difference."""
    if one.trace is None:
        return None
    found = [] if one.same else [f"another action, to {chain(one.plan)}"]
    pairs = (
        ("expected reward", COUNTS, one.reward, case.reward),
        ("a collision in", SHIFT, one.collision, case.collision),
        ("hardest braking", BRAKES, one.braking, case.braking),
    )
    for name, least, there, here in pairs:
        if there is not None and here is not None and abs(there.value - here.value) >= least:
            after, before = (_plain(figure) for figure in (there, here))
            found.append(f"{name} {after} instead of {before}")
    return "; ".join(found) or None


def _plain(figure: Figure) -> str:
    if figure.unit == "":
        return percent(figure.value)
    return f"{number(figure.value, figure.unit)} {figure.unit.replace('m/s2', 'm/s²')}"


def _avoidable(page: Page) -> Iterator[Markup]:
    known = page.report.avoidability
    if known is not None:
        yield joined((last_chance(known),))
        yield from emergencies(page, known)
        if known.light is not None:
            yield light_told(page, known.light)
