"""The section on from when a mishap could have been avoided, and how."""

from xavi_dialogue.explain.causes.plans.avoidance import LEEWAY, SELDOM
from xavi_dialogue.report.decisions.alternatives import Avoidability, Chance, LightStop, Way
from xavi_dialogue.report.decisions.avoiding import keeps_route
from xavi_dialogue.report.render.markup import Markup, joined, table, tag
from xavi_dialogue.report.render.observations import Page
from xavi_dialogue.report.render.words import action_words, capital, decisions_words, seconds


def avoidance(page: Page) -> Markup:
    """Return from when it could have been avoided, and how."""
    known = page.report.avoidability
    if known is None and page.report.moment.kind == "time":
        return tag("p", "The moment is a time that was asked for. What could have been avoided is "
                   "examined for a moment that is asked for as “collision”, “hardest braking” "
                   "or “red light”.")  # fmt: skip
    if known is None:
        return tag("p", "There was no collision, no hard braking and no stop at a light at this "
                   "moment, so there is nothing to be avoided.")  # fmt: skip
    return joined(
        (
            tag("p", f"Examined is {_mishap(known)} at {known.at:.1f} s, at every decision of the "
                "seconds before. An option is judged by its rollouts, as it was believed then: by "
                f"the {_believed(known)}. ", _rule(known), _more(known)),
            _supposed(page, known),
            tag("p", tag("b", last_chance(known))),
            *(tag("p", text) for text in emergencies(page, known)),
            tag("p", _apart(page)) if known.emergency else None,
            *(() if known.light is None else _light(page, known.light)),
            tag("div", _ways(page, known), class_="wide"),
        )
    )  # fmt: skip


def _supposed(page: Page, known: Avoidability) -> Markup | None:
    """Return from when on the other is supposed to drive on, and how; None if nothing is told."""
    if known.supposed_from is None or known.vehicle is None:
        return None
    who = page.names.of(known.vehicle)
    return tag(
        "p",
        f"The record has {who} up to {known.supposed_from:.1f} s. From then on, “as it really "
        "drove” is a supposition: straight on, for a second with its speed changing as in the "
        "second before, then at a steady speed. So an option whose lines pass it closely after "
        "that time may or may not have touched it.",
    )


def _apart(page: Page) -> str:
    """Return why braking alone and the options end at different times."""
    period = page.report.subject.settings.period
    return (
        f"The two ask different things. Options begin at decisions, which come {period:g} s apart, "
        "are driven as the planner would drive them, and are judged by what was believed of the "
        "others, too. Braking alone is tried from every sample, at one rate, against the other as "
        "it drove, which was not known then. So it may suffice after the last decision with an "
        "option."
    )


def _mishap(known: Avoidability) -> str:
    match known.mishap:
        case "collide":
            return "the collision"
        case "stop":
            return "the stop at the light"
    return f"braking at {known.threshold:g} m/s² or more"


def _believed(known: Avoidability) -> str:
    """Return what it is whose probability an option is judged by."""
    match known.mishap:
        case "collide":
            return "probability of a collision with anybody"
        case "stop":
            return "probability that a light holds the car up"
    return f"probability of braking at {known.threshold:g} m/s² or more"


def _more(known: Avoidability) -> str:
    """Return what is to be said where rollouts were added."""
    if not any(way.planned for chance in known.chances for way in chance.ways):
        return ""
    return (
        " Where an option was tried too seldom, it was planned again with more rollouts, and its "
        "figures are those of all of them: not those that the decision went by."
    )


def _rule(known: Avoidability) -> str:
    """Return from when on an option avoids the mishap."""
    if known.mishap == "collide":
        return (
            "Its lines are also laid against the other as it really drove. "
            "An option avoids it if both give it a probability of at most 25 %."
        )
    does = "a light holds the car up" if known.mishap == "stop" else "its rollouts brake so"
    return (
        f"An option avoids it if {does} with a probability of at most 25 %, "
        "and at least 25 % less often than with what was chosen, and if it collides with nobody "
        "with more than 5 %."
    )


def light_told(page: Page, known: LightStop) -> Markup:
    """Return when the light of a stop turned."""
    turned = "was not seen to turn from green" if known.turned is None else (
        f"turned from green at {seconds(known.turned)}"
    )  # fmt: skip
    again = "was not seen to turn green again" if known.again is None else (
        f"turned green again at {seconds(known.again)}"
    )  # fmt: skip
    text = f"The light of the stop {turned} before the stop, and {again}."
    first = next((one for one in known.passing if one.after is not None), None)
    if first is None:
        return joined((text,))
    return joined(
        (
            f"{text} By distance and time alone, from decision {first.number} on ",
            f"({page.by(first.time)}, ",
            page.notes.figure(first.distance),
            " before the light) a mean speed of at most ",
            page.notes.figure(first.after),
            " would have brought this car there when it was green again.",
        )
    )


def _light(page: Page, known: LightStop) -> list[Markup]:
    """Return when the light turned, and how fast one would have had to drive not to stop."""
    queue = " and ".join(page.names.of(vehicle) for vehicle in known.queue)
    stood = f"Between this car and the light was {queue} then." if queue else (
        "Nobody was between this car and the light on its lane then."
    )  # fmt: skip
    rows = (
        (
            f"D{one.number}, {page.by(one.time)}",
            page.notes.figure(one.distance),
            page.notes.figure(one.speed),
            page.notes.figure(one.limit),
            page.notes.figure(one.before),
            page.notes.figure(one.after),
        )
        for one in known.passing
    )
    head = (
        "Decision", "To the light", "Speed then", "Speed limit",
        "Mean speed to pass before it turned, at least",
        "Mean speed to come when green again, at most",
    )  # fmt: skip
    text = (
        f"{stood} By distance and time alone, so without traffic "
        "ahead and without time to speed up, this car would not have had to stop at these mean "
        "speeds. When a light would turn was not known before it did."
    )
    return [
        tag("p", light_told(page, known)),
        tag("p", text),
        tag("div", table(head, rows, "long"), class_="wide"),
    ]


def last_chance(known: Avoidability) -> str:
    """Return the last decision with a way out."""
    if known.last is None:
        text = "No decision of these seconds had an option that the record shows to avoid it."
        blind = unforeseen(known)
        if blind:
            text += f" {capital(decisions_words(blind))} did not foresee it under the plan chosen."
        return text
    text = f"The last decision with an option that avoids it is {_open_at(known, known.last)}."
    if known.last_on_route not in (None, known.last):
        kept = _open_at(known, known.last_on_route, lost=False)
        text += f" Of those that keep to the route, it is {kept}."
    return text


def unforeseen(known: Avoidability) -> list[int]:
    """Return the decisions whose chosen option did not lead to the mishap by its rollouts."""
    return [
        chance.number
        for chance in known.chances
        if any(way.chosen and way.believed and way.believed.value <= SELDOM for way in chance.ways)
    ]


def _open_at(known: Avoidability, number: int | None, *, lost: bool = True) -> str:
    """Return a decision with the options that avoid the mishap; `lost`: off the route, too."""
    chance = next(one for one in known.chances if one.number == number)
    told = " or ".join(
        f"to {action_words(way.action)}{_cost(way)}"
        for way in chance.ways
        if way.avoids and (lost or keeps_route(way))
    )
    return f"decision {chance.number}, {known.at - chance.time:.1f} s before: {told}"


def _cost(way: Way) -> str:
    return "" if keeps_route(way) else " (off the route to the goal)"


def emergencies(page: Page, known: Avoidability) -> list[Markup]:
    """Return from when braking alone would have avoided a collision."""
    found = []
    for one in known.emergency:
        note = page.notes.ref(one.source)
        if one.latest is None:
            text = (
                f"Apart from the options: braking at {one.rate:g} m/s² from "
                f"{one.looked_from:.1f} s on, or from any later "
                "sample, would not have avoided contact with the other as it drove"
            )
        else:
            text = (
                f"Apart from the options: braking at {one.rate:g} m/s² on its own line, whatever "
                f"the planner would have done, begun at {one.latest:.1f} s "
                f"({one.before:.1f} s before) or earlier, "
                "would have kept this car clear of the other as it drove"
            )
        found.append(joined((text, note, ".")))
    return found


def _ways(page: Page, known: Avoidability) -> Markup:
    crash = known.mishap == "collide"
    rows = [
        _way(page, chance, way, crash=crash)
        for chance in known.chances
        for way in sorted(chance.ways, key=lambda way: not way.chosen)
    ]
    replayed = ("Share of its lines that touch the other as it drove", "Least distance to it")
    of_crash = replayed if crash else ("Probability of a collision, as believed then",)
    until = f" by {known.at + LEEWAY:.1f} s" if known.mishap == "brake" else ""
    believed = f"{capital(_believed(known))}{until}, as believed then"
    braking = "Hardest braking up to the end of the rollouts"
    head = ("Decision", "Option", believed, *of_crash, braking, "Avoids it")
    return table(head, rows, "long")


def _way(page: Page, chance: Chance, way: Way, *, crash: bool) -> tuple[Markup | str, ...]:
    unknown = "not recorded" if way.believed is None else "was not foreseen"
    verdict = unknown if way.avoids is None else tag("b", "yes") if way.avoids else "no"
    name = capital(action_words(way.action)) + _cost(way)
    marks = [
        tag("b", " (chosen)") if way.chosen else None,
        " (more rollouts)" if way.planned else "",
    ]
    figures = [page.notes.figure(way.believed)]
    if crash:
        figures += [page.notes.figure(way.replayed), page.notes.figure(way.clearance)]
    else:
        figures.append(page.notes.figure(way.collision))
    return (
        f"D{chance.number}, {page.by(chance.time)}",
        joined((name, *marks)),
        *figures,
        page.notes.figure(way.braking),
        verdict,
    )
