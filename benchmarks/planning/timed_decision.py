"""A decision, with the time of each part of it."""

from benchmarks.figures import Watch
from planner.search.decide import predict, searched
from planner.search.inputs import Frame, Moment
from planner.search.mcts import Search
from planner.search.recording import record


def timed_decision(watch: Watch, prefix: str, frame: Frame, moment: Moment) -> Search:
    """Decide, and return the search.

    Args:
        watch: gets the durations `decision`, `recognition`, `search` and `record`.
        prefix: before these names.
        frame: what stays the same from decision to decision.
        moment: what is new in this decision.
    """
    with watch.time(f"{prefix}decision"):
        with watch.time(f"{prefix}recognition"):
            beliefs = predict(frame, moment)
        with watch.time(f"{prefix}search"):
            search = searched(frame, moment, beliefs)
        with watch.time(f"{prefix}record"):
            record(frame, moment, beliefs, search)
    return search
