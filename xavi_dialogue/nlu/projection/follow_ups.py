"""Acts and follow-ups as query fields, resolved against the question before."""

from collections.abc import Sequence

from msgspec.structs import replace

from xavi_dialogue.domain.meaning import (
    Act,
    Ask,
    AskHelp,
    Beyond,
    Claim,
    Elliptic,
    Feel,
    Identify,
    Quizzing,
    Repair,
    Request,
    Social,
    Whether,
)
from xavi_dialogue.domain.rewriting import parts
from xavi_dialogue.domain.terms import (
    Ago,
    Compares,
    Event,
    Is,
    Next,
    Not,
    Now,
    Pronoun,
    Proposition,
    Start,
    That,
)
from xavi_dialogue.nlu.projection.fields import (
    TALK,
    FieldActions,
    FieldTense,
    QueryFields,
    QueryType,
)
from xavi_dialogue.nlu.projection.polar import declined
from xavi_dialogue.nlu.projection.propositions import subject, tense
from xavi_dialogue.nlu.projection.questions import question_fields
from xavi_dialogue.nlu.projection.terms import (
    actions_of,
    actor_of,
    event_actions,
    events_of,
    is_beyond,
)

AMBIGUOUS = QueryFields(type="ambiguous")
_WEIGHTS: tuple[type, ...] = (
    *(Ask, Elliptic, Claim, Request, Beyond, AskHelp, Repair, Feel, Quizzing, Social),
)
_TENSES: dict[type, FieldTense] = {Now: "present", Ago: "past", Start: "past", Next: "future"}
_FORMS: dict[str, QueryType] = {
    "why": "why",
    "why-not": "why_not",
    "what-if": "what_if",
    "when": "when",
    "until": "when",
    "how-much": "what",
    "where": "where_goal",
    "how": "how",
    "sure": "confidence",
    "which": "what",
}


def project(acts: Sequence[Act], previous: QueryFields | None = None) -> QueryFields:
    """Project the act that an utterance is for onto the query fields.

    Args:
        acts: what is meant, grounded or as read.
        previous: the question before, for follow-ups that are not completed yet.
    """
    if not acts:
        return AMBIGUOUS
    main = min(acts, key=lambda act: _WEIGHTS.index(type(act)))
    told = [found for act in acts if isinstance(act, Claim)
            and (found := _act(act, previous)).type not in TALK]  # fmt: skip
    if isinstance(main, Claim) and told:
        return told[-1]
    if isinstance(main, Elliptic | Repair) and told and main is acts[-1]:
        previous = told[-1]
    found = _act(main, previous)
    asked = sum(isinstance(act, Ask) for act in acts)
    return replace(found, compound=True) if asked > 1 else found


def _act(act: Act, previous: QueryFields | None) -> QueryFields:
    match act:
        case Ask(question=question):
            return _resolved(act, question_fields(question), previous)
        case Elliptic():
            return _completed(act, previous)
        case Repair():
            return _repaired(act, previous)
        case Claim(that=that):
            return _resolved(act, _claimed(that), previous)
        case Request(event=event):
            beyond = is_beyond(event)
            return declined("not-an-action" if beyond else "command")
        case Beyond(topic=topic):
            return declined(topic)
        case Social(kind="insult"):
            return declined("abuse")
        case AskHelp():
            return QueryFields(type="help", tense="present")
        case Social() | Quizzing():
            return QueryFields(type="smalltalk", tense="present")
        case Feel():
            return AMBIGUOUS


def _claimed(that: Proposition) -> QueryFields:
    """Project a statement by what it wants to know: of what might have been done, why not."""
    events = tuple(events_of(that))
    actions, actor = actions_of(that), actor_of(subject(that))
    if isinstance(that, Is):
        return AMBIGUOUS
    if isinstance(that, Compares):
        return question_fields(Whether(that))
    if not actions or not events:
        return AMBIGUOUS
    if isinstance(that, Not) or events[0].modal in ("could", "should", "would", "might"):
        kind: QueryType = "why_not"
        return QueryFields(type=kind, actor=actor, counterfactual=actions, tense=tense(that))
    return QueryFields(type="what", actor=actor, factual=actions, tense=tense(that))


def _resolved(act: Ask | Claim, found: QueryFields, previous: QueryFields | None) -> QueryFields:
    """Complete a whole question that leans on the one before by "it", "that" or silence."""
    if previous is None or previous.type in TALK:
        return found
    own = previous.actor == "ego" and found.actor in ("vehicle:it", "vehicle:that")
    if own and found.type in ("when", "compare"):
        found = replace(found, actor="ego")  # "it" is what we did
    if own and isinstance(act, Ask) and isinstance(act.question, Identify):
        return replace(found, actor="vehicle:unknown", refers_to_previous=True)
    leans = any(True for _ in parts(act, That)) or any(
        one.form in ("it", "that", "he", "she", "they", "one") for one in parts(act, Pronoun)
    )
    if found.actor in ("vehicle:it", "vehicle:that") and previous.actor != "ego":
        found = replace(found, actor=previous.actor, refers_to_previous=True)
    if leans:
        found = replace(found, refers_to_previous=True)
    bare = found.factual is None and found.counterfactual is None
    spoken_of = any(event.action == "do" for event in parts(act, Event)) or leans
    if not bare or not (spoken_of or _is_bare(found)):
        return found
    return _of_previous(found.type, previous, found)


def _is_bare(found: QueryFields) -> bool:
    return found.type in ("confidence", "sensitivity", "how", "compare") and found.actor == "ego"


def _of_previous(
    kind: QueryType, previous: QueryFields, found: QueryFields | None = None
) -> QueryFields:
    """Ask another type of question about what was spoken of."""
    factual, counterfactual = previous.factual, previous.counterfactual
    actor = previous.actor
    if found is not None and found.actor not in ("ego", actor):
        actor = found.actor
    if kind == "why_not":
        factual, counterfactual = None, counterfactual or factual
    return replace(
        previous,
        type=kind,
        actor=actor,
        factual=factual,
        counterfactual=counterfactual,
        negated=previous.negated if kind == "what_if" else False,
        detail=None,
        refers_to_previous=True,
        intervention=previous.intervention if kind == "what_if" else None,
    )


def _completed(act: Elliptic, previous: QueryFields | None) -> QueryFields:
    """Complete a fragment from the question before."""
    if previous is None or previous.type in TALK:
        return _alone(act)
    kind = previous.type if act.form == "same" else _FORMS[act.form]
    found = _of_previous(kind, previous)
    besides = previous.type == "why_not" and act.thing is not None  # "nor vehicle 5?"
    if act.negated and act.form in ("same", "what-if") and not besides:
        return replace(_denied(found), tense=previous.tense)
    if act.besides and act.thing is None and act.event is None:
        return replace(found, detail="more")
    if act.form == "which":
        actor = actor_of(act.thing) if act.thing is not None else "vehicle:unknown"
        actor = "vehicle:unknown" if actor == "vehicle:that" else actor
        return QueryFields(type="what", actor=actor, tense=previous.tense)
    found = replace(found, tense=_TENSES.get(type(act.time), found.tense))
    leans = isinstance(act.thing, Pronoun) and previous.actor != "ego"
    if act.thing is not None and not leans:
        found = replace(found, actor=actor_of(act.thing))
    if act.event is not None:
        found = _with_actions(found, event_actions(act.event), previous)
    return found


def _denied(found: QueryFields) -> QueryFields:
    actions = found.counterfactual or found.factual
    return replace(found, type="what_if", factual=None, counterfactual=actions, negated=True)


def _with_actions(
    found: QueryFields, actions: FieldActions | None, previous: QueryFields
) -> QueryFields:
    match found.type:
        case "what_if":
            return replace(found, factual=None, counterfactual=actions, negated=False)
        case "why_not":
            said = previous.factual if previous.type == "why" else None
            return replace(found, factual=said, counterfactual=actions)
        case "compare":
            return replace(found, counterfactual=actions)
    return replace(found, factual=actions)


def _alone(act: Elliptic) -> QueryFields:
    """Project a fragment that nothing goes before."""
    actions = event_actions(act.event)
    actor = actor_of(act.thing if act.event is None else act.event.actor)
    match act.form:
        case "why" if actions:
            return QueryFields(type="why", actor=actor, factual=actions)
        case "why-not" if actions:
            return QueryFields(type="why_not", actor=actor, counterfactual=actions)
        case "what-if" if actions:
            negated = act.negated
            return QueryFields(type="what_if", actor=actor, counterfactual=actions, negated=negated)
    return AMBIGUOUS


def _repaired(act: Repair, previous: QueryFields | None) -> QueryFields:
    if act.question is not None:
        return replace(question_fields(act.question), refers_to_previous=True)
    if act.kind in ("cancel", "yes", "no", "repeat", "continue") and act.thing is None:
        return QueryFields(type="smalltalk", tense="present", refers_to_previous=True)
    if previous is None or previous.type in TALK:
        return AMBIGUOUS
    if act.thing is not None:
        return replace(previous, actor=actor_of(act.thing), refers_to_previous=True)
    match act.kind:
        case "why":
            return _of_previous("why", previous)
        case "longer" | "simpler":
            return replace(previous, detail="more", refers_to_previous=True)
        case "shorter":
            return replace(previous, detail="less", refers_to_previous=True)
    return AMBIGUOUS
