"""The checks of `xavi doctor` on this machine; those on the bus are in `bus_checks`."""

import importlib.metadata
import os
import re
import resource
import shutil
import socket
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Literal, TypeAlias

import msgspec
from platformdirs import user_cache_path, user_config_path, user_data_path, user_state_path

from sim import engine
from sim.roads import netconvert
from xavi_dialogue.bus.interface import DEFAULT_ENDPOINT
from xavi_dialogue.process import kernel_cache
from xavi_dialogue.storage.conversations import VERSION, Store
from xavi_dialogue.storage.store_errors import StoreError

Verdict: TypeAlias = Literal["ok", "warning", "fault"]

OURS = "xavi-dialogue"
PYTHON = (3, 11)
LITTLE = 1000  # [MB] of free space, below which it may run out within days
TOO_LITTLE = 50  # [MB] of free space, below which this is a fault
FEW_FILES = 1024  # descriptors; a hub needs one for every program linked to it
TOO_FEW_FILES = 128
PATIENCE = 0.05  # [s] for each attempt to open the store, of which there are many
NARROW = 40  # columns
REQUIRED = re.compile(r"([A-Za-z0-9._-]+)\s*(?:>=\s*([0-9.]+))?")


class Finding(msgspec.Struct, frozen=True):
    """The result of one check."""

    check: str
    verdict: Verdict
    found: str
    advice: str = ""  # how to solve the problem


@dataclass(frozen=True)
class CheckedSystem:
    """The subjects of the checks."""

    store: Path  # the file of conversations
    settings: Path  # the file of settings
    mistake: str | None = None  # in the settings
    endpoint: str = DEFAULT_ENDPOINT  # the endpoint of `xavi serve`


Check: TypeAlias = Callable[[CheckedSystem], Finding]


def python(_: CheckedSystem) -> Finding:
    """Check the interpreter."""
    found = f"{sys.version.split()[0]} at {sys.executable}"
    if sys.version_info < PYTHON:
        return Finding("python", "fault", found, "install Python 3.11 or newer and run make again")
    return Finding("python", "ok", found)


def packages(_: CheckedSystem) -> Finding:
    """Return the packages that this program requires, without extras."""
    try:
        lines = importlib.metadata.requires(OURS) or []
    except importlib.metadata.PackageNotFoundError:
        return Finding("packages", "fault", f"{OURS} is not installed", "run make chat")
    needed = [line for line in lines if "extra ==" not in line]
    wrong = [lack for line in needed if (lack := _lacking(line))]
    if wrong:
        return Finding("packages", "fault", "; ".join(wrong), "run make chat: it installs them")
    version = importlib.metadata.version(OURS)
    return Finding("packages", "ok", f"{OURS} {version}, and all that it requires")


def _lacking(requirement: str) -> str | None:
    """Check a required package."""
    match = REQUIRED.match(requirement)
    assert match is not None, requirement
    name, least = match.groups()
    try:
        found = importlib.metadata.version(name)
    except importlib.metadata.PackageNotFoundError:
        return f"{name} is not installed"
    if least and _numbers(found) < _numbers(least):
        return f"{name} {found} is older than {least}"
    return None


def _numbers(version: str) -> tuple[int, ...]:
    """Return the numbers of a release, without zeros at its end."""
    numbers = [int(part) for part in re.findall(r"\d+", version.partition("+")[0])]
    while numbers and not numbers[-1]:
        numbers.pop()
    return tuple(numbers)


def simulation(_: CheckedSystem) -> Finding:
    """Check SUMO as a library."""
    try:
        return Finding("sumo", "ok", engine.version())
    except engine.SumoMissing as error:
        found, _cut, advice = str(error).partition("; run: ")
        return Finding("sumo", "fault", found, f"run: {advice}")


def maps(_: CheckedSystem) -> Finding:
    """Check the converter of maps, which only some users need."""
    try:
        return Finding("netconvert", "ok", netconvert.program())
    except netconvert.NetconvertMissing as error:
        advice = str(error).partition("; ")[2]
        return Finding("netconvert", "ok", "not installed; only maps of your own need it", advice)


def compiled(_: CheckedSystem) -> Finding:
    """Check the planner's compiled kernels."""
    place = kernel_cache.place()
    if place is None or place.name.startswith(kernel_cache.LENT):
        found = "nowhere to keep them: every command compiles them anew"
        advice = f"name a folder that can be written with {kernel_cache.PLACE}"
        return Finding("kernels", "warning", found, advice)
    missing = kernel_cache.missing(place)
    if missing:
        found = f"not compiled yet: {', '.join(missing)}"
        return Finding("kernels", "warning", found, "run make chat, or wait at the first ride")
    return Finding("kernels", "ok", f"compiled, in {place}")


def folders(_: CheckedSystem) -> Finding:
    """Check the user's folders: existing ones can be written, others created."""
    every = [find(OURS) for find in (user_data_path, user_state_path, user_cache_path)]
    shut = [str(folder) for folder in every if not kernel_cache.writable(folder)]
    if shut:
        advice = "see to their permissions, or set XDG_DATA_HOME, XDG_STATE_HOME, XDG_CACHE_HOME"
        return Finding("folders", "fault", f"cannot be written: {', '.join(shut)}", advice)
    return Finding("folders", "ok", f"can be written: {', '.join(map(str, every))}")


def store(patient: CheckedSystem) -> Finding:
    """Check the file of conversations."""
    path = patient.store
    if not path.exists():
        if kernel_cache.writable(path.parent):
            return Finding("store", "ok", f"{path} will be made when something is said")
        advice = "see to its permissions, or name another file with --store"
        return Finding("store", "fault", f"{path} cannot be made", advice)
    try:
        with Store(path, patience=PATIENCE) as opened:
            opened.keep(())
            sessions = len(opened.names())
    except StoreError as error:
        found, _, advice = str(error).rpartition("; ")
        return Finding("store", "fault", found or advice, advice if found else "")
    return Finding("store", "ok", f"{path}: version {VERSION}, conversations: {sessions}")


def space(patient: CheckedSystem) -> Finding:
    """Check the free space on the disk of conversations."""
    folder = next(one for one in patient.store.absolute().parents if one.exists())
    try:
        free = shutil.disk_usage(folder).free // 10**6
    except OSError as error:
        return Finding("space", "fault", f"{folder}: {error.strerror}")
    found = f"{free} MB left at {folder}"
    if free >= LITTLE:
        return Finding("space", "ok", found)
    advice = "make room, or name a file on another disk with --store"
    return Finding("space", "fault" if free < TOO_LITTLE else "warning", found, advice)


def files(_: CheckedSystem) -> Finding:
    """Check how many files and connections a process may open."""
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    found = f"{_count(soft)} may be open at once, {_count(hard)} if asked for"
    if soft == resource.RLIM_INFINITY or soft >= FEW_FILES:
        return Finding("files", "ok", found)
    grave: Verdict = "fault" if soft < TOO_FEW_FILES else "warning"
    return Finding("files", grave, found, f"run: ulimit -n {FEW_FILES}")


def _count(limit: int) -> str:
    return "any number" if limit == resource.RLIM_INFINITY else str(limit)


def terminal(_: CheckedSystem) -> Finding:
    """Check the terminal."""
    encoding = (sys.stdout.encoding or "none").lower()
    if encoding.replace("-", "") != "utf8":
        return Finding("terminal", "warning", f"encoding {encoding}", "run: export LC_ALL=C.UTF-8")
    if not (sys.stdin.isatty() and sys.stdout.isatty()):
        return Finding("terminal", "ok", "none: questions are read line by line")
    size = shutil.get_terminal_size()
    found = f"{size.columns} columns, {size.lines} lines, UTF-8, TERM={os.environ.get('TERM')}"
    if size.columns < NARROW:
        return Finding("terminal", "warning", found, f"make it {NARROW} columns wide")
    return Finding("terminal", "ok", found)


def settings(patient: CheckedSystem) -> Finding:
    """Check the file of settings."""
    if patient.mistake is not None:
        return Finding(
            "settings", "fault", patient.mistake, f"correct or remove {patient.settings}"
        )
    if not patient.settings.exists():
        folder = user_config_path(OURS)
        return Finding("settings", "ok", f"none; {folder}/config.toml would be read")
    return Finding("settings", "ok", str(patient.settings))


def taken(endpoint: str) -> bool:
    """Check whether a process listens on an endpoint of this machine such as tcp/127.0.0.1:7447."""
    host, _, port = endpoint.partition("/")[2].rpartition(":")
    with socket.socket() as trial:
        trial.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)  # as other listeners do
        try:
            trial.bind((host, int(port)))
            trial.listen()
        except OSError:
            return True
    return False


CHECKS: tuple[Check, ...] = (
    *(python, packages, simulation, maps, compiled, folders, store, space, files, terminal),
    settings,
)


def on_this_machine(patient: CheckedSystem) -> Iterator[Finding]:
    """Do all checks of this machine, in their order; a check that fails counts as a fault."""
    for check in CHECKS:
        try:
            yield check(patient)
        except Exception as error:  # other checks are still to be done
            yield Finding(check.__name__, "fault", f"cannot be checked: {error!r}")
