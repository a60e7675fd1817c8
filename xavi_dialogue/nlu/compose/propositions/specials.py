"""Special predicates as propositions: what "know", "have", "cost", "make" and others say."""

from collections.abc import Callable
from typing import Any, cast

from msgspec import structs

from xavi_dialogue.domain.terms import (
    Ago,
    At,
    Believed,
    Caused,
    Compares,
    Described,
    Ego,
    Event,
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
    That,
    Unknown,
    Unsaid,
    Vehicle,
    Wanted,
    WholeRide,
)
from xavi_dialogue.nlu.compose.clauses.adoption import with_fields
from xavi_dialogue.nlu.compose.clauses.candidates import Special
from xavi_dialogue.nlu.compose.clauses.nominal import event_in, propose
from xavi_dialogue.nlu.compose.clauses.sem import Measure, Noun, as_thing
from xavi_dialogue.nlu.compose.propositions.feelings import felt, sensed
from xavi_dialogue.nlu.compose.propositions.having import had
from xavi_dialogue.nlu.compose.propositions.severally import each_seen
from xavi_dialogue.nlu.compose.propositions.valuing import (
    believed,
    given_up,
    preferred,
    rated,
    shifted,
)
from xavi_dialogue.nlu.compose.states.becoming import become
from xavi_dialogue.nlu.compose.states.pacing import exceed
from xavi_dialogue.nlu.compose.states.states import STATES
from xavi_dialogue.nlu.compose.verbs import lights
from xavi_dialogue.nlu.compose.verbs.deeds import (
    admits,
    begun,
    broken,
    changed,
    deed_named,
    do,
    event_of,
    had_wrong,
    happen,
    make_do,
    measured,
    missed,
    mistaken,
    neared,
    tense_of,
    time_of,
)
from xavi_dialogue.nlu.compose.verbs.others import is_of_us, is_other
from xavi_dialogue.nlu.compose.verbs.sheltering import beside, emerge, lurk
from xavi_dialogue.nlu.compose.verbs.trends import SINCE

_BELIEF = frozenset({"know", "believe", "conclude", "say", "assign", "lie", "hear",
                     "report", "understand", "wish", "fear", "trust", "ask"})  # fmt: skip
_JUDGING = frozenset({"opinion", "rude", "kind", "dangerous"})
_LIKING = frozenset({"like", "dislike", "mind"})
_DECISION = frozenset({"decide", "plan", "choose", "consider", "want"})


def proposition_of(special: Special) -> Proposition:
    """Turn a special predicate into a proposition; negation is kept."""
    found = _positive(special)
    return Not(found) if special.clause.negated else found


_OTHERS = (Measure, Feature, Described, Unknown)  # what is no view of us


def _positive(special: Special) -> Proposition:
    name = special.name
    if admits(special):
        return mistaken(special)
    if name == "assign":
        return rated(special, special.content or _about(special))
    thought = special.clause.that
    judged = thought is not None and (
        thought.feelings or {key for key, _ in thought.adjectives} & _JUDGING
    )
    if is_other(special.subject) and (name in _LIKING or (name in _BELIEF and judged)):
        # "He will think that we are rude."
        return Is("upset", special.subject, time=time_of(special), tense=tense_of(special))
    if name in _BELIEF and (is_of_us(special) or is_other(special.subject)):
        if special.content is None and isinstance(special.object, _OTHERS):
            return Happens(event_of(special, "do", Unknown(name)))  # "it gets its gap"
        return Related("can-see", special.subject, Ego(), time_of(special), tense_of(special))
    if name in _BELIEF:
        return believed(special, special.content or _about(special))
    if name in _DECISION:
        return _decided(special)
    rule = _RULES.get(name)
    if rule is not None:
        return rule(special)
    if name.startswith("feel"):
        return felt(name, special)
    verb = cast(Any, special.clause.verb).key
    thing = as_thing(special.object)
    return Happens(event_of(special, "do", thing or Unknown(verb)))


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
        if special.name in ("want", "plan"):
            event = structs.replace(event, modal="want")
        if isinstance(event.time, Unsaid):
            event = structs.replace(event, time=time_of(special))
        return Happens(structs.replace(event, actor=special.subject, tense=tense_of(special)))
    if isinstance(content, Not):
        return content
    sem = special.object
    if isinstance(sem, Event):
        return Happens(sem)
    thing = as_thing(sem) or as_thing(special.match.phrases.get("for"))
    if special.name == "consider" and isinstance(thing, Pronoun):
        return believed(special, That())  # "did you allow for that?"
    if special.name == "want":
        return Happens(event_of(special, "do", thing or Pronoun("that")))
    return Happens(
        event_of(special, "do", thing if isinstance(thing, Pronoun) else Pronoun("that"))
    )


def _see(special: Special) -> Proposition:
    if special.content is not None and is_other(special.subject):
        return Related("can-see", special.subject, Ego(), time_of(special), tense_of(special))
    if special.content is not None and special.clause.that is not None:
        return Believed(special.content, time_of(special), tense_of(special))
    seen = special.content.event.actor if isinstance(special.content, Happens) else None
    if isinstance(seen, Described | Vehicle) and tense_of(special) in ("present", "perfect"):
        return Related("can-see", special.subject, seen, time_of(special), tense_of(special))
    if special.content is not None and isinstance(special.content, Happens):
        return Believed(special.content, time_of(special), tense_of(special))
    both = each_seen(special.subject, special.object, time_of(special), tense_of(special))
    if both is not None:
        return both
    each = Pronoun("them-all" if "both" in special.clause.focus else "it")
    unseen = Ego() if is_other(special.subject) else each
    thing = as_thing(special.object) or as_thing(special.clause.gap) or unseen
    return Related("can-see", special.subject, thing, time_of(special), tense_of(special))


def _see_past(special: Special) -> Proposition:
    """Read "see past the lorry", "see round the corner", "see behind that building"."""
    to = beside(special)
    return Related("sees-past", special.subject, to, time_of(special), tense_of(special))


def _cause(special: Special) -> Proposition:
    sem = special.object
    by = special.match.phrases.get("by") if special.clause.passive else None
    cause, done = as_thing(cast(Any, by)), propose(special.clause.subject)
    if cause is not None and done is not None:
        return Caused(cause, done)
    effect: Proposition | None = Happens(sem) if isinstance(sem, Event) else None
    deed = special.clause.subject if effect is not None and special.clause.modal else None
    return Caused(Happens(deed) if isinstance(deed, Event) else special.subject, effect)


def _cost(special: Special) -> Proposition:
    named = (special.match.second, special.object)
    quantity = next((sem for sem in named if isinstance(sem, Quantity)), None)
    time = time_of(special)
    if quantity is None and isinstance(time, At) and _nothing_but_us(special):
        quantity, time = Quantity(time.at, "s"), Unsaid()  # "it saved us five minutes"
    takes = special.name == "take-time"
    attribute: Any = "duration" if takes or special.name == "last" else "delay"
    if special.name == "delay" and isinstance(special.subject, Ego):
        return Happens(event_of(special, "slow-down", None))
    ours = takes and special.subject == Pronoun("it")
    whose = Ego() if ours else special.light or special.subject
    if isinstance(special.clause.subject, Noun) and special.clause.subject.key == "ride":
        whose = Ego()
        time = WholeRide() if isinstance(time, Unsaid) else time
    by, subject = special.match.phrases.get("by"), special.clause.subject
    deed = by if isinstance(by, Event) else subject if isinstance(subject, Event) else None
    if deed is not None:
        deed = with_fields(deed, tense=tense_of(special), modal=special.clause.modal)
    measured = Measured(attribute, whose, None, deed, None, time, tense_of(special))
    if quantity is None:
        return Compares(measured, "too-much" if "too" in special.clause.focus else "more", None)
    return Compares(measured, "same", quantity)


def _nothing_but_us(special: Special) -> bool:
    """Tell whether nothing is named that is saved or lost, so that an amount of time is that."""
    us = (isinstance(sem, Ego | Passenger | None) for sem, _ in special.clause.objects)
    return not special.clause.dated and all(us)


def _is(
    state: str, *, positive: bool = True, of_object: bool = False
) -> Callable[[Special], Proposition]:
    def rule(special: Special) -> Proposition:
        event = special.object if isinstance(special.object, Event) else None
        if isinstance(special.content, Happens):
            event = special.content.event
        if event is None and not of_object and isinstance(special.clause.subject, Event):
            event = special.clause.subject  # "the lane change was over"
        thing = as_thing(special.object) if of_object else special.subject
        found: Proposition = Is(cast(Any, state), None if event else thing, event,
                                time=time_of(special), tense=tense_of(special))  # fmt: skip
        return found if positive else Not(found)

    return rule


def _seem(special: Special) -> Proposition:
    if special.content is not None:
        return special.content
    if special.clause.feelings and is_other(special.subject):
        return Is("upset", special.subject, time=time_of(special), tense=tense_of(special))
    if special.clause.adjectives:
        key = special.clause.adjectives[0][0]
        state: Any = key if key in STATES else "right"
        return Is(state, special.subject, time=time_of(special))
    for state in ("close", "far"):
        if state in special.clause.manner:  # "does it look close?"
            return Is(cast(Any, state), special.subject, time=time_of(special))
    return Related("same-as", special.subject, as_thing(special.object) or Pronoun("that"))


def _deem(special: Special) -> Proposition:
    """Read "do you call that safe": whether it is."""
    key = special.clause.adjectives[0][0] if special.clause.adjectives else ""
    state: Any = key if key in STATES else "right"
    if isinstance(special.content, Happens):  # "judge it acceptable to go"
        event = structs.replace(special.content.event, actor=Ego())
        state = "safe" if state == "right" else state
        return Is(state, event=event, time=time_of(special), tense=tense_of(special))
    return Is(state, as_thing(special.object) or Pronoun("that"), time=time_of(special))


def _leave_space(special: Special) -> Proposition:
    """Read "leave him more room", "leave more room for him": whom we keep a distance to."""
    found = special.match.phrases
    thing = as_thing(found.get("into") or found.get("for") or special.object)
    if isinstance(thing, Feature) and thing.kind == "light":
        return Happens(event_of(special, "leave", thing))  # "since we left the light"
    whom = None if isinstance(thing, Feature) else thing
    gives_way = getattr(as_thing(special.object), "kind", None) == "way"
    return Happens(event_of(special, "give-way" if gives_way else "keep-distance", whom))


def _priority(special: Special) -> Proposition:
    thing = as_thing(special.match.phrases.get("into")) or as_thing(special.object)
    return Happens(event_of(special, "give-way", thing))


def _owed(special: Special) -> Proposition:
    """Read "we owe them priority": we must let them go first."""
    to = as_thing(special.match.phrases.get("into")) or as_thing(special.object) or Pronoun("it")
    return Related("must-yield-to", special.subject, to, time_of(special), tense_of(special))


def _recede(special: Special) -> Proposition:
    """Read "pull away from us": the distance is more than it was shortly before."""
    to = as_thing(special.object) or Ego()
    here = special.subject
    if isinstance(here, Ego | Passenger):
        here, to = to, Ego()
    apart = Measured("distance", here, to, tense=tense_of(special))
    return Compares(apart, "more", with_fields(apart, time=Ago(SINCE), tense="past"))


def _along(special: Special) -> Proposition:
    """Read "come with us", "go the same way as us"."""
    to = as_thing(special.object) or Ego()
    return Related("with", special.subject, to, time_of(special), tense_of(special))


def _lost(special: Special) -> Proposition:
    """Read "you lost sight of him": he disappeared."""
    thing = as_thing(special.match.phrases.get("of")) or as_thing(special.object)
    return Happens(with_fields(event_of(special, "disappear", None), actor=thing or Pronoun("it")))


_RULES: dict[str, Callable[[Special], Proposition]] = {
    "see-past": _see_past, "emerge": emerge, "lurk": lurk,
    "see": _see, "look": _see, "have": had, "make-do": make_do, "cause": _cause,
    "influence": _cause, "matter": _cause, "cost": _cost, "delay": _cost, "take-time": _cost,
    "last": _cost, "save": _cost, "deed": deed_named, "happen": happen, "do": do,
    "had-wrong": had_wrong, "mistake": mistaken, "happen-wrong": _is("wrong"),
    "exist": lambda s: Exists(s.subject, time_of(s), tense_of(s)),
    "break": broken, "late": _is("late"), "obey": _is("allowed"),
    "violate": _is("allowed", positive=False), "exceed": exceed,
    "need": _is("necessary", of_object=True), "end": _is("over"),
    "free-up": _is("free"), "seem": _seem, "deem": _deem,
    "give-priority": _priority, "owe": _owed, "near": neared,
    "switch": lambda s: Happens(event_of(s, "signal", None)), "colour": lights.coloured,
    "stay-colour": lights.stays, "run-light": lights.ran, "make-light": lights.made,
    "become": lambda s: become(s, event_of), "sense": lambda s: sensed(s) or _see(s),
    "stay": _is("safe"), "allow": _is("allowed", of_object=True), "permit": _is("allowed"),
    "risk": _is("dangerous"), "blame": _is("at-fault", of_object=True),
    "leave-space": _leave_space, "begin": begun, "change": changed, "measure": measured,
    "missed-chance": missed, "lose-sight": _lost, "prefer": preferred, "rank": preferred,
    "shift": shifted, "refrain": given_up,
    "heed": lambda s: Related("can-see", s.subject, as_thing(s.object or s.match.phrases.get("of"))
                              or Pronoun("it"), time_of(s), tense_of(s)),
    "recede": _recede, "with": _along, "attend": _is("awake"),
    "load": lambda s: Has("load", "", s.subject, time_of(s), tense_of(s)),
    "driver": lambda s: Has("occupant", "", as_thing(s.object) or Pronoun("it"), time_of(s)),
    "weather": lambda s: Has("weather", "rain", tense=tense_of(s)),
    "prevent": lambda s: Happens(event_of(s, "avoid", as_thing(s.object))),
    "change-o": lambda s: Happens(event_of(s, "change-plan", None)),
    "overlook": lambda s: Not(Related("can-see", s.subject, as_thing(s.object) or Pronoun("it"),
                                      time_of(s), tense_of(s))),
    "belong": lambda s: Related("on", s.subject, as_thing(s.object) or Pronoun("that")),
    "pick-up": lambda s: Happens(event_of(s, "drop-off", as_thing(s.object))),
    "beyond": lambda s: Happens(event_of(s, "do", Unknown(cast(Any, s.clause.verb).key))),
    "remove": lambda s: Not(Exists(as_thing(s.object) or Pronoun("it"))),
    "drop": lambda s: Happens(event_of(s, "drop-off", None)),
    "come-right": lambda s: Is("right", Ego(), time=time_of(s), tense=tense_of(s)),
}  # fmt: skip
