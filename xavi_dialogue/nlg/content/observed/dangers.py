"""Dangers: whether somebody stops in time, and why no collision is expected."""

from xavi_dialogue.domain.answers import Closeness, PullingUp, Slowing
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.findings import Assurance
from xavi_dialogue.domain.terms import Vehicle, Vehicles
from xavi_dialogue.nlg.content.clauses.facts import belief_message, episode_message
from xavi_dialogue.nlg.content.clauses.plan import Plan
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.message import message
from xavi_dialogue.nlg.surface.values import Chance, Moment, Number, Quantity, Who

LIKELY = 0.5  # minimum probability that is stated with a rule
SOME = 0.5  # [m] braking distance below which braking is hardly needed
CERTAIN = 0.95  # minimum probability of a plan that is stated as certain
AT_ONCE = 1.0  # [s] maximum time of what comes at once


def plan_pulling_up(answer: PullingUp, context: SpeechContext) -> Plan:
    """Plan whether somebody stops in time: what it does or has to do, then the risk."""
    braking = None if answer.braking is None else episode_message(answer.braking, context)
    needed = answer.needed if answer.needed is not None and answer.needed > SOME else None
    chance = answer.chance if answer.chance is not None and answer.chance >= LIKELY else None
    first = message(
        "PULLING_UP",
        how=answer.how,
        ours=answer.ours,
        behind=answer.behind,
        who=Who(Vehicle(answer.vehicle)),
        braking=braking,
        slowing=braking,
        far=_quantity(answer.distance, "m"),
        speed=_quantity(answer.speed, "m/s"),
        needed=None if needed is None else Quantity(needed, "m"),
        chance=None if chance is None else Chance(chance),
    )
    if answer.risk is None or answer.how == "stands":
        return Plan((first,))
    return Plan((first,), (message("RISK", risk=Chance(answer.risk), past=False),))


def plan_slowing(answer: Slowing, context: SpeechContext) -> Plan:
    """Plan whether we stop or slow down, and for whom, or who has left our way by then."""
    named = Vehicles(answer.others) if answer.others[1:] else None
    one = Vehicle(answer.others[0]) if answer.others else None
    share = answer.share
    soon = None if answer.time is None else max(answer.time - context.now, 0.0)
    first = message(
        "SLOWING",
        who=None if one is None else Who(named or one),
        stops=answer.stops,
        held=answer.held >= LIKELY,
        ready=answer.held > 0.0,
        slows=answer.slows,
        slow=None if answer.slow is None else Quantity(answer.slow, "m/s"),
        soon=None if soon is None or soon < AT_ONCE else Quantity(soon, "s"),
        chance=None if share is None or share >= CERTAIN else Chance(share),
        order=answer.order,
        yields=answer.yields,
    )
    return Plan((first,))


def plan_assured(answer: Closeness, of: Assurance, context: SpeechContext) -> Plan:
    """Plan why no collision is expected: the risk, what is expected, what was simulated."""
    if of.decided is not None and of.situations and answer.risk is not None:
        return _was_assured(answer.risk, of, of.decided, answer.vehicle)
    known = of.belief is not None and of.belief.expectations and not of.stands
    who = None if answer.vehicle is None else Who(Vehicle(answer.vehicle))
    first = message(
        "ASSURED",
        risk=None if answer.risk is None else Chance(answer.risk),
        who=who,
        belief=belief_message(of.belief, context) if known and of.belief is not None else None,
        stands=of.stands,
        yields=of.yields,
        behind=of.behind,
        far=_quantity(answer.closest, "m"),
    )
    if of.situations == 0 or answer.risk is None:
        return Plan((first,))
    simulated = message(
        "ASSURED_SIMULATED",
        situations=Number(of.situations, "situation"),
        one=of.situations == 1,
        struck=Number(of.struck, "situation") if of.struck else None,
        who=who,
    )
    return Plan((first,), (simulated,))


def _was_assured(risk: float, of: Assurance, decided: float, vehicle: int | None) -> Plan:
    """Plan on what an earlier risk rested: what was simulated then, and the risk from that."""
    basis = message(
        "RISK_BASIS",
        when=Moment(decided),
        situations=Number(of.situations, "situation"),
        one=of.situations == 1,
        struck=Number(of.struck, "situation") if of.struck else None,
        who=None if vehicle is None else Who(Vehicle(vehicle)),
    )
    return Plan((basis, message("RISK_FROM", risk=Chance(risk))))


def _quantity(of: Measure | None, unit: str) -> Quantity | None:
    if of is None or of.value is None:
        return None
    return Quantity(of.value, "m" if unit == "m" else "m/s")
