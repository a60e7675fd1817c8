"""The rooms and the one way through them, read off the code."""

import ast
import graphlib
import importlib
from dataclasses import fields

import pytest

from planner.errors import PlannerError
from sim.errors import SimError
from sim.scene import Scene, VehicleState
from tests.sources import PACKAGES, Module, functions, imports, modules
from xavi_dialogue.errors import XaviError

# Rooms from the world to the shell. A module may import its own room and those before it.
ROOMS = (
    (
        *("sim.scene", "sim.boxes", "sim.roads.network", "sim.roads.lanes", "sim.roads.lines"),
        *("sim.roads.places", "sim.errors"),
    ),
    ("planner.errors", "planner.record", "planner.kernels"),
    ("planner.roads",),
    ("planner.traffic_lights",),
    ("planner.manoeuvres",),
    ("planner.motion",),
    ("planner.hidden_areas",),
    ("planner.rollouts",),
    ("planner.prediction",),
    ("planner.search",),
    ("planner",),
    ("xavi_dialogue.errors",),
    ("xavi_dialogue.domain",),
    ("xavi_dialogue.causal",),
    ("xavi_dialogue.explain.history",),
    ("xavi_dialogue.explain.facts",),
    ("xavi_dialogue.explain",),
    ("xavi_dialogue.nlu",),
    ("xavi_dialogue.nlg",),
    ("xavi_dialogue.dialogue",),
    ("xavi_dialogue.runtime",),
    ("xavi_dialogue.bus",),
    ("xavi_dialogue.storage", "xavi_dialogue.process", "xavi_dialogue.security"),
    ("xavi_dialogue.vehicle",),
    ("xavi_dialogue.service",),
    ("xavi_dialogue.terminal", "xavi_dialogue.transcripts"),
    ("xavi_dialogue.chat", "xavi_dialogue.recording", "xavi_dialogue.inspection"),
    ("xavi_dialogue.dashboard", "xavi_dialogue.report"),
    ("xavi_dialogue.library",),
    ("xavi_dialogue.viewers",),
    ("xavi_dialogue.audit",),
    ("xavi_dialogue.cli",),
    ("benchmarks", "xavi_dialogue.__main__"),
)
PURE = (
    *("planner", "xavi_dialogue.domain", "xavi_dialogue.causal", "xavi_dialogue.explain"),
    *("xavi_dialogue.nlu", "xavi_dialogue.nlg", "xavi_dialogue.dialogue"),
)
APART = {"xavi_dialogue.nlu": "xavi_dialogue.nlg", "xavi_dialogue.nlg": "xavi_dialogue.nlu"}
GATES = {  # each outside world enters through one file
    "foxglove_schemas_protobuf": "xavi_dialogue/viewers/messages.py",
    "google": "xavi_dialogue/viewers/messages.py",
    "mcap_protobuf": "xavi_dialogue/viewers/messages.py",
    "cryptography": "xavi_dialogue/bus/certificates.py",
    "distributed": "xavi_dialogue/audit/running/cluster.py",
    "jinja2": "xavi_dialogue/audit/results/page.py",
    "libsumo": "sim/engine.py",
    "matplotlib": "xavi_dialogue/audit/results/plots.py",
    "sumolib": "sim/roads/netreader.py",
    "mcap": "xavi_dialogue/storage/mcap_file.py",
    "pandas": "xavi_dialogue/library/tables.py",
    "playwright": "benchmarks/service/browser.py",
    "pyarrow": "xavi_dialogue/audit/results/tables.py",
    "rich": "xavi_dialogue/audit/running/progress.py",
    "sqlite3": "xavi_dialogue/storage/database.py",
    "starlette": "xavi_dialogue/dashboard/web/routes.py",
    "uvicorn": "xavi_dialogue/dashboard/web/server.py",
    "websockets": "xavi_dialogue/dashboard/web/server.py",
    "zenoh": "xavi_dialogue/bus/zenoh_bus.py",
    "zstandard": "xavi_dialogue/storage/mcap_file.py",
}
# Where time, waiting and threads go through one door, so that a simulation can replace them.
TIMED = ("xavi_dialogue.bus", "xavi_dialogue.service", "xavi_dialogue.storage")
TIMED_FILES = {
    *("xavi_dialogue/chat/client.py", "xavi_dialogue/chat/remote_backend.py"),
    *("xavi_dialogue/chat/batch.py", "xavi_dialogue/vehicle/node.py"),
    *("xavi_dialogue/vehicle/outbox.py", "xavi_dialogue/vehicle/telemetry.py"),
    *("xavi_dialogue/dashboard/controller.py", "xavi_dialogue/dashboard/document_cache.py"),
}
UNTIMED = {"xavi_dialogue/bus/timers.py", "xavi_dialogue/bus/zenoh_bus.py"}  # of Zenoh alone
SHELLS = {"xavi_dialogue/__main__.py", "xavi_dialogue/terminal/prompt.py"}
IMPURE = {
    *("asyncio", "datetime", "http", "multiprocessing", "os", "pathlib", "secrets", "shutil"),
    *("socket", "sqlite3", "subprocess", "sys", "tempfile", "threading", "time", "uuid"),
}
MAX_MODULE_LINES = 350
MAX_FUNCTION_LINES = 60

LAZY = "xavi_dialogue.library.names"  # what the root package loads, when a name is used

SHELL = ROOMS.index(("xavi_dialogue.bus",))  # the first room that may know the world of SUMO

every_module = pytest.mark.parametrize("module", modules().values(), ids=lambda m: m.path)


def within(name: str, package: str) -> bool:
    return name == package or name.startswith(package + ".")


def room(name: str) -> int | None:
    """The index of a module's room, None for what stands outside the order."""
    return next((i for i, r in enumerate(ROOMS) if any(within(name, p) for p in r)), None)


def ours(module: Module) -> list[str]:
    return [i.target for i in imports(module) if i.target.split(".")[0] in PACKAGES]


@every_module
def test_imports_point_towards_the_world(module: Module) -> None:
    here = room(module.name)
    for target in ours(module):
        there = room(target)
        if module.name.split(".")[0] == "grammars":
            pytest.fail(f"{module.path} imports {target}; it may import nothing of ours")
        elif module.name == "xavi_dialogue":
            assert target == LAZY, f"{module.path} imports {target}"
        elif here is None:  # the adapters around SUMO
            assert within(target, "sim"), f"{module.path} imports {target}"
        elif there is None:
            assert here >= SHELL, f"{module.path} imports {target}, an adapter around SUMO"
        else:
            assert there <= here, f"{module.path} imports {target}, a later room"


def test_the_root_package_loads_nothing_of_ours_at_once() -> None:
    found = imports(modules()["xavi_dialogue"])
    assert {i.target for i in found if i.target.split(".")[0] in PACKAGES} == {LAZY}
    assert all(i.deferred for i in found if i.target == LAZY)


@pytest.mark.parametrize(("one", "other"), APART.items())
def test_reading_and_wording_share_no_code(one: str, other: str) -> None:
    for name, module in modules().items():
        if within(name, one):
            found = [target for target in ours(module) if within(target, other)]
            assert found == [], f"{module.path} imports {found}"


def test_every_module_has_a_room() -> None:
    strays = [
        module.path
        for name, module in modules().items()
        if room(name) is None and name.split(".")[0] == "xavi_dialogue" and name != "xavi_dialogue"
    ]
    assert strays == []


def test_the_scene_imports_nothing_of_ours() -> None:
    assert ours(modules()["sim.scene"]) == []
    parts = {"sim.scene", "sim.roads.lanes", "sim.roads.lines", "sim.roads.places"}
    for name in ("sim.roads.network", *parts):
        assert set(ours(modules()[name])) <= parts


@pytest.mark.parametrize(("library", "gate"), GATES.items())
def test_an_outside_world_enters_through_one_file(library: str, gate: str) -> None:
    importers = {
        module.path
        for module in modules().values()
        if any(i.target.split(".")[0] == library for i in imports(module))
    }
    assert importers == {gate}


@every_module
def test_time_passes_and_threads_start_through_one_door(module: Module) -> None:
    timed = any(within(module.name, package) for package in TIMED) or module.path in TIMED_FILES
    if timed and module.path not in UNTIMED:
        used = {i.target.split(".")[0] for i in imports(module)}
        assert used & {"time", "secrets", "threading"} <= {"threading"}, module.path
        threads = [node.lineno for node in module.nodes if _is_waiting(node)]
        assert threads == [], f"{module.path} waits or starts threads in lines {threads}"


def _is_waiting(node: ast.AST) -> bool:
    """Check whether a node is a class of threads that may wait; a plain lock is none."""
    match node:
        case ast.Attribute(value=ast.Name(id="threading"), attr=name):
            return name != "Lock"
        case ast.Call(func=ast.Attribute(value=ast.Name(id="queue"), attr=_)):
            return True
    return False


@every_module
def test_imports_can_be_read_off_the_code(module: Module) -> None:
    assert "?" not in {i.target for i in imports(module)}, f"{module.path}: a computed import"
    assert calls(module, "__import__") == [], module.path


def test_sumo_is_reached_through_libsumo_alone() -> None:
    for module in modules().values():
        for found in imports(module):
            assert found.target.split(".")[0] not in {"traci", "sumo"}, module.path


def test_the_planner_sees_of_the_world_the_scene_and_the_roads_alone() -> None:
    for name, module in modules().items():
        if within(name, "planner"):
            seen = {target for target in ours(module) if within(target, "sim")}
            known = {"sim.scene", "sim.roads.network", "sim.roads.lines", "sim.boxes"}
            assert seen <= known, module.path


def test_nothing_in_the_planner_speaks_of_sumo() -> None:
    for name, module in modules().items():
        if within(name, "planner"):
            for node in module.nodes:
                word = _word(node).lower()
                for hidden in ("sumo", "traci", "getroute", ".rou.", "setroute"):
                    assert hidden not in word, f"{module.path}:{getattr(node, 'lineno', 0)}"


def _word(node: ast.AST) -> str:
    """The name or literal text of a node; docstrings may speak of anything and are left out."""
    match node:
        case ast.Name(id=word) | ast.Attribute(attr=word) | ast.arg(arg=word):
            return word
        case ast.Constant(value=str(word)) if "\n" not in word and not word.endswith("."):
            return word
    return ""


def test_a_scene_shows_only_what_can_be_seen() -> None:
    assert {field.name for field in fields(Scene)} == {
        "time",
        "vehicles",
        "lights",
        "people",
        "unseen",
    }
    assert {field.name for field in fields(VehicleState)} == {
        *("position", "heading", "speed", "acceleration", "length", "width"),
        *("kind", "colour", "signals"),
    }


@every_module
def test_the_core_is_pure(module: Module) -> None:
    if any(within(module.name, package) for package in PURE):
        used = {i.target.split(".")[0] for i in imports(module)}
        assert used & IMPURE == set(), module.path
        opened = [node.lineno for node in calls(module, "open")]
        assert opened == [], f"{module.path} opens files in lines {opened}"


@every_module
def test_only_shells_print(module: Module) -> None:
    if module.path not in SHELLS:
        printed = [node.lineno for node in calls(module, "print")]
        assert printed == [], f"{module.path} prints in lines {printed}"


def calls(module: Module, function: str) -> list[ast.Call]:
    return [
        node
        for node in module.nodes
        if isinstance(node, ast.Call)
        and isinstance(node.func, ast.Name)
        and node.func.id == function
    ]


def _exceptions(module: Module) -> list[type[Exception]]:
    """Return the exception classes that a module defines, without its private ones."""
    if not any(isinstance(node, ast.ClassDef) and node.bases for node in module.tree.body):
        return []
    defined = vars(importlib.import_module(module.name)).values()
    return [
        one
        for one in defined
        if isinstance(one, type)
        and issubclass(one, Exception)
        and one.__module__ == module.name
        and not one.__name__.startswith("_")
    ]


@pytest.mark.parametrize(
    ("package", "root"),
    [("planner", PlannerError), ("sim", SimError), ("xavi_dialogue", XaviError)],
)
def test_each_package_has_one_root_error(package: str, root: type[Exception]) -> None:
    found = [
        error
        for module in modules().values()
        if within(module.name, package)
        for error in _exceptions(module)
    ]
    assert len(found) > 5
    assert [error for error in found if not issubclass(error, root)] == []


def test_no_import_cycles() -> None:
    graph = {
        name: {i.target for i in imports(module) if not i.deferred and i.target in modules()}
        for name, module in modules().items()
    }
    try:
        order = list(graphlib.TopologicalSorter(graph).static_order())
    except graphlib.CycleError as error:
        pytest.fail(" -> ".join(error.args[1]))
    assert set(order) == set(modules())


@every_module
def test_modules_and_functions_are_small_and_documented(module: Module) -> None:
    assert ast.get_docstring(module.tree), f"{module.path} has no docstring"
    lines = module.text.count("\n")
    assert lines <= MAX_MODULE_LINES, f"{module.path} has {lines} lines"
    for function in functions(module):
        length = (function.end_lineno or function.lineno) - function.lineno + 1
        assert length <= MAX_FUNCTION_LINES, (
            f"{module.path}:{function.lineno} {function.name} has {length} lines"
        )
