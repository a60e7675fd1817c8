"""What is read out of the propositions of a question: the event, the vehicle, past or not."""

from typing import Any

import pytest
from msgspec.structs import replace

from tests.explain.answers.given import NOW, Given, look, refused
from xavi_dialogue.domain.answers import CannotSay, NoSuchVehicle
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.meaning import Whether
from xavi_dialogue.domain.terms import (
    Believed,
    Both,
    Caused,
    Ego,
    Event,
    Exists,
    Happens,
    Is,
    Lane,
    Nobody,
    Not,
    Now,
    Passenger,
    Vehicle,
    Vehicles,
)
from xavi_dialogue.explain.answers.reasons import motions
from xavi_dialogue.explain.answers.reference.reading import (
    check_able,
    check_seen,
    event_of,
    is_own,
    is_past,
    looks,
    manner_of,
    somebody,
    subject,
    unwrapped,
    vehicle_in,
)
from xavi_dialogue.explain.answers.suppositions import deciding, possible

BRAKED = Event("brake")
SAID = Happens(BRAKED)
EARLIER = Span(4.0, 6.0, said=True)


@pytest.mark.parametrize(
    ("of", "content", "negated"),
    [
        (SAID, SAID, False),
        (Not(SAID), SAID, True),
        (Not(Not(SAID)), SAID, False),
        (Both((Not(SAID), Exists(Vehicle(1)))), SAID, True),
        (Not(Both((SAID, Exists(Vehicle(1))))), SAID, True),
        (Both(()), None, False),
        (None, None, False),
    ],
)
def test_negations_are_taken_off_and_counted(of: Any, content: Any, negated: bool) -> None:
    assert unwrapped(of) == (content, negated)


@pytest.mark.parametrize(
    ("of", "event"),
    [
        (SAID, BRAKED),
        (Not(SAID), BRAKED),
        (Is("necessary", event=BRAKED), BRAKED),
        (Is("safe", Vehicle(1)), None),
        (Caused(Vehicle(1), SAID), BRAKED),
        (Caused(Vehicle(1)), None),
        (Believed(Not(SAID)), BRAKED),
        (Exists(Vehicle(1)), None),
        (None, None),
    ],
)
def test_the_event_of_a_proposition_is_found(of: Any, event: Event | None) -> None:
    assert event_of(of) == event


def test_things_are_told_to_be_ours_or_anothers() -> None:
    assert [is_own(x) for x in (None, Ego(), Passenger(), Vehicle(0))] == [True] * 4
    assert [is_own(x) for x in (Vehicle(1), Lane("left"))] == [False] * 2
    things = (Vehicle(3), Vehicle(0), Vehicles((4, 2)), Vehicles(()), Ego(), None)
    assert [vehicle_in(x) for x in things] == [3, None, 4, None, None, None]
    assert (somebody(0), somebody(5)) == (Ego(), Vehicle(5))


def test_who_was_never_seen_is_refused_with_who_is_in_view() -> None:
    one, gone = look(1), look(2, in_view=False, seen=3.0)
    asked = Given(looks={1: one, 2: gone}).asked()
    assert (check_seen(asked, Vehicle(2)), check_seen(asked, Ego())) == (2, None)
    assert refused(check_seen, asked, Vehicle(7)) == NoSuchVehicle(Vehicle(7), NOW, (one,))
    assert refused(check_seen, asked, Nobody()) == NoSuchVehicle(Nobody(), NOW, (one,))
    assert refused(check_seen, asked, Vehicles((9, 1))).thing == Vehicle(9)


def test_looks_are_of_the_moment_asked_about() -> None:
    def at(time: float) -> Any:
        return look(1, time=time) if time >= 4.9 else None

    given = Given(looks={1: at, 2: lambda t: look(2, time=t, in_view=t < 10.0)})
    assert [(x.vehicle, x.time) for x in looks(given.asked(EARLIER))] == [(1, 5.0), (2, 5.0)]
    assert [(x.vehicle, x.time) for x in looks(given.asked())] == [(1, NOW)]


@pytest.mark.parametrize(
    ("event", "span", "names", "past", "coming"),
    [
        (BRAKED, None, ("slow-down",), True, False),
        (replace(BRAKED, tense="perfect"), None, ("slow-down",), True, False),
        (replace(BRAKED, tense="present"), None, ("slow-down",), False, False),
        (replace(BRAKED, tense="future"), None, ("slow-down",), False, True),
        (replace(BRAKED, tense="present"), EARLIER, ("slow-down",), True, False),
        (Event("do"), None, (), True, False),
        (None, EARLIER, (), True, False),
    ],
)
def test_what_a_question_names_of_us(
    event: Any, span: Any, names: Any, past: bool, coming: bool
) -> None:
    found = subject(Given().asked(span), event)
    assert found.event == event
    assert set(names) <= set(found.names)
    assert bool(found.names) is bool(names)
    assert (found.is_past, found.coming) == (past, coming)
    assert found.span == (span if past else None)


def test_a_span_that_is_no_past_is_left_out_of_what_is_going_on() -> None:
    ahead = Span(30.0, 40.0, ahead=True)
    found = subject(Given().asked(ahead), replace(BRAKED, tense="present"))
    assert (found.is_past, found.span) == (False, None)


@pytest.mark.parametrize(
    ("event", "span", "past"),
    [
        (None, None, True),
        (BRAKED, None, True),
        (replace(BRAKED, tense="perfect"), None, True),
        (replace(BRAKED, tense="present"), None, False),
        (replace(BRAKED, tense="future"), None, False),
        (replace(BRAKED, tense="present"), EARLIER, True),
        (replace(BRAKED, tense="present", time=Now()), EARLIER, False),
    ],
)
def test_whether_a_question_is_about_the_past(event: Any, span: Any, past: bool) -> None:
    assert is_past(Given().asked(span), event) is past


def test_what_no_car_can_do_is_declined() -> None:
    assert refused(check_able, Event("fly")) == CannotSay("capability", "fly", "not-an-action")
    check_able(Event("overtake"))


def test_the_first_manner_of_those_wanted_is_told() -> None:
    event = Event("go", manner=("gently", "slowly", "early"))
    assert manner_of(event, "early", "slowly") == "slowly"
    assert manner_of(event, "fast") is None
    assert manner_of(None, "fast") is None


def modal(action: Any, how: Any, tense: Any = "past", **more: Any) -> Happens:
    return Happens(Event(action, modal=how, tense=tense, **more))


@pytest.mark.parametrize(
    ("of", "could", "must"),
    [
        (modal("stop", "could"), True, False),
        (modal("stop", "could", "perfect"), True, False),
        (modal("stop", "could", "present"), False, False),
        (modal("stop", "would"), False, False),
        (modal("see", "could"), False, False),
        (modal("honk", "could"), False, False),
        (modal("stop", "could", actor=Vehicle(1)), False, False),
        (Not(modal("stop", "could")), True, False),
        (modal("stop", "must"), False, True),
        (modal("arrive", "must"), False, False),
        (modal("stop", "must", actor=Vehicle(1)), False, False),
        (modal("give-way", "must"), False, False),
        (modal("wait", "must"), False, True),
        (modal("give-way", "must", object=Vehicle(1)), False, False),
        (modal("wait", "must", "present"), False, False),
        (modal("let-go", "must", "present"), False, False),
        (modal("stop", "must", "present"), False, True),
        (modal("stop", "must", object=Vehicle(1)), False, True),
        (Is("necessary", event=Event("stop", modal="must")), False, False),
        (Is("possible", event=Event("stop", modal="could")), False, False),
        (Exists(Vehicle(1)), False, False),
        (None, False, False),
    ],
)
def test_what_we_could_or_had_to_do_is_recognised(of: Any, could: bool, must: bool) -> None:
    assert (possible.is_could(of), possible.is_must(of)) == (could, must)


@pytest.mark.parametrize(
    ("event", "slow"),
    [
        (Event("speed-up", modal="could"), True),
        (Event("go", modal="could", manner=("fast",)), True),
        (Event("stop", modal="could"), False),
    ],
)
def test_what_we_could_have_done_is_supposed_but_for_going_faster(
    event: Event, slow: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(motions, "slow", lambda scene: ("why so slow", scene))
    monkeypatch.setattr(possible, "of_us", lambda event, scene, form: (event, scene, form))
    asked = Given().asked()
    found: Any = possible.could(Whether(Happens(event)), asked)
    wanted = ("why so slow", asked) if slow else (replace(event, modal="would"), asked, "could")
    assert found == wanted


@pytest.mark.parametrize(
    ("event", "slow"),
    [
        (Event("go", modal="must", manner=("slowly",)), True),
        (Event("move", modal="must", manner=("slowly",)), True),
        (Event("continue", modal="must", manner=("slowly",)), True),
        (Event("stop", modal="must", manner=("slowly",)), False),
        (Event("go", modal="must"), False),
    ],
)
def test_what_we_had_to_do_is_asked_as_a_necessity(
    event: Event, slow: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(motions, "slow", lambda scene: "why so slow")
    monkeypatch.setattr(deciding, "needed", lambda question, scene: question)
    found: Any = possible.must(Whether(Happens(event)), Given().asked())
    plain = replace(event, modal=None)
    about = Whether(Is("necessary", event=plain, time=plain.time, tense=plain.tense))
    assert found == ("why so slow" if slow else about)
