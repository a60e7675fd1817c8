"""Referring expressions: words for road users and things.

After the incremental algorithm of Dale and Reiter (1995): kind, colour and place are added in
the order in which passengers notice them. The number on the screen is added at the first mention,
or if the description fits others too. A description is true at the time that is discussed.
"""

from dataclasses import dataclass, field

from planner.record.trace import ON_FOOT
from xavi_dialogue.domain.facts import Look
from xavi_dialogue.domain.terms import (
    Described,
    Destination,
    Ego,
    Everyone,
    Exit,
    Feature,
    Junction,
    Lane,
    Nobody,
    Passenger,
    Pronoun,
    Record,
    Related,
    Road,
    Thing,
    Unknown,
    Vehicle,
    Vehicles,
    Wanted,
)
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.ordinals import ordinal
from xavi_dialogue.nlg.surface.quantities import number, plural
from xavi_dialogue.nlg.surface.tables import word
from xavi_dialogue.nlg.surface.values import Number, Who

RECENT = 2.0  # [s] maximum age of what counts as now
FEATURES = {"light": "the traffic light", "sign": "the sign", "crossing": "the crossing",
            "curb": "the kerb", "parking": "the parking place", "building": "the building",
            "line": "the line", "bend": "the bend", "queue": "the queue", "space": "the space",
            "way": "the way", "obstacle": "the obstacle",
            "headlight": "the headlights", "blind": "the blind corner"}  # fmt: skip


#: People on foot are not "it"; as a subject, "they" would mean several.
_PERSONAL = {"object": "them", "possessive": "their"}
MANY = 5  # maximum of vehicles that are named one by one
COUNTED = 3  # minimum of people that are counted rather than named


@dataclass(slots=True)
class ReferringContext:
    """The situation of the wording, and the vehicles that have been named so far, in order."""

    context: SpeechContext
    mentioned: list[int] = field(default_factory=list)
    lit: bool = False  # a traffic light was named
    passenger: bool = False  # the words are the passenger's own: "you" rather than "I"

    def refer(self, who: Who, form: str) -> str:
        """Return the words for a road user or a thing, and remember that it was named."""
        thing = who.thing
        if isinstance(thing, Ego):
            words = _ego(who, form)
            return {"I": "you", "my": "your"}.get(words, words) if self.passenger else words
        if isinstance(thing, Vehicle):
            return self._vehicle(thing.number, who, form)
        if isinstance(thing, Feature) and thing.kind == "light":
            self.lit = True  # "it" may mean the light from here on
        if isinstance(thing, Vehicles) and (people := self._people(thing, who)):
            return _owned(people, form)
        if isinstance(thing, Vehicles) and len(thing.numbers) > MANY:
            if {*thing.numbers} <= {*self.mentioned, *self.context.named}:
                return {"object": "them", "possessive": "their"}.get(form, "they")
            return _owned(self._counted(thing, who), form)
        if isinstance(thing, Vehicles):
            parts = [self._vehicle(v, who, "full") for v in thing.numbers]
            return _owned(listed(parts), form)
        return _owned(self._other(thing, form), form)

    def _vehicle(self, vehicle: int, who: Who, form: str) -> str:
        alone = self.mentioned == [vehicle] and not self.lit
        if form != "full" and not who.indefinite and alone:
            if self.on_foot(Vehicle(vehicle), who):
                return _PERSONAL.get(form) or self._named(vehicle, who)
            return "its" if form == "possessive" else "it"
        return _owned(self._named(vehicle, who), form)

    def on_foot(self, vehicle: Vehicle, who: Who) -> bool:
        """Check whether a vehicle is somebody on foot, and is to be called that."""
        look = self.context.look(vehicle.number, who.time)
        return look is not None and look.kind in ON_FOOT and self.context.style != "paper"

    def _people(self, several: Vehicles, who: Who) -> str:
        """Return people on foot as a number; "" for fewer than three, or with others among them."""
        looks = [self.context.look(v, who.time) for v in several.numbers]
        kinds = {look.kind for look in looks if look is not None and look.kind in ON_FOOT}
        if len(looks) < COUNTED or len(kinds) != 1 or self.context.style == "paper":
            return ""
        if any(look is None or look.kind not in kinds for look in looks):
            return ""
        self.mentioned += [v for v in several.numbers if v not in self.mentioned]
        return f"the {number(Number(len(looks), word('vehicles', 'kind', kinds.pop())))}"

    def _counted(self, several: Vehicles, who: Who) -> str:
        """Return how many vehicles there are, by their kind if it is the same."""
        looks = [self.context.look(v, who.time) for v in several.numbers]
        kinds = {"vehicle" if look is None else look.kind for look in looks}
        kind = kinds.pop() if len(kinds) == 1 else "vehicle"
        return number(Number(len(looks), word("vehicles", "kind", kind)))

    def _named(self, vehicle: int, who: Who) -> str:
        look = self.context.look(vehicle, who.time) or self.context.look(vehicle)
        label = f"vehicle {vehicle}"
        again = vehicle in self.mentioned
        if not again:
            self.mentioned.append(vehicle)
        if look is None or self.context.style == "paper":
            return label
        unique = look.alone and look.colour is not None and who.coloured and who.kinded
        if again and look.kind in ON_FOOT:
            people = [v for v in self.mentioned if self.on_foot(Vehicle(v), who)]
            return f"the {_head(look, who)}" + ("" if people == [vehicle] else f" ({label})")
        if again:
            return f"the {_head(look, who)}" if unique else label
        if vehicle in self.context.named and unique and not who.indefinite:
            return f"the {_head(look, who)}"
        article = _article(_head(look, who)) if who.indefinite else "the"
        place = self._place(look, who) if who.placed and not self._brief(vehicle) else ""
        return " ".join(f"{article} {_head(look, who)} {place} ({label})".split())

    def _brief(self, vehicle: int) -> bool:
        """Check whether the number is enough, because the vehicle was described before."""
        return vehicle in self.context.named

    def _place(self, look: Look, who: Who) -> str:
        """Return the place of a vehicle: where it is now, or was at the time discussed."""
        now = self.context.now
        if not look.in_view:
            return "that I saw last " + word("vehicles", "place", look.bearing)
        today = self.context.look(look.vehicle)
        seen = today is not None and today.in_view
        if who.time is None or now - who.time <= RECENT:
            return word("vehicles", "place", today.bearing if today and seen else look.bearing)
        if today is not None and seen and today.bearing == look.bearing:
            return word("vehicles", "place", look.bearing)
        return word("vehicles", "was", look.bearing)

    def _other(self, thing: Thing, form: str) -> str:
        match thing:
            case Described():
                return _described(thing, self)
            case Junction():
                return _junction(thing, self.context.now)
            case Exit():
                return _exit(thing)
            case Lane():
                return _lane(thing, self)
            case Road():
                return _ROADS[thing.which]
            case Feature(kind="light", colour=str(colour)):
                return f"the {colour} light"
            case Feature():
                return FEATURES[thing.kind]
        return _named_thing(thing, form)


def _ego(who: Who, form: str) -> str:
    if form == "possessive":
        return "our" if who.ride else "my"
    if form in ("object", "us"):
        return "us"
    return "we" if who.ride or form == "we" else "I"


def _owned(words: str, form: str) -> str:
    if form != "possessive":
        return words
    return f"{words}'" if words.endswith("s") else f"{words}'s"


def noun(look: Look) -> str:
    """Return the noun for the kind of a vehicle."""
    return word("vehicles", "kind", look.kind)


def described(look: Look) -> str:
    """Describe a vehicle as it is seen, without its number: "the blue car ahead of us"."""
    head = " ".join(part for part in (look.colour, noun(look)) if part)
    return f"the {head} {word('vehicles', 'place', look.bearing)}"


def _head(look: Look, who: Who) -> str:
    kind = noun(look) if who.kinded else "vehicle"
    return f"{look.colour} {kind}" if look.colour and who.coloured else kind


def _article(head: str) -> str:
    return "an" if head[:1] in "aeiou" else "a"


def _described(thing: Described, speaker: ReferringContext) -> str:
    kind = word("vehicles", "kind", thing.kind)
    head = " ".join(part for part in (thing.size, thing.colour, kind) if part)
    place = _place_of(thing, speaker)
    if thing.plural:
        head = plural(head)
    counted = number(Number(thing.number, ""), "word") if thing.number and thing.plural else ""
    order = ordinal(thing.rank) if thing.rank is not None else thing.extreme or ""
    other = "other" if thing.other else ""
    if not thing.definite:
        if thing.other:
            return " ".join(f"another {head} {place}".split())
        lead = "any" if thing.plural else _article(head)
        return " ".join(f"{lead} {counted} {head} {place}".split())
    return " ".join(f"the {counted} {order} {other} {head} {place}".split())


def _place_of(thing: Described, speaker: ReferringContext) -> str:
    if thing.bearing is not None:
        place = word("vehicles", "place", thing.bearing)
        if thing.of is not None and not isinstance(thing.of, Ego):
            return place.replace(" us", " " + speaker.refer(Who(thing.of), "object"))
        return place
    if thing.origin is not None:
        return word("vehicles", "was", thing.origin)
    such = thing.such
    if isinstance(such, Related) and such.relation == "in-the-way-of" and such.to == Ego():
        return "in our way"
    return ""


def _junction(thing: Junction, now: float) -> str:
    if thing.rank == -1:
        return f"the last {thing.form}"
    if thing.rank == 1 and (thing.time is None or thing.time > now):
        return f"the next {thing.form}"
    if thing.rank is not None and thing.rank > 1:
        return f"the {ordinal(thing.rank)} {thing.form} from here"
    return f"the {thing.form}"


def _exit(thing: Exit) -> str:
    if thing.rank is not None:
        return f"the {ordinal(thing.rank)} exit"
    if thing.side in ("left", "right"):
        return f"the exit on the {thing.side}"
    return "the exit straight on" if thing.side else "the exit"


_ROADS = {"own": "our road", "side": "the side road", "main": "the main road",
          "left": "the road on the left", "right": "the road on the right",
          "fitting": "the right road", "wrong": "the wrong road", "any": "a road"}  # fmt: skip


def _lane(thing: Lane, speaker: ReferringContext) -> str:
    if thing.which == "own":
        owner = "our" if thing.of is None else speaker.refer(Who(thing.of, ride=True), "possessive")
        return f"{owner} lane"
    if thing.which == "any":
        return "a lane"
    return f"the {thing.which} lane"


def _named_thing(thing: Thing, form: str) -> str:
    match thing:
        case Destination():
            return "our destination"
        case Nobody():
            return "nobody"
        case Everyone():
            return "everybody" if thing.kind == "vehicle" else f"all {plural(thing.kind)}"
        case Wanted():
            return "who" if thing.kind == "vehicle" else f"which {thing.kind}"
        case Passenger():
            return "you"
        case Record():
            return "the record of this ride"
        case Unknown():
            return f'"{thing.words}"'
        case Pronoun():
            objects = {"he": "him", "she": "her", "they": "them"} if form == "object" else {}
            return {"them-all": "them", **objects}.get(thing.form, thing.form)
    return "it"


def listed(parts: list[str], last: str = "and") -> str:
    """Return the parts as a list in words: a, b and c."""
    if len(parts) < 2:
        return "".join(parts)
    return f"{', '.join(parts[:-1])} {last} {parts[-1]}"
