"""`xavi bench plan`: how fast decisions are, on this machine."""

from planner.decide import Frame, Moment, predict, prepare, record, root_at
from planner.search import Root
from planner.trace import PlanTrace
from planner.trajectory import Roads
from sim.scenario import load
from sim.scene import EGO
from xavi_dialogue.app.bench.dialogue import SCENARIOS, SEED, ride
from xavi_dialogue.app.bench.figures import Figures, Watch
from xavi_dialogue.app.ride import settings_of


def measure() -> Figures:
    """Every decision of a ride taken again, part by part."""
    watch = Watch()
    for name in SCENARIOS:
        conversation, network = ride(name)
        scenario = load(name)
        goal = conversation.dialogue.traces[0].goal
        frame = Frame(Roads(network), goal, settings_of(scenario), SEED, "car")
        for trace in conversation.dialogue.traces:
            if trace.under_way is None:
                _decide(watch, name, frame, trace)
    return Figures("plan", watch.figures())


def _decide(watch: Watch, name: str, frame: Frame, trace: PlanTrace) -> None:
    here = root_at(frame.roads, trace.scene[EGO], trace.sim_time)
    if here is None:
        return
    moment = Moment(trace.decision, trace.sim_time, trace.scene, trace.history, Root(here))
    with watch.time(f"{name} decision"):
        with watch.time(f"{name} recognition"):
            beliefs = predict(frame, moment)
        with watch.time(f"{name} search"):
            search = prepare(frame, moment, beliefs)
            search.run()
        with watch.time(f"{name} record"):
            record(frame, moment, beliefs, search)
