"""Acts: the replies to each act of a turn, and to all of them together. Pure."""

from dataclasses import dataclass, replace
from typing import Literal, TypeAlias

from msgspec.structs import replace as changed

from xavi_dialogue.dialogue.chain import BOTTOM
from xavi_dialogue.dialogue.claims import NOTED, is_ground, kept, told
from xavi_dialogue.dialogue.objections import foreseen_then
from xavi_dialogue.dialogue.pipeline import Said, Situation, speak
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.dialogue.severally import listed, severally, whys
from xavi_dialogue.dialogue.soundness import is_told_within, says_something
from xavi_dialogue.dialogue.state.state import Understood
from xavi_dialogue.dialogue.state.turn import Part, Turn
from xavi_dialogue.domain.answers import (
    Acknowledged,
    Again,
    Answer,
    CannotSay,
    Comforting,
    Happenings,
    Helpful,
    Judged,
    NeedRollout,
    NotUnderstood,
    Refusal,
    Sociable,
    Unfamiliar,
)
from xavi_dialogue.domain.discourse import GroundedAct
from xavi_dialogue.domain.meaning import (
    Ask,
    AskHelp,
    Beyond,
    Claim,
    Elliptic,
    Feel,
    Quizzing,
    Repair,
    Request,
    Social,
)

Result: TypeAlias = Answer | Refusal
Results: TypeAlias = tuple[Result, ...]

#: Social moves that need no reply if there is another act.
_POLITE = frozenset(
    ("greeting", "farewell", "thanks", "agree", "disagree", "acknowledge", "laugh", "wish",
     "address", "apology", "praise", "caution")
)  # fmt: skip
#: Social moves that are replied to only if there are no others.
_FAINT = (Social("acknowledge"), Social("agree"), Social("address"))
_MENDING = frozenset(("meant", "correct", "pick"))
_REWORDINGS = frozenset(("longer", "shorter", "simpler"))


@dataclass(frozen=True, slots=True)
class Lacking:
    """The plan that the next act needs for its answer, and the answers so far."""

    need: NeedRollout
    done: tuple[Results, ...]  # of each act answered so far


def respond(now: Situation, understood: Understood, done: tuple[Results, ...]) -> Said | Lacking:
    """Answer every act in turn.

    Args:
        now: the question and all that it can be answered from.
        understood: the acts.
        done: the answers to the first of them.
    """
    acts = understood.acts
    spoken = _to_repeat(now, acts)
    if spoken is not None:
        return _repeat(now, spoken)
    for act in acts[len(done) :]:
        if is_ground(act, acts):
            found: Results | NeedRollout = () if isinstance(act.act, AskHelp) else (NOTED,)
        else:
            found = replies(now, act, beside=len(acts) > 1)
        if isinstance(found, NeedRollout):
            return Lacking(found, done)
        done = (*done, found)
    parts = _parts(understood, done)
    foreseen = foreseen_then(now, acts, done)
    beside = () if foreseen is None else (Part(None, foreseen),)
    said = speak(now, (*told(parts), *beside), understood.offer, understood.taken_as)
    return replace(said, parts=kept(parts))


def replies(now: Situation, act: GroundedAct, beside: bool) -> Results | NeedRollout:
    """Return the replies to one act.

    Args:
        now: the situation.
        act: the act.
        beside: there are other acts in the turn.
    """
    match act.act:
        case Ask() | Claim() | Request():
            return _explained(now, act)
        case Feel() as feel:
            return _comfort(now, act, feel, beside)
        case Repair() as repair:
            return _repair(now, repair)
        case Social(kind=kind, about=None):
            return (Sociable(kind),)
        case Social():
            found = now.pipeline.explain(act, now.record)
            return found if isinstance(found, NeedRollout) else (found,)
        case AskHelp():
            return (Helpful(),)
        case Quizzing():
            return (Acknowledged("cancelled"),)
        case Beyond(topic=topic, words=words):
            return (CannotSay(topic, words),)
        case Elliptic():
            return (NotUnderstood(),)


def _explained(now: Situation, act: GroundedAct) -> Results | NeedRollout:
    """Answer an act; one about several vehicles is answered for each of them."""
    found: list[Answer | Refusal] = []
    for one in (why for each in severally(act) for why in _occasions(now, each)):
        result = now.pipeline.explain(one, now.record)
        if isinstance(result, NeedRollout):
            return result
        found.append(result)
    return tuple(found)


def _occasions(now: Situation, act: GroundedAct) -> tuple[GroundedAct, ...]:
    """Return the act, or a question why for each occasion whose reason it asks for."""
    events = listed(act)
    if events is None:
        return (act,)
    told = now.pipeline.explain(events, now.record)
    deeds = told.episodes if isinstance(told, Happenings) else ()
    return whys(act, deeds, now.record.now) or (events,)


def pertinent(acts: tuple[GroundedAct, ...]) -> tuple[GroundedAct, ...]:
    """Return the acts to reply to; courtesies only if there is nothing else.

    If an answer is wanted in another form, it is not repeated as well. Next to a question, an
    insult, or a repair such as "what?", only expresses surprise.
    """
    asked = any(isinstance(act.act, Ask | Request) for act in acts)
    telling = tuple(
        act for act in acts
        if not _is_courtesy(act) and not (asked and _is_outcry(act))
    )  # fmt: skip
    mended = any(isinstance(a.act, Repair) and a.act.kind in _MENDING for a in acts)
    corrected = mended or any(act.leaned for act in acts)
    if corrected:
        telling = tuple(a for a in telling if a.act != Social("disagree")) or telling
    reworded = any(isinstance(a.act, Repair) and a.act.kind in _REWORDINGS for a in telling)
    kept = tuple(act for act in telling if not (reworded and act.act == Repair(kind="repeat")))
    hearty = tuple(act for act in acts if act.act not in _FAINT)
    return kept or hearty[:1] or acts[:1]


def _comfort(now: Situation, act: GroundedAct, feel: Feel, beside: bool) -> Results | NeedRollout:
    """Reply to a feeling, with a fact unless the turn has other acts."""
    if beside:
        return (Comforting(feel),)
    found = now.pipeline.explain(act, now.record)
    if isinstance(found, NeedRollout):
        return found
    return (found if isinstance(found, Comforting) else Comforting(feel),)


def _repair(now: Situation, repair: Repair) -> Results:
    """Reply to a turn about the conversation itself."""
    match repair.kind:
        case "longer" | "shorter" | "simpler" | "repeat" as how:
            return _again(now, how)
        case "continue":
            return _again(now, "longer")
        case "why":
            return (BOTTOM,) if now.memory.last is not None else (NotUnderstood(),)
        case "cancel":
            return (Acknowledged("cancelled"),)
        case "yes":
            return (Acknowledged("yes"),)
        case "no":
            return (Acknowledged("no"),)
        case "correct" | "meant" | "pick":
            return (Acknowledged("nothing-open"),)


def _again(now: Situation, how: Literal["repeat", "simpler", "shorter", "longer"]) -> Results:
    """Return the last answers in another form."""
    last = _previous(now)
    inner = () if last is None else tuple(_plain(r) for r in last.results)
    again = tuple(Again(how, one) for one in inner if one is not None)
    return again or (Acknowledged("nothing-open"),)


def _previous(now: Situation) -> Turn | None:
    """Return the turn to restate: the last that restated an answer, or was about the drive."""
    for turn in reversed(now.memory.turns):
        if any(isinstance(r, Again) for r in turn.results) or turn is now.memory.last:
            return turn
    return now.memory.last


def _plain(result: Result) -> Result | None:
    if isinstance(result, Again | Judged):
        return result.answer
    return None if isinstance(result, Unfamiliar) else result


def _repeat(now: Situation, last: Turn) -> Said:
    """Repeat the reply of a turn in the same words; what was offered stays open.

    A repair that led to them loses its act, so that its wish for more or fewer words counts once.
    """
    reply: Reply = changed(last.reply, sim_time=now.record.now, timing_ms=None)
    parts = tuple(Part(None, p.result) if _is_repair(p) else p for p in last.parts)
    return Said(
        reply=reply,
        parts=parts,
        mentioned=last.mentioned,
        offer=last.offer,
        quiz=last.quiz,
    )


def _is_repair(part: Part) -> bool:
    return part.act is not None and isinstance(part.act.act, Repair)


def _to_repeat(now: Situation, acts: tuple[GroundedAct, ...]) -> Turn | None:
    """Return the turn to be repeated word for word; None: no such repetition is wanted.

    A question of ours is repeated unchanged, even if another wording is wanted.
    """
    last = next((turn for turn in reversed(now.memory.turns) if not turn.turned_away), None)
    if last is None or len(acts) != 1 or not isinstance(acts[0].act, Repair):
        return None
    kind = acts[0].act.kind
    open_ = last.offer is not None or last.quiz is not None
    again = kind == "repeat" or (open_ and kind in ("simpler", "shorter", "longer"))
    return last if again else None


def _parts(understood: Understood, done: tuple[Results, ...]) -> tuple[Part, ...]:
    """Return acts and results in the order of the reply."""
    replied = tuple(
        Part(act, result)
        for act, results in zip(understood.acts, done, strict=True)
        for result in results
        if says_something(result)
    )
    told = [part.result for part in replied]
    replied = tuple(part for part in replied if not is_told_within(part.result, told))
    lost = [
        act
        for act, results in zip(understood.acts, done, strict=True)
        if isinstance(act.act, Ask | Request) and not any(map(says_something, results))
    ]
    heard = [act for act in understood.acts if isinstance(act.act, Ask | Request)]
    doubtful = [act for act in heard or understood.acts if act.doubts]
    answered = any(not isinstance(part.result, NotUnderstood) for part in replied)
    words = dict.fromkeys(word for act in doubtful for word in act.doubts if answered)
    strange = tuple(word for word in words if any(word in act.strange for act in doubtful))
    known = tuple(word for word in words if word not in strange)
    owned = (Part(None, Unfamiliar(strange)),) if strange else ()
    lacking = (Part(None, Unfamiliar(known, known=True)),) if known else ()
    before = tuple(Part(None, one) for one in understood.before)
    after = tuple(
        Part(understood.named if isinstance(one, NotUnderstood) else None, one)
        for one in understood.behind
    )
    quotes = [(act, understood.quotes.get(act, "")) for act in lost[:1]]
    missed = [
        Part(act, NotUnderstood(quote=quote, rest=bool(replied)))
        for act, quote in quotes
        if not understood.behind and (quote or not replied)
    ]
    return (*owned, *before, *replied, *lacking, *missed, *after)


def _is_outcry(act: GroundedAct) -> bool:
    """Check whether an act next to a question only expresses surprise, or is abuse."""
    return isinstance(act.act, Repair) or act.act == Social("insult")


def _is_courtesy(act: GroundedAct) -> bool:
    match act.act:
        case Social(kind=kind):
            return kind in _POLITE
        case Repair(kind="yes" | "no" | "cancel"):
            return True
    return False
