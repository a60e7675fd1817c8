"""Routes: the way ahead in words: the steps of a plan, turns, and exits of roundabouts."""

from collections.abc import Iterable
from dataclasses import dataclass

from planner.record.trace import Action
from xavi_dialogue.domain.answers import Counted
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.terms import Junction
from xavi_dialogue.nlg.content.clauses.clauses import doing
from xavi_dialogue.nlg.content.clauses.measures import measure_message
from xavi_dialogue.nlg.content.clauses.tenses import PRESENT
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.message import Message, message
from xavi_dialogue.nlg.surface.ordinals import ordinal
from xavi_dialogue.nlg.surface.values import Clause, Number, Quantity, Who

AT_HAND = 4.0  # [m] distance below which a place is just ahead
SAME = 2.0  # [m] maximum difference between two distances to one place
TURNS = frozenset(("exit-left", "exit-right", "exit-straight"))


def exits_passed(answer: Counted) -> Message:
    """Return how many exits of a roundabout we passed as a clause."""
    return message(
        "EXITS_PASSED", none=answer.count == 0, on=answer.until is None,
        number=Number(answer.count, "exit"),
    )  # fmt: skip


@dataclass(frozen=True, slots=True)
class Ring:
    """A roundabout ahead, with the exit that we take, and its distance."""

    exit: int
    exits: int | None
    far: float | None  # [m]
    next: bool  # it is the first junction that we come to

    @property
    def clause(self) -> Clause:
        """Return what we do there as a clause: take the second exit of the roundabout."""
        return Clause(Who(ride=True), "take", (f"the {ordinal(self.exit)} exit of the roundabout",))


def ring_of(measures: Iterable[Measure], now: float) -> Ring | None:
    """Return the roundabout ahead, according to the measures."""
    known = {m.attribute: m for m in measures if m.gap is None and m.value is not None}
    taken, turn = known.get("exit-number"), known.get("turn")
    if taken is None or taken.value is None or taken.count is None or now - taken.time > PRESENT:
        return None
    ring = next((m for m in measures if _to_ring(m)), None)
    far = None if ring is None or (ring.value or 0.0) < AT_HAND else ring.value
    near = turn is None or turn.value is None or far is None or abs(far - turn.value) <= SAME
    return Ring(int(taken.value), taken.count, far, near)


def _to_ring(one: Measure) -> bool:
    to = one.to
    return one.attribute == "distance" and isinstance(to, Junction) and to.form == "roundabout"


def step_clauses(actions: tuple[Action, ...], ring: Ring | None) -> list[Clause]:
    """Return the steps of a plan as clauses; going straight on only if there is nothing else."""
    found: list[Clause] = []
    rest = list(actions)
    while rest:
        action = rest.pop(0)
        around = action == "continue-next-exit"
        first = not any(a in TURNS for a in actions[: len(actions) - len(rest) - 1])
        if ring is not None and (around or (action in TURNS and first and ring.next)):
            while around and rest and rest[0] == "continue-next-exit":
                rest.pop(0)
            if around and rest and rest[0] in TURNS:
                rest.pop(0)
            found.append(ring.clause)
            ring = None
        elif action != "continue":
            found.append(Clause(Who(), doing(action, ego=True)))
    return found or [Clause(Who(), doing("continue", ego=True))]


def way_messages(measures: tuple[Measure, ...], context: SpeechContext) -> list[Message]:
    """Return where the way goes: the next turn, and the exit of the roundabout, each once."""
    ring = ring_of(measures, context.now)
    parts: list[Message] = []
    for one in measures:
        if _to_ring(one) or (ring is not None and one.attribute == "exit-number"):
            continue
        if one.attribute == "turn" and ring is not None and ring.next:
            parts.append(ring_message(ring))
            continue
        parts.append(measure_message(one, context))
        if one.attribute == "turn" and ring is not None:
            parts.append(ring_message(ring, later=True))
    return parts


def ring_message(ring: Ring, *, later: bool = False) -> Message:
    """Return which exit of the roundabout we take, and how far it is."""
    return message(
        "WAY_RING",
        rank=ring.exit,
        far=Quantity(ring.far, "m") if ring.far is not None else None,
        later=later,
    )
