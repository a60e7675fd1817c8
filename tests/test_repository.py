"""What the repository promises its readers: commands that exist, data that loads."""

import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
from lark import Lark

# Places and registries of one machine, and promises to work later, spelt so that this file passes.
STRAY = {
    "a path of one machine": r"/(?:work|home|root|Users|farm)/",
    "an address of a package registry": r"\b(?:pypi\.org|pythonhosted\.org|anaconda\.org)",
    "an index of packages": r"-{2}(?:(?:extra-)?index-url|find-links|trusted-host)",
    "a promise": r"\b(?:TO[D]O|FIX[M]E|X[X]X)\b",
}
#: Files of other programs that documents name.
FOREIGN_FILES = {"docs/metrics.md", "pdm_scorer.py", "randomTrips.py"}
OUR_FOLDERS = {
    *("benchmarks", "docs", "grammars", "planner", "scripts", "sim", "tests", "transcripts"),
    "xavi_dialogue",
}
LOCKS = re.compile(r"(?:^|/)(?:uv|poetry|pdm)\.lock$|(?:^|/)pylock.*\.toml$|(?:^|/)Pipfile\.lock$")


def committed(root: Path) -> list[Path]:
    listed = subprocess.run(
        ["git", "ls-files", "-z"], cwd=root, capture_output=True, check=True, text=True
    )
    return [root / name for name in listed.stdout.split("\0") if (root / name).is_file()]


def text_of(path: Path) -> str:
    """What a file says; nothing of one that holds NUL, which is a picture or packed."""
    data = path.read_bytes()
    return "" if b"\0" in data else data.decode("utf-8", errors="ignore")


def targets(root: Path) -> set[str]:
    makefile = (root / "Makefile").read_text(encoding="utf-8")
    return set(re.findall(r"^([a-z-]+):.*## ", makefile, flags=re.MULTILINE))


def code(page: str) -> str:
    """The parts of a Markdown page that are set as code."""
    return "\n".join(re.findall(r"```.*?```|`[^`\n]+`", page, flags=re.DOTALL))


@pytest.mark.parametrize("name", ["README.md", "ARCHITECTURE.md"])
def test_commands_in_the_documents_exist(root: Path, name: str) -> None:
    shown = code((root / name).read_text(encoding="utf-8"))
    assert set(re.findall(r"\bmake (?:-s )?([a-z-]+)", shown)) <= targets(root)


def test_programs_in_the_readme_exist(root: Path) -> None:
    helped = subprocess.run(
        [sys.executable, "-m", "xavi_dialogue", "--help"],
        cwd=root,
        capture_output=True,
        check=True,
        text=True,
    )
    shown = code((root / "README.md").read_text(encoding="utf-8"))
    assert set(re.findall(r"\bxavi ([a-z]+)", shown)) <= set(re.findall(r"\w+", helped.stdout))


def test_the_search_tree_in_the_readme_is_what_is_shown(root: Path) -> None:
    page = (root / "README.md").read_text(encoding="utf-8")
    found = re.search(r"`xavi (trace show [^`]*--at[^`]*)`.*?```text\n(.*?)```", page, re.DOTALL)
    assert found is not None
    shown = subprocess.run(
        [sys.executable, "-m", "xavi_dialogue", *found[1].split()],
        cwd=root,
        capture_output=True,
        check=True,
        text=True,
    )
    assert found[2] in shown.stdout


def test_the_makefile_offers_what_everybody_expects(root: Path) -> None:
    assert targets(root) >= {"chat", "test", "lint", "bench", "clean", "help"}


def markdown(root: Path) -> list[Path]:
    return [path for path in committed(root) if path.suffix == ".md"]


def test_links_in_the_documents_lead_somewhere(root: Path) -> None:
    for page in markdown(root):
        links = re.findall(r"\]\((?!https?:|mailto:)([^)#\s]+)", page.read_text(encoding="utf-8"))
        missing = [link for link in links if not (page.parent / link).exists()]
        assert missing == [], page.name


def test_files_named_in_the_documents_exist(root: Path) -> None:
    """A file or folder may be named without the folders above it."""
    known = set()
    for path in committed(root):
        parts = path.relative_to(root).parts
        whole = ["/".join(parts[:k]) for k in range(1, len(parts) + 1)]
        known.update(name[k:] for name in whole for k in starts(name))
    for page in markdown(root):
        if page.name == "CHANGELOG.md":  # names what was there then
            continue
        named = re.findall(r"`([a-z_][\w./]*)`", page.read_text(encoding="utf-8"))
        files = {name.rstrip("/") for name in named if looks_like_a_file(name)}
        assert files - known <= FOREIGN_FILES, page.name


def starts(path: str) -> list[int]:
    """Where the name of each part of a path begins."""
    return [0, *(place.end() for place in re.finditer("/", path))]


def looks_like_a_file(name: str) -> bool:
    first = name.split("/")[0]
    ending = name.endswith((".py", ".rules", ".lark", ".toml", ".md", ".js", ".sh"))
    return ending or (first in OUR_FOLDERS and "/" in name and "NAME" not in name)


def test_names_beside_files_in_the_glossary_are_in_them(root: Path) -> None:
    page = (root / "docs" / "glossary.md").read_text(encoding="utf-8")
    for file, name in re.findall(r"`([\w/]+\.py)` \(`(\w+)`\)", page):
        path = next(
            root / top / file for top in ("", "xavi_dialogue") if (root / top / file).is_file()
        )
        assert re.search(rf"\b{name}\b", path.read_text(encoding="utf-8")), f"{file}: {name}"


@pytest.mark.parametrize("what", STRAY)
def test_no_stray_words(root: Path, what: str) -> None:
    pattern = re.compile(STRAY[what])
    found = [
        f"{path.relative_to(root)}: {match.group()}"
        for path in committed(root)
        for match in pattern.finditer(text_of(path))
    ]
    assert found == [], f"{what} does not belong in the repository"


def test_no_test_is_named_after_the_time(root: Path) -> None:
    """Packed bytes hold the time unless told otherwise; in parameters they name tests."""
    calls = re.compile(r"gzip\.compress\((?:[^()]|\([^()]*\)|\((?:[^()]|\([^()]*\))*\))*\)")
    for path in (root / "tests").rglob("*.py"):
        for call in calls.findall(path.read_text(encoding="utf-8")):
            assert "mtime=0" in call, f"{path.name}: {call}"


def test_versions_are_pinned_without_addresses(root: Path) -> None:
    assert [path for path in committed(root) if LOCKS.search(path.as_posix())] == []
    lines = (root / "constraints.txt").read_text(encoding="utf-8").splitlines()
    for line in lines:
        assert re.fullmatch(r"#.*|[A-Za-z0-9_.-]+==[0-9][0-9a-z.]*", line), line


def test_every_requirement_is_pinned(root: Path) -> None:
    pins = (root / "constraints.txt").read_text(encoding="utf-8")
    pinned = {_normal(name) for name in re.findall(r"^([\w.-]+)==", pins, flags=re.MULTILINE)}
    project = tomllib.loads((root / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    extras = project["optional-dependencies"].values()
    wanted = [*project["dependencies"], *(name for extra in extras for name in extra)]
    assert {_normal(re.split(r"[<>=~! \[;]", name)[0]) for name in wanted} <= pinned


def _normal(name: str) -> str:
    return re.sub(r"[-_.]+", "-", name).lower()


def data(suffix: str) -> list[Path]:
    return sorted((Path(__file__).parents[1] / "grammars").rglob(f"*{suffix}"))


@pytest.mark.parametrize("path", data(".lark"), ids=lambda path: path.name)
def test_every_grammar_reads(path: Path) -> None:
    """By lark's grammar of grammars; some names come from word lists, as the parser's tests try."""
    grammars = Lark.open_from_package("lark", "lark.lark", ("grammars",), parser="lalr")
    tree = grammars.parse(path.read_text(encoding="utf-8") + "\n")
    assert list(tree.find_data("rule"))


@pytest.mark.parametrize("path", data(".toml"), ids=lambda path: path.name)
def test_every_word_list_reads(path: Path) -> None:
    assert tomllib.loads(path.read_text(encoding="utf-8"))
