"""Peak moments: extreme moments, decisions, and what changed between them, in words."""

from collections.abc import Mapping
from dataclasses import replace

from xavi_dialogue.domain.answers import Altered, Decided, PeakMoment, Wavered
from xavi_dialogue.domain.facts import Belief, Episode
from xavi_dialogue.domain.terms import Vehicle
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.nlg.content.clauses.clauses import episode_clause
from xavi_dialogue.nlg.content.clauses.facts import episode_message, verbs_of
from xavi_dialogue.nlg.content.clauses.manoeuvres import own_verbs
from xavi_dialogue.nlg.content.clauses.plan import Plan
from xavi_dialogue.nlg.content.clauses.traffic_lights import COLOURS
from xavi_dialogue.nlg.content.reasons.reasons import plan_choice
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.message import Message, message
from xavi_dialogue.nlg.surface.values import Chance, Clause, Moment, Number, Quantity, Who

UNITS = {"distance": "m", "time-to-collision": "s", "speed": "m/s", "duration": "s",
         "deceleration": "m/s2", "delay": "s", "speed-change": "m/s"}  # fmt: skip
YIELDING = frozenset(("give-way", "wait", "let-go"))
#: Nouns of turns.
TURNS: Mapping[ActionName, str] = {
    "turn": "turn", "exit-left": "left turn", "exit-right": "right turn",
}  # fmt: skip
NAMED = 3  # maximum of vehicles named
LONG = 1.5  # [s] minimum duration that is stated


def plan_peak_moment(answer: PeakMoment, context: SpeechContext) -> Plan:
    """Plan the moment at which something was greatest."""
    if answer.time is None:
        return Plan((message("SUMMIT_NONE", of=answer.of),))
    deed = next((e for e in answer.deeds if answer.of != "braking" or _tells(e)), None)
    measure = answer.measure
    value = None if measure is None or measure.value is None else measure.value
    several = len(answer.others) > 1 and deed is not None and deed.action in YIELDING
    spread = answer.of == "delay"  # the episodes came one after another
    others = tuple(
        Who(Vehicle(x.vehicle), x.time if spread else answer.time) for x in answer.others[:NAMED]
    )
    slots: dict[str, object] = {
        "of": answer.of,
        "among": answer.among,
        "when": Moment(answer.time),
        "who": others[0] if others else None,
        "several": others if several else None,
        "standing": measure is not None and measure.attribute == "speed" and (value or 0.0) < 0.3,
        "attribute": None if measure is None else measure.attribute,
        "deed": None if deed is None else _then(deed, context),
        "until": None if measure is None or measure.until is None else Moment(measure.until),
        "going_on": measure is not None and measure.at_least,
        "held": others or None,
        "lit": answer.lit,
        "kind": None if answer.kind is None else TURNS[answer.kind.action],
        "long": measure is not None and measure.attribute == "duration" and (value or 0.0) >= LONG,
    }
    if measure is not None and value is not None and measure.attribute == "probability":
        slots["chance"] = Chance(value)
    elif measure is not None and value is not None:
        slots["value"] = Quantity(value, UNITS.get(measure.attribute, "m"))  # type: ignore[arg-type]
    return Plan((message("SUMMIT", **slots),))


def _tells(deed: Episode) -> bool:
    """Check whether an action says more about braking than that there was some."""
    return deed.object is not None or deed.action not in ("brake", "slow-down")


def _then(deed: Episode, context: SpeechContext) -> Clause:
    return episode_clause(deed, context.now, tense="past")


def plan_decided(answer: Decided, context: SpeechContext) -> Plan:
    """Plan the result of a decision."""
    return Plan((_decided(answer, context),))


def _decided(answer: Decided, context: SpeechContext) -> Message:
    """Return what was decided, and how we drove then."""
    deed = next(iter(answer.doing), None)
    return message(
        "DECIDED",
        when=Moment(answer.time),
        kept=answer.kept,
        steps=own_verbs(answer.steps),
        doing=None if deed is None else replace(_then(deed, context), progressive=True),
    )


def plan_altered(answer: Altered, context: SpeechContext) -> Plan:
    """Plan the differences between a decision and an earlier one."""
    same = own_verbs(answer.before.steps) == own_verbs(answer.after.steps)
    first = message(
        "ALTERED",
        same=same,
        sudden=answer.sudden,
        begin=Moment(answer.before.time),
        end=Moment(answer.after.time),
        old=own_verbs(answer.before.steps),
        new=own_verbs(answer.after.steps),
    )
    others = []
    if answer.light is not None:
        others.append(message("ALTERED_LIGHT", colour=COLOURS[answer.light.colour]))
    if answer.appeared:
        looks = tuple(Who(Vehicle(x.vehicle), x.time) for x in answer.appeared[:NAMED])
        others.append(message("ALTERED_SEEN", looks=looks))
    others += [_belief(old, new) for old, new in answer.beliefs]
    others += [episode_message(e, context) for e in answer.did[:1]]
    if answer.reason is not None:
        why = plan_choice(answer.reason, context)
        return replace(why, core=(first, *why.core), more=(*why.more, *others[:1]))
    if not others:
        others.append(message("ALTERED_NOTHING"))
    return Plan((first, *others[:1]), tuple(others[1:2]), tuple(others[2:]))


def plan_wavered(answer: Wavered, context: SpeechContext) -> Plan:
    """Plan why a plan was given up repeatedly."""
    del context
    told = tuple(
        message(
            "WAVERED_TURN",
            when=Moment(turn.time),
            risk=Chance(turn.risk),
            who=None if turn.vehicle is None else Who(Vehicle(turn.vehicle), turn.time),
        )
        for turn in answer.turns[-NAMED:]
    )
    core = message(
        "WAVERED",
        plan=own_verbs((answer.plan,)),
        turns=told,
        several=len(answer.turns) > 1,
        times=Number(len(answer.turns), "time"),
        claim=answer.claim,
        resumed=answer.resumed,
    )
    return Plan((core,))


def _belief(old: Belief, new: Belief) -> Message:
    first = new.expectations[0]
    was = next((e.probability for e in old.expectations if e.actions == first.actions), 0.0)
    return message(
        "ALTERED_BELIEF",
        who=Who(Vehicle(new.vehicle), new.time),
        verbs=verbs_of(first.actions),
        up=first.probability > was,
        old=Chance(was),
        new=Chance(first.probability),
    )
