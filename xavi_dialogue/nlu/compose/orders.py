"""Orders: imperatives and polite questions: "tell me why", "could you slow down", "list ..."."""

from typing import Any, cast

from xavi_dialogue.domain.meaning import Act, Ask, Quizzing, Repair, Summarise, Whether, Why
from xavi_dialogue.domain.terms import (
    Compares,
    Ego,
    Event,
    Feature,
    Happens,
    Is,
    Measured,
    Not,
    Passenger,
    Proposition,
    Related,
    Relative,
)
from xavi_dialogue.nlu.compose.clauses.candidates import Special
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.sem import as_thing
from xavi_dialogue.nlu.compose.telling import Telling
from xavi_dialogue.nlu.compose.verbs.others import is_other
from xavi_dialogue.nlu.compose.wh_questions.wh import fact
from xavi_dialogue.nlu.compose.wishes import alights, pace_of, paced, request, requests

_TELLING = frozenset(
    {
        "tell",
        "describe",
        "rate",
        "summarise",
        "list",
        "justify",
        "know",
        "ask",
        "understand",
        "report",
        "compare",
        "count",
        "identify",
        "name",
        "say",
        "like",
        "want",
        "show",
    }
)
Found = list[tuple[tuple[Act, ...], float]]


class Orders(Telling):
    """Reads what the passenger asks the car to do or to tell."""

    def __init__(self, composer: Any) -> None:
        self.composer = composer

    # --- what is asked politely --------------------------------------

    def polite(
        self, clause: Clause, *, refrain: bool = False, please: bool = False
    ) -> tuple[Act, ...] | None:
        """Read "can you tell me why", "could you slow down", "do you know how far"."""
        if not isinstance(clause.subject, (Ego, Passenger)):
            return None
        value = self._best(clause)
        if isinstance(value, Special) and value.name == "quiz" and isinstance(clause.subject, Ego):
            return (Quizzing(),)
        sees = isinstance(value, Special) and value.name == "see" and not clause.objects
        if isinstance(value, Special) and (value.name in _TELLING or sees):
            if clause.question is not None:
                return self.embedded(clause) or None
            if (value.name == "know" or sees) and not clause.led and _inquires(clause):
                asked = self.asked_if(clause)  # "do you know if it is turning", "when it turns"
                return None if asked is None else (Ask(asked),)
            modal = clause.modal in ("can", "could", "would") or clause.has("modal-will")
            modal = modal or "semi-mind" in clause.aux
            if (
                value.name
                in (
                    "tell",
                    "describe",
                    "rate",
                    "summarise",
                    "list",
                    "justify",
                    "count",
                    "compare",
                    "identify",
                    "report",
                    "show",
                )
                and modal
            ):
                return self.told(clause, value) or None
            return None
        if _wavers(value):
            return (Ask(Why(Happens(Event("change-plan", tense="perfect")))),)
        return self._requested(clause, value, refrain, please)

    def _requested(
        self, clause: Clause, value: Any, refrain: bool, please: bool
    ) -> tuple[Act, ...] | None:
        modal = clause.modal in ("can", "could", "would") or clause.has("modal-will")
        minded = "semi-mind" in clause.aux  # "would you mind moving over"
        modal, refrain = modal or minded, refrain or minded
        of = fact(value) if value is not None else None
        if isinstance(of, Happens) and modal and alights(clause):
            return (request(of.event, clause),)  # "can I get out here?"
        if not modal or clause.has("have") or not isinstance(clause.subject, Ego):
            return None
        supposing = clause.condition is not None or clause.without is not None
        if clause.still or "semi-can" in clause.aux or supposing:
            return None
        plain = of is None or isinstance(of, Is) or (isinstance(of, Compares) and not please)
        speed = None if plain or of is None else paced(of)
        if speed is not None:
            return (speed,)
        event = of.event if isinstance(of, Happens) else None
        if event is not None and event.action == "do" and not clause.negated:
            found = pace_of(clause, event)  # "could you take the next one slower?"
            return None if found is None else (found,)
        if isinstance(of, Not) and isinstance(of.content, Happens):
            event = of.content.event
        if event is None or event.action in (
            "see",
            "do",
            "happen",
            "wait-for",
            "collide",
            "arrive",
        ):
            return None
        if clause.has("modal-will") and not clause.negated and "please" not in clause.focus:
            return None
        in_time = "early" in event.manner and event.action in ("stop", "brake") and not please
        races = "first" in event.manner and event.object is not None and not please
        on_red = isinstance(event.object, Feature) and event.object.colour == "red" and not please
        if clause.than is not None or in_time or races or on_red:
            return None  # "can you stop in time?", "can we turn on red?"
        return requests(event, clause, negated=refrain and isinstance(of, Not))

    def _best(self, clause: Clause) -> Any:
        found = self.composer.propositions.readings(clause)
        return found[0].value if found else None

    def stated(self, clause: Clause) -> tuple[Act, ...] | None:
        """Read "I want to know why", "I wonder how fast", "I would like you to stop"."""
        placed = clause.complements or clause.bearings  # "we are behind him", a statement itself
        if clause.question is not None and clause.verb is None and not placed:
            return self.embedded(clause) or None
        if not isinstance(clause.subject, (Passenger, Ego)):
            return None
        if clause.question is not None:
            value = self._best(clause)
            known = isinstance(value, Special) and value.name in _TELLING | {"want", "decide"}
            if known and isinstance(clause.subject, Passenger):
                return self.embedded(clause) or None
            return None
        inner = clause.infinitive
        if not isinstance(clause.subject, Passenger):
            return None
        if clause.condition is not None and clause.condition.question is not None:
            return self.embedded(clause.condition) or None
        if inner is not None and inner.question is not None:
            return self.embedded(inner) or None
        if inner is not None and inner.verb is not None and inner.verb.key in ("know", "tell"):
            asked = self.asked_if(inner)  # "I would like to know if you can see it"
            if asked is not None:
                return (Ask(asked),)
        wants = "semi-must" in clause.aux or clause.modal == "want"
        if wants and clause.verb is not None and clause.verb.key == "know":
            asked = self.asked_if(clause)  # "I need to know if you can see it"
            if asked is not None:
                return (Ask(asked),)
        return self._wished(clause)

    def _wished(self, clause: Clause) -> tuple[Act, ...] | None:
        if clause.verb is None or clause.verb.key not in (
            "want",
            "like",
            "need",
            "wish",
            "tell",
            "know",
            "understand",
            "ask",
        ):
            return None
        value = self._best(clause)
        inner = clause.infinitive
        if inner is not None and inner.verb is not None and inner.verb.key in ("quiz", "test"):
            return (Quizzing(),)
        if not isinstance(value, Special) or clause.negated:
            return None
        if isinstance(value.content, Happens) and isinstance(value.object, Ego):
            return (request(value.content.event, clause),)
        if value.name in ("tell", "know", "understand", "ask") and clause.modal == "want":
            return self.told(clause, value) or None
        return None

    # --- imperatives -------------------------------------------------

    def order(self, clause: Clause, *, negated: bool) -> Found:
        """Read an imperative."""
        style = self._style(clause)
        if clause.subject is None:
            clause.subject = Ego()
        found: Found = []
        for candidate in self.composer.propositions.readings(clause):
            acts = self._ordered(clause, candidate.value, negated, style)
            if acts:
                found.append((acts, candidate.cost))
        return found

    def _ordered(
        self, clause: Clause, value: Any, negated: bool, style: str | None
    ) -> tuple[Act, ...]:
        if isinstance(value, Special):
            asked = None if clause.question is None else clause.question[0]
            if value.name == "summarise" and asked is not None and asked.kind == "why":
                return self.embedded(clause)
            if clause.question is not None and value.name == "summarise":
                return (Ask(Summarise(None, self.asked_time(clause))),)
            if clause.question is not None and value.name in _TELLING:
                return self.embedded(clause)
            if value.name in ("tell", "say", "describe", "repeat") and style:
                return (Repair(cast(Any, style)),)
            if value.name == "repeat":
                return (Repair("repeat"),)
            if value.name == "quiz":
                return (Quizzing(),)
            thing = as_thing(value.object)
            if value.name == "heed" and thing is not None and is_other(thing):
                return (Ask(Whether(Related("can-see", Ego(), thing))),)
            if value.name == "obey":
                return (Ask(Whether(within_limit())),)
            if _wavers(value):
                return (Ask(Why(Happens(Event("change-plan", tense="perfect")))),)
            if value.name == "quiet" or (value.name == "end" and clause.gerund is not None):
                return (Repair("cancel"),)
            told = self.told(clause, value)
            if told:
                return told
            if value.name in _TELLING:
                return ()
        of = fact(value)
        match of:
            case Happens(event=event):
                return requests(event, clause, negated=negated)
            case Not(content=Happens(event=event)):
                return (request(event, clause, negated=True),)
        speed = paced(Not(of) if negated and not isinstance(of, Not) else of)
        return () if speed is None else (speed,)

    def _style(self, clause: Clause) -> str | None:
        words = " ".join(w for _, w in clause.comparisons) + " " + " ".join(clause.focus)
        for stem, kind in (("simpl", "simpler"), ("short", "shorter"), ("long", "longer")):
            if stem in words:
                return kind
        return "repeat" if "again" in clause.manner else None


def within_limit() -> Proposition:
    """Say that we keep to the speed limit."""
    return Compares(Measured("speed"), "at-most", Measured("limit"))


def _inquires(clause: Clause) -> bool:
    """Check whether "if" or "when" opens a clause that is the object of what we know."""
    timed = isinstance(clause.time, Relative) and clause.time.relation == "during"
    return clause.condition is not None or (timed and not clause.objects and clause.that is None)


def _wavers(value: Any) -> bool:
    """Say whether it is about making up one's mind."""
    verb = value.clause.verb if isinstance(value, Special) else None
    return verb is not None and verb.key == "make up one's mind"


def wavers(clause: Clause, value: Any) -> bool:
    """Check whether the passenger says that we cannot make up our mind."""
    return _wavers(value) and clause.negated and isinstance(clause.subject, Ego)
