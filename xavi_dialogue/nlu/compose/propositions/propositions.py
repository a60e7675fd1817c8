"""Propositions: what a clause says, by the senses of its verb and the types beside it."""

from dataclasses import replace
from typing import Any, cast

from msgspec import structs

from xavi_dialogue.domain.terms import (
    Both,
    Described,
    Ego,
    Event,
    Happens,
    Is,
    Not,
    Passenger,
    Pronoun,
    Proposition,
    Related,
    Thing,
    Unknown,
    Unsaid,
)
from xavi_dialogue.domain.vocabulary import Manner
from xavi_dialogue.nlu.compose.clauses.adoption import adopt, as_of, compared, with_fields
from xavi_dialogue.nlu.compose.clauses.candidates import Candidate, Special
from xavi_dialogue.nlu.compose.clauses.clause import PASSED_OVER, Clause, wanted_pronoun
from xavi_dialogue.nlu.compose.clauses.patterns import senses
from xavi_dialogue.nlu.compose.clauses.sem import Measure, Notes, Noun, Sem, as_thing
from xavi_dialogue.nlu.compose.clauses.senses import Match, amiss, match, offered
from xavi_dialogue.nlu.compose.clauses.tree import leaves_of, words_of
from xavi_dialogue.nlu.compose.propositions.specials import proposition_of
from xavi_dialogue.nlu.compose.states.positions import by_event
from xavi_dialogue.nlu.compose.states.states import state_of
from xavi_dialogue.nlu.compose.verbs.causing import CAUSATIVE, let_do, slowed
from xavi_dialogue.nlu.compose.verbs.events import event_of, when
from xavi_dialogue.nlu.compose.verbs.lights import shining
from xavi_dialogue.nlu.grammar.chart import Budget

SPREAD = 0.45  # readings that cost this much more than the best are not offered
NO_PREDICATE = 1.0
ODD_FORM = 0.3  # cost of "it is speed", of a verb form that does not go with its auxiliary
READING = 20  # steps that reading a clause with a verb takes


class Propositions:
    """Reads clauses."""

    def __init__(self, notes: Notes, budget: Budget) -> None:
        self.notes = notes
        self.budget = budget
        self.later: dict[int, tuple[Clause, Sem | None]] = {}  # chained clauses as events

    def readings(self, clause: Clause) -> list[Candidate]:
        """Read a clause in all the ways that its words allow, cheapest first."""
        _regovern(clause)
        _own_car(clause)
        self._inner(clause)
        told = self._told(clause)
        if told is not None:
            return [Candidate(told, 0.0)]
        if clause.verb is None:
            rest = tuple(node for _, node in clause.objects[1:])
            found = [Candidate(p, cost, rest) for p, cost in state_of(clause)]
            if not found:
                return []
        elif clause.verb.category == "UNK":
            return [Candidate(self._unknown(clause), 0.0)]
        else:
            found = self._verbal(clause)
        if clause.verb is not None and clause.verb.form == "base" and clause.aux_last() == "be":
            found = [replace(one, cost=one.cost + ODD_FORM) for one in found]
        elif clause.verb is not None and clause.verb.words == ("up", "to") and clause.aux == []:
            found = [replace(one, cost=one.cost + NO_PREDICATE) for one in found]
        found.sort(key=lambda candidate: candidate.cost)
        best = found[0].cost if found else 0.0
        kept = [c for c in found if c.cost <= best + SPREAD][:4]
        if kept:
            value = kept[0].value
            if isinstance(value, Special) and value.name == "beyond" and clause.verb is not None:
                self.notes.unknown.append(clause.verb)
            for part in kept[0].left:
                self.notes.unknown.extend(leaves_of(part))
        return kept

    def _told(self, clause: Clause) -> Proposition | None:
        """Read "it is not true that he turned": what is said to be so, or not."""
        key = clause.adjectives[0][0] if clause.adjectives else ""
        bare = clause.verb is None and wanted_pronoun(clause.subject)
        bare = bare and clause.subject != Pronoun("that")  # "that's not true, it was moving"
        if "where" in clause.focus and clause.verb is None and clause.that is not None:
            content = self.plain(clause.that)
            return Not(content) if content is not None and clause.negated else content
        if not bare or key not in ("right", "wrong") or clause.that is None:
            return None
        content = self.plain(clause.that)
        if content is None:
            return None
        return Not(content) if clause.negated != (key == "wrong") else content

    def _inner(self, clause: Clause) -> None:
        governed = clause.infinitive or clause.gerund or clause.bare
        if governed is not None and isinstance(governed.subject, Pronoun):
            governed.subject = Ego()
        if governed is not None and clause.verb is None and clause.inner is None:
            event = self.as_event(governed)
            clause.inner = event if isinstance(event, Event) else None

    def _verbal(self, clause: Clause) -> list[Candidate]:
        lemma = cast(Any, clause.verb).key
        self.budget.spend(READING)
        if clause.there and clause.objects and lemma in ("go", "come"):
            clause.subject = clause.objects.pop(0)[0]  # "there goes the grey one"
            clause.there = False
        found: list[Candidate] = []
        words = offered(clause)
        matches = [m for sense in senses(lemma) if (m := match(sense, clause, words)) is not None]
        if not matches:
            return [Candidate(self._bare(clause, lemma), 1.0, _objects(clause))]
        matches.sort(key=lambda m: m.cost)
        limit = matches[0].cost + SPREAD + 0.6
        for one in matches:
            if one.cost > limit or len(found) > 5:
                break
            found.append(self._candidate(clause, one))
        return _distinct(found)

    def _candidate(self, clause: Clause, one: Match) -> Candidate:
        adopt(one)
        one.cost += amiss(clause, one)
        if one.sense.head.startswith("@"):
            value: Proposition | Special = self._special(clause, one)
        else:
            event = self._idling(clause, event_of(clause, one))
            event = self._chain(clause, event)
            value = compared(clause, event) or by_event(clause, event) or Happens(event)
            if "semi-allowed" in clause.aux:
                if event.actor == Pronoun("it"):
                    event = with_fields(event, actor=Ego())  # "is it allowed to go?"
                value = Is("allowed", event=event, time=event.time, tense=event.tense)
            if clause.negated:
                value = Not(value)
        left: list[Any] = [phrase.node for phrase in one.left if phrase.sem is not None]
        left += [node for sem, node in clause.objects if any(sem is o for o in one.left_objects)]
        unused = clause.that is not None and not isinstance(value, Special)
        if isinstance(value, Special) and value.name == "have":
            unused = value.content is not None and isinstance(value.object, Measure)
        return Candidate(value, one.cost + PASSED_OVER * unused, tuple(left))

    def _special(self, clause: Clause, one: Match) -> Special:
        clause.time = when(clause, one)
        governed = clause.away if one.sense.head == "@prevent" else None
        governed = governed or clause.that or clause.infinitive or clause.gerund or clause.bare
        content: Proposition | None = None
        if one.sense.head == "@make-do" and isinstance(one.second, Event):
            content = Happens(with_fields(one.second, actor=as_thing(one.object) or Ego()))
        elif one.sense.head == "@make-do" and isinstance(one.phrases.get("into"), Event):
            sem = cast(Event, one.phrases["into"])
            content = Happens(with_fields(sem, actor=as_thing(one.object) or Ego()))
        elif governed is not None:
            _for_subject(governed, one)
            if clause.that is None and one.object is not None and one.sense.head != "@tell":
                governed.subject = one.object
                if clause.objects and words_of(clause.objects[0][1]) == "the car":
                    governed.subject = Ego()
            content = self.plain(governed)
            if content is not None and governed is not clause.that:
                content = as_of(content, clause.tense)
        return Special(one.sense.head[1:], clause, one, content)

    def _idling(self, clause: Clause, event: Event) -> Event:
        """Read "sit here looking at his back doors" as what is done meanwhile."""
        if event.action != "stand" or clause.gerund is None:
            return event
        clause.gerund.subject = clause.subject or clause.gerund.subject
        inner = self.as_event(clause.gerund)
        if not isinstance(inner, Event) or inner.action not in _MEANWHILE:
            return event
        found: Event = with_fields(inner, tense=event.tense, modal=event.modal, time=event.time)
        return found

    def _chain(self, clause: Clause, event: Event) -> Event:
        """Add what is done next: "change left and then turn right"."""
        for join, later in reversed(clause.chained):
            found = self._later(later)
            if join == "and" and isinstance(found, Event) and later.negated:
                self.notes.taken.add(id(later))  # "sat there and never moved"
            elif join == "and" and isinstance(found, Event):
                self.notes.taken.add(id(later))
                event = structs.replace(event, then=found)
        return event

    def _later(self, clause: Clause) -> Sem | None:
        """Read a chained clause as an event, once for all senses of the verb before it."""
        if id(clause) not in self.later:
            self.later[id(clause)] = (clause, self.as_event(clause))
        return self.later[id(clause)][1]

    def _unknown(self, clause: Clause) -> Proposition:
        word = cast(Any, clause.verb).words[0]
        found: Proposition = Happens(
            Event("do", as_thing(clause.subject) or Ego(), Unknown(word), cast(Any, clause.side),
                  time=when(clause, None), tense=cast(Any, clause.tense),
                  modal=cast(Any, clause.modal))
        )  # fmt: skip
        return Not(found) if clause.negated else found

    def _bare(self, clause: Clause, lemma: str) -> Proposition:
        """Read a verb whose senses all want something else as doing what is unknown."""
        found: Proposition = Happens(
            Event("do", as_thing(clause.subject) or Ego(), Unknown(lemma),
                  time=when(clause, None), tense=cast(Any, clause.tense),
                  modal=cast(Any, clause.modal))
        )  # fmt: skip
        return Not(found) if clause.negated else found

    # --- for others --------------------------------------------------

    def plain(self, clause: Clause) -> Proposition | None:
        """Read a clause in the likeliest way, as a proposition."""
        found = self.readings(clause)
        if not found:
            return None
        if clause.verb is not None:
            known = self.notes.inner.get(id(clause.verb), found[0].cost)
            self.notes.inner[id(clause.verb)] = min(known, found[0].cost)
        value = found[0].value
        if isinstance(value, Special):
            return proposition_of(value)
        return self.joined(clause, value)

    def joined(self, clause: Clause, value: Proposition) -> Proposition:
        """Join what the clause says with what is chained to it by "or", or to a state."""
        chained = [(j, c) for j, c in clause.chained
                   if j == "or" or not isinstance(value, Happens)]  # fmt: skip
        if not chained:
            return value
        for _, other in chained:
            other.time = clause.time if isinstance(other.time, Unsaid) else other.time
            other.than = other.than or clause.than  # "is he faster or slower than us?"
        others = [p for _, c in chained if (p := self.plain(c)) is not None]
        if not others:
            return value
        self.notes.taken.update(id(c) for _, c in chained)
        return Both((value, *others), cast(Any, chained[0][0]))

    def as_event(self, clause: Clause) -> Sem | None:
        """Read a clause as an event, or as what it is about."""
        found = self.plain(clause)
        match found:
            case Happens(event=event):
                return event
            case Not(content=Happens(event=event)):
                return event
            case Is(state="fast" | "slow" as pace, thing=thing) if thing is not None:
                manner: Manner = "fast" if pace == "fast" else "slowly"
                return Event("go", thing, manner=(manner,), time=found.time, tense=found.tense)
            case Related(relation="can-see", thing=thing, to=to):
                return Event("see", thing, to, tense=found.tense)
            case None:
                return None
            case _:
                named = getattr(found, "thing", None) or getattr(found, "to", None)
                return shining(found) or cast("Sem | None", named)

    def ended(self, clause: Clause) -> Event | None:
        """Give the event that a clause says is over: "when you finished the lane change"."""
        found = self.plain(clause)
        return found.event if isinstance(found, Is) and found.state == "over" else None

    def as_deed(self, clause: Clause) -> Sem:
        """Read a gerund as an event of our own car unless it says whose."""
        if clause.subject is None:
            clause.subject = Ego()
        found = self.as_event(clause)
        return found if found is not None else Pronoun("that")

    def anchor(self, sem: Sem | None) -> Event | Thing | None:
        """Give what a time can be relative to."""
        if isinstance(sem, Event):
            return sem
        if isinstance(sem, (Measure, Noun)):
            return None
        return as_thing(sem)


def _for_subject(governed: Clause, one: Match) -> None:
    """Give "for you to go" its subject."""
    for phrase in list(one.left):
        if phrase.key == "for" and as_thing(phrase.sem) is not None:
            governed.subject = phrase.sem
            one.left.remove(phrase)
            return


_MEANWHILE = frozenset({"follow", "wait", "give-way", "let-go", "block"})


def _regovern(clause: Clause) -> None:
    """Read "made you switch" as object and bare infinitive, not as a clause of its own."""
    inner = clause.that
    slowed(clause)
    let_do(clause)
    if clause.verb is None or clause.verb.key not in CAUSATIVE or inner is None:
        return
    if clause.objects or inner.subject is None or inner.aux:
        return
    clause.objects.append((inner.subject, clause.verb))
    clause.bare, clause.that = inner, None


_TOWARDS = frozenset({"cut", "come", "approach", "honk", "pull", "tailgate", "overtake", "hit"})


def _own_car(clause: Clause) -> None:
    """Take "the car" for our own where it does nothing to us and is nowhere seen from us."""
    if not clause.the_car or not isinstance(clause.subject, Described):
        return
    sems = [sem for sem, _ in clause.objects] + [phrase.sem for phrase in clause.complements]
    to_us = any(isinstance(sem, Ego | Passenger) for sem in sems) or bool(clause.bearings)
    verb = clause.verb.key if clause.verb is not None else ""
    if verb and verb not in _TOWARDS and not to_us:
        clause.subject = Ego()


def _objects(clause: Clause) -> tuple[Any, ...]:
    return tuple(node for _, node in clause.objects)


def _distinct(found: list[Candidate]) -> list[Candidate]:
    kept: list[Candidate] = []
    for candidate in sorted(found, key=lambda c: c.cost):
        value = candidate.value
        if isinstance(value, Special) or all(value != other.value for other in kept):
            kept.append(candidate)
    return kept
