"""What holds of every answer, whatever the explanation."""

import math
import re
from collections.abc import Iterator
from typing import Literal

from hypothesis import given, settings
from hypothesis import strategies as st

from tests.language.realise_cases import contexts, explanations, queries
from xavi_dialogue.explain.explanation import Explanation
from xavi_dialogue.explain.query import Query
from xavi_dialogue.language.context import SpeechContext
from xavi_dialogue.language.orthography import count_sentences, count_words
from xavi_dialogue.language.quantities import Quantity, bare, quantity
from xavi_dialogue.language.realise import MAX_SENTENCES, MAX_WORDS, MAX_WORDS_MORE, realise

JARGON = re.compile(
    r"\b(ego|macro|rollouts?|jerk|kl|curvature|angular|trajector\w+|prior|posterior|nan|none|null|"
    r"inf|true|false|change-\w+|exit-\w+|vehicle:\S+)\b",
    re.IGNORECASE,
)
DOUBLED = re.compile(r"\b(\w+) \1\b", re.IGNORECASE)
UNTIDY = re.compile(r"because\s*[.,]|[,.;:]\s*[,.;:]|\s[,.;:?]|  |\(\s|\s\)|[{}_]|[a-z]\. [a-z]")
EXAMPLES = settings(max_examples=400)


def spelt(value: float, unit: Literal["clock", "count"]) -> list[str]:
    return re.findall(r"\d+", quantity(Quantity(value, unit)))


def counted(found: Explanation) -> Iterator[str]:
    """Numbers of situations and options, and times of the ride."""
    if (sure := found.certainty) is not None:
        yield from (str(sure.good), str(sure.situations), str(sure.late))
    if (grounds := found.grounds) is not None:
        yield from [*spelt(grounds.start, "clock"), *spelt(grounds.end, "clock")]
        yield from spelt(grounds.fit or 0.0, "count")
    if found.choices is not None:
        yield str(len(found.choices.others))
        yield str(len(found.choices.others) - 3)
    if found.sight is not None:
        yield str(len(found.sight.others))
    if found.contrary is not None and found.contrary.done is not None:
        yield from spelt(found.contrary.done, "clock")
    if found.staying is not None and found.staying.since is not None:
        yield from spelt(found.staying.since, "clock")
    if found.seen is not None:
        yield from spelt(found.seen, "clock")
    yield from spelt(found.sim_time, "clock")


def details(found: Explanation, now: float) -> tuple[list[float], list[float], list[float]]:
    """The times [s], speeds [m/s] and probabilities of what single questions add."""
    times = [abs(step.moment - now) for step in found.steps]
    times += [max(end - now, 0.0) for end in found.span or ()]
    times += [math.floor(found.least or 0.0)]
    times += [m.delay * m.share for c in found.causes if (m := c.mechanism) and m.delay]
    times += [option.delta or 0.0 for option in found.choices.others] if found.choices else []
    speeds: list[float] = [found.sight.speed or 0.0] if found.sight is not None else []
    chances: list[float] = []
    if (grounds := found.grounds) is not None:
        speeds += [s for s in (grounds.speed_from, grounds.speed_to) if s is not None]
        chances += [grounds.probability, grounds.latest, grounds.before, grounds.after]
    if (sure := found.certainty) is not None:
        chances += [sure.share, sure.low]
    if (avoidance := found.avoidance) is not None:
        chances += [avoidance.risk, avoidance.other]
    if found.pivot is not None:
        chances.append(found.pivot.probability or 0.0)
    chances += [m.share for c in found.causes if (m := c.mechanism)]
    # What was simulated is told as neither impossible nor certain.
    return times, speeds, [min(max(chance, 0.01), 0.99) for chance in chances]


def numbers(found: Explanation, now: float) -> Iterator[str]:
    """Every number that an answer may contain, as it would be spelt."""
    evidence = found.evidence
    yield from (str(evidence.rollouts), str(evidence.distinct_samples))
    yield from counted(found)
    times = [found.arrival, *(x for e in found.effects for x in (e.delta, e.low, e.high))]
    speeds = [s for c in found.causes if (m := c.mechanism) for s in (m.speed_from, m.speed_to)]
    chances = [c.probability for c in found.causes]
    if found.outcome is not None:
        chances.append(found.outcome.probability)
    if found.activity is not None:
        speeds.append(found.activity.speed)
        chances.append(found.activity.probability or 0.0)
    if found.destination is not None:
        chances.append(found.destination.probability or 0.0)
    if found.moment is not None:
        times.append(abs(now - found.moment))
        yield from re.findall(r"\d+", quantity(Quantity(found.moment, "clock")))
    more_times, more_speeds, more_chances = details(found, now)
    times += more_times
    speeds += more_speeds
    chances += more_chances
    for value in times:
        yield from re.findall(r"[\d.]+", quantity(Quantity(value or 0.0, "s")))
        yield bare(Quantity(value or 0.0, "s"))
    if found.sight is not None:
        yield from re.findall(r"\d+", quantity(Quantity(found.sight.distance or 0.0, "m")))
    for value in speeds:
        yield from re.findall(r"\d+", quantity(Quantity(value or 0.0, "km/h")))
    if found.certainty is not None:
        yield str(5 * math.floor(found.certainty.low * 20.0 + 1e-9))  # a bound is rounded down
    for chance in chances:
        yield from re.findall(r"\d+", quantity(Quantity(chance, "probability")))


def vehicles(found: Explanation, query: Query) -> set[int]:
    known = {c.vehicle for c in found.causes}
    if found.outcome is not None and found.outcome.collided_with is not None:
        known.add(found.outcome.collided_with)
    if found.activity is not None:
        known.add(found.activity.vehicle)
    if found.destination is not None:
        known.add(found.destination.vehicle)
    if found.grounds is not None:
        known.add(found.grounds.vehicle)
    if found.pivot is not None and found.pivot.vehicle is not None:
        known.add(found.pivot.vehicle)
    if found.sight is not None:
        known |= {found.sight.vehicle, *found.sight.others}
    if found.choices is not None:
        known |= {o.collided_with for o in found.choices.others if o.collided_with is not None}
    if found.suspect is not None:
        known.add(found.suspect.vehicle)
    return known | {int(n) for n in re.findall(r"\d+", query.actor)}


@EXAMPLES
@given(queries, explanations, contexts)
def test_answers_are_tidy(query: Query, found: Explanation, context: SpeechContext) -> None:
    text = realise(query, found, context).text
    assert text[-1] in ".?"
    assert text[0].isupper()
    assert DOUBLED.search(text) is None
    assert UNTIDY.search(text) is None
    assert text.count("(") == text.count(")")
    assert "would not not" not in text


@EXAMPLES
@given(queries, explanations, contexts)
def test_answers_keep_to_a_passengers_words(
    query: Query, found: Explanation, context: SpeechContext
) -> None:
    assert JARGON.search(realise(query, found, context).text) is None


@EXAMPLES
@given(queries, explanations, contexts)
def test_answers_are_short(query: Query, found: Explanation, context: SpeechContext) -> None:
    text = realise(query, found, context).text
    if "more" in (query.detail, context.detail) and query.detail != "less":
        assert count_words(text) <= MAX_WORDS_MORE
    else:
        assert count_words(text) <= MAX_WORDS
        assert count_sentences(text) <= MAX_SENTENCES


@EXAMPLES
@given(queries, explanations, contexts)
def test_numbers_and_vehicles_come_from_the_explanation(
    query: Query, found: Explanation, context: SpeechContext
) -> None:
    said = realise(query, found, context)
    named = {int(n) for n in re.findall(r"[Vv]ehicle (\d+)", said.text)}
    assert named == set(said.mentioned)
    assert named <= vehicles(found, query)
    bare = re.sub(r"[Vv]ehicle \d+", "", said.text)
    assert set(re.findall(r"\d+(?:\.\d+)?", bare)) <= set(numbers(found, context.now))


@EXAMPLES
@given(queries, explanations, contexts)
def test_a_vehicle_is_described_once_and_only_where_it_is_new(
    query: Query, found: Explanation, context: SpeechContext
) -> None:
    said = realise(query, found, context)
    described = [int(n) for n in re.findall(r"\(vehicle (\d+)\)", said.text)]
    assert len(set(described)) == len(described)
    assert context.named.isdisjoint(described)
    for number in described:
        first = said.text.lower().index(f"vehicle {number}")
        assert said.text[first - 1] == "("


@EXAMPLES
@given(queries, explanations, contexts)
def test_only_what_was_said_before_is_said_to_have_been(
    query: Query, found: Explanation, context: SpeechContext
) -> None:
    text = realise(query, found, context).text
    assert ("as I said," in text or "As I said," in text) == context.repeated


@given(queries, explanations, contexts)
def test_wording_is_deterministic(query: Query, found: Explanation, context: SpeechContext) -> None:
    assert realise(query, found, context) == realise(query, found, context)


@given(queries, explanations)
def test_the_papers_style_is_tidy_too(query: Query, found: Explanation) -> None:
    context = SpeechContext(style="paper", max_causes=4, max_effects=4)
    text = realise(query, found, context).text
    assert text.endswith((".", "?"))
    assert UNTIDY.search(text) is None
    assert "  " not in text
    assert "would have certainly" not in text


@given(st.floats(0, 1))
def test_a_chance_is_never_certain(probability: float) -> None:
    spelt = quantity(Quantity(probability, "probability"))
    assert (spelt == "over 95 %") == (probability >= 0.975)
    assert (spelt == "under 5 %") == (probability < 0.025)
    assert spelt not in ("100 %", "0 %")
