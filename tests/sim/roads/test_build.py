"""The shipped nets follow from their sources."""

from pathlib import Path

import pytest

from sim.roads.netconvert import ConversionFailed, compile_plain, main
from sim.setup.scenario import available, load
from tests.sim.folders import copy_of, edit

PLAIN = [name for name in available() if (load(name).folder / f"{name}.nod.xml").is_file()]


def test_all_nets_but_those_of_maps_have_sources() -> None:
    maps = {name for name in available() if load(name).network.parent != load(name).folder}
    assert set(available()) - set(PLAIN) == maps


@pytest.mark.parametrize("name", PLAIN)
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


def test_a_folder_that_cannot_be_compiled_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "mine").mkdir()
    monkeypatch.chdir(tmp_path / "mine")
    with pytest.raises(SystemExit, match=r"/mine: netconvert failed: .*mine\.nod\.xml"):
        main(["."])
