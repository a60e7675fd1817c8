"""Reasoning: questions for what was considered, believed, decisive, preventive or worth it."""

from xavi_dialogue.domain.meaning import (
    Changed,
    HowAvoid,
    HowKnow,
    Listing,
    Question,
    WhatWouldChange,
    Why,
)
from xavi_dialogue.domain.terms import (
    Back,
    Ego,
    Event,
    Feature,
    Happens,
    Lane,
    Not,
    Pronoun,
    Proposition,
    Record,
    That,
    Unsaid,
)
from xavi_dialogue.nlu.compose.clauses.adoption import as_of
from xavi_dialogue.nlu.compose.clauses.candidates import Special
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.nominal import propose
from xavi_dialogue.nlu.compose.clauses.sem import Noun, as_thing
from xavi_dialogue.nlu.compose.verbs.others import expected_of
from xavi_dialogue.nlu.compose.wh_questions.lasting import measured
from xavi_dialogue.nlu.compose.wh_questions.savings import change_to


def reasoned(clause: Clause, value: Special) -> Question | None:
    """Ask what was considered, believed, decisive, preventive."""
    name, subject, time = value.name, value.subject, clause.time
    match name:
        case "consider" | "score":
            return Listing("options", time=time)
        case "know" | "believe" | "conclude":
            about = getattr(value.content, "event", None)
            thing = about.actor if about is not None else expected_of(value)
            if about is not None and isinstance(time, Unsaid):
                time = about.time  # "what did you expect it to do then"
            if isinstance(time, Unsaid) and thing is not None and clause.tense == "past":
                time = Back()  # what was expected when that was done of which was spoken
            return Listing("beliefs", None if isinstance(thing, Ego) else thing, time)
        case "matter" | "influence" | "depend":
            return WhatWouldChange(None, most=True)
        case "decide" | "choose":
            return Listing("decisions", time=time)
        case "cost" if isinstance(by := value.match.phrases.get("by"), Event):
            return measured("delay", clause, Ego(), event=by)  # "what did we lose by waiting?"
        case "save" if isinstance(by := value.match.phrases.get("by"), Event):
            return Why(as_of(Happens(by), value.clause.tense))
        case "achieve":
            by = value.match.phrases.get("by")
            return Why(as_of(Happens(by), clause.tense) if isinstance(by, Event) else That())
        case "change" if value.content is None and clause.modal is None:
            return Changed(time)
        case "require" | "change" | "need":
            return WhatWouldChange(value.content)
        case "prevent" if (denied := value.content or _against(value)) is not None:
            if clause.modal in ("would", "could"):
                return HowAvoid(denied)
            return Why(Not(denied))
        case "take-time" if clause.infinitive is not None and clause.modal == "would":
            return WhatWouldChange(value.content)
        case "make-know":
            return HowKnow(value.content)
        case "prevent" | "help" | "improve":
            return HowAvoid(value.content or propose(value.object))
        case "tell" | "say" | "report":
            if value.content is None and isinstance(clause.subject, Feature):
                if clause.subject.kind == "light":
                    return None  # "what is that light showing?"
                return measured("writing", clause, clause.subject)  # "what does the sign say?"
            if value.content is None and _shows_scene(clause.subject):
                return Listing("vehicles", time=time)  # "what is your screen showing?"
            return HowKnow(value.content)
        case "cost" | "take-time" if isinstance(subject, (Pronoun, Event)):
            return measured("delay", clause, as_thing(subject))
    return None


def decisive(clause: Clause) -> WhatWouldChange | None:
    """Ask what mattered most: "which vehicles were relevant to that decision?"."""
    if not any(key == "important" for key, _ in clause.adjectives) or clause.comparisons:
        return None
    named = (phrase.sem for phrase in clause.complements if phrase.key in ("for", "into"))
    return WhatWouldChange(next((propose(sem) for sem in named), None), most=True)


def _shows_scene(subject: object) -> bool:
    """Say whether somebody looks at our screen or sensors, which show who is in view."""
    named = isinstance(subject, Noun) and subject.key == "capability"
    return named or isinstance(subject, Record)


def _against(value: Special) -> Proposition | None:
    """Find against what something speaks: "what spoke against overtaking", "the left lane"."""
    deed = value.match.phrases.get("with")
    if isinstance(lane := as_thing(deed), Lane):
        deed = change_to(lane, value.clause.tense)
    return None if deed is None else as_of(propose(deed) or That(), value.clause.tense)
