"""The shipped nets follow from their sources."""

from pathlib import Path

import pytest

from sim.netconvert import ConversionFailed, compile_plain
from sim.scenario import available, load
from tests.sim.folders import copy_of, edit


@pytest.mark.parametrize("name", available())
def test_compiling_again_gives_the_same_net(name: str, tmp_path: Path) -> None:
    target = tmp_path / "built.net.xml"
    scenario = load(name)
    compile_plain(scenario.folder, name, target)
    assert target.read_bytes() == scenario.network.read_bytes()


def test_sources_that_netconvert_refuses(tmp_path: Path) -> None:
    folder = copy_of("s1", tmp_path)
    edit(folder / "s1.edg.xml", 'from="west"', 'from="nowhere"')
    with pytest.raises(ConversionFailed, match="nowhere"):
        compile_plain(folder, "s1", tmp_path / "built.net.xml")
