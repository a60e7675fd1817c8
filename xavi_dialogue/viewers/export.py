"""`xavi export`: a ride as an MCAP file that viewers show.

All log times are those of the ride, which begins at 0.
"""

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from importlib import resources
from pathlib import Path

from xavi_dialogue import __version__
from xavi_dialogue.dashboard.views.labels import event_words, plan_words
from xavi_dialogue.library.answers import Answer
from xavi_dialogue.library.decisions import Decision
from xavi_dialogue.library.ride import Ride
from xavi_dialogue.storage import ride_file
from xavi_dialogue.storage.mcap_file import McapWriter
from xavi_dialogue.storage.recording_format import EXPORT, Entry, FileThere, Unwritable
from xavi_dialogue.viewers import drawing, messages, motion, recorded, roads
from xavi_dialogue.viewers.messages import Message, form, stamp

LAYOUT = "layout.json"
RECORDING = ".mcap"
CAUTION = ("collided", "gave-way", "stopped-at-light")  # events that are warnings

#: The topics, all but our own.
ROADS, VEHICLES, LIGHTS = "/roads", "/vehicles", "/lights"
PLAN, BELIEFS, GHOST, LOG = "/plan", "/beliefs", "/ghost", "/log"
FRAMES, ODOMETRY = "/tf", "/odometry"


@dataclass(frozen=True, slots=True)
class ExportOptions:
    """Options of an export."""

    source: Path  # of the ride
    target: Path
    questions: Sequence[str] = ()
    at: float | None = None  # [s] when they are asked
    overwrite: bool = False
    layout: Path | None = None  # file for the layout of panels


@dataclass
class _Export:
    """The messages of a file that is being made."""

    made: list[tuple[float, str, Message | Entry]] = field(default_factory=list)

    def put(self, topic: str, time: float, message: Message | Entry) -> None:
        """Add a message."""
        self.made.append((time, topic, message))

    def say(self, time: float, source: str, text: str, *, warning: bool = False) -> None:
        """Add a line of the log."""
        self.put(LOG, time, messages.note(time, source, text, warning=warning))

    def write(self, file: McapWriter) -> dict[str, int]:
        """Write all in order of time, and return the number of messages by topic."""
        for time, topic, message in sorted(self.made, key=lambda one: one[0]):
            if isinstance(message, Entry):
                file.add(message)
            else:
                file.add_other(topic, form(message), messages.encode(message), stamp(time))
        return dict(sorted(Counter(topic for _, topic, _ in self.made).items()))


@dataclass(frozen=True, slots=True)
class Exported:
    """What an export wrote."""

    messages: dict[str, int]  # their number by topic
    answers: tuple[Answer, ...]  # to the questions; not each has a ghost


def export(ride: Ride, options: ExportOptions) -> Exported:
    """Write a ride for viewers.

    Raises:
        XaviError: the files cannot be written, or are one; or a question cannot be asked.
    """
    _check_apart(options)
    answers = tuple(ride.ask(question, options.at) for question in options.questions)
    out = _Export()
    if ride.network is not None:
        surface = messages.entity("roads", 0.0, roads.drawn(ride.network))
        out.put(ROADS, 0.0, messages.scene((surface,)))
    _scenes(out, ride, answers)
    _decisions(out, ride.decisions)
    _log(out, ride, answers)
    with McapWriter(options.target, __version__, overwrite=options.overwrite) as file:
        file.describe("xavi.ride", {"scenario": ride.scenario, "seed": str(ride.seed)})
        file.describe(EXPORT, {"for": "viewers"})
        if options.source.suffix == RECORDING:
            _copy(out, file, options.source, ride)
        counts = out.write(file)
    if options.layout is not None:
        write_layout(options.layout, overwrite=options.overwrite)
    return Exported(counts, answers)


def _check_apart(options: ExportOptions) -> None:
    """Check that no file is written over the ride, or over another one of the export."""
    written = {options.target.resolve(), *([options.layout.resolve()] if options.layout else ())}
    source = ride_file.named(options.source) if not options.source.is_file() else options.source
    if source.resolve() in written:
        raise Unwritable(f"{source} is the ride itself; give another file to write")
    if options.layout is not None and len(written) == 1:
        raise Unwritable(f"{options.layout} is the ride's file; give another one for the layout")


def write_layout(path: Path, *, overwrite: bool = False) -> None:
    """Write the layout of panels that viewers import.

    Raises:
        FileThere: there is a file, and it must not be overwritten.
        Unwritable: it cannot be written.
    """
    try:
        with path.open("wb" if overwrite else "xb") as file:
            file.write(layout())
    except FileExistsError:
        raise FileThere(f"{path} is there already; --force overwrites it") from None
    except OSError as error:
        raise Unwritable(f"cannot write {path}: {error.strerror}") from error


def layout() -> bytes:
    """Return the layout of panels."""
    return resources.files("xavi_dialogue.viewers").joinpath(LAYOUT).read_bytes()


def _scenes(out: _Export, ride: Ride, answers: Sequence[Answer]) -> None:
    before = None
    for scene in motion.scenes(ride):
        time = scene.time
        out.put(FRAMES, time, drawing.own_frame(scene))
        out.put(ODOMETRY, time, drawing.odometry(scene))
        out.put(VEHICLES, time, drawing.vehicles(scene, before))
        if ride.network is not None and (scene.lights or (before and before.lights)):
            out.put(LIGHTS, time, drawing.lights(scene, ride.network, before))
        for answer in answers:
            if answer.ghost is not None:
                name = f"instead: {answer.question}"
                out.put(GHOST, time, drawing.ghost(name, answer.ghost, time, scene.ego))
        before = scene


def _decisions(out: _Export, decisions: Iterable[Decision]) -> None:
    before = None
    for decision in decisions:
        time, trace = decision.time, decision.trace
        if decision.planned is not None:
            out.put(PLAN, time, drawing.plan(time, decision.planned.points))
        out.put(BELIEFS, time, drawing.beliefs(trace, before))
        if before is None or decision.plan != Decision(before).plan:
            out.say(time, "decision", plan_words(decision.plan) or "stop")
        before = trace


def _log(out: _Export, ride: Ride, answers: Iterable[Answer]) -> None:
    told = (event for event in ride.events if event.kind != "restrained")
    for event in told:
        warning = event.kind in CAUTION
        out.say(event.sim_time, "event", event_words(event), warning=warning)
    for answer in answers:
        out.say(answer.at, "question", answer.question)
        out.say(answer.at, "answer", answer.text)


def _copy(out: _Export, file: McapWriter, source: Path, ride: Ride) -> None:
    """Copy what the car reported, and what passengers shared."""
    for piece in recorded.pieces(source, ride.decisions[0].trace.vehicle):
        if isinstance(piece, Entry):
            out.put(piece.key, piece.logged / messages.NANO, piece)
        else:
            file.attach(piece.name, piece.data, 0)
