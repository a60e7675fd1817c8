"""Special predicates as propositions: what "know", "have", "cost", "make" and others say."""

from collections.abc import Callable
from typing import Any, cast

from xavi_dialogue.domain.terms import (
    Believed,
    Caused,
    Compares,
    Ego,
    Event,
    Everyone,
    Exists,
    Feature,
    Happens,
    Has,
    Is,
    Measured,
    Not,
    Passenger,
    Pronoun,
    Proposition,
    Quantity,
    Related,
    Road,
    That,
    Thing,
    Unknown,
    Unsaid,
    Wanted,
)
from xavi_dialogue.nlu.compose.adoption import exceeding, with_fields
from xavi_dialogue.nlu.compose.becoming import become
from xavi_dialogue.nlu.compose.candidates import Special
from xavi_dialogue.nlu.compose.clause import Clause
from xavi_dialogue.nlu.compose.events import when
from xavi_dialogue.nlu.compose.nominal import event_in
from xavi_dialogue.nlu.compose.rooms import roomy
from xavi_dialogue.nlu.compose.sem import Measure, Noun, as_thing
from xavi_dialogue.nlu.compose.tree import words_of
from xavi_dialogue.nlu.compose.trends import trend

_ABOVE = frozenset({"over", "above", "more", "beyond"})
_BELIEF = frozenset({"know", "believe", "conclude", "say", "assign", "mistake", "lie", "hear",
                     "report", "understand", "wish", "fear", "trust", "ask"})  # fmt: skip
_DECISION = frozenset({"decide", "plan", "choose", "consider", "want"})


def proposition_of(special: Special) -> Proposition:
    """Turn a special predicate into a proposition; negation is kept."""
    found = _positive(special)
    return Not(found) if special.clause.negated else found


def _positive(special: Special) -> Proposition:
    name = special.name
    if name == "assign":
        return _rated(special)
    if name in _BELIEF:
        return Believed(special.content or _about(special), _when(special), _tense(special))
    if name in _DECISION:
        return _decided(special)
    rule = _RULES.get(name)
    if rule is not None:
        return rule(special)
    if name.startswith("feel"):
        return Is("comfortable", as_thing(special.object) or Passenger())
    verb = cast(Any, special.clause.verb).key
    thing = as_thing(special.object)
    return Happens(_event(special, "do", thing or Unknown(verb)))


def _when(special: Special) -> Any:
    return when(special.clause, special.match)


def _tense(special: Special) -> Any:
    return special.clause.tense


def _event(special: Special, action: str, thing: Thing | None, **more: Any) -> Event:
    return Event(
        cast(Any, action), special.subject, thing, cast(Any, special.clause.side),
        tuple(special.clause.manner), _when(special), _tense(special),
        cast(Any, special.clause.modal), **more,
    )  # fmt: skip


def _rated(special: Special) -> Proposition:
    """Read "you rated the lorry turning right at 91 percent"."""
    about = special.content or _about(special)
    for sem in special.match.phrases.values():
        if isinstance(sem, Quantity) and not isinstance(about, That):
            measured = Measured(
                "probability", about=about, time=_when(special), tense=_tense(special)
            )
            return Compares(measured, "same", sem)
        event = event_in(sem)
        if event is not None:
            about = Happens(event)
    return Believed(about, _when(special), _tense(special))


def _about(special: Special) -> Proposition:
    """Make a proposition of the object of a belief: "it" and "that" stand for one."""
    sem = special.object
    event = event_in(sem)
    if event is not None:
        return Happens(event)
    if sem is None or isinstance(sem, (Pronoun, Noun, Wanted)):
        return That()
    thing = as_thing(sem)
    return Exists(thing) if thing is not None and not isinstance(sem, Measure) else That()


def _decided(special: Special) -> Proposition:
    content = special.content
    if isinstance(content, Happens):
        event = content.event
        fields = {k: getattr(event, k) for k in event.__struct_fields__}
        if special.name in ("want", "plan"):
            fields["modal"] = "want"
        fields["actor"] = special.subject
        fields["tense"] = _tense(special)
        if isinstance(fields["time"], Unsaid):
            fields["time"] = _when(special)
        return Happens(Event(**fields))
    if isinstance(content, Not):
        return content
    sem = special.object
    if isinstance(sem, Event):
        return Happens(sem)
    thing = as_thing(sem)
    if special.name == "want":
        return Happens(_event(special, "do", thing or Pronoun("that")))
    return Happens(_event(special, "do", thing if isinstance(thing, Pronoun) else Pronoun("that")))


def _see(special: Special) -> Proposition:
    if special.content is not None and special.clause.that is not None:
        return Believed(special.content, _when(special), _tense(special))
    if special.content is not None and isinstance(special.content, Happens):
        return Believed(special.content, _when(special), _tense(special))
    thing = as_thing(special.object) or as_thing(special.clause.gap) or Pronoun("it")
    return Related("can-see", special.subject, thing, _when(special), _tense(special))


def _have(special: Special) -> Proposition:
    sem = special.object
    over = next((as_thing(s) for k, s in special.match.phrases.items() if k in
                 ("over", "bearing-ahead", "with")), None)  # fmt: skip
    if over is None and not isinstance(special.clause.than, Clause):
        over = as_thing(special.clause.than)
    if isinstance(sem, Measure) and sem.of.attribute == "right-of-way":
        other = over or sem.of.to or Everyone()
        time = _when(special) if isinstance(sem.of.time, Unsaid) else sem.of.time
        return Related("has-priority-over", special.subject, other, time, _tense(special))
    if isinstance(sem, Measure) and sem.of.attribute in ("indicator", "brake-lights"):
        value = special.clause.side or "on"
        return Has(sem.of.attribute, value, special.subject, _when(special), _tense(special))
    if isinstance(sem, Measure):
        return Compares(Measured(sem.of.attribute, special.subject), "same", None)
    if isinstance(sem, Feature) and sem.kind == "space":
        return roomy(special.clause, _when(special))
    if isinstance(sem, Road) and sem.which == "main":
        return Related("has-priority-over", special.subject, over or Everyone(), _when(special),
                       _tense(special))  # fmt: skip
    if isinstance(sem, Feature):
        return Exists(sem, _when(special), _tense(special))
    if isinstance(sem, Noun):
        return _have_noun(special, sem)
    thing = as_thing(sem) or Pronoun("that")
    if isinstance(sem, Event):
        return Happens(Event(sem.action, special.subject, sem.object, sem.side, sem.manner,
                             _when(special), _tense(special)))  # fmt: skip
    if special.content is not None:
        return special.content
    return Related("with", special.subject, thing, _when(special), _tense(special))


def _have_noun(special: Special, sem: Noun) -> Proposition:
    if sem.key == "problem":
        return Is("wrong", special.subject, time=_when(special), tense=_tense(special))
    if sem.key in ("option", "plan", "reason"):
        found: Proposition = Is("possible", time=_when(special), tense=_tense(special))
        return Not(found) if sem.negative else found
    return Related("with", special.subject, Unknown(sem.word), _when(special), _tense(special))


def _make_do(special: Special) -> Proposition:
    effect = special.content
    if effect is None:
        thing = as_thing(special.object) or Ego()
        effect = Happens(Event("do", thing, Pronoun("that"), tense=_tense(special)))
    return Caused(special.subject, effect)


def _cause(special: Special) -> Proposition:
    sem = special.object
    effect: Proposition | None = Happens(sem) if isinstance(sem, Event) else None
    return Caused(special.subject, effect)


def _cost(special: Special) -> Proposition:
    quantity = special.match.second if isinstance(special.match.second, Quantity) else None
    if quantity is None and isinstance(special.object, Quantity):
        quantity = special.object
    attribute: Any = "duration" if special.name in ("take-time", "last") else "delay"
    by = special.match.phrases.get("by")
    deed = by if isinstance(by, Event) else None
    if deed is not None:
        deed = with_fields(deed, tense=_tense(special), modal=special.clause.modal)
    measured = Measured(attribute, special.subject, None, deed, None, _when(special),
                        _tense(special))  # fmt: skip
    if quantity is None:
        return Compares(measured, "too-much" if "too" in special.clause.focus else "more", None)
    return Compares(measured, "same", quantity)


def _deed(special: Special) -> Proposition:
    sem = special.object
    if isinstance(sem, Event):
        return Happens(_event(special, sem.action, sem.object))
    if sem is None and special.content is not None:
        return special.content  # "why do you make brake"
    return Happens(_event(special, "do", as_thing(sem)))


def _happen(special: Special) -> Proposition:
    about = next((as_thing(s) for s in special.match.phrases.values()), None)
    if special.content is not None:
        return special.content
    return Happens(Event("happen", about or special.subject, time=_when(special),
                         tense=_tense(special)))  # fmt: skip


def _do(special: Special) -> Proposition:
    sem = special.object
    above = exceeding(special.clause, _event(special, "do", None))
    if above is not None:
        return above
    if isinstance(sem, Event):
        return Happens(sem)
    thing = as_thing(sem)
    if isinstance(sem, Quantity):
        if sem.unit == "count":
            sem = Quantity(round(sem.value / 3.6, 6), "m/s")  # nobody says "km/h"
        return Compares(Measured("speed", special.subject, tense=_tense(special)), "same", sem)
    return Happens(_event(special, "do", thing))


def _changed(special: Special) -> Proposition:
    """Read "the gap is shrinking"; what changes otherwise is the plan."""
    found = trend(special.clause)
    return found or Happens(_event(special, "change-plan", None))


def _begun(special: Special) -> Proposition:
    """Read "you started braking", "you began the lane change": the deed itself."""
    if special.content is not None:
        return special.content
    sem = special.object
    if isinstance(sem, Event):
        event = _event(special, sem.action, sem.object)
        return Happens(cast(Event, with_fields(event, side=sem.side)))
    return Happens(_event(special, "go", None))


def _had_wrong(special: Special) -> Proposition:
    """Read "you had that wrong", "did you get him wrong": of whom was spoken."""
    who = as_thing(special.object)
    whom = Pronoun("he") if who is None or isinstance(who, Pronoun) else who
    return Is("wrong", whom, time=_when(special), tense="past")


def _is(
    state: str, *, positive: bool = True, of_object: bool = False
) -> Callable[[Special], Proposition]:
    def rule(special: Special) -> Proposition:
        event = special.object if isinstance(special.object, Event) else None
        if isinstance(special.content, Happens):
            event = special.content.event
        thing = as_thing(special.object) if of_object else special.subject
        found: Proposition = Is(cast(Any, state), None if event else thing, event,
                                time=_when(special), tense=_tense(special))  # fmt: skip
        return found if positive else Not(found)

    return rule


def _exceed(special: Special) -> Proposition:
    speed = Measured("speed", special.subject, time=_when(special), tense=_tense(special))
    limit = Measured("limit", special.subject)
    if isinstance(special.object, Quantity):
        said = special.object
        if said.unit == "count":
            said = Quantity(round(said.value / 3.6, 6), "m/s")  # nobody says "km/h"
        words = " ".join(words_of(node) for _, node in special.clause.objects)
        more = special.clause.verb is None or special.clause.verb.key != "do"
        more = more or any(word in _ABOVE for word in words.split())
        return Compares(speed, "more" if more else "same", said)
    return Compares(speed, "more", limit)


def _seem(special: Special) -> Proposition:
    if special.content is not None:
        return special.content
    if special.clause.adjectives:
        return Is(cast(Any, "dangerous" if special.clause.adjectives[0][0] == "dangerous" else
                       "right"), special.subject, time=_when(special))  # fmt: skip
    return Related("same-as", special.subject, as_thing(special.object) or Pronoun("that"))


def _priority(special: Special) -> Proposition:
    thing = as_thing(special.match.phrases.get("into")) or as_thing(special.object)
    return Happens(_event(special, "give-way", thing))


def _signal(special: Special) -> Proposition:
    return Happens(_event(special, "signal", None))


_RULES: dict[str, Callable[[Special], Proposition]] = {
    "see": _see, "look": _see, "have": _have, "make-do": _make_do, "cause": _cause,
    "influence": _cause, "matter": _cause, "cost": _cost, "delay": _cost, "take-time": _cost,
    "last": _cost, "save": _cost, "deed": _deed, "happen": _happen, "do": _do,
    "had-wrong": _had_wrong, "happen-wrong": _is("wrong"), "exist": lambda s: Exists(s.subject, _when(s), _tense(s)),
    "break": _is("faulty"), "late": _is("late"), "obey": _is("allowed"),
    "violate": _is("allowed", positive=False), "exceed": _exceed,
    "need": _is("necessary", of_object=True), "end": _is("over"),
    "free-up": _is("free"), "seem": _seem, "give-priority": _priority, "switch": _signal,
    "become": lambda s: become(s, _event),
    "stay": _is("safe"), "allow": _is("allowed", of_object=True), "permit": _is("allowed"),
    "risk": _is("dangerous"), "blame": _is("at-fault", of_object=True),
    "leave-space": lambda s: Happens(_event(s, "keep-distance", as_thing(s.object))),
    "begin": _begun, "change": _changed,
    "lose-sight": lambda s: Happens(_event(s, "see", as_thing(s.object))),
    "weather": lambda s: Has("weather", "rain", tense=_tense(s)),
    "prevent": lambda s: Happens(_event(s, "avoid", as_thing(s.object))),
    "change-o": lambda s: Happens(_event(s, "change-plan", None)),
    "overlook": lambda s: Not(Related("can-see", s.subject, as_thing(s.object) or Pronoun("it"),
                                      _when(s), _tense(s))),
    "belong": lambda s: Related("on", s.subject, as_thing(s.object) or Pronoun("that")),
    "pick-up": lambda s: Happens(_event(s, "drop-off", as_thing(s.object))),
    "beyond": lambda s: Happens(_event(s, "do", Unknown(cast(Any, s.clause.verb).key))),
    "remove": lambda s: Not(Exists(as_thing(s.object) or Pronoun("it"))),
    "drop": lambda s: Happens(_event(s, "drop-off", None)),
}  # fmt: skip
