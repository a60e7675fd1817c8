"""Understanding: the meaning of a passenger's words in the present situation. Pure."""

from collections.abc import Sequence

from xavi_dialogue.dialogue.acts import pertinent
from xavi_dialogue.dialogue.chain import recast
from xavi_dialogue.dialogue.claims import in_order
from xavi_dialogue.dialogue.pipeline import Situation
from xavi_dialogue.dialogue.quizzes.quiz_replies import signs
from xavi_dialogue.dialogue.quizzes.quizzing import judgement_of, put_again
from xavi_dialogue.dialogue.state.state import Understood
from xavi_dialogue.dialogue.state.turn import Offer, Turn
from xavi_dialogue.domain.answers import NoSuchVehicle, NotUnderstood, Refusal, WhichOne
from xavi_dialogue.domain.discourse import GroundedAct
from xavi_dialogue.domain.meaning import Act, Elliptic, Quizzing, Reading, Repair, TokenShare
from xavi_dialogue.nlu.grounding.result import Grounding


def understand(now: Situation, before: Turn | None) -> Understood:
    """Return the acts of a text, or what prevents a reply to them.

    Args:
        now: the question and all that it can be understood from.
        before: the turn before, if it ended with a question of ours.
    """
    chosen = _chosen(now.asked.text, before)
    readings = now.pipeline.read(now.asked.text) if chosen is None else (chosen,)
    quiz = None if before is None else before.quiz
    if quiz is not None:
        judged = judgement_of(now, quiz, readings)
        if judged is not None:
            return judged
    wants = [act for reading in readings[:1] for act in reading.acts]
    if now.memory.is_quizzing and "another" in signs(now.asked.text) and not _of_reply(wants):
        return Understood(aim="quiz")
    if any(isinstance(act, Quizzing) and not act.stop for act in wants):
        return Understood(aim="quiz")
    asked = tuple(recast(reading, now.memory.turns) for reading in readings)
    grounding = now.pipeline.ground(asked, now.record, now.memory.discourse)
    understood = grounded(grounding)
    if quiz is not None and (not understood.acts or _is_fragment(now, readings)):
        return put_again(quiz)
    return understood


def _chosen(text: str, before: Turn | None) -> Reading | None:
    """Read a text that is the number, or the exact words, of a choice that was offered."""
    if before is None or before.offer is None:
        return None
    typed = text.strip().strip("().").casefold()
    for rank, choice in enumerate(before.reply.choices, start=1):
        if text.strip().casefold() == choice.casefold() or typed == str(rank):
            share = TokenShare(text, text, "meaning", act=0)
            return Reading((Repair("pick", pick=rank),), (share,))
    return None


def _of_reply(acts: Sequence[Act]) -> bool:
    """Check whether acts ask for the last reply in another form: "more", "again"."""
    return any(isinstance(act, Repair) and act.kind in ("longer", "repeat") for act in acts)


def _is_fragment(now: Situation, readings: tuple[Reading, ...]) -> bool:
    """Check whether a text is a bare answer rather than a question: "vehicle 1"."""
    acts = readings[0].acts if readings else ()
    bare = all(isinstance(a, Elliptic) and a.form == "same" and not a.besides for a in acts)
    return bare and "?" not in now.asked.text


def grounded(grounding: Grounding) -> Understood:
    """Return the result of grounding as what the turn has to reply to."""
    acts = in_order(pertinent(grounding.acts))
    refusal, clarify = grounding.refusal, grounding.clarify
    misdescribed = isinstance(refusal, NoSuchVehicle) and refusal.misdescribed is not None
    before: tuple[Refusal, ...] = (refusal,) if misdescribed and refusal is not None else ()
    behind: tuple[Refusal, ...] = () if misdescribed or refusal is None else (refusal,)
    if clarify is not None:
        behind = (*behind, clarify)
    if not acts and not before and not behind:
        unknown = () if grounding.reading is None else grounding.reading.strange
        behind = (NotUnderstood(words=unknown),)
    quotes = dict(zip(grounding.acts, grounding.quotes, strict=False))
    named = None if grounding.named is None else GroundedAct(Elliptic(grounding.named))
    offer = _offer(grounding, clarify)
    taken_as = "" if grounding.reading is None else grounding.reading.paraphrase
    return Understood(acts, before, behind, offer, named, quotes, taken_as)


def _offer(grounding: Grounding, clarify: WhichOne | None) -> Offer | None:
    if clarify is None:
        return None
    things = grounding.offered_things
    return Offer(acts=grounding.offers, things=things, pending=grounding.pending)
