"""Faults of one line in the code that repeats, orders, resumes and erases.

The simulated world has to notice each of them. `python -m tests.simulated.planted` plants them one
by one, each in a copy of the process, and runs seeds until one fails.
"""

import argparse
import os
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from tests.mutants.swap import living, swap
from tests.simulated.plan import STORIES, plan_of
from tests.simulated.world import right, run

ROOT = Path(__file__).parents[2] / "xavi_dialogue"
ENOUGH = 500  # seeds that are tried on a fault
LIMIT = 600  # [s] of processor time that a fault may take


@dataclass(frozen=True, slots=True)
class Planted:
    """One fault."""

    path: str
    before: str  # a part of one line
    after: str
    subject: str


def _of(subject: str, path: str, *edits: tuple[str, str]) -> tuple[Planted, ...]:
    return tuple(Planted(path, before, after, subject) for before, after in edits)


PLANTED = (
    *_of(
        "dedup",
        "service/request_handler.py",
        ("known.again.append(call)", "pass"),
        ("said = self.repeat(vehicle_session.vehicle, asked)", "said = None"),
        ("if known is not None:", "if known is None and known is not None:"),
    ),
    *_of(
        "dedup",
        "service/responder.py",
        ("return payload if told == asked and fresh else None", "return None"),
        ("for call in question.calls:", "for call in question.calls[:1]:"),
        (
            "turn = self.memory.answered(asked.session, name, system.wall() - AGAIN)",
            "turn = None",
        ),
    ),
    *_of(
        "retry",
        "storage/turn_log.py",
        ("self._missed.clear()", "pass"),
        ("self._unsynced = True", "self._unsynced = False"),
        ("store.sync()", "pass"),
        ("store.keep(self._missed)", "store.keep(self._missed[-1:])"),
    ),
    *_of(
        "retry",
        "storage/database.py",
        ('self._connection.execute("ROLLBACK")', "pass"),
        ('self._connection.execute("COMMIT")', "pass"),
    ),
    *_of(
        "retry",
        "service/server.py",
        ("self._held -= len(payload)", "pass"),
        ("call.refuse(pack(refusal.failure))", "pass"),
        ("self._run(vehicle_session, vehicle_session.deliver(task, result))", "pass"),
    ),
    *_of(
        "retry",
        "service/vehicle_session.py",
        ("self._planning.pop(task.need, [])", "self._planning.get(task.need, [])"),
        ("tasks += self._expire(overdue)", "pass"),
    ),
    *_of(
        "retry",
        "chat/controller.py",
        ("await self._sent(text, request)", "await self._sent(text, new_request())"),
    ),
    *_of(
        "ordering",
        "service/reorder_buffer.py",
        ("while self.next in self.held:", "while self.held and min(self.held) in self.held:"),
        ("if number >= self.next and", "if"),
        ("self.held.setdefault(number, item)", "self.held.setdefault(len(self.held), item)"),
        ("return self.reached >= at - EPSILON", "return True"),
        ("if scene is None or not self._arrived(scene):", "if scene is None:"),
    ),
    *_of(
        "ordering",
        "service/ride_tracker.py",
        ("if report.ride in self._names:", "if not report.ride:"),
        ("coming.inputs += coming.reports.hear(report)", "coming.reports.hear(report)"),
    ),
    *_of(
        "ordering",
        "dashboard/conversation.py",
        ("fresh = said.turns[overlap or 0 :]", "fresh = said.turns[0:]"),
        ("len(turns) - (said.total - self._total)", "len(turns) + (said.total - self._total)"),
    ),
    *_of(
        "resume",
        "service/vehicle_session.py",
        ("self._tell(Resumed(session, before))", "pass"),
        ("self.past[session] = turns[-MAX_PAST:]", "self.past[session] = turns[:1]"),
    ),
    *_of(
        "resume",
        "service/request_handler.py",
        ("vehicle_session.resume(session, self.memory.recall(session))", "pass"),
        ("self.owners.claim(asked.session, asked.token, held)", "pass"),
    ),
    *_of(
        "resume",
        "service/responder.py",
        ("owner = self.owners.known.get(asked.session)", "owner = None"),
    ),
    *_of(
        "resume",
        "service/ownership.py",
        ("return token is not None and hmac", "return token is None or hmac"),
    ),
    *_of(
        "resume",
        "storage/conversations.py",
        ("for (turn,) in reversed(rows)", "for (turn,) in rows"),
        ("coalesce(max(number), 0) + 1", "0 - count(*)"),
    ),
    *_of(
        "erase",
        "service/request_handler.py",
        ("self.forgotten(session)", "pass"),
        ("self.owners.release(wanted.session)", "pass"),
        ("known = self.put_away(wanted.session)", "known = 0"),
        ("erased = self.memory.forget(wanted.session)", "erased = known"),
    ),
    *_of(
        "erase",
        "service/vehicle_session.py",
        ("self._tell(Forgotten(session))", "pass"),
        ("len(self.past.pop(session, ()))", "len(self.past.get(session, ()))"),
    ),
    *_of(
        "erase",
        "storage/turn_log.py",
        ("self._unforgotten.add(session)", "pass"),
    ),
    *_of(
        "erase",
        "storage/conversations.py",
        (
            'file.execute("DELETE FROM owners WHERE session NOT IN (SELECT session FROM turns)")',
            "pass",
        ),
        ("self._file.purge()", "pass"),
    ),
    *_of(
        "erase",
        "storage/database.py",
        ("wal_checkpoint(TRUNCATE)", "wal_checkpoint(PASSIVE)"),
    ),
)


def plant(fault: Planted) -> None:
    """Exchange the code of the loaded functions.

    Raises:
        ValueError: the line is not in the module.
    """
    path = ROOT / fault.path
    source = path.read_text(encoding="utf-8")
    if fault.before not in source:
        raise ValueError(f"{fault.path} has no {fault.before!r} any more")
    lines = source.split("\n")
    k = next(k for k, line in enumerate(lines) if fault.before in line)
    lines[k] = lines[k].replace(fault.before, fault.after, 1)
    old = compile(source, str(path), "exec")
    new = compile("\n".join(lines), str(path), "exec")
    swap(old, new, living([str(path)])[str(path)])


def noticed(fault: Planted, seeds: int) -> tuple[int, str] | None:
    """Return the first seed that fails with a fault, and how; None if none does."""
    for story in range(len(STORIES)):
        right(story)  # what is right is told by the code without the fault
    plant(fault)
    for seed in range(seeds):
        try:
            outcome = run(plan_of(seed))
        except Exception as error:
            return seed, repr(error)
        if outcome.problems:
            return seed, outcome.problems[0].replace("\n", " ")
    return None


def apart(act: Callable[[], tuple[int, str] | None]) -> tuple[int, str] | None:
    """Do something in a copy of this process."""
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:
        found = None
        try:
            import resource

            resource.setrlimit(resource.RLIMIT_CPU, (LIMIT, LIMIT))
            found = act()
        except BaseException as error:
            found = (-1, repr(error))
        with os.fdopen(writing, "w") as pipe:
            pipe.write("" if found is None else f"{found[0]} {found[1]}")
        os._exit(0)
    os.close(writing)
    with os.fdopen(reading) as pipe:
        told = pipe.read()
    _, status = os.waitpid(child, 0)
    if status != 0:
        return -1, "the process was ended: it took too long, or broke down"
    if not told:
        return None
    seed, _, problem = told.partition(" ")
    return int(seed), problem


def main() -> int:
    """Plant all faults, or those whose line has a text; 0 where all are noticed."""
    parser = argparse.ArgumentParser(prog="python -m tests.simulated.planted", description=__doc__)
    parser.add_argument("--seeds", type=int, default=ENOUGH, help="that are tried on each")
    parser.add_argument("--only", default="", help="faults with this text in them")
    parser.add_argument("--part", default="1/1", metavar="K/N", help="every Nth fault from the Kth")
    asked = parser.parse_args()
    for story in range(len(STORIES)):
        right(story)
    part, parts = map(int, asked.part.split("/"))
    missed = 0
    chosen = [one for one in PLANTED if asked.only in f"{one.subject} {one.path} {one.before}"]
    for fault in chosen[part - 1 :: parts]:
        found = apart(lambda fault=fault: noticed(fault, asked.seeds))
        missed += found is None
        how = "NOT NOTICED" if found is None else f"seed {found[0]}: {found[1][:150]}"
        sys.stdout.write(f"{fault.subject}: {fault.path}: {fault.before[:60]} -> {how}\n")
        sys.stdout.flush()
    sys.stdout.write(f"{len(chosen[part - 1 :: parts])} planted, {missed} not noticed\n")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
