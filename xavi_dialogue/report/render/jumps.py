"""Sentences on probabilities that moved far between two decisions, and what changed in between."""

from planner.record.trace import Action
from xavi_dialogue.report.content import Change, Jump
from xavi_dialogue.report.figures import Figure
from xavi_dialogue.report.render.markup import Markup, Part, joined
from xavi_dialogue.report.render.observations import Page
from xavi_dialogue.report.render.words import OURS, action_words, capital, goal, phrase

NONE_SHOWN = " The record shows nothing that changed in between, so it does not show why."
SHOWN = " What changed in between, by the record: "
UNSURE = "Which of it moved the figure, and by how much, the record does not show."


def told_jump(page: Page, jump: Jump) -> Markup:
    """Return what moved, and what changed in between."""
    between = f"between decision {jump.before} and decision {jump.number}"
    parts: list[Part] = [f"{capital(between)}, {_what(page, jump)} went from "]
    parts += [_figure(page, jump.was), " to ", _figure(page, jump.now), "."]
    if not jump.changes:
        return joined((*parts, NONE_SHOWN))
    told = joined((_told(page, one) for one in jump.changes), "; ")
    return joined((*parts, SHOWN, told, f". {UNSURE}"))


def _what(page: Page, jump: Jump) -> str:
    if jump.vehicle is None and jump.goal is not None:
        return f"the share of rollouts that collide, of the option to {action_words(jump.goal)},"
    if jump.vehicle is None:
        return "the share of the rollouts of the plan that collide"
    what = goal(jump.goal or "continue", jump.place)
    return f"the belief that {page.names.of(jump.vehicle)} {what}"


def _figure(page: Page, known: Figure | None) -> Markup:
    return page.notes.figure(known, "“not among its goals”")


def _told(page: Page, one: Change) -> Markup:
    who = OURS if one.vehicle is None else page.names.of(one.vehicle)
    note = None if one.source is None else page.notes.ref(one.source)
    was, now = one.words
    match one.kind:
        case "speed":
            first, then = page.notes.figure(one.was), page.notes.figure(one.now)
            return joined((f"the speed of {who} from ", first, " to ", then))
        case "expected":
            first, then = page.notes.figure(one.was), page.notes.figure(one.now)
            return joined((f"{who} drove ", then, " where ", first, " had been expected"))
        case "moved":
            return joined((f"{who} moved on by ", page.notes.figure(one.now)))
        case "turned":
            return joined((f"{who} turned by ", page.notes.figure(one.now)))
        case "plan":
            return joined((f"the plan from {_deed(was)} to {_deed(now)}", note))
        case "in-view":
            return joined((f"{who} {'came into' if now else 'went out of'} view", note))
        case "road":
            text = f"{who} came from {was} to {now}, and its goals count from where it is"
            return joined((text, note))
        case "signals":
            text = f"the lights that {who} shows from {was or 'none'} to {now or 'none'}"
            return joined((text, note))
    states = [phrase("light", state) if state else "none in view" for state in (was, now)]
    return joined((f"the light ahead from {states[0]} to {states[1]}", note))


def _deed(action: str) -> str:
    known: Action = action  # type: ignore[assignment]
    return f"“{action_words(known)}”" if action else "none"
