"""What must hold in every run of the simulated world."""

from collections import Counter
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import msgspec

from tests.simulated.network import Served
from tests.simulated.parts import PLANNED, SECRET, STORE, Person
from xavi_dialogue.bus.errors import MessageError
from xavi_dialogue.bus.interface import NoAnswer, Refused, TooLate
from xavi_dialogue.bus.messages import AskRequest, PastTurn, unpack
from xavi_dialogue.service.ownership import digest
from xavi_dialogue.service.responder import AGAIN, MAX_SENT, PASSING

if TYPE_CHECKING:
    from tests.simulated.network import Asked
    from tests.simulated.world import World

DISK = frozenset(("full", "failing", "locked", "read"))  # faults of the disk
SLACK = 0.15  # [s] one step of an answer may take that long after its deadline
WINDOW = 2.0  # [s] after which what was said is flushed, however busy the service is


def at_rest(world: "World") -> list[str]:
    """Return what is wrong once everything has come to rest."""
    found = [*_requests(world), *_transcripts(world), *_bounds(world), *_dashboard(world)]
    found += world.network.forbidden
    for (_, ride), times in world.rides.items():
        if times > 1:
            found.append(f"a service began the record of ride {ride} {times} times")
    for person in world.erased:
        found += left_of(world, person)
    return found


def _promised(served: Served) -> float:
    """Return in how many seconds a request has to end.

    A question names its deadline, even one of somebody who does not wait as long.
    """
    try:
        return max(served.timeout, unpack(served.payload, AskRequest).deadline_ms / 1000.0)
    except MessageError:
        return served.timeout


def _requests(world: "World") -> Iterator[str]:
    """Each request gets exactly one reply or refusal, by its deadline."""
    now = world.scheduler.now
    for served in world.network.served:
        tail = served.key.split("/", 3)[-1]
        where = f"{tail} that came to {served.server.name} at {served.came:.2f} s"
        if len(served.ends) > 1:
            yield f"{where} was ended {len(served.ends)} times"
        stalled = served.server.stalled > served.came
        if served.ends:
            took = served.ends[0][0] - served.came
            if took > _promised(served) + SLACK and not stalled:
                yield f"{where} was ended after {took:.2f} s"
        elif served.server.alive and now > served.came + served.timeout + SLACK:
            yield f"{where} was never ended"
    for asked in world.network.asked:
        tail = asked.key.split("/", 3)[-1]
        where = f"{tail} of {asked.asker.name} at {asked.sent:.2f} s"
        if not asked.outcomes:
            if asked.asker.alive and now > asked.sent + asked.timeout + SLACK:
                yield f"{where} has no outcome"
            continue
        _, outcome = asked.outcomes[0]
        late = isinstance(outcome, TooLate) and not asked.troubled
        if late and not _bad_weather(world) and not _slowly_planned(world, asked):
            yield f"{where} got no answer, though nothing had failed"


def _bad_weather(world: "World") -> bool:
    kinds = {fault.kind for fault in world.plan.faults}
    return bool(kinds & {"loss", "stall", "delay", "disorder"})


def _slowly_planned(world: "World", asked: "Asked") -> bool:
    """Check whether planning again took too long: the car says so when time is over.

    An earlier plan of the same question may have left no time for this one.
    """
    return asked.key.endswith("@rpc/whatif") and (
        asked.timeout < PLANNED[1] + SLACK
        or any(
            fault.kind == "planner" and fault.at <= asked.sent <= fault.at + fault.lasts
            for fault in world.plan.faults
        )
    )


def _transcripts(world: "World") -> Iterator[str]:
    """No turn that was shown is lost or changed, and all are those of a run without faults."""
    world.transcripts = {}
    _excuse(world)
    for person in world.people:
        turns = [t for t in world.stored(person.session) if t.reply.reason not in PASSING]
        if person.session not in world.exempt:  # else a stranger may have begun it anew
            yield from _once(person, turns)
        yield from _names(world, person)
        told = tuple((turn.text, msgspec.json.encode(_timeless(turn)).decode()) for turn in turns)
        world.transcripts[person.session] = told
        if person.forgotten is not None:
            if told:
                yield f"{person.session} was erased, and has {len(told)} turns"
            continue
        yield from _kept(world, person, turns)
        if person.session in world.exempt or person.unsure or not world.plan.faults:
            continue
        yield from _same(world, person, told)


def _once(person: Person, turns: list[Any]) -> Iterator[str]:
    """A question is answered no more often than it was asked, whatever was lost or came twice."""
    asked: Counter[str] = Counter()
    for number, times in person.asks.items():
        asked[person.script[number][1]] += times
    for text, times in Counter(turn.text for turn in turns).items():
        if times > asked[text]:
            yield f"{person.session} has {times} turns of {text!r}, asked {asked[text]} times"


def _names(world: "World", person: Person) -> Iterator[str]:
    """A question that is sent again keeps its name: by that the service knows it."""
    sent = {
        question["request"]
        for asked, question in _questions(world)
        if asked.asker.machine == person.machine
    }
    times = sum(person.asks.values())
    if len(sent) > times:
        yield f"{person.machine} asked {times} times, under {len(sent)} names"


def _excuse(world: "World") -> None:
    """Note whose answers lack a plan or a report, as they say themselves."""
    failed = [
        asked
        for asked in world.network.asked
        if asked.key.endswith("@rpc/whatif") and asked.outcomes and _failed(asked.outcomes[0][1])
    ]
    whose = {asked["request"]: asked["session"] for _, asked in _questions(world)}
    named = [msgspec.json.decode(asked.payload)["request"] for asked in failed]
    # It may have been given up by the service before, or after by the passenger.
    sessions = [whose[request] for request in named if request in whose]
    times = [asked.outcomes[0][0] for asked in failed]
    for session in (*sessions, *_asked_within(world, [(when, when) for when in times])):
        world.exempt.setdefault(session, "a decision could not be planned again")
    for session in _repeated_over_a_jump(world):
        world.exempt.setdefault(session, "the service's clock jumped while a request was repeated")
    if {fault.kind for fault in world.plan.faults} & {"apart", "stall", "crash", "stored", "power"}:
        for session in _asked_within(world, world.gaps):
            world.exempt.setdefault(session, "reports were lost")


def _repeated_over_a_jump(world: "World") -> Iterator[str]:
    """Yield the sessions of requests that were repeated too late, by the service's clock."""
    jumps = [
        fault.at
        for fault in world.plan.faults
        if fault.kind == "clock" and fault.machine == "hub" and abs(fault.amount) >= AGAIN
    ]
    first: dict[str, float] = {}
    for asked, question in _questions(world):
        began = first.setdefault(question["request"], asked.sent)
        if any(began <= jump <= asked.sent for jump in jumps):
            yield question["session"]


def _asked_within(world: "World", gaps: list[tuple[float, float]]) -> Iterator[str]:
    """Yield the sessions that had a question open in one of these times [s]."""
    for asked, question in _questions(world):
        end = asked.outcomes[0][0] if asked.outcomes else world.scheduler.now
        if any(asked.sent <= until and since <= end for since, until in gaps):
            yield question["session"]


def _questions(world: "World") -> Iterator[tuple["Asked", dict[str, Any]]]:
    """Yield the questions that were sent, with what each says."""
    for asked in world.network.asked:
        if asked.key.endswith("@rpc/ask"):
            yield asked, msgspec.json.decode(asked.payload)


def _failed(outcome: object) -> bool:
    """Check whether a decision was not planned again, otherwise than when it was recorded."""
    if isinstance(outcome, Refused):
        return b"as it was recorded" not in outcome.payload
    return isinstance(outcome, NoAnswer)


def _timeless(turn: Any) -> PastTurn:
    return PastTurn(turn.text, msgspec.structs.replace(turn.reply, timing_ms=None))


def _kept(world: "World", person: Person, turns: list[Any]) -> Iterator[str]:
    if person.session in world.exempt:
        return
    stored = iter([(turn.text, turn.reply.text) for turn in turns])
    for text, reply, when in person.shown:
        if not any(one == (text, reply) for one in stored):
            yield (
                f"{person.session}: what was shown at {when:.2f} s is lost or changed:"
                f" {text!r}: {reply!r}"
            )
            return


def _same(world: "World", person: Person, told: tuple[tuple[str, str], ...]) -> Iterator[str]:
    from tests.simulated.world import right

    faultless = right(world.plan.story)
    wanted = faultless["phone" if person.session == "fresh" else person.session]
    # Asked about a moment between two decisions, the later one tells more where it has arrived.
    later = faultless["fresh"] if person.session in ("phone", "fresh") else wanted
    pairs = zip(wanted, later, strict=True)
    if len(told) == len(wanted) and all(a in b for a, b in zip(told, pairs, strict=True)):
        return
    repeated = sum(person.asks.values()) - len(person.asks)
    if len(told) > len(wanted) + repeated:
        yield f"{person.session} was answered {len(told)} times to {len(wanted)} questions"
    elif len(told) > len(wanted):
        world.exempt[person.session] = "a question was repeated and answered twice"
    else:
        k = next(
            (k for k, (a, b) in enumerate(zip(told, wanted, strict=False)) if a != b), len(told)
        )
        got = told[k] if k < len(told) else None
        yield f"{person.session} differs in turn {k}: {_difference(got, wanted[k])}"


def _difference(got: tuple[str, str] | None, wanted: tuple[str, str]) -> str:
    """Say briefly in what two turns differ."""
    if got is None:
        return f"{wanted[0]!r} is missing"
    one, other = (msgspec.json.decode(turn[1])["reply"] for turn in (got, wanted))
    if one["text"] != other["text"] or got[0] != wanted[0]:
        return f"{got[0]!r}: {one['text']!r}, not {wanted[0]!r}: {other['text']!r}"
    return f"{got[0]!r}: {'; '.join(_paths(one, other, ''))[:400]}"


def _paths(one: Any, other: Any, path: str) -> Iterator[str]:
    """Yield where two documents differ."""
    if isinstance(one, dict) and isinstance(other, dict):
        for name in sorted({*one, *other}):
            yield from _paths(one.get(name), other.get(name), f"{path}.{name}")
    elif isinstance(one, list) and isinstance(other, list) and len(one) == len(other):
        for k, (a, b) in enumerate(zip(one, other, strict=True)):
            yield from _paths(a, b, f"{path}[{k}]")
    elif one != other:
        yield f"{path} is {str(one)[:150]}, not {str(other)[:150]}"


def faults_of(world: "World") -> list[str]:
    """Return what a service says of its own faults."""
    faults = 0.0 if world.service is None else world.service.alive.counted("faults")
    return [f"the service counts {faults:g} internal errors"] if faults else []


def _bounds(world: "World") -> Iterator[str]:
    """Nothing is left over, and nothing grows."""
    service, memory = world.service, world.memory
    if service is None or memory is None:
        yield "there is no service in the end"
        return
    yield from faults_of(world)
    handler = service.handler
    sizes = {
        "open questions": handler.waiting(),
        "questions in turn": handler.ready(),
        "messages in the inbox": service._inbox.qsize(),
        "bytes of reports": service._held,
        "turns that wait for the disk": len(memory._missed),
        "sessions to be erased": len(memory._unforgotten),
        "writes that are not flushed": int(memory._unsynced),
        "erased data in the files": int(memory._unpurged),
        "replies beyond the limit": max(len(service._responder.sent) - MAX_SENT, 0),
        "plans that questions wait for": sum(
            len(waiting) for v in handler.all_vehicles() for waiting in v._planning.values()
        ),
        "reports that wait for their turn": sum(
            len(v.reports.traces.held) + len(v.reports.events.held)
            for v in handler.all_vehicles()
            if v.reports is not None
        ),
        "outcomes outstanding": sum(
            not asked.outcomes and asked.asker.alive and asked.sent < world.scheduler.now - 15.0
            for asked in world.network.asked
        ),
    }
    for name, size in sizes.items():
        if size:
            yield f"at rest there are {size} {name}"
    for vehicle in handler.all_vehicles():
        if len(vehicle.scheduler._deadlines) > len(vehicle.scheduler.open) + 200:
            yield "the deadlines of finished questions are kept"
    if world.network.hub is not None and not world.network.hub.alive:
        yield "there is no hub in the end"


def _dashboard(world: "World") -> Iterator[str]:
    """The dashboard shows the ride and the conversation as they were."""
    controller, browsers = world.controller, world.browsers
    starter = world.starters["desk"]
    if controller is None or starter.process is None or not starter.process.alive:
        return
    turns = [(turn.text, turn.reply.text) for turn in controller.conversation.turns]
    stored = [(turn.text, turn.reply.text) for turn in world.stored("desk")]
    owner = world.owner("desk")
    lost = "desk" in world.exempt and owner != digest(world.people[2].token)
    if lost and owner is not None:  # somebody else has begun it anew
        stored = []
    # What was begun anew without a token is open to all, who may erase it at any moment.
    anybodys = lost and owner is None
    if not anybodys and (turns != stored[-len(turns) :] or (stored and not turns)):
        yield f"the dashboard shows {turns}, stored are {stored}"
    for one in world.dashboards:
        if one.begun_anew > 1 and "desk" not in world.exempt:
            yield f"a browser was told {one.begun_anew} times to show the conversation anew"
    for request, answers in browsers.answers.items():
        if len(answers) != 1:
            yield f"the browser's question {request} was answered {len(answers)} times"


def power_cut(world: "World", person: Person, before: list[Any], flushed: float) -> None:
    """Check that a power cut took nothing that had been flushed, nor what had long been shown."""
    after = world.stored(person.session)
    if person.forgotten is None and not before:
        return  # nothing was there, or an erasure that was not confirmed yet is undone
    if after != before[: len(after)]:
        world.problems.append(f"{person.session}: a power cut changed what was stored")
    lost = [(turn.text, turn.reply.text) for turn in before[len(after) :]]
    if not lost:
        return
    world.exempt[person.session] = "a power cut took what was not flushed"
    for text, reply, when in person.shown:
        if (text, reply) in lost and when < flushed:
            world.problems.append(f"{person.session}: {text!r} was lost after it was flushed")
        elif (text, reply) in lost and _quiet(world, when, flushed):
            world.problems.append(
                f"{person.session}: {text!r} was shown at {when:.2f} s and not flushed"
                f" by {world.scheduler.now:.2f} s"
            )


def _quiet(world: "World", when: float, flushed: float) -> bool:
    """Check whether there was time to flush what was shown at a time [s]."""
    now = world.scheduler.now
    troubled = any(
        fault.kind in DISK | {"stall"} and fault.at <= now and fault.at + fault.lasts >= when
        for fault in world.plan.faults
    )
    return now - when > WINDOW and not troubled


def left_of(world: "World", person: Person) -> list[str]:
    """Return what is left of a session that was erased: in the files, and in memory."""
    found = []
    volume = world.disk.volume(STORE)
    for word in (SECRET, person.session):
        if word.encode() in volume.contents():
            found.append(f"{word!r} is still in the files after it was erased")
    service = world.service
    if service is not None and world.memory is not None:
        vehicles = service.handler.all_vehicles()
        held = {
            "replies to repeat": [name for name, _ in service._responder.sent],
            "owners": [*service.handler.owners.known],
            "turns": [name for vehicle in vehicles for name in vehicle.past],
            "conversations": [name for vehicle in vehicles for name in vehicle.dialogue.sessions],
            "questions": [name for vehicle in vehicles for name, _ in vehicle.scheduler.open],
            "turns to be stored": [getattr(one, "session", "") for one in world.memory._missed],
        }
        for where, names in held.items():
            if person.session in names:
                found.append(f"{person.session} is among the {where} after it was erased")
    return found
