"""Going deeper: what a bare "why?", "how do you know?" or "are you sure?" refers to.

Each bare "why?" in a series goes one level down: from a decision to the belief about the vehicle
behind it, then to the evidence for that belief. There the series ends.
"""

from collections.abc import Sequence
from typing import Literal, TypeAlias

from msgspec.structs import replace

from xavi_dialogue.dialogue.risked import beneath, foretold, risked
from xavi_dialogue.dialogue.state.assertions import event_of
from xavi_dialogue.dialogue.state.memory import is_about_drive
from xavi_dialogue.dialogue.state.turn import Turn
from xavi_dialogue.domain.answers import (
    Activity,
    Again,
    Altered,
    Answer,
    Avoidance,
    Beliefs,
    Bound,
    CannotSay,
    Cause,
    Certainty,
    ChoiceReason,
    Comforting,
    Contrast,
    Decided,
    DecisiveFactor,
    Declined,
    DidNotHappen,
    Grounds,
    Happenings,
    Judged,
    Measures,
    Method,
    MotionCause,
    MotionReason,
    NotApplicable,
    Options,
    OtherReason,
    PeakMoment,
    PlanAhead,
    Reaction,
    Refusal,
    SupposedOfOther,
    SupposedOfUs,
    TooLittle,
    Verdict,
)
from xavi_dialogue.domain.facts import Belief, Episode, Measure
from xavi_dialogue.domain.meaning import (
    Act,
    Ask,
    Elliptic,
    HowKnow,
    HowSure,
    Listing,
    Question,
    Reading,
    Repair,
    WhatIf,
    WhatWouldChange,
    Why,
)
from xavi_dialogue.domain.rewriting import first
from xavi_dialogue.domain.terms import (
    At,
    Believed,
    Compares,
    Ego,
    Event,
    Happens,
    Not,
    Proposition,
    Tense,
    That,
    Vehicle,
)
from xavi_dialogue.domain.vocabulary import ActionName

#: "bottom": nothing lies beneath the last answer; "leave": the act keeps its own meaning.
Deeper: TypeAlias = Act | Literal["bottom", "leave"]
BOTTOM = CannotSay(topic="deeper")
MORE = Repair(kind="longer")


def recast(reading: Reading, turns: Sequence[Turn]) -> Reading:
    """Replace bare follow-ups by what they ask after the answers so far.

    A follow-up with nothing beneath it becomes `Repair(kind="why")`.
    """
    last, acts = _last(turns), reading.acts
    own = [k > 0 and isinstance(acts[k - 1], Ask) and _is_bare_why(a) for k, a in enumerate(acts)]
    return replace(reading, acts=tuple(
        Elliptic(form="why") if mine else _recast(act, last)
        for act, mine in zip(acts, own, strict=True)
    ))  # fmt: skip


def _recast(act: Act, last: Turn | None) -> Act:
    if last is None:  # "why though?" before anything was said is of what we do
        return Elliptic(form="why") if act == Repair(kind="why") else act
    if _is_bare_why(act):
        found = deeper(last)
        return act if found == "leave" else Repair(kind="why") if found == "bottom" else found
    if _is_of_supposed(act, result := _main(last)):
        if isinstance(result, SupposedOfUs) and _blamed(result) is not None:
            told = _asked(result, last)  # names the cause
            return act if told is None else Ask(told)
        found = deeper(last)
        return act if isinstance(found, str) else found
    match act:
        case Ask(question=HowKnow(of=None | That())):
            event = _blamed(result) or foretold(result)
            of = risked(result, None if result is None else _asked(result, last))
            of = of if event is None else Happens(event)
            return act if of is None else Ask(HowKnow(of))
        case Ask(question=HowSure(of=None | That(), changed=False) as question):
            event = _doubted(_main(last))
            return act if event is None else Ask(replace(question, of=Happens(event)))
    return act


def _is_of_supposed(act: Act, result: Answer | Refusal | None) -> bool:
    """Check whether an act after a supposition is about its world: "what would cause that?"."""
    match act:
        case Ask(question=Why(of=of, instead=None, suspect=None)):
            supposed = isinstance(result, SupposedOfUs | SupposedOfOther)
            weighed = isinstance(of, Compares) and of.right is None  # "why would it take longer?"
            of_it = weighed or isinstance(of, That) or _is_imagined(first(of, Event))
            return supposed and of_it
        case Ask(question=WhatWouldChange(of=None | That(), most=False)):
            return isinstance(result, SupposedOfOther)
        case Ask(question=HowSure(of=of, changed=False)):
            open_ = of is None or isinstance(of, That) or _is_imagined(first(of, Event))
            return isinstance(result, SupposedOfOther) and open_
        case Ask(question=Listing(of="rivals", event=event)):
            return isinstance(result, SupposedOfOther) and _is_imagined(event)
    return False


def _is_imagined(event: Event | None) -> bool:
    return event is not None and event.actor == Ego() and event.modal == "would"


def _of_other(result: SupposedOfOther, last: Turn) -> Act:
    """Ask why we would act so in the supposed world; after that answer, why we act as we do."""
    asked, tense = _asked(result, last), _tense_of(result.past)
    if isinstance(asked, WhatIf) and result.within is None:
        would = Event(result.then[0], tense=tense, modal="would")
        return Ask(WhatIf(asked.supposed, Why(Happens(would))))
    return Ask(Why(Happens(Event(result.plan[0], tense=tense))))


def _asked(result: Answer | Refusal, last: Turn) -> Question | None:
    """Return the question of a turn that a result answers."""
    acts = (p.act.act for p in last.parts if p.act is not None and p.result == result)
    return next((act.question for act in acts if isinstance(act, Ask)), None)


def _tense_of(past: bool) -> Tense:
    return "past" if past else "present"


def deeper(last: Turn) -> Deeper:
    """Return what a bare "why?" asks after a turn."""
    result = _main(last)
    match result:
        case ChoiceReason() | MotionReason() | SupposedOfUs() | DidNotHappen() | Declined():
            return _of_ours(result, last)
        case OtherReason(goal=Belief() as belief) | Bound(belief=Belief() as belief):
            return _evidence(belief)
        case Beliefs(history=history) if history:
            return _evidence(history[-1])
        case Activity(actor=Vehicle(), belief=Belief() as belief):
            return _evidence(belief)
        case Verdict(that=that, holds=bool() as holds):
            return Ask(Why(that if holds else _contrary(that)))
        case Happenings(episodes=episodes) if episodes:
            return Ask(Why(Happens(event_of(episodes[-1]))))
        case Measures(measures=(Measure(attribute="speed", gap=None) as speed, *_)):
            driving = Event("move", speed.thing, time=At(speed.time), tense="present")
            return Ask(Why(Happens(driving)))
        case Activity(doing=doing) if doing:
            return Ask(Why(Happens(event_of(_telling(doing)))))
        case PeakMoment(deeds=deeds) if deeds:
            return Ask(Why(Happens(event_of(deeds[0]))))
        case Decided(time=time, steps=steps) if steps:
            return Ask(Why(Happens(Event(steps[0], time=At(time)))))
        case Altered(after=after) if after.steps:
            return Ask(Why(Happens(Event(after.steps[0], time=At(after.time)))))
        case PlanAhead(steps=steps) if steps:
            return Ask(Why(Happens(Event(steps[0][0], tense="future", modal="will"))))
        case SupposedOfOther(plan=plan, then=then) if plan and then:
            return _of_other(result, last)
        case Certainty(contrast=Contrast(fact=fact, foil=foil, decided=time)) if fact and foil:
            told = next((a for a, b in zip(fact, foil, strict=False) if a != b), fact[0])
            return Ask(Why(Happens(Event(told, time=At(time)))))
        case Options(options=options, decided=decided):
            chosen = [one.action for one in options if one.chosen]
            return Ask(Why(Happens(Event(chosen[0], time=At(decided))))) if chosen else "bottom"
        case OtherReason() | Grounds() | Certainty() | Method() | DecisiveFactor() | Avoidance():
            return "bottom"
        case Reaction():
            return MORE
        case CannotSay() | NotApplicable() | TooLittle():
            return "bottom"
    return beneath(result, None if result is None else _asked(result, last)) or "leave"


#: Actions that say least about what somebody is doing.
_PLAIN = frozenset(("signal", "follow", "speed-up", "slow-down", "continue", "move", "approach"))


def _telling(doing: Sequence[Episode]) -> Episode:
    """Return the action that says most about what somebody is doing; of equals the last."""
    return max(doing, key=lambda e: (e.action not in _PLAIN, e.action != "signal", e.begin))


def _of_ours(
    result: ChoiceReason | MotionReason | SupposedOfUs | DidNotHappen | Declined, last: Turn
) -> Deeper:
    """Return what lies beneath an answer about what we did or might have done."""
    if isinstance(result, DidNotHappen):
        if result.answer is not None:
            return "bottom"
        deeds = result.instead[-1:]
        return Ask(Why(Happens(event_of(deeds[0])))) if deeds else "leave"
    if isinstance(result, Declined):
        return Ask(Why(Not(Happens(replace(result.request.event, actor=Ego(), tense="present")))))
    event = _blamed(result)
    if event is not None:
        time = event.time
        return Ask(Why(Believed(Happens(event), time=time)))
    cause = _seen(result)
    if cause is not None:
        return cause
    asked_more = any(isinstance(r, Again) and r.how == "longer" for r in last.results)
    return "bottom" if asked_more else MORE


def _seen(result: ChoiceReason | MotionReason | SupposedOfUs) -> Act | None:
    """Return the question why a visible vehicle did what was in our way."""
    if not isinstance(result, MotionReason):
        return None
    first = _first(result)
    if first is None or first.vehicle is None:
        return None
    if first.did is not None:
        return Ask(Why(Happens(event_of(first.did))))
    doing: ActionName = "stand" if first.speed is not None and first.speed < 0.5 else "move"
    about = Event(doing, Vehicle(first.vehicle), tense="present")
    if result.deed.end is not None:
        about = replace(about, tense="past", time=At(result.deed.begin))
    return Ask(Why(Happens(about)))


def _first(result: MotionReason) -> MotionCause | None:
    """Return the main reason if it is a vehicle; None if it is a light, the road or the like."""
    main = next(iter(result.causes), None)
    return main if main is not None and main.vehicle else None


def _blamed(result: Answer | Refusal | None) -> Event | None:
    """Return what was expected of the vehicle that an answer names first, as of the decision."""
    match result:
        case ChoiceReason(contrast=contrast) | SupposedOfUs(contrast=contrast):
            return _of_contrast(contrast)
        case MotionReason(deed=deed):
            main = _first(result)
            return None if main is None else _foreseen(main, deed.begin)
        case OtherReason(goal=Belief() as belief) | Bound(belief=Belief() as belief):
            return _expected(belief)
        case Activity(actor=Vehicle(), belief=Belief() as belief):
            return _expected(belief)
        case Beliefs(history=history) if history:
            return _expected(history[-1])
    return None


def _doubted(result: Answer | Refusal | None) -> Event | None:
    """Return the event that "are you sure?" is about; None: the act keeps its own meaning."""
    match result:
        case ChoiceReason(deed=deed) if deed is not None:
            return event_of(deed)
        case MotionReason() | OtherReason() | Bound() | Beliefs() | Activity():
            return _blamed(result)
        case PlanAhead(steps=steps) if steps:
            return Event(steps[0][0], tense="future", modal="will")
    return foretold(result)


def _of_contrast(contrast: Contrast) -> Event | None:
    first = next((c for c in contrast.causes if c.vehicle != 0), None)
    if first is None or (first.mechanism is not None and first.mechanism.present):
        return None
    return _foreseen(first, contrast.decided)


def _foreseen(cause: Cause | MotionCause, time: float) -> Event | None:
    if cause.vehicle is None or not cause.actions:
        return None
    return Event(cause.actions[-1], Vehicle(cause.vehicle), time=At(time), modal="will")


def _expected(belief: Belief) -> Event | None:
    likeliest = belief.expectations[:1]
    if not likeliest or not likeliest[0].actions:
        return None
    action = likeliest[0].actions[-1]
    return Event(action, Vehicle(belief.vehicle), time=At(belief.time), modal="will")


def _evidence(belief: Belief) -> Deeper:
    event = _expected(belief)
    return "bottom" if event is None else Ask(HowKnow(Happens(event)))


def _contrary(that: Proposition) -> Proposition:
    return that.content if isinstance(that, Not) else Not(that)


def _is_bare_why(act: Act) -> bool:
    return act in (Repair(kind="why"), Elliptic(form="why"), Elliptic(form="why-not"))


def _last(turns: Sequence[Turn]) -> Turn | None:
    """Return the turn that a follow-up refers to; small talk is passed over."""
    return next((turn for turn in reversed(turns) if _counts(turn)), None)


def _counts(turn: Turn) -> bool:
    told = any(isinstance(result, Again) for result in turn.results)
    return is_about_drive(turn) or told or BOTTOM in turn.results


def _main(turn: Turn) -> Answer | Refusal | None:
    """Return the answer of a turn that reasons are asked for: the last that is more than talk."""
    for result in reversed(turn.results):
        match result:
            case Again(answer=inner) | Comforting(fact=inner) | Judged(answer=inner):
                if inner is not None:
                    return inner
            case _:
                return result
    return None
