"""Access to SUMO: the only module that imports libsumo.

SimulationError
├── SumoMissing          libsumo, or a system library that it needs, is not installed
├── SimulationRunning    a second simulation in one process
├── SumoFailed           SUMO refused what it was given
└── EgoGone              the ego is not on the road
"""

import importlib
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path
from types import TracebackType
from typing import Any, Self, TypeVar

from sim.errors import SimError
from sim.quiet import errors_to, first_error

SYSTEM_LIBRARIES = "libgl1 libx11-6 libxext6 libxrender1 libatomic1 libexpat1"
UPWARDS = "../" * 64  # from any folder to the root

_running = False  # libsumo is one per process: a second start would silently replace the first

Value = TypeVar("Value")


class SimulationError(SimError):
    """The simulation cannot start or go on."""


class SumoMissing(SimulationError):
    """libsumo, or a system library that it needs, is not installed."""


class SimulationRunning(SimulationError):
    """A second simulation in one process."""

    def __init__(self) -> None:
        super().__init__("a simulation runs in this process already; close it or use another one")


class SumoFailed(SimulationError):
    """SUMO refused what it was given."""


class EgoGone(SimulationError):
    """The ego is not on the road."""


class Engine:
    """SUMO in this process; close it, or use it in a `with` statement."""

    def __init__(self) -> None:
        """Load libsumo, and claim it for this object.

        Raises:
            SumoMissing: libsumo or a system library is not installed.
            SimulationRunning: this process has a simulation already.
        """
        global _running
        if _running:
            raise SimulationRunning
        self.api = _libsumo()
        self._scratch = tempfile.TemporaryDirectory(prefix="xavi-")
        self.scratch = Path(self._scratch.name)  # removed on close
        self.log = self.scratch / "errors.txt"  # what SUMO writes while it reads its input
        self.log.touch()
        self.now = 0.0  # [s] that errors state as the time
        _running = self._open = True

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.close()

    def close(self) -> None:
        """End the simulation; closing twice does nothing."""
        global _running
        if self._open:
            _running = self._open = False
            self._scratch.cleanup()
            self.api.close()

    def start(self, arguments: Sequence[str], file: Path) -> None:
        """Start SUMO; its output files go to the scratch folder.

        Args:
            arguments: of its command line, without the program's name.
            file: what errors call the input.

        Raises:
            SumoFailed: SUMO does not accept them.
        """
        # SUMO puts the prefix before the last part of a path, in the folder of that file.
        apart = ("--output-prefix", f"{UPWARDS}{self.scratch.resolve()}/".replace("//", "/"))
        self.guarded(file, lambda: self.call(self.api.start, ["sumo", *arguments, *apart]))

    def guarded(self, file: Path, act: Callable[[], Value]) -> Value:
        """Call a function that makes SUMO read its input, and raise SUMO's own first error.

        Raises:
            SumoFailed: SUMO does not accept the input.
        """
        try:
            with errors_to(self.log):
                return act()
        except SumoFailed as error:
            # What SUMO writes is more exact than what it raises.
            reason = first_error(self.log) or str(error)
            raise SumoFailed(f"{file}: SUMO refuses it: {reason}") from error

    def call(self, function: Callable[..., Value], *arguments: Any) -> Value:
        """Call a function of libsumo, and turn its errors into SumoFailed.

        Raises:
            SumoFailed: SUMO cannot do it.
        """
        try:
            return function(*arguments)
        except (self.api.TraCIException, self.api.FatalTraCIError, RuntimeError) as error:
            reason = str(error) or type(error).__name__
            raise SumoFailed(f"SUMO at {self.now:g} s: {reason}") from error


def version() -> str:
    """Return the version of SUMO that is installed.

    Raises:
        SumoMissing: SUMO, or a system library that it needs, is not installed.
    """
    return str(_libsumo().getVersion()[1])


def _libsumo() -> Any:
    """Return the libsumo module, which has no type annotations.

    Raises:
        SumoMissing: libsumo, or a system library that it needs, is not installed.
    """
    try:
        return importlib.import_module("libsumo")
    except ModuleNotFoundError as error:
        raise SumoMissing("libsumo is not installed; run: pip install libsumo") from error
    except ImportError as error:
        raise SumoMissing(
            f"SUMO lacks a system library ({error}); run: apt-get install -y {SYSTEM_LIBRARIES}"
        ) from error
