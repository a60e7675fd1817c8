"""Verdicts: yes or no questions, and claims checked against the record."""

from xavi_dialogue.domain.answers import Answer, Verdict
from xavi_dialogue.domain.meaning import Claim, Whether
from xavi_dialogue.domain.terms import Caused, Happens, Is, Not, Proposition
from xavi_dialogue.explain.answers.asked import Asked
from xavi_dialogue.explain.answers.findings import Finding
from xavi_dialogue.explain.answers.weighing import weigh


def whether(question: Whether, asked: Asked) -> Answer:
    """Tell whether something holds, with what bears it out or is so instead.

    Raises:
        Unanswered: it is of what is unknown or did not happen; or rollouts are needed.
    """
    found = weigh(question.that, asked)
    return found.answer if found.answer is not None else found.verdict(question.that)


def claim(act: Claim, asked: Asked) -> Answer:
    """Tell whether a claim is right: agreed, denied with what was so, or not to be told.

    Raises:
        Unanswered: it is of what is unknown, or rollouts are needed.
    """
    found = weigh(act.that, asked)
    if found.answer is not None and (found.holds is None or _own_type(act.that)):
        return found.answer
    return _checked(found, act)


def _checked(found: Finding, act: Claim) -> Verdict:
    return found.verdict(act.that, claim=True, challenge=act.challenge)


def _own_type(that: Proposition) -> bool:
    """Tell whether an answer of another type replies to such a claim better than a verdict does."""
    content = that.content if isinstance(that, Not) else that
    if isinstance(content, Caused):
        return True
    if isinstance(content, Is):
        return content.state not in ("right", "wrong")
    return not isinstance(content, Happens)
