"""Merging: what two acts beside each other ask together, such as "he is slowing. Is that right?".

"Suppose he pulls out. What then?" is one question, and so is "we are going faster, why is that?".
"""

from typing import Final

from msgspec import structs

from xavi_dialogue.domain.meaning import (
    Act,
    Ask,
    Changed,
    Claim,
    Doing,
    Elliptic,
    HowDecide,
    HowKnow,
    HowMuch,
    HowSure,
    Identify,
    Listing,
    Repair,
    Request,
    Summarise,
    WhatIf,
    WhatWouldChange,
    When,
    Where,
    Whether,
    Which,
    Why,
)
from xavi_dialogue.domain.rewriting import first
from xavi_dialogue.domain.terms import (
    Back,
    Believed,
    Caused,
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
    Now,
    Pronoun,
    Proposition,
    Rank,
    Related,
    That,
    Unsaid,
    Vehicle,
    Wanted,
)
from xavi_dialogue.nlu.compose.refining.sounds import of_one_sound
from xavi_dialogue.nlu.compose.verbs.trends import as_slowing, believed
from xavi_dialogue.nlu.compose.wh_questions.wh import answer_to
from xavi_dialogue.nlu.joining.blaming import HELD, asked_with, is_clear
from xavi_dialogue.nlu.joining.recalling import recalled
from xavi_dialogue.nlu.joining.unchanged import spared


def merged(before: Act, later: Act) -> Act | None:
    """Read two acts as one; None where they are two."""
    return (
        asked_with(before, later)
        or recalled(before, later)
        or _of_chance(before, later)
        or _of_evidence(before, later)
        or _of_duty(before, later)
        or _of_choice(before, later)
        or _of_reason(before, later)
        or _of_told(before, later)
        or _of_world(before, later)
        or _of_claim(before, later)
        or of_one_sound(before, later)
    )


def _of_chance(before: Act, later: Act) -> Act | None:
    """Ask how sure we are, or were, of what was told or asked before."""
    match before, later:
        case Ask(question=HowSure(of=None, changed=False)), (
            Ask(question=Whether(that=that, tag=True)) | Claim(that=that)
        ):  # "are you sure he sees us?", "were you sure he would turn?"
            event = first(that, Event)
            then = event is not None and event.modal == "would"
            return Ask(Whether(Believed(that) if then else that))
        case Claim(that=Compares(left=Measured(attribute="probability") as left)), Ask(
            question=HowKnow(of=None | That())
            | Changed(time=Unsaid())
            | Why(of=That() | Happens(event=Event(action="do" | "happen")), suspect=None)
        ):
            return Ask(HowSure(believed(left), changed=True))  # "it just dropped. What did that?"
        case Claim(that=Compares(left=Measured(attribute="probability"))), Claim(
            that=Caused(cause=Described(kind="vehicle", rank=int()))
        ):
            return before  # "now it is a third"
        case Ask(question=HowSure(of=of) as asked), Ask(
            question=HowSure(of=None | That() | Exists(thing=Pronoun()), changed=True)
        ) if of is not None:  # "..., and when did that change?"
            return Ask(structs.replace(asked, changed=True))
    return None


def _of_evidence(before: Act, later: Act) -> Act | None:
    """Ask how what follows is known: "how can you tell when the light changes?"."""
    match before, later:
        case Ask(question=HowKnow(of=None)), Ask(
            question=Whether(tag=True) | When(of=Happens()) | Where(of=Event()) as embedded
        ):
            return Ask(HowKnow(answer_to(embedded)))
    return None


def _of_duty(before: Act, later: Act) -> Act | None:
    """Ask of what we had to do, or did without need: "you brake? Nobody is near us!"."""
    match before, later:
        case Claim(that=Not(content=Happens(event=Event(actor=Ego()) as left))), Claim(
            that=Happens(event=Event(action=due, actor=Ego(), modal="should"))
        ) if left.action == due and left.modal is None:  # "you never stopped! you should have"
            return Ask(Why(Not(Happens(left))))
        case Claim(that=Not(content=Happens(event=Event(action=due, actor=Ego()) as left))), Ask(
            question=Whether(that=Is(state="allowed", thing=None | Ego(), event=None, tense=tense))
        ) if due in HELD and left.object is not None:
            # "you did not wait for him at all. Were you allowed to?"
            return Ask(Whether(Related("has-priority-over", Ego(), left.object, tense=tense)))
        case (
            (
                Claim(that=Happens(event=Event(action=action, actor=Ego())) as that)
                | Ask(
                    question=Whether(
                        that=Happens(event=Event(action=action, actor=Ego())) as that, tag=True
                    )
                )
            ),
            Claim(
                that=Related(thing=Nobody())
                | Is(thing=Nobody())
                | Is(state="far")
                | Not(content=Exists() | Related() | Is(state="close"))
            ),
        ) if action in HELD:
            return Ask(Why(that))  # "you brake? Nobody is anywhere near us!"
    return None


def _of_choice(before: Act, later: Act) -> Act | None:
    """Ask why one plan came out ahead of another, or took its place."""
    match before, later:
        case Claim(
            that=Compares(
                left=Measured(attribute="value", event=Event() as done, time=time), right=right
            )
        ), Ask(
            question=Why(of=That() | Happens(event=Event(action="do")), instead=instead) as why
        ):  # "decision 5 puts a stop before going on. What made that come out ahead?"
            of = Happens(structs.replace(done, time=time))
            other = getattr(right, "event", None)
            against = Happens(other) if isinstance(other, Event) else None
            return Ask(structs.replace(why, of=of, instead=instead or against))
        case Claim(
            that=Compares(
                left=Measured(attribute="value", event=Event() as done, time=time),
                right=Measured(event=Event() as other),
            )
        ), Ask(
            question=Changed(time=Unsaid())
        ):  # "you went from turning to stopping. What changed?"
            return Ask(Why(Happens(structs.replace(done, time=time)), Happens(other)))
    return None


def _of_reason(before: Act, later: Act) -> Act | None:
    """Ask why that is so which was told or asked before."""
    match before, later:
        case Ask(
            question=Doing(actor=None, tense="present")
            | Why(of=That() | Happens(event=Event(action="do")), suspect=None)
        ), Ask(question=Why(of=Happens())):  # "what is the matter, why have we stopped?"
            return later
        case Ask(question=Why(of=Happens(event=Event(action="do")), suspect=None)), Elliptic(
            event=Event() as event, thing=None, form="same"
        ):  # "what are you doing that for, slowing down?"
            return Ask(Why(Happens(event)))
        case Elliptic(thing=Described() as thing, form="same"), Ask(
            question=WhatWouldChange(of=None)
        ):  # "and the red one, did that matter?"
            return Ask(Why(That(), suspect=thing))
        case Ask(question=Whether(that=Related("same-as", Pronoun("it")))), Ask(
            question=Which(thing=Wanted())
        ):  # "is it us or them who has to wait?"
            return later
        case Ask(question=Why(of=Not(content=Happens(event=Event(actor=Ego()) as event)))), Ask(
            question=Where(of=Ego())
        ) if event.action in ("wait", "stand", "keep-lane"):  # "why don't we stay where we were?"
            return Ask(Why(Not(Happens(structs.replace(event, action="keep-lane")))))
        case Repair(kind="why"), Request(event=event, negated=False):
            return Ask(Why(Happens(event)))  # "and why crawl along?"
    return None


def _of_told(before: Act, later: Act) -> Act | None:
    """Ask why what was stated is so: "you did not brake, why not?"."""
    match before, later:
        case Claim(that=Not() as that), Elliptic(
            thing=None, event=None, time=Unsaid(), negated=True, form="why-not"
        ):  # "you did not brake, why not?"
            return Ask(Why(that))
        case Claim(that=Happens(event=Event(modal="could" | "should", actor=Ego()) as event)), (
            Elliptic(thing=None, event=None, time=Unsaid(), negated=True, form="why-not")
        ) if event.tense in ("past", "perfect"):  # "you could have overtaken, why didn't you?"
            time = Unsaid() if isinstance(event.time, Now) else event.time
            undone = structs.replace(event, modal=None, tense="perfect", time=time)
            return Ask(Why(Not(Happens(undone))))
        case Claim(that=Happens(event=Event(actor=Described() | Pronoun() | Vehicle()) as event)), (
            Elliptic(thing=None, event=None, time=Unsaid(), negated=True, form="why-not")
        ) if event.modal is None:  # "the lorry went, why didn't you?"
            return Ask(Why(Not(Happens(structs.replace(event, actor=Ego())))))
        case Ask(question=Why(of=Not())), Elliptic(event=None, negated=True, form="why-not"):
            return before  # "I thought it would stop. Why didn't it?"
        case Claim(that=Happens(event=event) as that), Ask(
            question=Why(of=Happens(event=Event(action="do", object=Pronoun(), actor=actor)))
        ) if actor == event.actor or isinstance(actor, Pronoun):
            return Ask(Why(that))  # "you braked, why did you do that?"
        case Claim(that=Compares() as that), Ask(
            question=Why(of=Happens(event=Event(action="do", object=Pronoun())))
        ):
            return Ask(Why(_latest(that)))  # "the speed dropped, why?"
        case Claim(that=that), (
            Repair(kind="why")
            | Elliptic(
                thing=None | Pronoun(form="that" | "this" | "it"),
                event=None,
                time=Unsaid(),
                negated=False,
                form="why",
            )
            | Ask(question=Why(of=That() | Believed(content=That()), suspect=None))
        ) if not (isinstance(that, Caused) or is_clear(that)):
            return Ask(Why(_latest(that)))  # "we are going faster, why is that?"
    return None


def _latest(told: Proposition) -> Proposition:
    """Take "this is the second time you stopped", "second time we stop" for the latest stop."""
    match told:
        case Happens(event=Event(time=Rank(), tense="present") as event):
            return Happens(structs.replace(event, time=Rank(-1), tense="past"))
        case Compares(left=Measured(attribute="count", event=Event() as event), comparator="same"):
            return Happens(structs.replace(event, time=Rank(-1), tense="past"))
    return as_slowing(told) or told


def _of_world(before: Act, later: Act) -> Act | None:
    """Ask what comes of what was supposed, or of what it hangs."""
    match before, later:
        case Ask(question=WhatIf(then=None) as question), Ask(
            question=Whether(that=Happens(event=Event(modal="would" | "could"))) as then
        ):
            return Ask(structs.replace(question, then=then))
        case Ask(question=WhatIf(then=None) as question), Ask(question=Whether(that=that)) if (
            hurt := spared(that)
        ) is not None:  # "say he stops dead. Do you stop in time?"
            return Ask(structs.replace(question, then=Whether(hurt)))
        case Ask(question=WhatIf(then=None) as question), Ask(
            question=HowDecide(of=Happens(event=Event(action="go", actor=Pronoun())))
            | Doing(actor=None)
        ):
            return Ask(structs.replace(question, then=Doing(None)))
        case Ask(question=WhatWouldChange(of=None) as question), Ask(
            question=Whether(that=Happens(event=Event(modal="can" | "could")) as of)
        ):  # "what must change so that we can go?"
            return Ask(structs.replace(question, of=of))
        case Ask(question=WhatIf(then=None)), Elliptic(
            thing=None, event=None, time=Back("after") | Unsaid(), form="same" | "which"
        ):  # "suppose he pulls out. What then?"
            return before
        case Ask(question=WhatIf(then=None) as question), Ask(
            question=Listing(of="beliefs", about=None | Ego())
            | Summarise(about=None | Event(action="do"))
        ):  # "..., what do you predict?"
            return Ask(structs.replace(question, then=Doing(None)))
        case Ask(question=WhatIf(then=None) as question), Request(event=event, negated=False):
            done = structs.replace(event, modal=event.modal or "could")
            return Ask(structs.replace(question, then=Whether(Happens(done))))
        case Ask(question=WhatIf(then=None) as question), Ask(question=Doing(actor=Ego()) as doing):
            return Ask(structs.replace(question, then=doing))
    return None


_GOING: Final = frozenset(
    ("go", "move", "enter", "turn", "exit-left", "exit-right", "exit-straight", "pull-out", "pass",
     "cross")
)  # fmt: skip


def _of_claim(before: Act, later: Act) -> Act | None:
    """Ask whether that is so which was stated, or do what it makes room for."""
    match before, later:
        case Claim(that=Is(state="roomy" | "free", thing=thing)), Request(
            event=Event(
                action="move" | "go" | "do", object=None | Pronoun(), side=None, where=None
            ),
            negated=False,
        ):  # "there is a gap on the left, take it"
            lane = thing if isinstance(thing, Lane) and thing.which != "own" else None
            return Request(Event("change-lane", object=lane, tense="present"))
        case Claim(
            that=Related(relation="has-priority-over", thing=other, to=Ego() | Everyone())
        ), (Claim(that=Happens(event=Event(action=action, actor=Ego(), object=None)))) if (
            action in _GOING and not isinstance(other, Ego)
        ):  # "he had priority and you just went"
            return Claim(Happens(Event("go", Ego(), other, manner=("first",))))
        case Claim(that=that), Ask(
            question=Whether(that=Is(state="right", thing=None | Pronoun(), event=None))
        ):
            return Ask(Whether(that, tag=True))
        case Claim(that=that), Ask(
            question=Which(thing=Wanted(), such=Is(thing=Wanted(), event=None, state=state))
        ) if state != "visible":
            return Ask(Whether(that, tag=True))  # "..., which is fine, isn't it?"
        case Ask(question=HowMuch()) as named, Ask(question=Identify(thing=Pronoun(form="it"))):
            return named  # "the limit, what is it"
        case Claim(that=that), Elliptic() if later == Elliptic():
            return Ask(Whether(that, tag=True))
    return None


def grounds(act: Act, later: Act) -> Act | None:
    """Take "why isn't it higher" behind a chance for the question on what it rests."""
    match act, later:
        case Ask(question=Whether(that=Happens(event=event) as that)), Ask(
            question=HowKnow(of=None)
        ) if not isinstance(event.actor, Ego):  # "is he turning, and how do you know?"
            return Ask(HowKnow(that))
        case Ask(question=HowSure(of=of)), Ask(
            question=Why(of=Compares(left=left) | Not(content=Compares(left=left)))
        ) if of is not None and left.attribute in ("value", "probability"):
            return Ask(HowKnow(of)) if isinstance(left.thing, Pronoun | Ego) else None
    return None
