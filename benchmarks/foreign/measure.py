"""The rides of `xavi bench foreign`; those already driven are read from a file."""

from collections.abc import Callable, Collection, Sequence
from pathlib import Path

import msgspec

from benchmarks.drive.runs import in_processes
from benchmarks.errors import ForeignUnusable
from benchmarks.foreign.report import ForeignReport, report
from benchmarks.foreign.riding import Ridden, Task, rode
from benchmarks.foreign.sites import LeftOut, Site, installed, sites

DIED = "its process died"


def measure(
    folders: Sequence[Path],
    names: Collection[str],
    seeds: Sequence[int],
    results: Path | None,
    keep: Path | None,
    jobs: int,
    note: Callable[[str], None],
) -> ForeignReport:
    """Drive on the networks in folders.

    Args:
        folders: folders to search; none: SUMO's distribution.
        names: of the sites to drive on; none: all.
        seeds: of the rides on each.
        results: file with one ride per line, which is extended; rides in it are not driven again.
        keep: folder for traffic that is made up; None: it is not kept.
        jobs: number of parallel processes.
        note: is called with notes on progress.

    Raises:
        NetconvertMissing: no folder is given, and the distribution is not installed.
        ForeignUnusable: the file holds other things than rides, or there is no site of a name.
    """
    found, left_out = _sites(folders or [installed()], names)
    done = {} if results is None else read(results)
    tasks = [Task(x, seed, None if keep is None else str(keep)) for seed in seeds for x in found]
    rest = [task for task in tasks if (task.site.name, task.seed) not in done]
    note(f"{len(tasks)} rides on {len(found)} networks, {len(rest)} of them still to be driven")
    for one in in_processes(rode, rest, jobs, lambda t: Ridden(t.site.name, t.seed, error=DIED)):
        done[one.site, one.seed] = one
        if results is not None:
            with results.open("ab") as file:
                file.write(msgspec.json.encode(one) + b"\n")
        note(f"{one.site} {one.seed}: {_outcome(one)}")
    rides = [done[task.site.name, task.seed] for task in tasks]
    return report(rides, left_out)


def read(results: Path) -> dict[tuple[str, int], Ridden]:
    """Read a file of rides; return none if there is no file.

    Raises:
        ForeignUnusable: it holds other things.
    """
    if not results.exists():
        return {}
    decoder = msgspec.json.Decoder(Ridden)
    try:
        rides = [decoder.decode(line) for line in results.read_bytes().splitlines()]
    except msgspec.DecodeError as error:
        raise ForeignUnusable(f"{results}: {error}; remove it, or name another file") from error
    return {(ride.site, ride.seed): ride for ride in rides}


def _sites(
    folders: Sequence[Path], names: Collection[str]
) -> tuple[list[Site], tuple[LeftOut, ...]]:
    known: dict[str, Site] = {}
    left_out: list[LeftOut] = []
    for folder in folders:
        here, gone = sites(folder)
        left_out += gone
        for site in here:
            taken = f"{folder.name}/{site.name}" if site.name in known else site.name
            known[taken] = msgspec.structs.replace(site, name=taken)
    for name in names:
        if name not in known:
            raise ForeignUnusable(
                f"no network {name!r}; there are {', '.join(sorted(known)) or 'none'}"
            )
    if names:
        return [known[name] for name in sorted(names)], ()
    return [known[name] for name in sorted(known)], tuple(left_out)


def _outcome(ride: Ridden) -> str:
    if ride.ours is None or ride.sumo is None:
        return ride.error or "failed"
    own, other = ride.ours.drive, ride.sumo.drive
    return f"{own.ended} at {own.time:.1f} s; SUMO's driver {other.ended} at {other.time:.1f} s"
