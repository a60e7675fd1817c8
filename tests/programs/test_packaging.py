"""A wheel built from the repository is complete: it answers questions far from the checkout."""

import json
import os
import shutil
import subprocess
import sys
import sysconfig
import venv
import zipfile
from collections.abc import Iterator
from pathlib import Path

import pytest

PACKAGES = ("grammars", "planner", "sim", "xavi_dialogue")
BUILD_INPUTS = ("pyproject.toml", "README.md", "LICENSE")
KERNELS = "planner/kernels"
CALLED = "along.averaged-"  # how the files of a kernel begin that every ride calls
#: A program that says where numba keeps kernels, and compiles none.
PLACE = "from planner.kernels.along import averaged; print(averaged.stats.cache_path)"

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def wheel(root: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A wheel, built from a copy so that the checkout stays clean, without a download."""
    folder = tmp_path_factory.mktemp("build")
    source = folder / "source"
    for package in PACKAGES:
        shutil.copytree(
            root / package, source / package, ignore=shutil.ignore_patterns("__pycache__")
        )
    for name in BUILD_INPUTS:
        shutil.copy(root / name, source)
    build = [sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", "--no-build-isolation"]
    done = subprocess.run(
        [*build, "--no-index", "--wheel-dir", str(folder), str(source)],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    [built] = folder.glob("*.whl")
    return built


@pytest.fixture(scope="module")
def installed(root: Path, wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An environment with this wheel; its dependencies are lent by the one that runs the tests.

    A path file lends them. Entries of path files come after the environment's own packages, and
    path files in a folder so added are not read, so the checkout stays out of sight.
    """
    place = tmp_path_factory.mktemp("elsewhere") / "env"
    venv.create(place, with_pip=False)
    own = Path(sysconfig.get_path("purelib", vars={"base": str(place)}))
    install = [sys.executable, "-m", "pip", "--python", str(place), "install", "--quiet"]
    done = subprocess.run(
        [*install, "--no-deps", "--no-index", str(wheel)],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    (own / "lent.pth").write_text(sysconfig.get_path("purelib") + "\n", encoding="utf-8")
    lend_kernels(root / KERNELS, own / KERNELS)
    return place


def lend_kernels(checkout: Path, own: Path) -> None:
    """Put what the checkout's kernels were compiled to beside those that are installed.

    numba takes it for a source of the same text and time, and compiles the others.
    """
    for source in own.glob("*.py"):
        held = checkout / source.name
        assert source.read_bytes() == held.read_bytes()
        os.utime(source, ns=(held.stat().st_atime_ns, held.stat().st_mtime_ns))
    for kernel in kernels_of(checkout):
        shutil.copy(kernel, own / "__pycache__")


def run(
    place: Path, *command: str, home: Path | None = None, **more: str
) -> subprocess.CompletedProcess[str]:
    """Run a program of the environment in an empty folder, told nothing of the checkout.

    Of the environment that runs the tests it finds netconvert, as from the extra `maps`.
    """
    folder = place.parent / "empty"
    folder.mkdir(exist_ok=True)
    lent = place.parent / "maps"
    lent.mkdir(exist_ok=True)
    shutil.copy(Path(sys.executable).parent / "netconvert", lent)
    path = os.pathsep.join((str(lent), os.defpath))
    return subprocess.run(
        [str(place / "bin" / command[0]), *command[1:]],
        cwd=folder,
        env={"PATH": path, "HOME": str(home or folder), "LANG": "C.UTF-8", **more},
        capture_output=True,
        text=True,
        check=False,
    )


def test_the_wheel_holds_every_file_of_the_packages_and_nothing_else(
    root: Path, wheel: Path
) -> None:
    expected = {
        path.relative_to(root).as_posix()
        for package in PACKAGES
        for path in (root / package).rglob("*")
        if path.is_file() and "__pycache__" not in path.parts
    }
    names = set(zipfile.ZipFile(wheel).namelist())
    assert {name for name in names if ".dist-info/" not in name} == expected
    assert any(name.endswith("/licenses/LICENSE") for name in names)


def test_packages_are_imported_from_the_wheel(root: Path, installed: Path) -> None:
    code = f"import {', '.join(PACKAGES)}; print({', '.join(f'{p}.__file__' for p in PACKAGES)})"
    done = run(installed, "python", "-c", code)
    assert done.returncode == 0, done.stderr
    assert all(Path(name).is_relative_to(installed) for name in done.stdout.split())
    assert str(root) not in done.stdout


def test_an_installed_car_answers(installed: Path) -> None:
    done = run(installed, "xavi", "ask", "--scenario", "s1", "--json", "Why did you change left?")
    assert done.returncode == 0, done.stderr
    reply = json.loads(done.stdout)
    assert reply["kind"] == "answer"
    assert reply["explanation"]["causes"] or reply["explanation"]["effects"]
    assert reply["text"]


def test_an_installed_car_drives_on_a_map_in_opendrive(installed: Path) -> None:
    done = run(installed, "xavi", "drive", "--scenario", "bend", "--duration", "1", "--json")
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout)["decisions"] == 1


def kernels_of(folder: Path) -> list[Path]:
    """The files of compiled kernels."""
    return sorted(folder.rglob("*.nb[ci]"))


@pytest.fixture
def read_only(installed: Path) -> Iterator[Path]:
    """The environment, where nothing can be kept beside the planner's kernels."""
    [cache] = installed.glob("lib/*/site-packages/planner/kernels/__pycache__")
    aside = cache.rename(cache.with_name("aside"))
    cache.write_text("not a folder")
    yield installed
    cache.unlink()
    aside.rename(cache)


def test_a_read_only_installation_keeps_its_kernels_in_the_users_cache(
    read_only: Path, tmp_path: Path
) -> None:
    place = Path(run(read_only, "python", "-c", PLACE, home=tmp_path).stdout.strip())
    assert place.is_relative_to(tmp_path / ".cache")
    for kernel in kernels_of(read_only):  # all but one, so that only that is compiled
        if not kernel.name.startswith(CALLED):
            shutil.copy(kernel, place)
    done = run(read_only, "xavi", "drive", "--duration", "0.1", home=tmp_path)
    assert done.returncode == 0, done.stderr
    assert [kept for kept in kernels_of(place) if kept.name.startswith(CALLED)]


def test_an_installation_drives_where_nothing_can_be_kept(read_only: Path) -> None:
    # All kernels are compiled for this alone; less well takes less time.
    drive = ("xavi", "drive", "--duration", "0.1")
    done = run(read_only, *drive, home=Path(os.devnull), NUMBA_OPT="1")
    assert done.returncode == 0, done.stderr


def test_an_installed_car_declines(installed: Path) -> None:
    done = run(installed, "xavi", "ask", "--scenario", "s1", "Why did you not fly?")
    assert done.returncode == 3, done.stderr
    assert done.stdout.strip()
