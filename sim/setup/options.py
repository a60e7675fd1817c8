"""The options that SUMO is started with."""

LANE_CHANGE = 3.0  # [s] SUMO's lane changes jump unless they are given a duration

#: Options that override what a configuration says.
ALWAYS = {
    "--route-steps": "0",  # load all routes at once: else SUMO drops vehicles that are out of order
    "--collision.action": "warn",
    "--collision.check-junctions": "true",
    "--collision.mingap-factor": "0",
    "--time-to-teleport": "-1",
    "--xml-validation": "never",
    "--xml-validation.net": "never",
    "--xml-validation.routes": "never",
    "--no-step-log": "true",
    "--verbose": "false",
    "--duration-log.disable": "true",
}


def of_ride(step: float, seed: int, *, sublane: bool) -> dict[str, str]:
    """Return the options of a ride, except for its files.

    Args:
        step: [s] of the simulation.
        seed: of SUMO's random numbers.
        sublane: whether SUMO's sublane model moves vehicles sideways; if not, lane changes are
            given a duration.
    """
    lanes = {} if sublane else {"--lanechange.duration": repr(LANE_CHANGE)}
    own = {"--step-length": repr(step), "--seed": str(seed), "--random": "false"}
    return {**own, **lanes, **ALWAYS, "--no-warnings": "true"}


def listed(options: dict[str, str]) -> list[str]:
    """Return options as arguments of a command line."""
    return [part for option in options.items() for part in option]
