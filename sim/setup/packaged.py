"""Files of the package eclipse-sumo, which a scenario may name instead of having its own."""

from pathlib import Path

from sim.roads.netconvert import NetconvertMissing, package_folder
from sim.setup.tables import Table

PACKAGED = "sumo:"  # prefix of the path of a file within the package
INSTALL = "pip install -U eclipse-sumo"


def packaged_file(table: Table, key: str, folder: Path) -> Path:
    """Find a file that a table names, in a folder or in the package.

    Raises:
        TableError: there is no such file; its cause is NetconvertMissing if the package is missing.
    """
    name = table.text(key)
    if not name.startswith(PACKAGED):
        return table.path(key, folder)
    inside = name.removeprefix(PACKAGED)
    try:
        file = package_folder() / inside
    except NetconvertMissing as error:
        problem = f"{inside} is part of eclipse-sumo, which is not installed"
        raise table.wrong(key, problem, f"run: {INSTALL}") from error
    if not file.is_file():
        problem = f"the eclipse-sumo that is installed has no {inside}"
        raise table.wrong(key, problem, f"run: {INSTALL}")
    return file
