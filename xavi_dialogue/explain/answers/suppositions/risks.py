"""Risks: who an option of a decision would have collided with in its rollouts."""

import dataclasses
from collections import Counter

from msgspec.structs import replace

from xavi_dialogue.causal.model import plan_of
from xavi_dialogue.domain.answers import Answer, Options
from xavi_dialogue.domain.meaning import WhatIf, Which
from xavi_dialogue.domain.terms import Ego, Event, Happens
from xavi_dialogue.explain.answers.measuring.closeness import closeness
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.moments import Window
from xavi_dialogue.explain.answers.suppositions import supposing
from xavi_dialogue.explain.answers.suppositions.undone import is_present
from xavi_dialogue.explain.causes.plans.options import of_trace, situations
from xavi_dialogue.explain.causes.plans.premise import Premise
from xavi_dialogue.explain.causes.vehicles.actions import names_of
from xavi_dialogue.explain.history.ride import planned

ONWARD = frozenset(("continue", "exit-straight"))


def what_if(question: WhatIf, asked: Asked) -> Answer:
    """Return the consequences of something, or who an option would have hit.

    Raises:
        Unanswered: it cannot be supposed; or it is what was; or rollouts are needed.
    """
    return _struck_by(question, asked) or supposing.what_if(question, asked)


def who(question: Which, scene: Asked) -> Answer:
    """Return who we may hit by our plan, according to its rollouts.

    Raises:
        Unanswered: no decision is recorded.
    """
    step = next(iter(planned(scene.ride.latest)), None)
    now = dataclasses.replace(scene, span=None)
    supposed = None if step is None else Happens(Event(step, tense="present"))
    found = None if supposed is None else _struck_by(WhatIf(supposed, question), now)
    if found is None or found.hits == 0:
        return closeness(scene, None, Window(scene.now, scene.now), "hit", past=False)
    return found


def _struck_by(question: WhatIf, asked: Asked) -> Options | None:
    """Return who an option would have hit; None if that is not asked, or not recorded."""
    match question:
        case WhatIf(
            supposed=Happens(event=Event(actor=Ego()) as event),
            then=Which(such=Happens(event=Event(action="collide", actor=Ego()))),
        ):
            pass
        case _:
            return None
    trace = asked.ride.at(asked.now if is_present(event, asked) else asked.moment)
    if trace is None:
        return None
    names = set(names_of(event)) | (ONWARD if event.action in ONWARD else set())
    known = of_trace(asked.ride, trace)
    found = [option for option in known if option.action in names]
    if not found:
        return None
    option, evidence = found[0], situations(Premise(trace, None))
    begun = (r for r in trace.rollouts if r.actions and r.actions[0].action == option.action)
    drives = {(r.samples, plan_of(r)): r for r in begun}  # each rollout once
    struck = Counter(r.collided_with for r in drives.values() if r.collided_with is not None)
    if option.collided_with is None and struck:
        option = replace(option, collided_with=struck.most_common(1)[0][0])
    hits = sum(struck.values())
    return Options((option,), trace.sim_time, evidence, risk=True, hits=hits, drives=len(drives))
