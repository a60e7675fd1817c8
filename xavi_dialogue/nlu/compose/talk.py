"""Talk: acts that need no clause, and statements of how the passenger feels."""

from typing import Any, cast

from xavi_dialogue.domain.meaning import (
    Act,
    Ask,
    AskHelp,
    Beyond,
    Claim,
    Elliptic,
    Feel,
    HowSure,
    Listing,
    Quizzing,
    Repair,
    Social,
    Whether,
)
from xavi_dialogue.domain.terms import (
    Back,
    Described,
    Ego,
    Event,
    Everyone,
    Happens,
    Is,
    Not,
    Passenger,
    Pronoun,
    Proposition,
    Related,
    That,
    Thing,
    Vehicle,
)
from xavi_dialogue.domain.vocabulary import FeelingKind
from xavi_dialogue.nlu.compose.clauses.candidates import Special
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.sem import Noun, Sem, as_thing
from xavi_dialogue.nlu.compose.clauses.tree import leaves_of
from xavi_dialogue.nlu.grammar.chart import Node
from xavi_dialogue.nlu.grammar.lexicon import Leaf

_FEELINGS = {
    "startle": "startled",
    "like": "liking",
    "dislike": "disliking",
    "trust": "distrustful",
    "fear": "afraid",
    "mind": "disliking",
}


_BODY: dict[str, FeelingKind] = {"heart": "startled", "body": "sick", "spill": "startled"}
_PRAISING = frozenset(
    {"clever", "good", "lovely", "brilliant", "genius", "star", "hero", "angel", "wonderful",
     "beauty", "darling", "great", "smart", "dear", "sweet"}
)  # fmt: skip
_STIRRING = frozenset(
    {"frighten", "scare", "startle", "worry", "bother", "unsettle", "alarm", "annoy", "irritate",
     "upset", "bore"}
)  # fmt: skip
_HINDERING = frozenset({"bother"})
_SAYING = frozenset({"ask", "say", "use", "talk", "speak", "phrase"})


def says(clause: Clause) -> bool:
    """Say whether it is asked what the passenger may say: "how do I ask", "can I ask about"."""
    named = clause.verb is not None and clause.verb.key in _SAYING
    return named and isinstance(clause.subject, Passenger) and clause.tense != "past"


def talk_act(leaf: Leaf) -> Act | None:
    """Read a social move, a repair, a wish for help or a quiz."""
    match leaf.category:
        case "TALK":
            return Social(cast(Any, leaf.key))
        case "REPAIR" if leaf.key == "onward":
            return Elliptic(time=Back("after"))
        case "REPAIR" if leaf.key == "besides":
            return Elliptic(besides=True)
        case "REPAIR":
            return Repair(cast(Any, leaf.key))
        case "HELP":
            return AskHelp()
        case "QUIZ":
            return Quizzing(stop=leaf.key == "stop")
        case "OFFTOPIC":
            return Beyond(cast(Any, leaf.key), " ".join(leaf.words))
        case "YES":
            return Social("agree")
        case "NO":
            return Social("disagree")
        case "HEDGE" if leaf.key == "likely":
            return Ask(HowSure())
    return None


def called(node: Node) -> list[tuple[tuple[Act, ...], float]]:
    """Read "you useless lump of metal", "you clever car": what we are called."""
    leaves = list(leaves_of(node))
    if len(leaves) < 2:
        return []
    words = {word for leaf in leaves for word in leaf.words}
    good = any(leaf.key in ("safe", "kind", "comfortable") for leaf in leaves)
    kind: Any = "praise" if good or not words.isdisjoint(_PRAISING) else "insult"
    return [((Social(kind),), 0.0)]


def bodily(clause: Clause) -> Act | None:
    """Read "my heart is pounding", "I felt that in my tummy", "my coffee!" as a feeling."""
    sems = [clause.subject, *(sem for sem, _ in clause.objects)]
    sems += [phrase.sem for phrase in clause.complements]
    kinds = [sem.key for sem in sems if isinstance(sem, Noun) and sem.key in _BODY]
    if kinds and clause.negated and clause.modal is not None:
        return Social("acknowledge")  # "I can't turn my neck round": no complaint
    return Feel(_BODY[kinds[0]]) if kinds else None


def feeling_of(clause: Clause, value: Any) -> Act | None:
    """Read "I am nervous", "that scared me", "I don't like it when you go so fast"."""
    subject = clause.subject
    if clause.feelings and isinstance(subject, (Passenger, Ego)) and _own(clause):
        hurried = clause.feelings[0] == "impatient"
        if clause.feelings[0] == "patient" or (clause.negated and hurried):
            return Social("acknowledge")
        if clause.negated:
            return Feel(cast(Any, _opposite(clause.feelings[0])), _about(clause))
        return Feel(cast(Any, clause.feelings[0]), _about(clause))
    if not isinstance(value, Special):
        return None
    return _special_feeling(clause, value)


def _own(clause: Clause) -> bool:
    """Say whether it is the passenger who feels: "we are nervous", and not "you are"."""
    return isinstance(clause.subject, Passenger) or "us" in clause.focus or clause.verb is None


def _opposite(feeling: str) -> str:
    return {"happy": "annoyed", "afraid": "relieved", "nervous": "relieved"}.get(feeling, feeling)


def _special_feeling(clause: Clause, value: Special) -> Act | None:
    name = value.name
    if name in ("startle", "collide-hurt") or name.startswith("feel:"):
        sufferer = value.object
        feeling = name.removeprefix("feel:") if ":" in name else "startled"
        if isinstance(clause.subject, Passenger):
            return Feel(cast(Any, feeling), _about(clause))
        if sufferer is None or isinstance(sufferer, (Passenger, Ego)):
            return Feel(cast(Any, feeling), as_thing(clause.subject))
        return None
    if name in ("make-feel", "feel-adj", "get", "become", "startle") and clause.feelings:
        passenger = isinstance(clause.subject, Passenger) or isinstance(
            value.object, (Passenger, Ego)
        )
        if passenger:
            about = None if isinstance(clause.subject, Passenger) else as_thing(clause.subject)
            return Feel(cast(Any, clause.feelings[0]), about)
        return None
    if name == "make-do" and isinstance(value.content, Is | Not):
        return _made_feel(value.content)
    everything = isinstance(clause.subject, Everyone | Noun | Event)
    if name == "feel-adj" and (everything or isinstance(clause.subject, (Passenger, Pronoun))):
        state = clause.adjectives[0][0] if clause.adjectives else ""
        if state == "slow" and not (clause.negated or isinstance(clause.subject, Passenger)):
            return Claim(Is("slow", Ego(), tense=cast(Any, clause.tense)))  # "it feels slow"
        feeling = {"safe": "relieved", "dangerous": "afraid", "comfortable": "happy",
                   "uncomfortable": "nervous", "fast": "nervous"}.get(state, "nervous")  # fmt: skip
        if clause.comparisons and clause.comparisons[0][0] in ("better", "safe", "good"):
            feeling = "relieved"  # "I feel better"
        if clause.negated:
            feeling = "nervous"
        quick = state == "fast" and not clause.negated
        return Feel(cast(Any, feeling), Is("fast", Ego()) if quick else None)
    if name in _FEELINGS and isinstance(clause.subject, Passenger):
        feeling = _FEELINGS[name]
        if name == "like":
            feeling = "disliking" if clause.negated else "liking"
        if name == "trust" and not clause.negated:
            feeling = "liking"
        if clause.modal == "would" or (name == "mind" and clause.negated):
            return None
        return Feel(cast(Any, feeling), _object(clause, value))
    return None


def _made_feel(content: Proposition) -> Act | None:
    """Read "that makes me feel better": what was said does the passenger good."""
    inner = content.content if isinstance(content, Not) else content
    if not isinstance(inner, Is) or inner.thing != Passenger():
        return None
    return Feel("nervous" if isinstance(content, Not) else "relieved")


def _object(clause: Clause, value: Special) -> Proposition | Thing | None:
    time = clause.time
    anchor = getattr(time, "anchor", None)
    if isinstance(anchor, Event):
        return Happens(anchor)
    if value.content is not None:
        return value.content
    sem: Sem | None = value.object
    if isinstance(sem, Event):
        return Happens(sem)
    return as_thing(sem)


def and_you(unit: Node) -> tuple[Act, ...]:
    """Read the tail of "I was scared, weren't you?": whether the car was, too."""
    tails = [part for part in unit.parts if isinstance(part, Node) and part.name == "tail"]
    named = any(leaf.category == "YOU" for tail in tails for leaf in leaves_of(tail))
    return (Social("feelings", That()),) if named else ()


def stirred(unit: Node, clause: Clause, *, liked: bool) -> Social | Ask | None:
    """Read "were you scared of him", "did that not frighten you", "do you like driving".

    Args:
        unit: what was asked.
        clause: the same.
        liked: it is asked what the car likes.
    """
    if not any(leaf.category == "YOU" for leaf in leaves_of(unit)):
        return None
    verb = clause.verb
    if isinstance(clause.subject, Ego) and clause.because is None:
        if verb is not None and verb.key == "panic":
            return Social("feelings", That())
        if liked and clause.that is None and not clause.complements:
            return Social("feelings")
        if clause.feelings and not clause.objects:  # "let her cross" is no anger
            about = None if clause.that is not None else _about(clause)
            if "surprised" in clause.feelings and (foreseen := _unforeseen(clause, about)):
                return foreseen
            over = clause.tense in ("past", "perfect") and verb is None and about is None
            return Social("feelings", That() if over else about)
    shaken = verb is not None and verb.key in _STIRRING
    if not shaken or not any(isinstance(sem, Ego) for sem, _ in clause.objects):
        return None
    thing = as_thing(clause.subject)
    if isinstance(thing, Described | Vehicle) and verb is not None and verb.key in _HINDERING:
        held = Related("in-the-way-of", thing, Ego(), clause.time, cast(Any, clause.tense))
        return Ask(Whether(held))
    return Social("feelings", That() if thing is None or isinstance(thing, Pronoun) else thing)


def _unforeseen(clause: Clause, about: object) -> Ask | None:
    """Read "were you surprised by him" as whether we were wrong about whom is named."""
    if not isinstance(about, Described | Vehicle) and about not in _SOMEBODY:
        return None
    if about == Described(definite=False):
        return Ask(Listing("wrong-predictions", time=clause.time))  # "by anything"
    return Ask(Whether(Is("wrong", cast(Any, about), time=clause.time, tense="past")))


_SOMEBODY = (Pronoun("he"), Pronoun("she"), Pronoun("they"))


def _about(clause: Clause) -> Proposition | Thing | None:
    anchor = getattr(clause.time, "anchor", None)
    if isinstance(anchor, Event):
        return Happens(anchor)
    for phrase in clause.complements:
        if phrase.key in ("about", "of", "by", "at", "with"):
            thing = phrase.sem
            return Happens(thing) if isinstance(thing, Event) else as_thing(thing)
    if clause.that is not None:
        return That()
    return None


def missed(clause: Clause) -> bool:
    """Check whether a clause asks what the passenger missed."""
    return clause.verb is not None and clause.verb.key == "miss" and clause.subject == Passenger()
