"""Traffic lights: their colours, their expected changes, and how we passed them, in words."""

from xavi_dialogue.domain.terms import Everyone, Feature, Nobody, Vehicle, Vehicles
from xavi_dialogue.domain.traffic_lights import (
    Crossed,
    Foreseen,
    LightColour,
    LightForeseen,
    LightOdds,
    LightPassed,
    LightTold,
    Shown,
    SupposedOfLight,
    TurnOnRed,
)
from xavi_dialogue.nlg.content.clauses.plan import Plan
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.message import Message, message
from xavi_dialogue.nlg.surface.values import Chance, Moment, Quantity, Who

#: What a light shows, in words.
COLOURS: dict[LightColour, str] = {
    "red": "red", "red-amber": "red and amber", "amber": "amber", "green": "green",
    "flashing": "flashing amber", "off": "off",
}  # fmt: skip
STATED = ("colour", "whether", "claim")  # questions about what it shows
SPENT = 0.75  # [s] minimum duration of a state that is stated
JUST_PASSED = 3.0  # [s] for which a light that we passed is still the one in question
SAVED = 1.0  # [s] minimum difference that matters
AT_ONCE = 0.75  # [s] maximum time between two events that count as simultaneous
CERTAIN = 0.95  # minimum probability of a plan that is stated as certain
EXACT = 2.0  # [s] maximum range of times that is stated as one time
REPLIES = {("whether", True): "yes", ("whether", False): "no", ("claim", True): "right",
           ("claim", False): "wrong", ("seen", True): "yes", ("seen", False): "no",
           ("turn", False): "no"}  # fmt: skip


def plan_light(answer: LightTold, context: SpeechContext) -> Plan:
    """Plan what a light shows or showed."""
    reply = "" if answer.holds is None else REPLIES.get((answer.asked, answer.holds), "")
    if answer.asked == "count":
        return _counted(answer)
    who = None if answer.whose is None else Who(answer.whose)
    others = isinstance(answer.whose, Everyone | Nobody)
    none = {
        "past": answer.past,
        "where": answer.asked == "where",
        "reply": reply,
        "who": who,
        "others": others,
        "around": {None: "", True: "some", False: "none"}[answer.around],
        "own": None if answer.own is None else COLOURS[answer.own.colour],
    }
    if answer.shown is None and answer.passed is None:
        rule = "LIGHT_SEEN" if answer.asked == "seen" and reply else "LIGHT_NONE"
        why = (message("LIGHT_WHY"),) if answer.asked == "why" and who is not None else ()
        return Plan((*why, message(rule, **none)))
    slots = {**shown_slots(answer.shown, answer, context), "reply": reply}
    rules = {"seen": "LIGHT_SEEN", "when": "LIGHT_WHEN", "how-long": "LIGHT_LONG",
             "where": "LIGHT_WHERE", "how-known": "LIGHT_KNOWN", "turn": "LIGHT_TURN"}  # fmt: skip
    core = message(rules.get(answer.asked, "LIGHT_IS"), **slots)
    if answer.asked == "why":
        return Plan((message("LIGHT_WHY"), core))
    yields = answer.shown is not None and answer.shown.gives_way and answer.asked in STATED
    details = (message("LIGHT_YIELD", past=slots["past"]),) if yields else ()
    return Plan((core,), details)


def _counted(answer: LightTold) -> Plan:
    """Plan how many lights we passed, or how many of them showed a colour."""
    last = (answer.crossed or answer.others)[-1:]
    seen = next((one.shown.colour for one in answer.others if one.shown is not None), "")
    slots: dict[str, object] = {
        "count": answer.count or 0,
        "wanted": answer.wanted or "",
        "others": len(answer.others),
        "colour": seen,
        "when": Moment(last[0].time) if last else None,
    }
    return Plan((message("LIGHT_COUNT", **slots),))


def shown_slots(one: Shown | None, answer: LightTold, context: SpeechContext) -> dict[str, object]:
    """Return the slots for what a light showed at the moment asked about."""
    slots: dict[str, object] = {
        "far": None if answer.distance is None else Quantity(answer.distance, "m"),
        "passed": None if answer.passed is None else Moment(answer.passed),
        "behind": _behind(answer, context),
        "wanted": None if answer.wanted is None else COLOURS[answer.wanted],
        "light": Who(Feature("light") if one is None else one.light),
        "past": answer.past,
    }
    if one is None:
        return slots
    at = context.now if answer.time is None or not answer.past else answer.time
    until = context.now if one.end is None else one.end
    spent = (at if answer.asked != "how-long" else until) - one.begin
    over = one.end is not None and one.ended
    gone = one.end is not None and not one.ended
    never = answer.asked == "when" and answer.wanted is not None and one.colour != answer.wanted
    return slots | {
        "colour": COLOURS[one.colour],
        "begun": one.begun,
        "spent": Quantity(spent, "s") if spent >= SPENT else None,
        "lasted": Quantity(max(spent, 0.0), "s"),
        "when": _when(one, answer),
        "until": Moment(until) if over else None,
        "seen": Moment(until) if gone else None,
        "never": never,
        "past": answer.past and (gone or not never),
    }


def _behind(answer: LightTold, context: SpeechContext) -> Moment | None:
    """Return when we passed the light; None for a past state, or within JUST_PASSED of it."""
    passed = None if answer.past else answer.passed
    return None if passed is None or context.now - passed < JUST_PASSED else Moment(passed)


def _when(one: Shown, answer: LightTold) -> Moment | None:
    """Return when the light changed to it; for a past state, the moment asked about."""
    if answer.asked in ("when", "how-long"):
        return Moment(one.begin)
    return None if answer.time is None or not answer.past else Moment(answer.time)


def light_message(one: Shown, context: SpeechContext) -> Message:
    """Return what a light shows or showed as a clause."""
    told = LightTold("colour", one, past=one.end is not None, time=one.end)
    return message("LIGHT_IS", **shown_slots(one, told, context))


def plan_foreseen(answer: LightForeseen, context: SpeechContext) -> Plan:
    """Plan when a light is expected to change: the belief with its range, and its basis."""
    found = answer.foreseen
    reply = {None: "", True: "yes", False: "no"}[answer.holds]
    if answer.stops is not None:
        return _met(answer, answer.stops, reply, context)
    if answer.odds is not None:
        return _odds(answer, answer.odds, reply, context)
    if found is None:
        shown = answer.shown
        colour = None if shown is None else COLOURS[shown.colour]
        light = Who(Feature("light"))
        slots = {"already": shown is not None, "colour": colour, "light": light}
        return Plan((message("LIGHT_EXPECT", unknown=shown is None, reply=reply, **slots),))
    core = message("LIGHT_EXPECT", reply=reply, **_belief(found, answer, context))
    sure = found.middle is not None and _exact(found)
    basis = () if sure else (message("LIGHT_BASIS", cycle=found.cycle),)
    return Plan((core,), basis)


def _odds(answer: LightForeseen, odds: LightOdds, reply: str, context: SpeechContext) -> Plan:
    """Plan how likely a light shows a colour by some moment, and when it is expected to change."""
    core = message(
        "LIGHT_CHANCE",
        reply=reply,
        sure=not 1.0 - CERTAIN < odds.chance < CERTAIN,
        stays=odds.stays,
        light=Who(Feature("light")),
        colour=COLOURS[odds.colour],
        after=Quantity(max(odds.by - context.now, 0.0), "s"),
        chance=Chance(odds.chance),
    )
    found = answer.foreseen
    told = () if found is None else (message("LIGHT_EXPECT", **_belief(found, answer, context)),)
    basis = message("LIGHT_BASIS", cycle=found is not None and found.cycle)
    return Plan((core,), (*told, basis))


def _met(answer: LightForeseen, stops: float, reply: str, context: SpeechContext) -> Plan:
    """Plan whether we have to stop for a light ahead, what it shows, and when it changes."""
    slots: dict[str, object] = {"reply": reply, "chance": Chance(stops)}
    slots |= {"sure": stops >= CERTAIN, "never": stops <= 1.0 - CERTAIN, "likely": stops >= 0.5}
    core = message("LIGHT_MET", light=Who(Feature("light")), **slots)
    shown = () if answer.shown is None else (light_message(answer.shown, context),)
    found = answer.foreseen
    told = () if found is None else (message("LIGHT_EXPECT", **_belief(found, answer, context)),)
    return Plan((core,), (*shown, *told))


def foreseen_message(found: Foreseen, context: SpeechContext) -> Message:
    """Return when a light was expected to change as a clause."""
    past = context.now - found.time > found.horizon / 10.0
    return message("LIGHT_BELIEF", **_belief(found, LightForeseen(found, past=past), context))


def _exact(found: Foreseen) -> bool:
    known = found.low is not None and found.high is not None
    return known and (found.high or 0.0) - (found.low or 0.0) <= EXACT


def _belief(found: Foreseen, answer: LightForeseen, context: SpeechContext) -> dict[str, object]:
    at = found.time if answer.past else context.now

    def until(time: float | None) -> Quantity | None:
        return None if time is None else Quantity(max(time - at, 0.0), "s")

    came = found.came if answer.past else None
    waits = came is None and found.shown.end is None
    return {
        "past": answer.past,
        "light": Who(Feature("light")) if answer.asked == "going" else None,
        "when": Moment(found.time),
        "to": COLOURS[found.to],
        "middle": until(found.middle),
        "low": until(found.low),
        "high": until(found.high),
        "exact": _exact(found),
        "horizon": Quantity(found.horizon, "s"),
        "odds": Chance(found.chance) if found.chance > 0.0 else None,
        "came": None if came is None else Quantity(came - found.time, "s"),
        "soon": came is not None and came - found.time < AT_ONCE,
        "waited": answer.past and waits,
    }


def plan_passed(answer: LightPassed, context: SpeechContext) -> Plan:
    """Plan how we passed a light, compared with the claim or question about it."""
    why, claim = answer.asked == "why", answer.asked == "claim"
    reply = {None: "", True: "yes", False: "no"}[answer.holds]
    red = answer.claimed in ("red", "red-amber")
    if answer.holds and red:
        reply = "owned"
    slots: dict[str, object] = {"reply": reply, "why": why, "claim": claim}
    slots["wanted"] = None if answer.claimed is None else COLOURS[answer.claimed]
    if answer.crossed is None:
        colour = None if answer.ahead is None else COLOURS[answer.ahead.colour]
        return Plan((message("LIGHT_PASSED", none=True, colour=colour, **slots),))
    core = message("LIGHT_PASSED", **slots, **crossed_slots(answer.crossed))
    amber = answer.crossed.shown is not None and answer.crossed.shown.colour == "amber"
    details = (message("PASSED_AMBER"),) if amber and answer.crossed.late else ()
    return Plan((core,), details)


def crossed_slots(one: Crossed) -> dict[str, object]:
    """Return the slots of how we passed a line."""
    spent = one.since if one.since is not None and one.since >= SPENT else None
    return {
        "unseen": one.shown is None,
        "colour": None if one.shown is None else COLOURS[one.shown.colour],
        "begun": one.shown is not None and one.shown.begun,
        "spent": None if spent is None else Quantity(spent, "s"),
        "when": Moment(one.time),
        "speed": Quantity(one.speed, "m/s"),
    }


def plan_supposed_light(answer: SupposedOfLight, context: SpeechContext) -> Plan:
    """Plan what we would have done if a light had shown something else."""
    late = context.now if answer.passed is None else answer.passed
    saved = None if answer.passing is None else late - answer.passing
    gained = saved is not None and saved >= SAVED
    slots = {
        "already": not answer.past and answer.shown.colour == answer.supposed == "green",
        "light": Who(answer.shown.light),
        "same": answer.same,
        "waits": answer.waits,
        "first": _those(answer.first, context.now),
        "standing": answer.standing,
        "reply": {None: "", True: "yes", False: "no"}[answer.holds],
        "past": answer.past,
        "faster": answer.faster and answer.past,
        "passing": None if answer.passing is None else Moment(answer.passing),
        "saved": Quantity(saved or 0.0, "s") if gained and answer.passed is not None else None,
        "lost": gained and answer.passed is None,
        "unknown": answer.amount and answer.passed is None and not gained,
    }
    return Plan((message("LIGHT_IF", **slots),))


def _those(vehicles: tuple[int, ...], time: float) -> Who | None:
    if not vehicles:
        return None
    return Who(Vehicles(vehicles) if vehicles[1:] else Vehicle(vehicles[0]), time)


def plan_turn_on_red(answer: TurnOnRed, context: SpeechContext) -> Plan:
    """Plan why we do not turn on red."""
    one = answer.shown
    slots = {
        "none": one is None,
        "other": answer.way is not None and answer.way != answer.asked,
        "turning": one is not None and one.turning,
        "colour": None if one is None else COLOURS[one.colour],
        "asked": answer.asked,
        "way": answer.way,
    }
    return Plan((message("TURN_ON_RED", **slots),))
