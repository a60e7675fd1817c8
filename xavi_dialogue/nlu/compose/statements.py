"""Statements: a declarative clause becomes a claim, a question, a request or a feeling."""

from typing import Any, cast

from msgspec.structs import replace

from xavi_dialogue.domain.meaning import (
    Act,
    Ask,
    Claim,
    Fault,
    Feel,
    HowSure,
    Question,
    Repair,
    Social,
    Whether,
    Why,
)
from xavi_dialogue.domain.terms import (
    Believed,
    Compares,
    Described,
    Ego,
    Event,
    Everyone,
    Exists,
    Happens,
    Is,
    Lane,
    Measured,
    Nobody,
    Not,
    Passenger,
    Pronoun,
    Proposition,
    Related,
    That,
    Unknown,
    Vehicle,
)
from xavi_dialogue.domain.vocabulary import ActionName, Manner
from xavi_dialogue.nlu.compose.alternatives.polar import judged
from xavi_dialogue.nlu.compose.clauses.candidates import Special
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.peaks import extreme_told
from xavi_dialogue.nlu.compose.clauses.sem import Measure, Noun, as_thing
from xavi_dialogue.nlu.compose.clauses.tree import leaf_of, words_of
from xavi_dialogue.nlu.compose.orders import Orders, wavers
from xavi_dialogue.nlu.compose.propositions.phrases import Phrases
from xavi_dialogue.nlu.compose.propositions.propositions import Propositions
from xavi_dialogue.nlu.compose.propositions.tally import counts, tallied
from xavi_dialogue.nlu.compose.questions import Questions
from xavi_dialogue.nlu.compose.refining.sounds import heard
from xavi_dialogue.nlu.compose.refining.told import refined_claim, refined_whether
from xavi_dialogue.nlu.compose.states.states import ungoverned
from xavi_dialogue.nlu.compose.talk import and_you, bodily, feeling_of
from xavi_dialogue.nlu.compose.verbs.pointed import pointed
from xavi_dialogue.nlu.compose.wh_questions.wh import fact
from xavi_dialogue.nlu.compose.wishes import wished
from xavi_dialogue.nlu.grammar.chart import Node
from xavi_dialogue.nlu.grammar.lexicon import Leaf

Acts = tuple[Act, ...]
Found = list[tuple[Acts, float]]
UNFELT = 0.3  # of a manner that a feeling leaves out: "I am scared, slow down"
UNLIKE = 0.6  # cost of a subject and a verb of different number
STATED = 0.15  # of a statement taken for a question
#: What is felt of how something was done, and asks for nothing.
_UPSET = ("happy", "annoyed", "angry", "sad", "impressed", "relieved")
_GROUNDLESS = ("for no reason", "for no good reason", "for nothing", "without reason",
               "without any reason", "without a reason", "needlessly", "unnecessarily")  # fmt: skip


class Statements:
    """Reads statements."""

    asks: bool
    propositions: Propositions
    questions: Questions
    phrases: Phrases
    orders: Orders

    def _declarative(self, unit: Node) -> Found:
        clause = self.phrases.slots.fill(unit.parts)
        meant = self._meant(clause) or bodily(clause)
        if meant is not None:
            return [((meant,), 0.0)]
        if "semi-mind" in clause.aux and not isinstance(clause.subject, Ego):
            return [((Social("acknowledge"),), 0.0)]  # "I do not mind waiting"
        sore = clause.feelings[:1] if clause.verb is None and clause.question is not None else []
        if sore and sore[0] in _UPSET and isinstance(clause.subject, Passenger):
            felt = feeling_of(clause, None)
            return [((felt,), 0.0)] if felt is not None else []
        if (peak := extreme_told(clause)) is not None:
            return [((Ask(peak),), 0.0)]
        if (deed := pointed(clause, self.propositions.plain)) is not None:
            return [((deed,), 0.0)]
        order = self.orders.stated(clause)
        if order is not None:
            return [(order, 0.0)]
        if isinstance(clause.subject, Ego) and any(
            key in ("rude", "opinion") for key, _ in clause.adjectives
        ):
            return [((Social("insult"),), 0.0)]
        opinion = any(key == "opinion" for key, _ in clause.adjectives)
        kind = any(key == "kind" for key, _ in clause.adjectives)
        opinion = opinion or (kind and (clause.negated or self.asks or _tagged(unit)))
        if any(key == "fun" for key, _ in clause.adjectives) and clause.verb is None:
            return [((Feel("disliking" if clause.negated else "liking"),), 0.0)]
        if kind and not opinion and clause.verb is None:
            return [((Feel("liking"),), 0.0)]
        if opinion and not isinstance(clause.subject, Ego):
            return [((Ask(Fault(That(), judged(clause))),), 0.0)]
        candidates = self.propositions.readings(clause)
        asking = _asking(unit)
        tagged = asking not in ("", "wishing") or _tagged(unit)
        if (tagged or self.asks or not candidates) and not clause.feelings:
            compared = self.questions.comparison(clause)
            if compared is not None:
                return [((Ask(self.questions.framed(compared, clause, None)),), STATED)]
        found: Found = []
        for candidate in candidates:
            acts = self._stated(clause, candidate.value, tagged, unit)
            acts = tuple(_asked(act, asking) for act in acts)
            cost = candidate.cost + (UNLIKE if _disagrees(clause) else 0.0)
            found.append((acts, cost + _unfelt(acts, clause)))
        others = isinstance(clause.subject, Described) or clause.subject == Pronoun("he")
        if not candidates and clause.feelings and not others:
            feeling = feeling_of(clause, None)
            if feeling is not None:
                cost = ungoverned(clause) + _unfelt((feeling,), clause)
                found.append(((feeling,), cost))
        return found

    def _meant(self, clause: Clause) -> Act | None:
        """Read "I meant the red one", "I was asking about vehicle 3"."""
        if clause.verb is None or not isinstance(clause.subject, Passenger):
            return None
        if clause.verb.key not in ("mean", "ask", "talk", "refer", "speak"):
            return None
        sems = [p.sem for p in clause.complements] + [sem for sem, _ in clause.objects]
        thing = next((t for sem in sems if (t := as_thing(sem)) is not None), None)
        return Repair("meant", thing) if thing is not None and thing != Ego() else None

    def _stated(self, clause: Clause, value: Any, tagged: bool, unit: Node) -> Acts:
        unit_words, wishing = words_of(unit), _asking(unit) == "wishing"
        feeling = feeling_of(clause, value)
        if feeling is not None:
            return (feeling, *and_you(unit)) if tagged else (feeling,)
        asked = self._embedded(clause, value) or heard(clause, value)
        if asked:
            return asked
        if wavers(clause, value):
            return (Ask(Why(Happens(Event("change-plan", tense="perfect")))),)
        counted = counts(clause)
        of = counted or tallied(clause, self.propositions.joined(clause, fact(value)))
        if (why := groundless(unit_words, of)) is not None:
            return (Ask(why),)
        if isinstance(value, Special) and isinstance(clause.subject, Passenger) and _thinks(value):
            of = Not(value.content) if value.content is not None else of
        if isinstance(of, Believed) and isinstance(clause.subject, Unknown | Noun):
            told = clause.modal is None and clause.tense == "present"
            of = of.content  # "my wife thinks you are too slow"
            if not told and not (tagged or self.asks):
                return (Social("acknowledge"),)  # "my husband would have said they never look"
        of = _in_our_place(of, clause)
        asking = (tagged or self.asks) and not wishing  # "I wish you slowed down, could you?"
        wish = None if asking else wished(of, clause, wishing=wishing)
        if wish is not None:
            return (wish,)
        if clause.there and clause.inner is not None and _is_needless(of):
            return (Ask(Why(Happens(replace(clause.inner, tense=cast(Any, clause.tense))))),)
        if isinstance(value, Special) and isinstance(clause.subject, Passenger):
            expected = self._expected(value)
            if expected is not None:
                return (Ask(expected),)
        if tagged and clause.there and (deed := _expected_of(of, unit)) is not None:
            return (Ask(Whether(deed)),)
        anybody = unit_words.startswith("any") and clause.modal is None  # "anyone else coming"
        if tagged or self.asks or anybody:
            question = refined_whether(clause, self.questions.polar(clause, value, tag=True))
            match question:
                case Whether(that=Is(state="stationary") as still) if "not moving" in unit_words:
                    question = Whether(Not(replace(still, state="moving")), True)
            if isinstance(value, Special) and isinstance(of, Believed):
                question = Whether(of, True)
            return (Ask(self.questions.framed(question, clause, value)),)
        if clause.because is not None and isinstance(of, Happens):
            return (Ask(self.questions.polar(clause, value, tag=False)),)
        if isinstance(of, Related) and of.thing == Passenger() and of.relation == "with":
            return (Social("acknowledge"),)
        supposed = self.questions.supposition(clause)
        if supposed is not None:
            return (Ask(self.questions.framed(Whether(of, True), clause, value)),)
        if isinstance(of, Not) and isinstance(of.content, Is) and of.content.state == "comfortable":
            return (Claim(replace(of.content, state="uncomfortable")),)
        return (refined_claim(Claim(of, _disputes(of, clause))),)

    def _expected(self, value: Special) -> Question | None:
        """Take "I expected you to stop" for the question why not."""
        if value.name in ("believe", "wish", "want") and value.content is not None:
            content = value.content
            if _thinks(value):
                return None
            if value.clause.negated:
                return Why(content)
            return Why(content.content if isinstance(content, Not) else Not(content))
        return None

    def _embedded(self, clause: Clause, value: Any) -> Acts:
        """Find the question behind "I wonder", "I do not understand", "do you know"."""
        if not isinstance(value, Special) or clause.question is None:
            return ()
        return self.orders.embedded(clause)


def _disagrees(clause: Clause) -> bool:
    """Say whether a bare verb stands with one thing: "reason for lane change", "v1 speed"."""
    if clause.verb is None or clause.verb.form != "base" or clause.aux:
        return False
    named = clause.verb.words == ("speed",) and isinstance(clause.subject, (Vehicle, Event))
    return named or isinstance(clause.subject, (Lane, Measure, Noun, Unknown))


_ASKING = ("asking", "likely", "agreeing", "wishing")


def _asking(unit: Node) -> str:
    """Tell how words such as "I wonder if", "what are the odds" ask what follows."""
    leads = (p for p in unit.parts if isinstance(p, Leaf) and p.category == "HEDGE")
    return next((leaf.key for leaf in leads if leaf.key in _ASKING), "")


def _asked(act: Act, asking: str) -> Act:
    """Put a statement to the question that the words before it ask."""
    match act:
        case Ask(question=Whether(that=that)) if asking == "likely":
            return Ask(HowSure(that))
        case Ask(question=Whether(that=that, tag=True)) if asking == "asking":
            return Ask(Whether(that))
    return act


def _tagged(unit: Node) -> bool:
    for part in unit.parts:
        if isinstance(part, Node) and part.name == "tail":
            if leaf_of(part, "TAGWORD") or any(isinstance(p, Node) for p in part.parts):
                return True
            if leaf_of(part, "NOT"):
                return True
    return False


def _expected_of(of: Proposition, unit: Node) -> Proposition | None:
    """Read "there is a car that looks as if it will cut in. Will it?" as whether it will."""
    tails = (part for part in unit.parts if isinstance(part, Node) and part.name == "tail")
    if not any({"will", "would"} & {*words_of(tail).split()} for tail in tails):
        return None
    match of:
        case Exists(thing=Described(such=Believed(content=Happens(event=event))) as thing):
            whole = replace(thing, such=None, definite=True)
        case Exists(thing=Described(doing=Event() as event) as thing):
            whole = replace(thing, doing=None, definite=True)
        case _:
            return None
    return Happens(replace(event, actor=whole, tense="future", modal=None))


def _is_needless(of: Proposition) -> bool:
    """Check whether a deed is said to have no need or point, and not of room for it."""
    inner = of.content if isinstance(of, Not) else of
    return isinstance(of, Not | Is) and not (isinstance(inner, Is) and inner.state == "roomy")


def disputed(question: Question, words: str) -> Question:
    """Ask "are we stopping for no reason?" why we do."""
    if not isinstance(question, Whether):
        return question
    return groundless(words, question.that) or question


def groundless(words: str, of: Proposition) -> Question | None:
    """Take "you braked for nothing" for the question why: what it disputes is the reason."""
    if not any(phrase in words for phrase in _GROUNDLESS) or not isinstance(of, Happens):
        return None
    event = of.event
    return Why(Happens(replace(event, object=None) if event.object == Nobody() else event))


def _thinks(value: Special) -> bool:
    """Say whether it is "I do not think that ...": the contrary is claimed."""
    verb = "" if value.clause.verb is None else value.clause.verb.key
    return value.clause.negated and verb in ("think", "believe", "suppose", "reckon")


def _in_our_place(of: Proposition, clause: Clause) -> Proposition:
    """Take what "any driver would have done" for what we should have."""
    advised = {"modal-might", "semi-want"} <= {*clause.aux}
    match of:
        case Not(content=content):
            return Not(_in_our_place(content, clause))
        case Happens(event=Event(actor=Ego(), modal="might") as event) if advised:
            return Happens(replace(event, modal="should"))  # "you might want to slow down"
        case Related("on", Ego(), Lane("left" | "right" as side)) if clause.modal == "should":
            moving: ActionName = "change-left" if side == "left" else "change-right"
            return Happens(Event(moving, tense="present", modal="should"))
        case Happens(event=Event(modal="would", tense="past") as event) if (
            clause.subject == Passenger() and isinstance(event.actor, Ego | Passenger)
        ):  # "I would not have gone there"
            return Happens(replace(event, actor=Ego(), modal="should"))
        case Compares(left=Measured(attribute="speed", thing=driver), comparator=more) if (
            driver == Described(definite=False) and clause.modal == "would"
        ):
            paces: tuple[Manner, ...] = ("slowly",) if more == "less" else ("fast",)
            return Happens(Event("move", Ego(), None, None, paces, tense="past", modal="should"))
        case Happens(event=Event(actor=actor, modal="would", tense="past") as event) if (
            actor == Described(definite=False) or isinstance(actor, Everyone)
        ):
            return Happens(replace(event, actor=Ego(), modal="should"))
        case Happens(event=Event(actor=Nobody(), modal="would", tense="past") as event):
            return Not(Happens(replace(event, actor=Ego(), modal="should")))
    return of


def _disputes(of: Proposition, clause: Clause) -> bool:
    """Say whether a claim disputes what the car said: "that is wrong", "you could have known"."""
    match of:
        case Not() | Believed():
            return True
        case Happens(event=Event(actor=Ego(), modal=modal)) if modal in ("could", "should"):
            return True
    state = getattr(of, "state", "")
    return state in ("wrong", "dangerous")


def _unfelt(acts: Acts, clause: Clause) -> float:
    """Return the cost of a manner beside a feeling: nobody is scared slowly."""
    return UNFELT if clause.manner and any(isinstance(act, Feel) for act in acts) else 0.0
