"""The command line that SUMO is started with."""

from pathlib import Path

from sim.scenario import Scenario

LANE_CHANGE = 3.0  # [s] SUMO's lane changes jump unless they are given a duration


def start_arguments(scenario: Scenario, routes: Path, seed: int) -> list[str]:
    """Everything that `libsumo.start` is given.

    Args:
        scenario: what to run.
        routes: its route file, or one made from it.
        seed: of SUMO's random numbers.
    """
    options = {
        "--net-file": str(scenario.network),
        "--route-files": str(routes),
        "--step-length": repr(scenario.step),
        "--seed": str(seed),
        "--lanechange.duration": repr(LANE_CHANGE),
        "--collision.action": "warn",
        "--collision.check-junctions": "true",
        "--collision.mingap-factor": "0",
        "--time-to-teleport": "-1",
        "--xml-validation": "never",
        "--xml-validation.net": "never",
        "--xml-validation.routes": "never",
        "--no-step-log": "true",
        "--no-warnings": "true",
        "--duration-log.disable": "true",
    }
    return ["sumo", *(part for option in options.items() for part in option)]
