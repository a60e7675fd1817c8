"""Clauses as slots: the subject, verb, objects and adverbs of a clause, in any order."""

from dataclasses import dataclass, field
from typing import Any, cast

from msgspec.structs import replace

from xavi_dialogue.domain.terms import (
    Back,
    Event,
    Exit,
    Feature,
    Junction,
    Pronoun,
    Quantity,
    Relative,
    Road,
    Time,
    Unsaid,
)
from xavi_dialogue.domain.vocabulary import Manner
from xavi_dialogue.nlu.compose.clauses.contracted import with_would
from xavi_dialogue.nlu.compose.clauses.sem import Sem, as_thing
from xavi_dialogue.nlu.grammar.chart import Node, Part
from xavi_dialogue.nlu.grammar.lexicon import Leaf

PASSED_OVER = 0.6  # cost of an inner clause that contributes nothing
RELATIONS = frozenset(("before", "after", "since", "until", "during"))  # relations to an event


#: Verbs that take a percentage as an argument: "you put it at 91 percent".
RATING = frozenset(("rate", "put", "give", "have", "estimate", "assign", "set", "see", "score"))


@dataclass(slots=True)
class Complement:
    """A phrase with a preposition; `sem` is None where the preposition stands alone."""

    key: str  # of the preposition, "bearing-ahead" and so on
    sem: Sem | None
    node: Part


@dataclass(slots=True)
class Clause:
    """The slots of a clause."""

    subject: Sem | None = None
    the_car: bool = False  # the subject is just "the car"
    there: bool = False
    aux: list[str] = field(default_factory=list)  # "be-past", "modal-would", "semi-must"
    negated: bool = False
    verb: Leaf | None = None
    objects: list[tuple[Sem, Part]] = field(default_factory=list)
    complements: list[Complement] = field(default_factory=list)
    bearings: list[tuple[str, Part]] = field(default_factory=list)
    origin: str | None = None
    particles: list[Leaf] = field(default_factory=list)
    side: str | None = None
    manner: list[Manner] = field(default_factory=list)
    adjectives: list[tuple[str, str]] = field(default_factory=list)  # key, degree
    feelings: list[str] = field(default_factory=list)
    comparisons: list[tuple[str, str]] = field(default_factory=list)  # key, words
    than: "Sem | Clause | None" = None
    than_time: Time = field(default_factory=Unsaid)  # "than before", "than when we came in"
    time: Time = field(default_factory=Unsaid)
    dated: bool = False  # the time is said with "at", and no amount of time: "at 52 s"
    contrast: "Sem | Clause | str | None" = None
    condition: "Clause | None" = None
    led: bool = False  # the condition comes first
    because: "Sem | Clause | None" = None
    without: Sem | None = None
    lacking: Event | None = None  # what does not happen at the same time: "without stopping"
    infinitive: "Clause | None" = None
    gerund: "Clause | None" = None
    away: "Clause | None" = None  # a gerund after "from": "keeps us from turning"
    bare: "Clause | None" = None
    that: "Clause | None" = None
    question: Any = None  # an embedded question, composed
    also: list[Any] = field(default_factory=list)  # other questions of the same clause
    chained: list[tuple[str, "Clause"]] = field(default_factory=list)
    gap: Sem | None = None  # the thing for which a question word or relative pronoun stands
    instead: bool = False
    else_: bool = False
    still: bool = False
    focus: set[str] = field(default_factory=set)
    skipped: list[Leaf] = field(default_factory=list)
    inner: Event | None = None  # the event of the infinitive or gerund
    times: int | None = None  # how often: "three times"
    share: Quantity | None = None  # how likely it was thought: "at 91 percent"
    topic: Sem | None = None  # named first: "as for the bus"
    comma: int = -1  # index of the first word after the last comma
    pairs: list[Sem] = field(default_factory=list)  # things after "between"
    speeds: tuple[Quantity, Quantity] | None = None  # "from 50 to 15"

    def has(self, kind: str) -> bool:
        """Check whether the clause has an auxiliary of a kind: "be", "modal-would"."""
        return any(a == kind or a.startswith(kind + "-") for a in self.aux)

    @property
    def modal(self) -> str | None:
        """Return the modal of the clause; None for plain "will"."""
        order = ("would", "could", "should", "must", "might", "can", "want")
        for name in order:
            if f"modal-{name}" in self.aux or f"semi-{name}" in self.aux:
                return name
        return None

    @property
    def tense(self) -> str:
        """Return the tense, by auxiliaries and verb form."""
        if ("semi-future" in self.aux and "be-past" not in self.aux) or "modal-will" in self.aux:
            return "future"
        modal = any(a.startswith("modal-") for a in self.aux)
        if modal:
            return "past" if self.has("have") else "present"
        if self.has("have"):
            must = "semi-must" in self.aux and "semi-past" not in self.aux
            if must and self.verb is not None and self.verb.form == "base":
                return "present"  # "have we got to turn", not "have you had to turn"
            return "past" if "have-past" in self.aux else "perfect"
        if not {"do-past", "be-past", "semi-past"}.isdisjoint(self.aux):
            return "past"
        if {"be-present", "be-been"} <= set(self.aux):
            return "perfect"  # "how long's it been red"
        form = self.verb.form if self.verb is not None else ""
        if self.verb is not None and self.verb.key in _UNCHANGED and form == "base":
            return "past" if self.subject is not None and not self.aux else "present"
        if form in ("past", "part") and not self.has("be") and not self.has("do"):
            return "past"
        return "present"

    @property
    def passive(self) -> bool:
        """Check whether the clause is passive: "was overtaken", "got overtaken by"."""
        ends = self.verb is not None and self.verb.form in ("part", "past")
        if self.verb is None or not ends or self.aux_last() != "be":
            return False
        return self.verb.key not in _RESULTING or any(c.key == "by" for c in self.complements)

    @property
    def only_subject(self) -> bool:
        """Check whether the clause has nothing but a subject: "than we are", "than he does"."""
        said = self.objects or self.complements or self.bearings or self.adjectives
        bare = self.verb is None or self.verb.key == "do"
        return bare and not said and self.subject is not None

    def judge(self) -> None:
        """Read "right" in "was it right to stop" as an adjective, not as a side."""
        if self.verb is None and self.side == "right" and self.has("be"):
            self.side = None
            self.adjectives.append(("right", ""))

    def aux_last(self) -> str:
        """Return the last auxiliary before the verb; empty if there is none."""
        plain = [a for a in self.aux if not a.startswith("semi")]
        return plain[-1].split("-")[0] if plain else ""


_AUX = {"BE": "be", "GOT": "be", "DO": "do", "HAVE": "have", "HAD": "have", "MODAL": "modal",
        "SEMI": "semi"}  # fmt: skip
#: First words of phrases before verbs that mark the past: "had to", "wanted to", "decided to".
_PAST = frozenset(
    {"had", "needed", "wanted", "tried", "intended", "planned", "hoped", "decided", "chose",
     "opted", "elected", "happened", "bothered", "ended", "seemed", "appeared", "dared", "agreed",
     "began", "started", "kept", "continued", "managed", "used", "attempted", "preferred", "went",
     "failed", "refused", "neglected", "omitted", "refrained", "held", "forgot", "hesitated",
     "declined", "steered"}
)  # fmt: skip
_KEEP = {"again": "again", "already": "already", "still": "still", "ever": "", "first": "first"}


#: Verbs with the same form in the past, for what happens in a moment: "you cut in".
_UNCHANGED = frozenset({"hit", "cut", "let", "let go", "let cross", "set"})
#: Verbs whose participle after "be" describes a state: "we are stuck, headed, stopped".
_RESULTING = frozenset(
    ("allow", "permit", "stick", "sit", "stand", "hold one's ground", "head", "park", "stop", "go",
     "finish", "come", "get", "turn", "end", "arrive")
)  # fmt: skip


def timed_by(clause: Clause) -> None:
    """Take "after the stop", "since the light" as the time of a clause that has none."""
    for phrase in clause.complements if isinstance(clause.time, Unsaid) else ():
        anchor = phrase.sem if isinstance(phrase.sem, Event) else as_thing(phrase.sem)
        if phrase.key in RELATIONS and isinstance(anchor, Event | Junction | Feature | Exit | Road):
            clause.time = Relative(cast(Any, phrase.key), anchor)
            clause.complements.remove(phrase)
            return


def _earlier(clause: Clause) -> None:
    """Take "earlier" in "did you brake earlier?", and "then", as a time."""
    alone = clause.comparisons == [("soon", "earlier")] and clause.than is None
    untimed = isinstance(clause.time, Unsaid) and isinstance(clause.than_time, Unsaid)
    happened = not clause.negated and not {"do-past", "have-present"}.isdisjoint(clause.aux)
    if alone and untimed and happened and clause.modal is None:
        clause.comparisons, clause.time = [], Back("earlier")
    if "then" in clause.focus and untimed and clause.tense == "past" and clause.modal is None:
        clause.time = Back("during")  # "how fast were we then?"


def _be_back(clause: Clause) -> None:
    """Take "back" after "be" as a place, not as a verb: "we are back in our lane"."""
    verb = clause.verb
    if verb is not None and verb.words == ("back",) and clause.aux_last() == "be":
        clause.particles.append(verb)
        clause.verb = None


def _deed_made(clause: Clause) -> None:
    """Complete the event after "make": "made us turn left", "made it overtake the bus"."""
    if clause.verb is None or clause.verb.key != "make" or len(clause.objects) < 2:
        return
    deed, part = clause.objects[1]
    if not isinstance(deed, Event):
        return
    if deed.action == "turn" and deed.side is None and clause.side is not None:
        deed, clause.side = replace(deed, action=cast(Any, f"exit-{clause.side}")), None
    more = as_thing(clause.objects[2][0]) if clause.objects[2:] and deed.object is None else None
    if more is not None:
        deed = replace(deed, object=more)
        del clause.objects[2]
    clause.objects[1] = deed, part


def _deed_placed(clause: Clause) -> None:
    """Take "waiting" in "is the van at the roundabout waiting" as the verb of the clause."""
    inner = clause.gerund
    placed = bool(clause.complements or clause.bearings) and clause.subject is not None
    said = clause.objects or clause.adjectives or clause.comparisons or clause.feelings
    if clause.verb is not None or inner is None or not placed or said or not clause.has("be"):
        return
    if inner.verb is None or inner.aux or wanted_pronoun(clause.subject):
        return
    clause.verb, clause.gerund = inner.verb, inner.gerund
    clause.objects, clause.infinitive = inner.objects, inner.infinitive
    clause.complements += inner.complements
    clause.bearings += inner.bearings
    clause.particles += inner.particles
    clause.manner += inner.manner
    clause.side = clause.side or inner.side


class Slots:
    """Fills the slots of a clause from the parts of a parse."""

    def __init__(self, reader: Any) -> None:
        self.reader = reader

    def fill(self, parts: tuple[Part, ...], clause: Clause | None = None) -> Clause:
        """Put the parts of a clause into its slots, in whatever order they come."""
        clause = clause if clause is not None else Clause()
        for part in parts:
            if isinstance(part, Leaf):
                self._leaf(part, clause)
            else:
                self._phrase(part, clause)
        _be_back(clause)
        with_would(clause.aux, clause.verb, negated=clause.negated)
        _deed_made(clause)
        _deed_placed(clause)
        if clause.verb is None:
            timed_by(clause)
        _earlier(clause)
        return clause

    def _leaf(self, leaf: Leaf, clause: Clause) -> None:
        match leaf.category:
            case "BE" | "GOT" | "DO" | "HAVE" | "HAD" | "MODAL" | "SEMI":
                clause.aux.append(f"{_AUX[leaf.category]}-{leaf.key.removesuffix('-not')}")
                clause.negated ^= leaf.category == "SEMI" and leaf.key.endswith("not")
                past = leaf.words[0] in _PAST and leaf.words != ("had", "better")
                if leaf.category == "SEMI" and past and not clause.has("be"):
                    clause.aux.append("semi-past")
            case "NOT":
                clause.negated = not clause.negated
            case "MAKE" | "FELT":
                verb = "make" if leaf.category == "MAKE" else "feel"
                clause.verb = Leaf(
                    "V", verb, leaf.key, leaf.words, leaf.tokens, leaf.start, leaf.end, leaf.cost
                )
            case "V" | "VPAST" | "VED" | "VING" | "GOING":
                clause.verb = leaf
            case "PART":
                clause.particles.append(leaf)
            case "SIDE":
                clause.side = leaf.key
            case "ADV":
                clause.manner.append(cast(Manner, leaf.key))
                clause.still |= leaf.key == "still"
            case "FOCUS":
                clause.focus.update(leaf.words)
                clause.still |= "still" in leaf.words
                if kept := _KEEP.get(leaf.words[0]):
                    clause.manner.append(cast(Manner, kept))
            case "INSTEAD":
                clause.instead = True
            case "ELSE":
                clause.else_ = True
            case _:
                self._other_leaf(leaf, clause)

    def _other_leaf(self, leaf: Leaf, clause: Clause) -> None:
        match leaf.category:
            case "BEARING" | "PLACEADV":
                sideways = clause.verb is not None and leaf.words[0] in ("to", "over")
                if sideways and leaf.key in ("left", "right"):
                    clause.side = leaf.key
                else:
                    clause.bearings.append((leaf.key, leaf))
            case "FROM":
                clause.origin = leaf.key
            case "THERE":
                clause.bearings.append(("there", leaf))
            case "ADJ":
                clause.adjectives.append((leaf.key, ""))
            case "I" | "YOU" | "WE" | "PRON":
                self._subject(Node("pronoun", (leaf,), leaf.start, leaf.end, 0.0), clause)
            case "SKIP" | "UNK":
                clause.skipped.append(leaf)
            case "COMPAR":
                clause.comparisons.append((leaf.key, " ".join(leaf.words)))

    def _subject(self, pronoun: Node, clause: Clause) -> None:
        np = Node("np", (pronoun,), pronoun.start, pronoun.end, 0.0)
        clause.subject = self.reader.nouns.read(np)

    def _phrase(self, part: Node, clause: Clause) -> None:
        handler = getattr(self.reader, "_on_" + part.name, None)
        if handler is not None:
            handler(part, clause)


def wanted_pronoun(sem: Sem | None) -> bool:
    """Check whether a subject is a pronoun that may be empty: "it is ..."."""
    return isinstance(sem, Pronoun) and sem.form in ("it", "that", "this")


def is_share(key: str, sem: Sem | None, clause: Clause) -> bool:
    """Check whether a phrase is the probability of what a clause says: "at 91 percent"."""
    said = isinstance(sem, Quantity) and sem.unit == "%" and key in ("at", "with", "by")
    return said and clause.verb is not None and clause.verb.key not in RATING


def takes_name(clause: Clause) -> bool:
    """Check whether the subject is a pronoun that a name after the clause may explain."""
    subject = clause.subject
    return isinstance(subject, Pronoun) and subject.form in ("it", "he", "she")
