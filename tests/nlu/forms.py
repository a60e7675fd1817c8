"""Forms: each question form asked of each predicate, parsed, and written as a table.

    python -m tests.nlu.forms docs/forms.md

The verbs, measures and states are those of the lexicon in `grammars/`; each form is a frame for
them. A cell holds if the text has one act, of that type of question, about that predicate and
that road user, with its negation, and no word without a part in it.
"""

import re
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, get_args

from xavi_dialogue.domain import vocabulary
from xavi_dialogue.domain.base import Value
from xavi_dialogue.domain.meaning import Ask, Claim
from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Event,
    Feature,
    Happens,
    Has,
    Is,
    Measured,
    Related,
)
from xavi_dialogue.nlu.grammar.inflect import verb_forms
from xavi_dialogue.nlu.parse import Parser
from xavi_dialogue.nlu.text.tables import load, phrases

Subject = str  # "us", "car" or "light"
CAR = Described("car", "red")
LIGHT = Feature("light")
OBJECTS = {"v": "the bus", "*": "the bus", "l": "the left lane", "j": "the junction",
           "d": "this road", "x": "the exit", "p": "the destination"}  # fmt: skip
# Where the shortest pattern of the lexicon is not how people say it: verb, and what follows.
SAID = {
    "change-left": "change to the left lane", "change-right": "change to the right lane",
    "exit-left": "turn left", "exit-right": "turn right", "exit-straight": "go straight on",
    "slow-down": "slow down", "change-lane": "change lanes", "overtake": "overtake the bus",
    "pass": "drive past the bus", "nearly-collide": "nearly hit the bus",
    "let-go": "let the bus go",
    "avoid": "avoid the bus", "follow": "follow the bus", "approach": "approach the bus",
    "block": "block the bus", "collide": "hit the bus", "keep-lane": "stay in lane",
    "keep-distance": "keep your distance", "enter": "enter the roundabout",
    "leave": "leave the roundabout", "arrive": "arrive", "continue-next-exit": "miss the exit",
    "turn-colour": "turn green", "show": "stay red",
}  # fmt: skip
OF_LIGHTS = {"turn-colour", "show"}
ONLY_OTHERS = {"appear", "disappear", "come"}  # nobody says so of their own car
UNSAID = {"do", "happen"}
OTHER_FORMS = {"heading", "probability"}  # "where is it going" and "how sure" ask for these
BEHAVIOURS = ("stationary", "hidden", "fast", "slow", "close", "far", "stuck")
ROW = re.compile(r"^\| ([a-z-]+) \| (.+) \| (yes|no) \|$", re.MULTILINE)

# {base}, {third}, {past}, {part}, {ing}: the verb; {did}, {is} ...: auxiliaries by the subject.
DEEDS = {
    "Why": "Why did {s} {base}?",
    "Why not": "Why did {s} not {base}?",
    "What if": "What if {s} had {part}?",
    "What if not": "What if {s} had not {part}?",
    "Whether it happened": "Did {s} {base}?",
    "Whether it will": "Will {s} {base}?",
    "Who": "Who {past}?",
    "When": "When did {s} {base}?",
    "Where": "Where did {s} {base}?",
    "How long": "How long did {s} {base}?",
    "How often": "How often did {s} {base}?",
    "How it was known": "How did you know that {s} would {base}?",
    "How sure": "How sure were you that {s} would {base}?",
    "How it was decided": "How did you decide to {base}?",
    "How to avoid": "How could {s} have avoided {ing}?",
    "Whether it was safe": "Was {ing} safe?",
    "Told": "Tell me why {s} {past}.",
    "Statement": "{S} {past}.",
    "Denial": "{S} did not {base}.",
}
STATES = {
    "Whether": "{Is} {s} {base}?",
    "Whether then": "{Was} {s} {base} at 0:10?",
    "Why": "Why {is} {s} {base}?",
    "Why not": "Why {is} {s} not {base}?",
    "Who": "Who is {base}?",
    "When": "When {was} {s} {base}?",
    "How many": "How many cars are {base}?",
    "What if": "What if {s} had been {base}?",
    "What if not": "What if {s} had not been {base}?",
    "How sure": "How sure are you that {s} {is} {base}?",
    "Statement": "{S} {is} {base}.",
    "Denial": "{S} {is} not {base}.",
}
MEASURES = {
    "How much": "What is {of} {base}?",
    "How much then": "What was {of} {base} at 0:10?",
    "Highest": "What was {of} highest {base}?",
    "How it went": "How did {of} {base} change?",
    "Told": "Tell me {of} {base}.",
    "Statement": "{Of} {base} was 12.",
}
TYPES: dict[str, tuple[str, ...]] = {
    "Why": ("Why",), "Why not": ("Why",), "Told": ("Why",), "What if": ("WhatIf",),
    "What if not": ("WhatIf",), "Whether it happened": ("Whether",), "Whether": ("Whether",),
    "Whether it will": ("Whether",), "Whether then": ("Whether",), "Who": ("Which",),
    "When": ("When",), "Where": ("Where",), "How long": ("HowLong",), "How often": ("HowMany",),
    "How many": ("HowMany",), "How it was known": ("HowKnow",), "How sure": ("HowSure",),
    "How it was decided": ("HowDecide",), "How to avoid": ("HowAvoid",),
    "Whether it was safe": ("Whether",), "Statement": ("Claim",), "Denial": ("Claim",),
    "How much": ("HowMuch",), "How much then": ("HowMuch",), "Highest": ("HowMuch",),
    "How it went": ("HowMuch", "HowSure", "Listing"),
}  # fmt: skip
DENIED = {"Why not", "What if not", "Denial"}
NOBODY = {
    "Who",
    "How many",
    "Whether it was safe",
    "How to avoid",
    "How it was decided",
}  # in the act itself


@dataclass(frozen=True, slots=True)
class Predicate:
    """What is asked about: its name in the domain, and its words."""

    sort: str  # "deed", "state", "relation", "measure"
    name: str
    words: tuple[str, ...]  # the forms of a verb, or one phrase
    rest: str = ""  # what follows a verb


@dataclass(frozen=True, slots=True)
class Cell:
    """A text that asks a form of a predicate, of us and of another car."""

    form: str
    predicate: Predicate
    subject: Subject
    text: str


@cache
def deeds() -> tuple[Predicate, ...]:
    """Give each action the plainest verb and pattern that the lexicon has for it."""
    table = load("nlu_verbs.toml")
    best: dict[str, tuple[tuple[float, int, int], Predicate]] = {}
    actions = set(get_args(vocabulary.ActionName)) - vocabulary.BEYOND - UNSAID
    for place, (lemma, patterns) in enumerate(table["senses"].items()):
        words = lemma.split()
        if "-" in lemma:
            continue
        for pattern in patterns:
            action, *roles = pattern.split()
            rest, cost = _rest(roles)
            if action not in actions or rest is None:
                continue
            own = lemma.replace(" ", "-") == action or lemma == action.split("-")[0]
            rank = (cost + (0.0 if own else 3.0), len(rest), place)
            if action not in best or rank < best[action][0]:
                best[action] = rank, Predicate("deed", action, _conjugated(words), rest)
    for action, said in SAID.items():
        adverb, verb, rest = re.fullmatch(r"(nearly )?(\w+) ?(.*)", said).groups(default="")
        best[action] = (0, 0, 0), Predicate("deed", action, _conjugated([verb], adverb), rest)
    return tuple(best[name][1] for name in get_args(vocabulary.ActionName) if name in best)


def _conjugated(words: list[str], adverb: str = "") -> tuple[str, ...]:
    """Give base, third person, past, participle and -ing of a verb."""
    forms: dict[str, str] = {}
    for form, word in verb_forms(words[0], load("nlu_verbs.toml")["forms"].get(" ".join(words))):
        forms.setdefault(form, adverb + " ".join([word, *words[1:]]))
    return tuple(forms.values())


def _rest(roles: list[str]) -> tuple[str | None, float]:
    """Put the roles of a pattern that must be there into words, and say what that costs."""
    said: list[str] = []
    cost = 0.0
    for role in roles:
        if role.startswith("$"):
            cost += float(role[1:]) * 4
        elif "?" in role:
            continue
        elif role.startswith("+"):
            said.append(role[1:])
            cost += 0.5
        elif role.startswith("side:"):
            said.append(role[5:])
            cost += 0.5
        elif role.startswith("o:") and role[2] in OBJECTS:
            said.append(OBJECTS[role[2]])
            cost += 1.0
        elif role == "go":
            said.append("go")
        else:
            return None, 0.0
    return " ".join(said), cost


@cache
def predicates() -> tuple[Predicate, ...]:
    """List all predicates: deeds, states, relations and measures of the lexicon."""
    words = load("nlu_words.toml")
    states = [_worded("state", name, words["ADJ"][name]) for name in BEHAVIOURS]
    bearings = {"ahead": "ahead-of", "behind": "behind", "left": "left-of", "right": "right-of",
                "beside": "beside"}  # fmt: skip
    relations = [
        Predicate(
            "relation", name, (f"{' '.join(phrases(words['BEARP'][key].lstrip('*'))[0])} us",)
        )
        for key, name in bearings.items()
    ]
    attributes = set(get_args(vocabulary.Attribute))
    measures = [_worded("measure", k, v) for k, v in words["MEAS"].items() if k in attributes]
    plain = [m for m in measures if m.words[0][0] != "*" and m.name not in OTHER_FORMS]
    return (*deeds(), *states, *relations, *plain)


def _worded(sort: str, name: str, listed: str) -> Predicate:
    return Predicate(sort, name, (" ".join(phrases(listed)[0]),))


def forms_of(sort: str) -> dict[str, str]:
    """Give the frames for a sort of predicate."""
    return {"deed": DEEDS, "measure": MEASURES}.get(sort, STATES)


def cells() -> Iterator[Cell]:
    """Ask every form of every predicate."""
    for predicate in predicates():
        for form, frame in forms_of(predicate.sort).items():
            subjects = ("us", "car")
            if predicate.name in ONLY_OTHERS or predicate.sort == "relation":
                subjects = ("car",)
            if predicate.name in OF_LIGHTS:
                subjects = ("light",)
            if "{s}" not in frame and "{S}" not in frame and "{of}" not in frame.lower():
                subjects = subjects[:1]
            for subject in subjects:
                yield Cell(form, predicate, subject, _text(frame, predicate, subject))


def _text(frame: str, predicate: Predicate, subject: Subject) -> str:
    who, of, verb, was = ("you", "our", "are", "were")
    if subject == "car":
        who, of, verb, was = ("the red car", "the red car's", "is", "was")
    elif subject == "light":
        who, of, verb, was = ("the traffic light", "the traffic light's", "is", "was")
    elif predicate.sort != "deed":
        who = "we"
    words = [f"{word} {predicate.rest}".strip() for word in predicate.words]
    names = ("base", "third", "past", "part", "ing")[: len(words)]
    values = {"s": who, "of": of, "is": verb, "was": was, **dict(zip(names, words, strict=True))}
    values |= {key.capitalize(): _capital(values[key]) for key in ("s", "of", "is", "was")}
    return frame.format(**values)


def _capital(text: str) -> str:
    return text[0].upper() + text[1:]


@cache
def _parser() -> Parser:
    return Parser()


def holds(cell: Cell) -> bool:
    """Say whether the best reading of a text asks that form of that predicate."""
    best = _parser().read(cell.text)[0]
    if best.unknown or len(best.acts) != 1:
        return False
    act = best.acts[0]
    inner = act.question if isinstance(act, Ask) else act
    wanted = TYPES[cell.form]
    if cell.predicate.sort == "measure" and cell.form == "Told":
        wanted = ("HowMuch",)
    if type(inner).__name__ not in wanted or not isinstance(act, Ask | Claim):
        return False
    terms = list(_inside(inner))
    if (cell.form in DENIED) != any(type(term).__name__ == "Not" for term in terms):
        return False
    return any(_is(term, cell) for term in terms)


def _is(term: Any, cell: Cell) -> bool:
    """Say whether a term is the predicate of a cell, of the road user of the cell."""
    name = cell.predicate.name
    who: Value = {"us": Ego(), "light": LIGHT}.get(cell.subject, CAR)
    match term:
        case Happens(event=event) if _is(event, cell):
            return True
        case Event(action=action, actor=actor) if action == name:
            return cell.form in NOBODY or actor == who
        case Measured(attribute=attribute, thing=thing, to=to) if attribute == name:
            return who in (thing, to)
        case Has(attribute=attribute, thing=thing) if attribute == name:
            return thing == who
        case Is(state=state, thing=thing) if state == name:
            return cell.form in NOBODY or thing == who
        case Related(relation=relation, thing=thing, to=to) if relation == name:
            return cell.form in NOBODY or (thing == who and to == Ego())
    return False


def _inside(value: Any) -> Iterator[Any]:
    yield value
    for name in getattr(value, "__struct_fields__", ()):
        inner = getattr(value, name)
        for one in inner if isinstance(inner, tuple) else (inner,):
            if hasattr(one, "__struct_fields__"):
                yield from _inside(one)


TITLES = {"deed": "What is done", "state": "States", "relation": "Places", "measure": "Measures"}
HEAD = """# Question forms and what they can be asked of

Written by `python -m tests.nlu.forms docs/forms.md`; `tests/nlu/test_forms.py` reads it back.

A row below is an example text for one question form and one predicate. Predicates and their
words come from the lexicon (`nlu_verbs.toml` and `nlu_words.toml` in `grammars/`). A text is
*covered* if its best reading is one act of that form, about that predicate and that road user,
with its negation, and no word is without a part. Whether the record then has an answer is another
matter. Forms are put to predicates without asking whether anybody would say so ("How often did
you continue?"). So the tables show what the parser can compose, and not how well it understands
what passengers say; [language.md](language.md) has the figures for that.

In the overviews `●` means that all texts of a cell are covered (one about us and one about another
car, where both make sense; or one about a traffic light), `◐` that some are, and `·` that none is.
Of {all} texts {good} are covered ({share} %). Those that are not have `no` in the tables below.
"""


def page() -> str:
    """Write the document."""
    rows = [(cell, holds(cell)) for cell in cells()]
    good = sum(found for _, found in rows)
    share = f"{100 * good / len(rows):.0f}"
    parts = [HEAD.replace("{all}", str(len(rows))).replace("{good}", str(good))
             .replace("{share}", share)]  # fmt: skip
    for sort, title in TITLES.items():
        mine = [row for row in rows if row[0].predicate.sort == sort]
        parts += [f"## {title}\n", _overview(mine)]
        for form in forms_of(sort):
            listed = [
                f"| {cell.predicate.name} | {cell.text} | {'yes' if found else 'no'} |"
                for cell, found in mine
                if cell.form == form
            ]
            head = f"### {title}: {form}\n\n| predicate | text | covered |\n|---|---|---|\n"
            parts.append(head + "\n".join(listed) + "\n")
    return "\n".join(parts)


def _overview(rows: list[tuple[Cell, bool]]) -> str:
    found: dict[tuple[str, str], list[bool]] = {}
    for cell, ok in rows:
        found.setdefault((cell.predicate.name, cell.form), []).append(ok)
    forms = list(dict.fromkeys(cell.form for cell, _ in rows))
    lines = ["| | " + " | ".join(forms) + " |", "|---" * (len(forms) + 1) + "|"]
    for name in dict.fromkeys(cell.predicate.name for cell, _ in rows):
        marks = [found[name, form] for form in forms]
        signs = ["●" if all(m) else "◐" if any(m) else "·" for m in marks]
        lines.append(f"| {name} | " + " | ".join(signs) + " |")
    return "\n".join(lines) + "\n"


def covered(document: str) -> set[str]:
    """Read back the texts that a document says are covered."""
    return {text for _, text, mark in ROW.findall(document) if mark == "yes"}


if __name__ == "__main__":
    Path(sys.argv[1]).write_text(page(), encoding="utf-8")
