"""Questions about the option or the decision that the answer before told of."""

from typing import Any

import pytest
from msgspec.structs import replace

from tests.nlu.grounding.fakes import Car, FakeWorld, did, talk
from xavi_dialogue.domain.discourse import Discourse, Mention, Span
from xavi_dialogue.domain.meaning import (
    Compare,
    HowDecide,
    HowMuch,
    HowSure,
    Listing,
    Question,
    WhatIf,
    WhatWouldChange,
    Whether,
    Why,
)
from xavi_dialogue.domain.terms import (
    At,
    AtDecision,
    Described,
    Ego,
    Event,
    Exists,
    Happens,
    Is,
    Measured,
    Not,
    Now,
    Pronoun,
    That,
    Vehicle,
)
from xavi_dialogue.nlu.grounding.acts.follow_ups import compared, followed
from xavi_dialogue.nlu.grounding.context import Context
from xavi_dialogue.nlu.grounding.grounder import TermGrounder

STOP = Event("stop", tense="present", time=At(12.0))
LEFT = Event("change-left", tense="present", time=At(12.0))
GO = Event("continue", tense="present", time=At(12.0))
SLOWED, OVERTOOK = Happens(Event("slow-down", tense="past")), Event("overtake", tense="past")
HIM = Vehicle(1)
NOT_LEFT = Not(Happens(replace(LEFT, modal=None)))
TOLD = talk(option=replace(LEFT, modal="can"), decided=GO)
CLOSE, CLOSE_TWO = Whether(Is("close", Pronoun("it"))), Whether(Is("close", Pronoun("them-all")))
APART = HowMuch(Measured("distance", Pronoun("them-all"), to=Pronoun("them-all")))
MARGIN = Compare((Happens(GO), Happens(LEFT)), "margin")
DO = Event("do", tense="present")


def grounder(said: Discourse, *happened: Any) -> TermGrounder:
    return TermGrounder(Context(FakeWorld({1: Car(20.0)}, happened, now=20.0), said))


def of(question: Question | None, **more: Any) -> Discourse:
    """A discourse after a question, of which the answer told nothing else."""
    return replace(Discourse(turn=2), question=question, **more)


def weighed(question: Question, **more: Any) -> Discourse:
    return of(question, option=LEFT, decided=GO, **more)


def option_of(said: Discourse) -> Not:
    assert said.option is not None
    return Not(Happens(replace(said.option, modal=None)))


@pytest.mark.parametrize("form", ["that", "this"])
@pytest.mark.parametrize("asked", [
    Why(SLOWED), WhatIf(SLOWED), HowMuch(Measured("speed")), HowSure(SLOWED),
    Compare((SLOWED, Happens(GO)), "best"),
])  # fmt: skip
def test_that_for_a_cause_is_what_was_told_of_us(form: Any, asked: Question) -> None:
    g = grounder(of(asked, option=replace(LEFT, modal="can")))
    found = followed(Why(Happens(DO), suspect=Pronoun(form)), g)
    assert found == Why(NOT_LEFT)
    assert g.notes.leaned
    # What is said by its own name stays.
    assert followed(Why(SLOWED, suspect=Pronoun(form)), g) == Why(SLOWED)
    plain = grounder(of(asked))
    assert followed(Why(That(), suspect=Pronoun(form)), plain) == Why(That())


@pytest.mark.parametrize("asked", [None, Why(Happens(Event("brake", HIM))), Listing("options")])
def test_that_for_a_cause_is_nothing_where_no_reason_of_ours_was_told(
    asked: Question | None,
) -> None:
    spoken = Why(SLOWED, suspect=Pronoun("that"))
    g = grounder(of(asked, option=LEFT))
    assert followed(spoken, g) == spoken
    assert not g.notes.leaned


def test_whether_somebody_is_the_reason_is_asked_of_the_option_under_discussion() -> None:
    g = grounder(TOLD)
    assert followed(Why(That(), suspect=HIM), g) == Why(NOT_LEFT, suspect=HIM)
    assert g.notes.leaned
    nothing = grounder(talk())
    assert followed(Why(That(), suspect=HIM), nothing) == Why(That(), suspect=HIM)
    assert not nothing.notes.leaned
    alone = grounder(TOLD)
    assert followed(Why(That()), alone) == Why(That())
    assert not alone.notes.leaned


DECISIONS = (
    Listing("options"), Listing("rivals"), Listing("decisions"), HowDecide(), WhatWouldChange(),
    Compare((Happens(GO), Happens(LEFT)), "best"), HowSure(Happens(LEFT)), Why(NOT_LEFT),
)  # fmt: skip
OTHERS = (
    Listing("vehicles"), Compare((HIM, Vehicle(2)), by="speed"), Why(Happens(Event("brake", HIM))),
    Compare((Happens(GO), Happens(Event("stop", HIM))), "best"),
    HowSure(Happens(Event("turn", HIM))), HowSure(Happens(Event("collide"))), HowSure(None),
    Why(Exists(HIM)), WhatIf(SLOWED), Why(SLOWED),
)  # fmt: skip


@pytest.mark.parametrize(
    "spoken",
    [CLOSE, HowMuch(Measured("distance", Pronoun("it"))), Whether(Is("close", Pronoun("they")))],
)
@pytest.mark.parametrize("asked", DECISIONS)
def test_how_close_it_was_is_by_how_much_the_decision_was_taken(
    asked: Question, spoken: Question
) -> None:
    g = grounder(weighed(asked))
    assert followed(spoken, g) == MARGIN
    assert g.notes.leaned
    assert followed(spoken, grounder(of(asked))) == Listing("rivals")
    assert followed(spoken, grounder(of(asked, option=LEFT))) == Listing("rivals")
    assert followed(spoken, grounder(of(asked, decided=GO))) == Listing("rivals")


@pytest.mark.parametrize("asked", DECISIONS)
def test_what_it_costs_is_asked_of_what_a_decision_weighed(asked: Question) -> None:
    for form in ("it", "that"):
        spoken = HowMuch(Measured("delay", Pronoun(form)))  # type: ignore[arg-type]
        assert followed(spoken, grounder(of(asked))) == Listing("rivals")
    elsewhere = grounder(of(Listing("vehicles")))
    assert followed(HowMuch(Measured("delay", Pronoun("it"))), elsewhere) != Listing("rivals")


@pytest.mark.parametrize("asked", OTHERS)
def test_how_close_it_was_is_a_distance_where_no_decision_was_told_of(asked: Question) -> None:
    g = grounder(weighed(asked))
    assert followed(CLOSE, g) == CLOSE
    assert not g.notes.leaned


def test_how_close_the_two_are_is_of_a_decision_after_a_reason_or_a_supposition() -> None:
    for asked in (Why(SLOWED), WhatIf(SLOWED)):
        assert followed(CLOSE_TWO, grounder(weighed(asked))) == MARGIN
        assert followed(APART, grounder(weighed(asked))) == MARGIN
    # Otherwise "them all" means those who are near.
    of_him = Why(Happens(Event("brake", HIM)))
    assert followed(CLOSE_TWO, grounder(weighed(of_him))) == CLOSE
    him = Whether(Is("close", Pronoun("he")))
    assert followed(him, grounder(weighed(Why(NOT_LEFT)))) == him


def test_it_is_who_was_named_beside_what_we_did_not_do() -> None:
    waited = Why(Not(Happens(Event("wait", tense="present"))))
    named = (Mention(HIM, 1, True, 0.9), Mention(Ego(), 1, True, 0.8))
    assert followed(CLOSE, grounder(weighed(waited))) == MARGIN
    assert followed(CLOSE, grounder(weighed(waited, mentions=named))) == CLOSE
    long_ago = (Mention(HIM, 0, True, 0.9),)
    assert followed(CLOSE, grounder(weighed(waited, mentions=long_ago))) == MARGIN
    # A turn or a lane change is weighed, no matter who was named.
    assert followed(CLOSE, grounder(weighed(Why(NOT_LEFT), mentions=named))) == MARGIN
    turn = Why(Not(Happens(Event("exit-left", tense="present"))))
    assert followed(CLOSE, grounder(weighed(turn, mentions=named))) == MARGIN


def test_what_would_change_most_is_asked_of_the_option() -> None:
    for what in (None, That()):
        g = grounder(TOLD)
        spoken = WhatWouldChange(what, most=True)
        assert followed(spoken, g) == WhatWouldChange(NOT_LEFT, most=True)
        assert g.notes.leaned
        assert followed(spoken, grounder(talk())) == spoken
    assert followed(WhatWouldChange(), grounder(TOLD)) == WhatWouldChange()


def test_what_else_there_was_is_asked_of_the_decision_that_was_told_of() -> None:
    for kind in ("options", "rivals"):
        g = grounder(TOLD)
        assert followed(Listing(kind), g) == Listing(kind, time=At(12.0))
        assert g.notes.leaned
    decided = of(HowDecide(), episode=(9.0, 9.0))
    assert followed(Listing("options"), grounder(decided)) == Listing("options", time=At(9.0))
    for other in (
        of(HowDecide(), episode=(9.0, 11.0)),
        of(HowDecide()),
        of(Why(SLOWED), episode=(9.0, 9.0)),
        of(HowDecide(), option=Event("stop")),
    ):
        g = grounder(other)
        assert followed(Listing("options"), g) == Listing("options")
        assert not g.notes.leaned
    said = Listing("options", time=Now())
    assert followed(said, grounder(TOLD)) == said
    assert followed(Listing("vehicles"), grounder(TOLD)) == Listing("vehicles")


DELAY = HowMuch(Measured("delay", event=Event("do", tense="past")))


@pytest.mark.parametrize("action", [
    "turn", "exit-left", "exit-right", "exit-straight", "leave", "keep-lane", "continue",
    "change-plan",
])  # fmt: skip
def test_what_a_choice_saved_is_what_else_there_was(action: Any) -> None:
    done = Event(action, tense="past", time=At(8.0))
    g = grounder(talk(propositions=(Happens(done),)))
    assert followed(DELAY, g) == Listing("rivals", event=done)
    assert g.notes.leaned


def test_what_was_saved_is_by_what_we_spoke_of_and_else_by_the_last_change_of_lanes() -> None:
    done = replace(OVERTOOK, time=At(8.0))
    g = grounder(talk(propositions=(Happens(done),)))
    assert followed(DELAY, g) == HowMuch(Measured("delay", event=done))
    assert g.notes.leaned
    # No halt saves time, nor does what others do.
    for nothing in (replace(done, action="wait"), replace(done, actor=HIM)):
        said = talk(propositions=(Happens(nothing),))
        changed = grounder(said, did("change-lane", 5.0, 7.0))
        found = followed(DELAY, changed)
        assert found == HowMuch(Measured("delay", event=Event("change-lane", tense="perfect")))
        assert not changed.notes.leaned
        assert followed(DELAY, grounder(said)) == Listing("rivals")
    both = talk(propositions=(Happens(replace(done, action="wait")), Happens(done)))
    assert followed(DELAY, grounder(both)) == HowMuch(Measured("delay", event=done))


def test_how_sure_we_were_of_what_we_do_is_of_that_decision() -> None:
    spoken = HowSure(Happens(replace(DO, object=Described())))
    assert followed(spoken, grounder(talk())) == HowSure(Happens(DO))
    for time in (At(40.0), AtDecision(3)):
        timed = replace(spoken, time=time)
        assert followed(timed, grounder(talk())) == replace(
            timed, of=Happens(replace(DO, time=time))
        )
    assert followed(replace(spoken, time=Now()), grounder(talk())).of == Happens(DO)  # type: ignore[union-attr]
    may = HowSure(Happens(replace(DO, modal="can", object=Described())))
    assert followed(may, grounder(talk())) == may


def test_how_sure_of_nothing_is_of_the_choice_that_was_asked_about() -> None:
    stopped = Happens(Event("stop", tense="past"))
    for told in (NOT_LEFT, stopped):
        g = grounder(of(Why(told)))
        assert followed(HowSure(None), g) == HowSure(told)
        assert g.notes.leaned
    his = Not(Happens(Event("stop", HIM)))
    for other in (Why(SLOWED), Why(his), Why(Happens(Event("stop", HIM))), WhatIf(NOT_LEFT), None):
        g = grounder(of(other))
        assert followed(HowSure(None), g) == HowSure(None)
        assert not g.notes.leaned
    changed = HowSure(None, changed=True)
    assert followed(changed, grounder(of(Why(NOT_LEFT)))) == changed


def test_what_is_not_of_a_decision_is_left_as_it_is() -> None:
    for spoken in (Whether(SLOWED), HowMuch(Measured("speed")), HowDecide(), WhatIf(SLOWED)):
        assert followed(spoken, grounder(TOLD)) == spoken


def compare(*options: Any, said: Discourse = TOLD) -> tuple[Any, ...]:
    return compared(Compare(options, "best"), options, grounder(said)).options


def test_only_what_was_decided_is_compared_with_the_option() -> None:
    said = talk(option=LEFT, decided=GO)
    assert compare(Happens(GO), said=said) == (Happens(GO), Happens(LEFT))
    assert compare(Happens(STOP), said=said) == (Happens(STOP),)
    assert compare(Happens(GO), said=talk(decided=GO)) == (Happens(GO),)
    assert compare(Happens(GO), said=talk(option=LEFT)) == (Happens(GO),)


def test_that_among_options_is_the_one_under_discussion_and_else_what_was_asked() -> None:
    assert compare(That(), Happens(STOP), said=talk(option=LEFT)) == (Happens(LEFT), Happens(STOP))
    asked = talk(question=Why(Not(SLOWED)))
    assert compare(That(), Happens(STOP), said=asked) == (SLOWED, Happens(STOP))
    assert compare(That(), Happens(STOP), said=talk()) == (That(), Happens(STOP))


@pytest.mark.parametrize("action", ["wait", "keep-lane", "stand"])
def test_staying_beside_an_option_is_what_was_decided(action: Any) -> None:
    stay = Happens(Event(action, tense="present"))
    said = talk(option=STOP, decided=GO)
    assert compare(stay, Happens(STOP), said=said) == (Happens(GO), Happens(STOP))
    assert compare(stay, Happens(STOP), said=talk(option=STOP))[0] == Happens(STOP)
    assert compare(stay, Happens(STOP), said=talk()) == (stay, Happens(STOP))
    waiting = talk(option=Event("wait"), decided=GO)
    assert compare(stay, Happens(STOP), said=waiting) == (stay, Happens(STOP))
    his = Happens(Event(action, HIM, tense="present"))
    assert compare(his, Happens(STOP), said=said) == (his, Happens(STOP))


def test_staying_beside_changing_is_staying_in_the_lane() -> None:
    wait, change = Event("wait", tense="present"), Event("change-lane", tense="present")
    keep = Happens(replace(wait, action="keep-lane"))
    assert compare(Happens(wait), Happens(change), said=talk()) == (keep, Happens(change))
    other = Event("change-plan", tense="present")
    assert compare(Happens(wait), Happens(other), said=talk()) == (keep, Happens(change))
    for_him = Happens(replace(wait, object=HIM))
    assert compare(for_him, Happens(change), said=talk()) == (for_him, Happens(change))
    turn = Happens(Event("turn", tense="present"))
    assert compare(Happens(wait), turn, said=talk()) == (Happens(wait), turn)


def test_what_would_have_been_better_is_asked_of_when_that_was() -> None:
    passed = Happens(Event("overtake", tense="past"))
    asked = of(Why(SLOWED), episode=(4.0, 6.0))
    for spoken, said, span in (
        (passed, asked, Span(4.0, 6.0)), (Happens(LEFT), asked, None),
        (passed, of(Listing("options"), episode=(4.0, 6.0)), None), (passed, of(Why(SLOWED)), None),
        (passed, of(HowSure(SLOWED), episode=(4.0, 6.0)), Span(4.0, 6.0)),
    ):  # fmt: skip
        g = grounder(said)
        compared(Compare((spoken,), "best"), (spoken,), g)
        assert g.notes.span == span
        assert g.notes.leaned == (span is not None)
