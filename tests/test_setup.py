"""The set-up script, run with a stand-in for Python that writes down what it is told to do."""

import shutil
import subprocess
from pathlib import Path

import pytest

# It makes environments that hold itself, installs nothing, and fails where a file `broken-<word>`
# lies beside the script's folder and its arguments hold the word.
STAND_IN = """#!/bin/sh
echo "$*" >>log
for broken in broken-*; do
    case "$*" in *"${broken#broken-}"*) exit 1;; esac
done
case "$*" in
    "-m venv"*) mkdir -p "$3/bin" && cp "$PYTHON" "$3/bin/python";;
    -V) echo "Python 3.9.1";;
    *print*) echo "python3.11-venv";;
esac
"""


class Checkout:
    """A checkout with the script, and programs that shadow the system's."""

    def __init__(self, root: Path, folder: Path) -> None:
        self.folder, self.system = folder, Path("/usr/bin")
        (folder / "scripts").mkdir()
        shutil.copy(root / "scripts" / "setup.sh", folder / "scripts")
        for name in ("pyproject.toml", "constraints.txt"):
            shutil.copy(root / name, folder)
        for kernel in (root / "planner" / "kernels").glob("*.py"):
            copied = folder / kernel.relative_to(root)
            copied.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(kernel, copied)
        self.python = self.program("python", STAND_IN)
        self.program("id", "#!/bin/sh\necho 1000\n")
        self.program("sudo", "#!/bin/sh\nexit 1\n")
        self.program("apt-get", '#!/bin/sh\necho "apt-get $*" >>log\n')

    def program(self, name: str, text: str) -> Path:
        path = self.folder / "bin" / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(text, encoding="utf-8")
        path.chmod(0o755)
        return path

    def hide_browsers(self) -> None:
        """Let the system's programs be found, but for browsers."""
        self.system = self.folder / "system"
        self.system.mkdir()
        for program in Path("/usr/bin").iterdir():
            if not program.name.startswith(("chrom", "google")):
                (self.system / program.name).symlink_to(program)

    def setup(
        self, level: str = "runtime", python: str = "", chromium: str = ""
    ) -> subprocess.CompletedProcess[str]:
        (self.folder / "log").write_text("")
        done = subprocess.run(
            ["/bin/sh", str(self.folder / "scripts" / "setup.sh"), level],
            cwd="/",
            env={
                "PATH": f"{self.folder}/bin:{self.system}",
                "PYTHON": python or str(self.python),
                "XAVI_CHROMIUM": chromium,
            },
            input="a question that belongs to the passenger\n",
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.stdout == ""
        return done

    def breaks(self, word: str) -> None:
        (self.folder / f"broken-{word}").touch()

    def mends(self, word: str) -> None:
        (self.folder / f"broken-{word}").unlink()

    @property
    def log(self) -> str:
        return (self.folder / "log").read_text()


@pytest.fixture
def checkout(root: Path, tmp_path: Path) -> Checkout:
    return Checkout(root, tmp_path)


def test_a_fresh_checkout_is_set_up_once(checkout: Checkout) -> None:
    assert checkout.setup().returncode == 0
    assert "-m venv .venv" in checkout.log
    assert "--editable ." in checkout.log
    assert "import libsumo" in checkout.log
    assert checkout.setup().returncode == 0
    assert checkout.log == ""


@pytest.mark.parametrize("file", ["pyproject.toml", "constraints.txt"])
def test_a_change_of_what_is_needed_installs_anew(checkout: Checkout, file: str) -> None:
    checkout.setup()
    with (checkout.folder / file).open("a") as changed:
        changed.write("# changed\n")
    assert checkout.setup().returncode == 0
    assert "pip install" in checkout.log
    assert "-m venv" not in checkout.log


def test_what_serves_the_developer_serves_the_passenger(checkout: Checkout) -> None:
    checkout.setup("develop")
    assert "--editable .[audit,browser,cluster,dashboard,dev,maps,tables,viewers]" in checkout.log
    checkout.setup("runtime")
    assert checkout.log == ""


def test_what_serves_the_passenger_is_not_enough_for_the_developer(checkout: Checkout) -> None:
    checkout.setup("runtime")
    checkout.setup("develop")
    assert "pip install" in checkout.log


def test_the_site_has_a_level_of_its_own_that_serves_the_passenger_too(checkout: Checkout) -> None:
    checkout.setup("docs")
    assert "--editable .[dashboard,docs,tables,viewers]" in checkout.log
    checkout.setup("runtime")
    assert checkout.log == ""
    checkout.setup("develop")
    assert "--editable .[audit,browser,cluster,dashboard,dev,maps,tables,viewers]" in checkout.log
    for level in ("docs", "develop"):
        checkout.setup(level)
        assert checkout.log == ""


def test_the_planner_is_compiled_once(checkout: Checkout) -> None:
    checkout.setup()
    assert "-m xavi_dialogue.vehicle.compile_kernels" in checkout.log
    checkout.setup("develop")
    assert "compile_kernels" not in checkout.log
    with (checkout.folder / "planner" / "kernels" / "driving.py").open("a") as changed:
        changed.write("# changed\n")
    assert checkout.setup().returncode == 0
    assert checkout.log == "-m xavi_dialogue.vehicle.compile_kernels\n"


def test_a_planner_that_does_not_compile_is_tried_again(checkout: Checkout) -> None:
    checkout.breaks("compile_kernels")
    assert checkout.setup().returncode == 1
    checkout.mends("compile_kernels")
    assert checkout.setup().returncode == 0
    assert checkout.log == "-m xavi_dialogue.vehicle.compile_kernels\n"


def test_an_installation_that_broke_off_is_made_anew(checkout: Checkout) -> None:
    checkout.breaks("editable")
    assert checkout.setup().returncode == 1
    checkout.mends("editable")
    assert checkout.setup().returncode == 0
    assert "-m venv .venv" in checkout.log
    checkout.setup()
    assert checkout.log == ""


def test_missing_system_libraries_are_named_in_a_command(checkout: Checkout) -> None:
    checkout.breaks("libsumo")
    done = checkout.setup()
    assert done.returncode == 1
    assert "sudo apt-get install -y --no-install-recommends libgl1 libx11-6" in done.stderr
    assert "apt-get" not in checkout.log


def test_missing_system_libraries_are_installed_where_that_is_permitted(
    checkout: Checkout,
) -> None:
    checkout.breaks("libsumo")
    checkout.program("id", "#!/bin/sh\necho 0\n")
    checkout.program(
        "apt-get", '#!/bin/sh\necho "apt-get $*" >>log\n[ $1 = update ] || rm broken-libsumo\n'
    )
    assert checkout.setup().returncode == 0
    assert "libgl1 libx11-6 libxext6 libxrender1 libatomic1 libexpat1" in checkout.log


def test_a_python_that_cannot_make_environments(checkout: Checkout) -> None:
    checkout.breaks("ensurepip")
    done = checkout.setup()
    assert done.returncode == 1
    assert "sudo apt-get install -y --no-install-recommends python3.11-venv" in done.stderr


def test_a_python_that_is_too_old(checkout: Checkout) -> None:
    checkout.breaks("version_info")
    done = checkout.setup()
    assert done.returncode == 1
    assert "Python 3.9.1 is too old" in done.stderr
    assert "make chat PYTHON=" in done.stderr


def test_a_python_that_is_not_there(checkout: Checkout) -> None:
    done = checkout.setup(python="python-of-nowhere")
    assert done.returncode == 1
    assert "'python-of-nowhere' was not found" in done.stderr


def test_an_unknown_level(checkout: Checkout) -> None:
    done = checkout.setup("everything")
    assert done.returncode == 1
    assert "runtime or develop or docs or browser" in done.stderr


def test_a_browser_is_installed_where_there_is_none(checkout: Checkout) -> None:
    checkout.hide_browsers()
    checkout.program("id", "#!/bin/sh\necho 0\n")
    checkout.program(
        "apt-get",
        '#!/bin/sh\necho "apt-get $*" >>log\n[ $1 = update ] || cp bin/id bin/chromium\n',
    )
    assert checkout.setup("develop").returncode == 0
    assert "apt-get" not in checkout.log
    assert checkout.setup("browser").returncode == 0
    assert "apt-get install -y --no-install-recommends chromium" in checkout.log
    assert checkout.setup("browser").returncode == 0
    assert checkout.log == ""


def test_a_browser_that_cannot_be_had(checkout: Checkout) -> None:
    checkout.hide_browsers()
    done = checkout.setup("browser")
    assert done.returncode == 1
    assert "sudo apt-get install -y --no-install-recommends chromium" in done.stderr


def test_a_browser_of_one_s_own(checkout: Checkout) -> None:
    checkout.hide_browsers()
    own = checkout.program("my-browser", "#!/bin/sh\n")
    assert checkout.setup("browser", chromium=str(own)).returncode == 0
    done = checkout.setup("browser", chromium="/nowhere/browser")
    assert done.returncode == 1
    assert "XAVI_CHROMIUM names '/nowhere/browser', which was not found" in done.stderr
