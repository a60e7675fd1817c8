"""Sections on what was believed and decided, what it hangs on, and whether it was avoidable."""

from xavi_dialogue.report.content import Beliefs, Choice, Decided, GoalBelief, SpeedExpected
from xavi_dialogue.report.decisions.alternatives import Cases, Holding, Tested
from xavi_dialogue.report.render.charts import Line, chart
from xavi_dialogue.report.render.colours import OTHERS, STROKES
from xavi_dialogue.report.render.jumps import told_jump
from xavi_dialogue.report.render.markup import Markup, joined, listed, table, tag
from xavi_dialogue.report.render.notes import percent
from xavi_dialogue.report.render.observations import Page
from xavi_dialogue.report.render.words import (
    action_words,
    capital,
    chain,
    goal,
    phrase,
    supposed_words,
)

OTHER_PROGRAM = (
    "With nothing changed, this program plans it otherwise than recorded: another version drove "
    "the ride. What follows shows that, too, and not the changes alone."
)
MOST = 5  # goals of one road user that are drawn


def beliefs(page: Page) -> Markup:
    """Return what was believed of those involved, and how it moved."""
    text = (
        "The probability of each goal in each decision. It follows from how well the motion so "
        "far fits driving to that goal. One that a decision did not ascribe has none then."
    )
    parts = [tag("p", text)]
    for known in page.report.beliefs:
        parts.append(tag("h3", page.names.shown(known.vehicle)))
        parts += _beliefs(page, known)
    if not page.report.beliefs:
        parts.append(tag("p", "Nobody else is involved."))
    return joined(parts)


def _beliefs(page: Page, known: Beliefs) -> list[Markup]:
    if not known.goals:
        return [tag("p", "No decision of these seconds predicted it.")]
    times = sorted({point.time for one in known.goals for point in one.points})
    drawn = [
        Line(
            f"{k + 1}",
            _drawn(one, times),
            OTHERS[k % len(OTHERS)],
            STROKES[k % len(STROKES)] or None,
            dots=True,
        )
        for k, one in enumerate(known.goals[:MOST])
    ]
    came = {True: "yes", False: "no", None: "not seen"}
    rows = []
    for k, one in enumerate(known.goals):
        first, last = one.points[0], one.points[-1]
        ends = [
            joined((f"{percent(p.probability)} (D{p.source.number})", page.notes.ref(p.source)))
            for p in (first, last)
        ]
        rows.append((f"{k + 1}: {goal(one.kind, one.place)}", *ends, came[one.came]))
    head = ("Goal", "First in the window", "Last in the window", "Did so, as far as seen")
    return [
        chart(page.axes, "Probability of its goals [%]", drawn, high=100.0),
        table(head, rows),
        *(
            tag("p", told_jump(page, one))
            for one in page.report.jumps
            if one.vehicle == known.vehicle
        ),
        *_speeds(page, known.speeds),
    ]


def _drawn(one: GoalBelief, times: list[float]) -> tuple[tuple[float, float], ...]:
    """Return the curve of a goal [s], [%]: none where a decision did not ascribe it."""
    chances = {point.time: 100.0 * point.probability for point in one.points}
    return tuple((time, chances.get(time, 0.0)) for time in times)


def _speeds(page: Page, known: tuple[SpeedExpected, ...]) -> list[Markup]:
    """Return how fast it was expected to drive, against how fast it drove."""
    if not known:
        return []
    rows = (
        (
            f"D{one.decision} at {one.time:.1f} s",
            f"{one.at:.1f} s ({page.by(one.at)})",
            page.notes.figure(one.speed),
            page.notes.figure(one.driven, "not seen"),
        )
        for one in known
        if one.at <= page.report.until + 1e-6
    )
    head = ("By decision", "For", "Speed expected", "Speed driven")
    return [tag("p", "How fast it was expected to drive, and how fast it drove:"),
            table(head, rows, "long")]  # fmt: skip


def decisions(page: Page) -> Markup:
    """Return all decisions of the window, and the one in force in full."""
    report = page.report
    rows = (
        (
            f"D{one.number}",
            f"{one.time:.1f} s ({page.by(one.time)})",
            joined((capital(chain(one.plan)), tag("b", " (changed)") if one.changed else None)),
            page.notes.figure(one.speed),
            page.notes.figure(one.collision),
            page.notes.figure(one.value),
        )
        for one in report.decisions
    )
    head = ("", "Time", "Plan", "Speed then", "Collision: share of the rollouts",
            "Expected reward")  # fmt: skip
    text = (
        "In the tables of options below, a collision has two figures. The share of the rollouts is "
        "what the reward counts. But rollouts err: the next column is the probability that this "
        "car would tell its passengers, made from such a share and from how often SUMO bore "
        "rollouts out. The last column compares options over the same situations if both were "
        "tried in all of them, else each by its own; its source says which. The hardest braking is "
        "that of the rollouts, from the decision up to their ends: what was expected "
        "of the option, not what was driven, which the timeline tells."
    )
    moved = [tag("p", told_jump(page, one)) for one in report.jumps if one.vehicle is None]
    asked = tag("p", text) if report.decided else None
    short = joined((table(head, rows, "long"), *moved, asked))
    whole = [_decided(page, one) for one in report.decided]
    return joined((tag("h3", "All decisions of these seconds"), short, *whole))


def _decided(page: Page, one: Decided) -> Markup:
    begun = "" if one.under_way is None else (
        f" It had to finish first what was under way: {action_words(one.under_way)}."
    )  # fmt: skip
    weighed = (
        "Figures are those that the decision went by."
        if one.by_weights
        else "Nothing was weighed; figures are those that answers rest on."
    )
    horizon = page.report.subject.settings.horizon
    cost = ", ".join(f"{phrase('outcome', k)} {v:g} s" for k, v in one.costs.penalties.items())
    parts = [
        tag("h3", f"Decision {one.number}: {reasons_why(one)}"),
        tag("p", f"Taken at {one.time:.1f} s ({page.by(one.time)}), trace {one.trace}: ",
            tag("b", chain(one.plan)), f".{begun} {weighed} The reward counts lost seconds; "
            f"penalties: {cost}. Out of time means not at its goal within the "
            f"{horizon:g} s that rollouts look ahead."),
        *(_options(page, one) if one.choices else [tag("p", "It had nothing to choose from.")]),
        _terms(page, one) if any(choice.terms for choice in one.choices) else None,
    ]  # fmt: skip
    if one.ruled_out:
        barred: dict[str, list[str]] = {}
        for action, why in one.ruled_out.items():
            barred.setdefault(action_words(action), []).append(why)
        told = (f"{capital(words)}: {'; '.join(why)}." for words, why in barred.items())
        parts += [tag("p", "Not possible then:"), listed(told)]
    return joined(parts)


def reasons_why(one: Decided) -> str:
    """Return why a decision is examined."""
    return "; ".join(phrase("examined", why) for why in one.why)


def _options(page: Page, one: Decided) -> list[Markup]:
    """Return the options as a table, with what its columns hold."""
    rows = [
        (
            joined((capital(action_words(c.action)), tag("b", " (chosen)") if c.chosen else None)),
            page.notes.figure(c.value),
            _outcomes(page, c),
            page.notes.figure(c.told),
            page.notes.figure(c.time),
            page.notes.figure(c.braking),
            page.notes.figure(c.behind),
        )
        for c in one.choices
    ]
    head = (
        "Option", "Expected reward", "Outcomes: shares of the rollouts",
        "Collision, with the error of the rollouts", "Time to the goal", "Hardest braking",
        "Worse than the chosen one by",
    )  # fmt: skip
    return [tag("div", table(head, rows), class_="wide"), *_kept(page, one)]


def _kept(page: Page, one: Decided) -> list[Markup]:
    """Return why another option was not chosen that came out better, if there is one."""
    if one.kept is None:
        return []
    best = max(one.choices, key=lambda choice: choice.value.value)
    text = (
        f"To {action_words(best.action)} came out better, but by no more than the standard error "
        "of that comparison, ",
        page.notes.figure(one.kept),
        ". Within it, the planner keeps to what the car is doing, unless that is likelier to end "
        "in a collision or off the route.",
    )
    return [tag("p", *text)]


def _outcomes(page: Page, one: Choice) -> Markup:
    told = []
    for name, figure in one.chances.items():
        whom = one.hit.items() if name == "collision" else ()
        hit = [
            joined((f"{page.names.short(vehicle)} ", page.notes.figure(share)))
            for vehicle, share in whom
        ]
        within = joined((" (", joined(hit, ", "), ")")) if hit else None
        told.append(joined((f"{phrase('outcome', name)} ", page.notes.figure(figure), within)))
    return joined(told, ", ")


def _terms(page: Page, one: Decided) -> Markup:
    """Return the terms of the reward, by option."""
    terms = list(dict.fromkeys(term for choice in one.choices for term in choice.terms))
    head = ("Expected cost by term", *(capital(phrase("term", term)) for term in terms))
    rows = (
        (
            capital(action_words(choice.action)),
            *(page.notes.figure(choice.terms.get(term), "0") for term in terms),
        )
        for choice in one.choices
    )
    return tag("div", table(head, rows), class_="wide")


def causes(page: Page) -> Markup:
    """Return what removing or changing others does to decisions."""
    text = (
        "Decisions were planned again, with one thing changed at a time and the beliefs about all "
        "others kept. A change that alters neither plan nor outcome is no cause of them. "
        "Collisions are shares of the rollouts. Planned again are the decision in force, the last "
        "change of what to do next, and the last from which the mishap was avoidable on the route."
    )
    parts = [tag("p", text)]
    for case in page.report.cases:
        parts.append(tag("h3", f"Decision {case.decision} at {case.time:.1f} s "
                         f"({page.by(case.time)})"))  # fmt: skip
        parts += _case(page, case)
    return joined(parts)


def _case(page: Page, case: Cases) -> list[Markup]:
    held = [_holding(page, one) for one in case.held]
    what = tag("p", "Expected to hold this car up under its plan:") if held else tag(
        "p", "Nobody and nothing was expected to hold this car up under its plan."
    )  # fmt: skip
    own = (
        tag("b", "as it was"),
        capital(chain(case.plan)),
        "",
        page.notes.figure(case.reward),
        page.notes.figure(case.collision),
        page.notes.figure(case.braking),
        page.notes.figure(case.arrival),
    )
    head = (
        "Changed", "Plan then", "Decision", "Expected reward", "Collision", "Hardest braking",
        "Time to the goal",
    )  # fmt: skip
    rows = [own, *(_tested(page, one) for one in case.tested)]
    control = [] if case.reproduced is not False else [tag("p", tag("b", OTHER_PROGRAM))]
    changed = tag("div", table(head, rows), class_="wide")
    return [what, *([listed(held)] if held else []), *control, changed]


def _holding(page: Page, one: Holding) -> Markup:
    who = "" if one.vehicle is None else f"{page.names.of(one.vehicle)}, "
    parts: list[Markup | str] = [
        capital(f"{who}{phrase('held', one.how)}: "),
        page.notes.figure(one.expected),
    ]
    parts += [" in the mean, with a probability of ", page.notes.figure(one.share)]
    if one.speeds is not None:
        first, least = (3.6 * speed for speed in one.speeds)
        parts.append(f"; its speed then {first:.0f} km/h, at the lowest {least:.0f} km/h")
    return joined((*parts, "."))


def _tested(page: Page, one: Tested) -> tuple[Markup | str, ...]:
    what = capital(supposed_words(page.names, one.supposed))
    prior = one.supposed.prior
    supposed = joined((what, ", believed ", page.notes.figure(prior))) if prior else joined((what,))
    if one.trace is None:
        return supposed, f"not planned again: {one.refused}", "–", "–", "–", "–", "–"
    return (
        supposed,
        capital(chain(one.plan)),
        "the same" if one.same else tag("b", "another"),
        page.notes.figure(one.reward),
        page.notes.figure(one.collision),
        page.notes.figure(one.braking),
        page.notes.figure(one.time),
    )
