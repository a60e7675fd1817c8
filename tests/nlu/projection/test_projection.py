"""Meanings onto the fields by which annotated texts are scored."""

import pytest

from xavi_dialogue.domain.meaning import (
    Act,
    Ask,
    AskHelp,
    Beyond,
    Claim,
    Compare,
    Doing,
    Elliptic,
    Fault,
    HowAvoid,
    HowKnow,
    HowLong,
    HowSure,
    Repair,
    Request,
    Social,
    WhatIf,
    WhatWouldChange,
    When,
    Whether,
    Which,
    Whither,
    Why,
)
from xavi_dialogue.domain.terms import (
    Both,
    Caused,
    Described,
    Event,
    Exists,
    Happens,
    Not,
    Pronoun,
    Vehicle,
    Wanted,
)
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.nlu.projection import QueryFields, project

LORRY = Described(kind="truck")
FRONT = Described(kind="car", bearing="ahead")


def happens(action: ActionName, **rest: object) -> Happens:
    return Happens(Event(action, **rest))  # type: ignore[arg-type]


def fields(query: QueryFields) -> dict[str, object]:
    """The fields that say something."""
    found = {name: getattr(query, name) for name in query.__struct_fields__}
    return {name: value for name, value in found.items() if value and value != "ego"}


@pytest.mark.parametrize(
    ("act", "expected"),
    [
        (Ask(Why(happens("change-left"))), {"type": "why", "factual": ("change-left",)}),
        (
            Ask(Why(happens("stop"), instead=happens("go"))),
            {"type": "why", "factual": ("stop",), "counterfactual": ("continue",)},
        ),
        (
            Ask(Why(Not(happens("stop", actor=Vehicle(2))))),
            {"type": "why_not", "actor": "vehicle:2", "counterfactual": ("stop",)},
        ),
        (
            Ask(Why(happens("brake", actor=FRONT, tense="present"))),
            {
                "type": "why",
                "actor": "vehicle:front",
                "factual": ("stop",),
                "tense": "present",
            },
        ),
        (
            Ask(Whether(Caused(LORRY, happens("stop")))),
            {"type": "why", "factual": ("stop",), "hypothesised_cause": "vehicle:truck"},
        ),
        (Ask(Why(happens("collide"))), {"type": "why", "event": "collision"}),
        (
            Ask(Why(Not(happens("u-turn")))),
            {"type": "out_of_scope", "reason": "not-an-action"},
        ),
        (
            Ask(WhatIf(Not(Exists(Vehicle(1))))),
            {
                "type": "what_if",
                "actor": "vehicle:1",
                "negated": True,
                "tense": "present",
                "intervention": "remove",
            },
        ),
        (
            Ask(WhatIf(Both((happens("exit-straight", actor=Vehicle(1)), Not(happens("stop")))))),
            {
                "type": "what_if",
                "actor": "vehicle:1",
                "factual": ("stop",),
                "counterfactual": ("exit-straight",),
            },
        ),
        (
            Ask(WhatIf(Not(Exists(Vehicle(1))), Whether(happens("stop", modal="would")))),
            {"type": "sensitivity", "factual": ("stop",), "condition": "vehicle:1"},
        ),
        (
            Ask(Which(Wanted(), happens("brake", actor=Wanted()))),
            {"type": "what", "actor": "vehicle:unknown", "factual": ("stop",)},
        ),
        (
            Ask(Whither(Vehicle(1))),
            {"type": "where_goal", "actor": "vehicle:1", "tense": "present"},
        ),
        (Ask(Doing(tense="future")), {"type": "what", "tense": "future"}),
        (Ask(When(happens("slow-down"))), {"type": "when", "factual": ("slow-down",)}),
        (
            Ask(HowLong(Event("stand", tense="present"))),
            {"type": "when", "factual": ("stop",), "tense": "present"},
        ),
        (
            Ask(HowSure(happens("exit-left", actor=Vehicle(1), tense="future"))),
            {
                "type": "confidence",
                "actor": "vehicle:1",
                "factual": ("exit-left",),
                "tense": "future",
            },
        ),
        (
            Ask(Compare((happens("change-left"), happens("keep-lane")), "best")),
            {"type": "compare", "factual": ("change-left",), "counterfactual": ("continue",)},
        ),
        (
            Ask(Compare((happens("go", modal="would"), happens("give-way")), "time")),
            {"type": "compare", "factual": ("give-way",), "counterfactual": ("continue",)},
        ),
        (
            Ask(HowKnow(happens("stop", actor=Vehicle(1), tense="future"))),
            {"type": "how", "actor": "vehicle:1", "factual": ("stop",), "tense": "future"},
        ),
        (Ask(HowAvoid(happens("collide"))), {"type": "how_avoid", "event": "collision"}),
        (
            Ask(WhatWouldChange(happens("exit-left"), most=True)),
            {"type": "sensitivity", "factual": ("exit-left",)},
        ),
        (Ask(Fault()), {"type": "out_of_scope", "reason": "blame"}),
        (
            Claim(happens("stop", modal="could")),
            {"type": "why_not", "counterfactual": ("stop",)},
        ),
        (
            Request(Event("change-lane")),
            {"type": "out_of_scope", "tense": "present", "reason": "command"},
        ),
        (
            Beyond("off-topic"),
            {"type": "out_of_scope", "tense": "present", "reason": "off-topic"},
        ),
        (Social("greeting"), {"type": "smalltalk", "tense": "present"}),
        (AskHelp(), {"type": "help", "tense": "present"}),
        (Elliptic(form="why"), {"type": "ambiguous"}),
        (
            Ask(Why(happens("change-lane"))),
            {"type": "why", "factual": ("change-left",), "underspecified": "direction"},
        ),
    ],
)
def test_a_meaning_has_its_fields(act: Act, expected: dict[str, object]) -> None:
    assert fields(project((act,))) == {"tense": "past", **expected}


WHY = QueryFields(type="why", actor="vehicle:1", factual=("stop",))
OURS = QueryFields(type="why", factual=("exit-right",), tense="present")


@pytest.mark.parametrize(
    ("act", "before", "expected"),
    [
        (Elliptic(thing=Vehicle(2)), WHY, {"actor": "vehicle:2"}),
        (Repair("longer"), WHY, {"detail": "more"}),
        (Repair("shorter"), WHY, {"detail": "less"}),
        (Repair("meant", thing=Vehicle(3)), WHY, {"actor": "vehicle:3"}),
        (
            Elliptic(form="what-if", negated=True),
            WHY,
            {"type": "what_if", "factual": None, "counterfactual": ("stop",), "negated": True},
        ),
        (
            Elliptic(form="why-not", event=Event("exit-left")),
            OURS,
            {"type": "why_not", "factual": ("exit-right",), "counterfactual": ("exit-left",)},
        ),
        (Ask(HowSure()), WHY, {"type": "confidence"}),
        (Elliptic(form="when"), WHY, {"type": "when"}),
        (
            Ask(Why(happens("do", actor=Pronoun("it")))),
            QueryFields(type="what", actor="vehicle:1"),
            {"type": "why", "actor": "vehicle:1", "factual": None},
        ),
    ],
)
def test_a_follow_up_takes_the_rest_from_the_question_before(
    act: Act, before: QueryFields, expected: dict[str, object]
) -> None:
    found = project((act,), before)
    whole = {name: getattr(before, name) for name in before.__struct_fields__} | expected
    assert found == QueryFields(**{**whole, "refers_to_previous": True})


def test_the_first_question_counts_and_others_are_noted() -> None:
    both = project((Social("thanks"), Ask(Why(happens("stop"))), Ask(Doing())))
    assert (both.type, both.compound) == ("why", True)


def test_nothing_understood_is_ambiguous() -> None:
    assert project(()).type == "ambiguous"
