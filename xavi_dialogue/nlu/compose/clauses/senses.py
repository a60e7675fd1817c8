"""Senses of verbs: their patterns, matched against a clause by type."""

from dataclasses import dataclass, field

from xavi_dialogue.domain.terms import Ego, Event, Lane, Pronoun, Quantity, Wanted
from xavi_dialogue.nlu.compose.clauses.clause import Clause, Complement
from xavi_dialogue.nlu.compose.clauses.flags import flag
from xavi_dialogue.nlu.compose.clauses.patterns import FLAGS, STRANDED, WORDED, Role, Sense
from xavi_dialogue.nlu.compose.clauses.sem import Sem, is_thing, types

_DEEDS = frozenset({"go", "alight"})  # roles of what somebody is let do
_NO_BASE = frozenset({"be", "have"})  # auxiliaries that no base form follows
VAGUE = 0.25  # cost of a pronoun as the subject that a sense asks for
LEFT_OBJECT = 1.3  # cost of an object without a role
LEFT_OTHER = 0.35  # of another phrase without a role
MISSING = 2.0  # of a role that must be filled
ALMOST = 0.5  # of a thing of another type that might do
LEFT_PARTICLE = 0.25
CAUSED = 1.0  # of what somebody was caused to do
NO_ACTOR = 0.6  # of a deed that is said to drive: "its turning passed us"
UNITLESS = 0.4  # what a number is cheaper by beside a verb of speed: "doing 60"
STEADY = 0.4  # of being about to do what may as well last: "is driving in front of us"
COLOUR = "c"  # types of a role that what is asked for fills only where it is a colour
_OF_VEHICLES = frozenset(
    {"pass", "overtake", "cut-in", "brake", "turn", "exit-left", "exit-right", "change-left",
     "change-right", "pull-out", "merge", "stand", "wait", "move"}
)  # fmt: skip
OURS = 0.08  # of "in front" for "in front of us"
_OWNERS: dict[str, Sem] = {
    "my": Ego(), "our": Ego(), "your": Ego(), "his": Pronoun("he"), "her": Pronoun("he"),
    "its": Pronoun("it"), "their": Pronoun("they"),
}  # fmt: skip


@dataclass(slots=True)
class Match:
    """A sense as it fits a clause: what fills its roles, what is left over, what that costs."""

    sense: Sense
    cost: float
    object: Sem | None = None
    second: Sem | None = None
    phrases: dict[str, Sem] = field(default_factory=dict)
    left: list[Complement] = field(default_factory=list)
    left_objects: list[Sem] = field(default_factory=list)
    gap_used: bool = False
    sided: bool = False


def amiss(clause: Clause, found: Match) -> float:
    """Say what it costs that a thing does or undergoes what things of its kind do not.

    A speed without a unit is cheaper beside a verb of speed.
    """
    if found.sense.head == "@exceed" and clause.objects and isinstance(found.object, Quantity):
        return -UNITLESS
    if found.sense.head == "@cause" and clause.infinitive is not None:
        return CAUSED  # "what caused you to slow down": what was caused is the slowing down
    if found.sense.head == "@change-o" and isinstance(found.object, Lane):
        return MISSING  # "change lanes" changes no plan
    if found.sense.head == "cut-in" and clause.verb is not None and clause.verb.key == "drive":
        return STEADY * (clause.verb.category == "VING")
    return NO_ACTOR * (isinstance(clause.subject, Event) and found.sense.head in _OF_VEHICLES)


def offered(clause: Clause) -> frozenset[str]:
    """List the prepositions and particles of a clause as the kinds of roles that they may fill."""
    found = [phrase.key for phrase in clause.complements]
    found += [f"+{leaf.key}" for leaf in clause.particles]
    for bearing, _ in clause.bearings:
        found += (f"bearing-{bearing}", f"+{bearing}")
    return frozenset(found)


def fits(sem: Sem, wanted: str) -> float | None:
    """Say at what cost a meaning fits the types of a role; None where it does not."""
    if "*" in wanted:
        return 0.0
    own = types(sem)
    if own[0] in wanted:
        return 0.0
    if any(letter in wanted for letter in own[1:]):
        return 0.05
    return ALMOST if own == "u" and "v" in wanted else None


def match(sense: Sense, clause: Clause, words: frozenset[str]) -> Match | None:
    """Fit a sense to a clause that offers some words; None where a role cannot be filled."""
    for one in sense.calls:
        if words.isdisjoint(one):
            return None
    found = Match(sense, sense.cost)
    objects = [sem for sem, _ in clause.objects]
    agent = "by" if clause.passive and sense.head == "@make-do" else None
    phrases = [phrase for phrase in clause.complements if phrase.key != agent]
    particles = [leaf.key for leaf in clause.particles]
    filled = 0
    for role in sense.roles:
        cost = _fill(role, found, clause, objects, phrases, particles)
        if cost is None:
            if not role.optional:
                return None
            continue
        filled += 1
        found.cost += cost
    found.cost -= 0.12 * filled + 0.01 * sum(role.types != "*" for role in sense.roles)
    if clause.side is not None and not found.sided:
        found.cost += 0.15
    if clause.verb is not None and clause.verb.form == "base" and clause.aux_last() in _NO_BASE:
        found.cost += 0.0 if clause.has("semi") else 0.4
    found.cost += _ungoverned(sense, clause)
    found.left_objects = objects
    found.left = phrases
    found.cost += LEFT_OBJECT * len(objects) + LEFT_OTHER * len(phrases)
    found.cost += LEFT_PARTICLE * len(particles)
    if clause.gap is not None and not found.gap_used:
        found.cost += 0.6 if isinstance(clause.gap, Wanted) else 0.1
    return found


def _ungoverned(sense: Sense, clause: Clause) -> float:
    """Say what the clauses inside cost for which the sense has no role."""
    kinds = {role.kind for role in sense.roles}
    cost = 0.0
    for kind, inner, price in (("that", clause.that, 0.9), ("wh", clause.question, 1.2),
                               ("bare", clause.bare, 0.8), ("ger", clause.gerund, 0.3),
                               ("inf", clause.infinitive, 0.1)):  # fmt: skip
        if inner is not None and kind not in kinds and not (kind == "bare" and kinds & _DEEDS):
            cost += price
    return cost


def _fill(
    role: Role, found: Match, clause: Clause, objects: list[Sem], phrases: list[Complement],
    particles: list[str],
) -> float | None:  # fmt: skip
    if role.kind in ("o", "o2"):
        return _fill_object(role, found, clause, objects)
    if role.kind == "one":
        words = clause.verb.words if clause.verb is not None else ()
        found.object = next((_OWNERS[word] for word in words if word in _OWNERS), None)
        return 0.0
    if role.kind == "s":
        if clause.subject is None:
            return None
        unlit = clause.subject == Pronoun("that") or isinstance(clause.subject, Wanted)
        if unlit and found.sense.head == "turn-colour":
            return None  # "what would change?", "has that changed?" are not asked of lights
        cost = fits(clause.subject, role.types)
        vague = isinstance(clause.subject, Pronoun | Wanted)
        return cost if cost is None or not vague else cost + VAGUE
    if role.kind.startswith("+"):
        return _fill_particle(role.kind[1:], found, clause, particles, phrases, objects)
    if role.kind == "side":
        wanted = role.types
        if clause.side is None or (wanted != "*" and clause.side != wanted):
            return None
        found.sided = True
        return 0.0
    if role.kind in FLAGS:
        return 0.0 if flag(role.kind, role.types, clause) else None
    return _fill_phrase(role, found, clause, phrases)


def _fill_object(role: Role, found: Match, clause: Clause, objects: list[Sem]) -> float | None:
    for index, sem in enumerate(objects):
        cost = fits(sem, role.types)
        if cost is not None:
            del objects[index]
            _take(role, found, sem)
            return cost
    if clause.passive and role.kind == "o" and clause.subject is not None:
        cost = fits(clause.subject, role.types)
        if cost is not None:
            _take(role, found, clause.subject)
        return cost
    if clause.gap is not None and not found.gap_used and not _stranded(clause):
        strict = types(clause.gap) == "n" or role.types == COLOUR
        if strict and fits(clause.gap, role.types) is None:
            return None
        found.gap_used = True
        _take(role, found, clause.gap)
        return 0.0
    return None


def _take(role: Role, found: Match, sem: Sem) -> None:
    if role.kind == "o":
        found.object = sem
    else:
        found.second = sem


def _stranded(clause: Clause) -> bool:
    return any(phrase.sem is None for phrase in clause.complements)


def _fill_particle(
    word: str, found: Match, clause: Clause, particles: list[str], phrases: list[Complement],
    objects: list[Sem],
) -> float | None:  # fmt: skip
    if word in particles:
        particles.remove(word)
        return 0.0
    stranded = STRANDED.get(word)
    for index, phrase in enumerate(phrases):
        if phrase.sem is None and phrase.key == stranded and clause.gap is None:
            del phrases[index]
            return 0.02
        takes = any(role.kind == "o" for role in found.sense.roles) and not objects
        if phrase.sem is not None and takes and phrase.key == stranded:
            objects.append(phrase.sem)
            del phrases[index]
            return 0.02
    if word in WORDED:
        return 0.0 if _worded(word, clause) else None
    if word in ("back", "ahead", "around") and word in [bearing for bearing, _ in clause.bearings]:
        found.phrases[f"bearing-{word}"] = Ego()
        return 0.0
    return None


def _worded(word: str, clause: Clause) -> bool:
    if word == "first":
        return "first" in clause.manner
    if word == "there":
        return any(bearing == "there" for bearing, _ in clause.bearings)
    if word == "still":
        return clause.still or any(key == "stationary" for key, _ in clause.adjectives)
    if word == "put":
        return any(leaf.key == "put" for leaf in clause.skipped)
    inner = clause.gerund.verb if clause.gerund is not None else None
    return inner is not None and word in inner.words


def _fill_phrase(
    role: Role, found: Match, clause: Clause, phrases: list[Complement]
) -> float | None:
    for index, phrase in enumerate(phrases):
        if phrase.key != role.kind:
            continue
        if phrase.sem is None:
            if clause.gap is None or found.gap_used:
                continue
            sem: Sem = clause.gap
            found.gap_used = True
        else:
            sem = phrase.sem
        cost = fits(sem, role.types)
        if cost is None:
            continue
        del phrases[index]
        found.phrases[role.kind] = sem
        if (
            found.object is None and (is_thing(sem) or isinstance(sem, Wanted))
        ) or found.object is None:
            found.object = sem
        return cost
    return _fill_bearing(role, found, clause)


def _fill_bearing(role: Role, found: Match, clause: Clause) -> float | None:
    """Take a bearing that is seen from us for a phrase: "pull in front", "go round us"."""
    bearing = role.kind.removeprefix("bearing-")
    if bearing == role.kind or bearing not in [key for key, _ in clause.bearings]:
        return None
    found.phrases[role.kind] = Ego()
    if not isinstance(clause.subject, Ego) and found.object is None:
        found.object = Ego()
    return OURS
