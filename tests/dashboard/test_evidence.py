"""What an answer rests on: never at odds with the answer, and told as far as it is at hand."""

from functools import cache

import msgspec
import pytest
from msgspec.structs import replace

from planner.record.trace import PlanTrace, Rollout
from tests.dialogue.talking import Talk, ride
from tests.explain.trust import trusted
from xavi_dialogue.dashboard.typed_answer import told_of
from xavi_dialogue.dashboard.views.evidence import has_evidence, of_turn, traces_of, vehicles_of
from xavi_dialogue.dashboard.web.http_documents import EvidenceShown
from xavi_dialogue.dialogue.explanation import Contrastive, as_json
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.domain.answers import ChoiceReason
from xavi_dialogue.domain.discourse import GroundedAct
from xavi_dialogue.domain.meaning import Ask, Identify
from xavi_dialogue.domain.terms import Ego, Thing, Vehicle, Vehicles

CONTRASTS = (
    "Why did you change lanes?",
    "Why did you turn right?",
    "What if you had gone straight?",
    "What if you had stopped?",
    "Why did you not turn left?",
    "Would stopping have been safer?",
    "What if vehicle 1 had not been there?",
    "What if vehicle 1 had turned left?",
    "What if vehicle 1 went straight on?",
    "What else could you have done?",
    "Did you have to do that?",
    "What mattered most?",
    "What would have to change for you to stop?",
    "Would you still have slowed down if vehicle 1 had gone straight?",
    "Would you still have changed lanes if vehicle 1 had turned left?",
)
OTHERS = (
    "Why did you slow down?",
    "What are you doing now?",
    "How did you decide that?",
    "How sure are you?",
    "When will we be there?",
    "Where is vehicle 1 going?",
    "Why is vehicle 1 slowing down?",
    "What will vehicle 2 do?",
    "How fast is vehicle 1?",
    "How do you know that vehicle 1 turns right?",
    "Why are you in this lane?",
)
ABOUT_OTHERS = (
    "Is vehicle 1 going to turn right?",
    "Is vehicle 1 going to turn left?",
    "What is vehicle 1 doing?",
    "Where is vehicle 1 going?",
    "Why is vehicle 1 slowing down?",
    "What will vehicle 2 do?",
)
RIDES = ("s1-0", "s1-4", "s2-0", "s2-2", "s3-0", "s4-0")


@cache
def every(name: str) -> dict[str, PlanTrace]:
    known = ride(name)
    return {trace.trace_id: trace for trace in (*known.traces, *known.whatifs.values())}


def asked(name: str, text: str, at: float | None = None) -> Reply:
    return Talk(name, at).say(text).reply


def evidence(name: str, reply: Reply) -> EvidenceShown:
    found = of_turn(7, reply, every(name))
    assert found is not None
    assert msgspec.json.decode(msgspec.json.encode(found), type=EvidenceShown) == found
    return found


def explained(reply: Reply) -> Contrastive:
    told = told_of(reply)
    assert told is not None
    return told.said


def reason(reply: Reply) -> ChoiceReason:
    return msgspec.convert(reply.answers[0], ChoiceReason)


def replies(name: str, questions: tuple[str, ...]) -> list[Reply]:
    last = ride(name).ended or ride(name).traces[-1].sim_time
    times = (0.4 * last, 0.7 * last, last)
    found = [asked(name, text, at) for text in questions for at in times]
    return [reply for reply in found if has_evidence(reply)]


@pytest.mark.parametrize("name", RIDES)
def test_what_is_shown_agrees_with_what_was_said(name: str) -> None:
    compared = 0
    for reply in replies(name, CONTRASTS):
        explanation, shown = explained(reply), evidence(name, reply)
        assert shown.missing is None, (reply.text, shown.missing)
        assert shown.factual is not None
        assert (shown.counterfactual is None) == (not explanation.counterfactual)
        if shown.counterfactual is None or shown.factual is None:
            continue
        compared += 1
        outcome = explanation.outcome
        if outcome is not None:
            share = shown.counterfactual.outcomes[outcome.name]
            told = share if outcome.name == "dead" else trusted(share, outcome.name)
            assert told == pytest.approx(outcome.probability, abs=1e-4)
        for effect, said in zip(explanation.effects, shown.effects, strict=True):
            assert said.delta == pytest.approx(effect.delta, abs=1e-4)
            assert said.low <= said.delta <= said.high
            arrivals = shown.factual.arrival, shown.counterfactual.arrival
            if effect.component == "time" and None not in arrivals:
                assert arrivals[1] - arrivals[0] == pytest.approx(effect.delta, abs=2e-3)  # type: ignore[operator]
        for side in (shown.factual, shown.counterfactual):
            assert sum(side.outcomes.values()) == pytest.approx(1.0, abs=1e-3)
            assert len(side.lines) <= 5
            assert 0 < len(side.runs) <= 100
            assert {run.outcome for run in side.runs} <= set(side.outcomes)
            assert len({(line.path, line.outcome) for line in side.lines}) == len(side.lines)
            shares = [line.probability for line in side.lines]
            assert shares == sorted(shares, reverse=True)
            assert sum(shares) <= 1.001
    assert compared > 0


@pytest.mark.parametrize("name", RIDES)
def test_answers_without_a_counterfactual_show_what_there_is(name: str) -> None:
    alone = 0
    for reply in replies(name, OTHERS):
        shown = evidence(name, reply)
        if not explained(reply).counterfactual:
            alone += 1
            assert shown.counterfactual is None
            assert shown.missing is None
        assert shown.decision in every(name)
    assert alone > 0


def test_runs_are_the_rollouts_that_they_name() -> None:
    reply = asked("s1-0", "Why did you change to the left lane?")
    shown = evidence("s1-0", reply)
    trace = every("s1-0")[shown.traces[0]]
    rollouts: dict[int, Rollout] = {rollout.index: rollout for rollout in trace.rollouts}
    assert shown.counterfactual is not None
    for run in shown.counterfactual.runs:
        rollout = rollouts[run.index]
        assert run.outcome == rollout.outcome
        assert run.arrival == rollout.components["time"]
        assert [vehicle for vehicle, _, _ in run.samples] == sorted(
            sample.vehicle for sample in rollout.samples
        )
        long = sum(stretch.until - stretch.since for stretch in rollout.held_up)
        assert sum(seconds for _, _, seconds in run.held_up) == pytest.approx(long, abs=0.2)


def test_who_is_left_out_is_in_no_run_of_the_counterfactual() -> None:
    shown = evidence("s1-0", asked("s1-0", "What if vehicle 1 had not been there?"))
    assert shown.method == "planning again"
    assert shown.factual is not None
    assert shown.counterfactual is not None
    assert any(v == 1 for run in shown.factual.runs for v, _, _ in run.samples)
    assert not any(v == 1 for run in shown.counterfactual.runs for v, _, _ in run.samples)


def test_a_cause_is_told_with_how_and_whether_it_was_tried() -> None:
    [cause, *_] = evidence("s1-0", asked("s1-0", "Why did you change to the left lane?")).causes
    assert cause.vehicle == 1
    assert cause.words.startswith("will ")
    assert cause.how is not None
    assert cause.checked is not None
    assert "without vehicle 1" in cause.checked.lower()


def test_what_is_supposed_of_a_vehicle_does_not_pass_for_taking_it_away() -> None:
    shown = evidence("s2-0", asked("s2-0", "What if vehicle 1 went straight on?"))
    assert [cause.vehicle for cause in shown.causes] == [1]
    assert shown.causes[0].checked is None


def test_what_is_not_at_hand_is_said() -> None:
    reply = asked("s1-0", "What if vehicle 1 had not been there?")
    decision, again = traces_of(reply)
    known = every("s1-0")
    none = of_turn(0, reply, {})
    assert none is not None
    assert none.factual is None is none.counterfactual
    assert none.missing is not None
    assert none.effects  # the answer's own figures are there all the same
    part = of_turn(0, reply, {decision: known[decision]})
    assert part is not None
    assert part.factual is not None
    assert part.counterfactual is None
    assert part.missing is not None
    assert part.missing != none.missing
    other = of_turn(0, reply, {again: known[again]})
    assert other is not None
    assert other.factual is None is other.counterfactual


def test_rollouts_that_give_other_figures_than_the_answer_are_not_shown() -> None:
    reply = asked("s1-0", "Why did you change to the left lane?")
    told = reason(reply)
    first, *rest = told.contrast.effects
    odd = replace(told.contrast, effects=(replace(first, delta=first.delta + 1.0), *rest))
    shown = evidence("s1-0", replace(reply, answers=(as_json(replace(told, contrast=odd)),)))
    assert shown.counterfactual is None
    assert shown.missing is not None


def test_the_decision_behind_a_plan_made_again_is_found() -> None:
    known = every("s1-0")
    again = next(t for t in known.values() if t.what_if is not None)
    reply = asked("s1-0", "Why did you change to the left lane?")
    told = reason(reply)
    rests = replace(told.contrast.evidence, traces=(again.trace_id,))
    changed = replace(told, contrast=replace(told.contrast, evidence=rests))
    odd = replace(reply, answers=(as_json(changed),))
    found = of_turn(0, odd, known)
    assert found is not None
    decision = known[found.decision]
    assert decision.what_if is None
    assert decision.decision == again.decision
    alone = of_turn(0, odd, {again.trace_id: again})
    assert alone is not None
    assert alone.decision == again.trace_id


def test_refusals_and_small_talk_rest_on_nothing() -> None:
    for text in ("Why did you fly?", "Hello!", "Why did you stop?"):
        reply = asked("s1-0", text)
        assert not has_evidence(reply)
        assert traces_of(reply) == ()
        assert of_turn(0, reply, every("s1-0")) is None


@pytest.mark.parametrize(
    ("text", "thing", "found"),
    [
        ("The car ahead (vehicle 2) brakes; vehicle 1 waits for Vehicle 2.", Ego(), (2, 1)),
        ("It is going straight on.", Vehicle(3), (3,)),
        ("They wait.", Vehicles((2, 4)), (2, 4)),
        ("I drive.", Vehicle(0), ()),
        ("I am vehicle 0.", Ego(), ()),
        ("There is nobody.", Ego(), ()),
        ("vehicle 99999999999999999999", Ego(), ()),
    ],
)
def test_vehicles_that_a_reply_speaks_of(text: str, thing: Thing, found: tuple[int, ...]) -> None:
    acts = (as_json(GroundedAct(Ask(Identify(thing)))),)
    assert vehicles_of(Reply(text=text, kind="answer", acts=acts, sim_time=1.0)) == found
    assert vehicles_of(Reply(text="Nothing.", kind="answer", sim_time=1.0)) == ()


@pytest.mark.parametrize("name", RIDES)
def test_what_another_vehicle_does_is_never_told_as_our_plan(name: str) -> None:
    shown = 0
    for text in ABOUT_OTHERS:
        for at in (3.0, 4.0, 8.0):
            reply = asked(name, text, at)
            found = of_turn(7, reply, every(name))
            if found is not None:
                shown += 1
                assert found.factual is None, (text, at)
                assert found.counterfactual is None, (text, at)
    assert shown or name in ("s3-0", "s4-0")  # nobody there is explained from a decision


def test_there_is_evidence_only_where_there_is_more_than_the_decision() -> None:
    assert has_evidence(asked("s1-0", "Why did you change to the left lane?"))
    for text in ("Where is vehicle 1 going?", "How fast is vehicle 1?", "Hello!"):
        assert not has_evidence(asked("s1-0", text)), text


def test_every_rollout_is_counted_once() -> None:
    shown = evidence("s1-0", asked("s1-0", "Why did you change to the left lane?"))
    for side in (shown.factual, shown.counterfactual):
        assert side is not None
        assert sum(run.draws for run in side.runs) == side.rollouts
