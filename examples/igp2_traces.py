"""Turn decisions of IGP2's published planner into plan traces, which `xavi explain` answers from.

IGP2 is at https://github.com/uoe-agents/IGP2. This file holds none of its code and runs in an
environment with what IGP2 requires; it needs no package of ours. With a checkout, it runs one of
its scenarios and writes a trace for every decision:

    python examples/igp2_traces.py CHECKOUT scenario1 traces.jsonl
    xavi trace check traces.jsonl
    xavi explain traces.jsonl "Why did you change left?"

Who runs IGP2 in a program of their own calls `trace_of` after each search. The search must be told
to keep all its results (`store_results="all"`).

What differs: IGP2's rewards have no unit. Here they are seconds, of which 100 are one unit: about
0.99 s for each second of travelling at first. Its angular velocity stands for angular acceleration,
which it does not use. It weighs no common samples, so that no margin of a decision is known, and
it knows neither colours nor lights of vehicles.
"""

import argparse
import importlib
import itertools
import json
import logging
import math
import os
import random
import sys
from pathlib import Path

RATE = 5.0  # [Hz] of paths in traces
SECONDS = 100.0  # [s] that one unit of reward stands for
TURN = math.radians(25.0)  # change of heading from which on it is a turn
ACTIONS = {
    "Continue": "continue",
    "ChangeLaneLeft": "change-left",
    "ChangeLaneRight": "change-right",
    "StopMA": "stop",
    "Stop": "stop",
}
EXITS = {1: "exit-left", 0: "exit-straight", -1: "exit-right"}
PLACES = {1: "the road to the left", 0: "the road straight on", -1: "the road to the right"}
ENDINGS = (
    ("coll", "collision", "collision"),
    ("dead", "dead", "dead"),
    ("term", "termination", "late"),
)
TERMS = {"jerk": "jerk", "angular_velocity": "angular-acceleration", "curvature": "curvature"}


def trace_of(results, frame, predictions, observed, *, ego, time, fps, search_fps, number, seed):
    """Return the plan trace of one search, as a value for `json.dumps`.

    Args:
        results: `AllMCTSResult` of the search.
        frame: the state of each agent that it started from, by id.
        predictions: `GoalsProbabilities` of each other agent, by id.
        observed: the `StateTrajectory` of each agent so far, by id.
        ego: id of the agent that planned.
        time: [s] of the decision.
        fps: [Hz] of `observed`.
        search_fps: [Hz] of the simulations of the search.
        number: running number of the decision.
        seed: of the ride.
    """
    numbers = {agent: k for k, agent in enumerate(sorted(frame, key=lambda a: (a != ego, a)))}
    goals = {agent: reachable(known) for agent, known in predictions.items() if agent in numbers}
    ways = {
        id(way): k for known in predictions.values() for several in known.all_trajectories.values()
        for k, way in enumerate(several)
    }  # fmt: skip
    rollouts, names = [], {}
    for result in results.mcts_results:
        one = rollout_of(result, numbers, goals, ways, ego, time, search_fps, names)
        if one is not None:
            rollouts.append({"index": len(rollouts), **one})
    tree = results.mcts_results[-1].tree
    scene = {numbers[agent]: state_of(state) for agent, state in frame.items()}
    return {
        "schema": "xavi.plan_trace/2",
        "vehicle": "igp2",
        "sim_time": round(time, 3),
        "decision": number,
        "seed": seed,
        "settings": {"rollouts": len(results.mcts_results), "min_rollouts": 0, "comparisons": 0},
        "network": "igp2",
        "goal": {"edge": "goal", "position": 0.0, "lane": None},
        "under_way": None,
        "history": {numbers[a]: track_of(observed[a], time, fps) for a in frame if a in observed},
        "scene": dict(sorted(scene.items())),
        "predictions": [
            prediction_of(numbers[agent], predictions[agent], known, frame[agent])
            for agent, known in sorted(goals.items(), key=lambda pair: numbers[pair[0]])
            if known
        ],
        "rollouts": rollouts,
        "not_applicable": not_applicable(tree.root, names),
        "plan": plan_of(results, tree, names),
    }


def reachable(known):
    """Return the goals of an agent that have a trajectory."""
    chances = known.goals_probabilities
    return [g for g in chances if chances[g] > 0.0 and known.all_trajectories[g]]


def rollout_of(result, numbers, goals, ways, ego, time, fps, names):
    """Return one simulation of the search; None if it broke off."""
    tree, key = result.tree, result.trace
    reward = tree[key[:-1]].reward_results[key[-1]][-1]
    if reward.reward is None:
        return None
    runs = [tree[key[:depth]].run_result for depth in range(1, len(key))]
    driven = runs[-1].agents[ego].trajectory_cl
    start, actions = time, []
    for depth, run in enumerate(runs, 1):
        name = action_name(run.selected_action, run.ego_trajectory)
        names[key[: depth + 1]] = name
        actions.append({"action": name, "start": round(start, 3)})
        start += max(len(run.ego_trajectory.path) - 1, 0) / fps
    outcome, terms = outcome_of(reward)
    struck = [numbers[agent] for agent in runs[-1].collided_agents_ids if agent in numbers]
    return {
        "forced": False,
        "samples": samples_of(result.samples, numbers, goals, ways),
        "actions": actions,
        "path": points(driven, fps, runs[-1].agents[ego].metadata.length),
        "speed": [round(float(v), 3) for v in sampled(driven.velocity, fps)],
        "same_as": None,
        "outcome": outcome,
        "components": components(driven, fps, outcome),
        "reward": round(-sum(terms.values()), 3),
        "collided_with": struck[0] if outcome == "collision" and struck else None,
        "held_up": [],
        "terms": terms,
    }


def samples_of(samples, numbers, goals, ways):
    """Return what was drawn for the others, as indices into their predictions."""
    found = [
        {
            "vehicle": numbers[agent],
            "goal": goals[agent].index(goal),
            "trajectory": ways.get(id(trajectory), 0),
        }
        for agent, (goal, trajectory) in samples.items()
        if goal in goals.get(agent, ())
    ]
    return sorted(found, key=lambda one: one["vehicle"])


def outcome_of(reward):
    """Return how a simulation ended, and the terms of its reward [s]."""
    parts = {name: value for name, value in reward.reward_components.items() if value is not None}
    for name, outcome, term in ENDINGS:
        if name in parts:
            return outcome, {term: round(SECONDS * (1.0 - parts[name]), 3)}
    terms = {"time": SECONDS * (1.0 - parts.get("time", 0.0))}
    for name, term in TERMS.items():
        terms[term] = -SECONDS * parts.get(name, 0.0)
    return "done", {name: round(value, 3) for name, value in terms.items() if round(value, 3)}


def components(driven, fps, outcome):
    """Return the time and the mean jerk and curvature of a drive that reached the goal."""
    if outcome != "done":
        return dict.fromkeys(("time", "jerk", "angular-acceleration", "curvature"))
    return {
        "time": round((len(driven.path) - 1) / fps, 3),
        "jerk": mean(driven.jerk),
        "angular-acceleration": mean(driven.angular_acceleration),
        "curvature": mean(driven.curvature),
    }


def mean(values):
    """Return the mean absolute value of finite numbers; None without any."""
    finite = [abs(float(value)) for value in values if math.isfinite(value)]
    return round(sum(finite) / len(finite), 4) if finite else None


def prediction_of(number, known, goals, state):
    """Return the goals of a vehicle with their probabilities and ways."""
    total = sum(known.goals_probabilities[goal] for goal in goals)
    likely = max((known.likelihood[goal] or 0.0 for goal in goals), default=0.0) or 1.0
    found = []
    for index, goal in enumerate(goals):
        ways = []
        chances = known.trajectories_probabilities[goal]
        several = zip(chances, known.all_trajectories[goal], known.all_plans[goal], strict=True)
        for chance, trajectory, plan in several:
            ways.append(
                {
                    "probability": round(float(chance / sum(chances)), 6),
                    "actions": plan_names(plan, trajectory, state),
                    **line(trajectory, state),
                }
            )
        side = turned(ahead(known.all_trajectories[goal][0], state))
        stops = type(goal[0]).__name__ == "StoppingGoal"
        last = [name for name in ways[0]["actions"] if name.startswith("exit")]
        found.append(
            {
                "kind": "stop" if stops else (last[-1] if last else "continue"),
                "place": "where it stops" if stops else PLACES[side],
                "edge": None if stops else f"goal {index}",
                "prior": round(float(known.goals_priors[goal]), 6),
                "likelihood": round(float((known.likelihood[goal] or 0.0) / likely), 6),
                "probability": round(float(known.goals_probabilities[goal] / total), 6),
                "trajectories": ways,
            }
        )
    return {"vehicle": number, "goals": found}


def plan_names(plan, trajectory, state):
    """Return the actions of another vehicle; the turn of an exit is read from its way."""
    side = turned(ahead(trajectory, state))
    return [ACTIONS.get(type(one).__name__, EXITS[side]) for one in plan or ()] or ["continue"]


def ahead(trajectory, state):
    """Return the headings of a trajectory from where a vehicle is now."""
    near = nearest(trajectory, state)
    return [float(angle) for angle in trajectory.heading[near:]]


def nearest(trajectory, state):
    """Return the index of the point of a trajectory that is nearest to a vehicle."""
    gaps = [math.dist(point, state.position) for point in trajectory.path]
    return gaps.index(min(gaps))


def line(trajectory, state):
    """Return path and speed of a trajectory from where a vehicle is now, at RATE."""
    near = nearest(trajectory, state)
    times = [float(t - trajectory.times[near]) for t in trajectory.times[near:]]
    path, speed, k, at = [], [], near, 0.0
    while at <= times[-1] + 1e-6:
        while k + 1 < len(trajectory.path) and times[k + 1 - near] <= at:
            k += 1
        heading = float(trajectory.heading[k])
        path.append(bumper(trajectory.path[k], heading, state.metadata.length))
        speed.append(round(float(trajectory.velocity[k]), 3))
        at += 1.0 / RATE
    return {"path": path, "speed": speed}


def action_name(action, driven):
    """Return the name of an action of the ego; the turn of an exit is read from what it drove."""
    name = action.macro_action_type.__name__
    return ACTIONS.get(name) or EXITS[turned([float(angle) for angle in driven.heading])]


def turned(headings):
    """Return 1 if headings turn left in all, -1 if right, 0 if neither."""
    steps = (math.remainder(b - a, math.tau) for a, b in itertools.pairwise(headings))
    change = sum(steps)
    return 0 if abs(change) < TURN else int(math.copysign(1, change))


def not_applicable(root, names):
    """Return the actions that IGP2 did not consider at first."""
    tried = {ACTIONS.get(one.macro_action_type.__name__, "exit") for one in root.actions}
    tried |= {name for key, name in names.items() if len(key) == 2}
    exits = () if "exit" in tried else EXITS.values()
    return [
        {"node": [], "action": name, "reason": "IGP2 does not hold it to be applicable here"}
        for name in (*dict.fromkeys(ACTIONS.values()), *exits)
        if name not in tried
    ]


def plan_of(results, tree, names):
    """Return the chosen actions with value [s] and visits."""
    found, key = [], ("Root",)
    for action in results.final_plan:
        node = tree[key]
        index = node.actions_names.index(str(action))
        key = (*key, str(action))
        if key not in names:
            break
        found.append(
            {
                "action": names[key],
                "value": round(SECONDS * (float(node.q_values[index]) - 1.0), 3),
                "visits": int(node.action_visits[index]),
            }
        )
        if tree[key] is None:
            break
    return found


def state_of(state):
    """Return a vehicle as it is seen."""
    acceleration = state.acceleration
    return {
        "position": bumper(state.position, float(state.heading), state.metadata.length),
        "heading": round(float(state.heading), 4),
        "speed": round(float(state.speed), 3),
        "acceleration": 0.0 if hasattr(acceleration, "__len__") else round(float(acceleration), 3),
        "length": state.metadata.length,
        "width": state.metadata.width,
        "kind": "car",
        "colour": None,
        "signals": [],
    }


def track_of(trajectory, time, fps):
    """Return what was seen of a vehicle, at RATE up to now."""
    every = max(round(fps / RATE), 1)
    states = list(trajectory.states)[::-1][::every][: int(10 * RATE)][::-1]
    return {
        "start": round(time - (len(states) - 1) / RATE, 3),
        "position": [bumper(s.position, float(s.heading), s.metadata.length) for s in states],
        "heading": [round(float(s.heading), 4) for s in states],
        "speed": [round(float(s.speed), 3) for s in states],
    }


def points(driven, fps, length):
    """Return the path of a drive at RATE."""
    pairs = zip(sampled(driven.path, fps), sampled(driven.heading, fps), strict=True)
    return [bumper(point, float(heading), length) for point, heading in pairs]


def sampled(values, fps):
    """Return values at RATE."""
    return values[:: max(round(fps / RATE), 1)]


def bumper(centre, heading, length):
    """Return the centre of the front bumper; IGP2's positions are centres of vehicles."""
    x, y = float(centre[0]), float(centre[1])
    reach = length / 2.0
    return [round(x + reach * math.cos(heading), 2), round(y + reach * math.sin(heading), 2)]


def run(checkout, scenario, seed, steps):
    """Run a scenario of a checkout, and yield the trace of each decision."""
    sys.path[:0] = [str(checkout), str(checkout / "scripts")]
    os.chdir(checkout)  # where its scenarios name their maps
    igp2, script = importlib.import_module("igp2"), importlib.import_module("run")
    numpy = importlib.import_module("numpy")
    random.seed(seed)
    numpy.random.seed(seed)  # which IGP2 draws from
    file = checkout / "scenarios" / "configs" / f"{scenario}.json"
    config = json.loads(file.read_text(encoding="utf-8"))
    settings = importlib.import_module("igp2.core.config").Configuration()
    settings.set_properties(**config["scenario"])
    roads = igp2.Map.parse_from_opendrive(config["scenario"]["map_path"])
    frame = script.generate_random_frame(roads, config)
    fps = config["scenario"].get("fps", 20)
    simulation = igp2.simplesim.Simulation(roads, fps)
    ego = None
    for one in config["agents"]:
        one.get("mcts", {}).update(store_results="all")
        agent, role = script.create_agent(one, roads, frame, fps, argparse.Namespace(carla=False))
        simulation.add_agent(agent, rolename=role)
        ego = agent if role == "ego" else ego
    found = []
    search = ego._mcts.search

    def searched(**asked):
        answer = search(**asked)
        found.append((ego._mcts.results, dict(asked["frame"]), asked["predictions"]))
        return answer

    ego._mcts.search = searched
    number = 0
    for step in range(steps or config["scenario"]["max_steps"]):
        alive = simulation.step()
        for results, seen, predictions in found:
            observed = {agent: track[0] for agent, track in ego._observations.items()}
            yield trace_of(
                results, seen, predictions, observed, ego=ego.agent_id, time=step / fps, fps=fps,
                search_fps=ego._mcts.fps, number=number, seed=seed,
            )  # fmt: skip
            number += 1
        found.clear()
        if not alive or not ego.alive:
            return


def main():
    """Write the traces of a scenario, one in a line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("checkout", type=Path, help="folder of a checkout of IGP2")
    parser.add_argument("scenario", help="name in its scenarios/configs, such as scenario1")
    parser.add_argument("file", type=Path, help="where the traces are written, one in a line")
    parser.add_argument("--seed", type=int, default=21)
    parser.add_argument("--steps", type=int, help="of its simulation; default: the scenario's")
    asked = parser.parse_args()
    checkout = asked.checkout.resolve()
    if not (checkout / "scenarios" / "configs" / f"{asked.scenario}.json").is_file():
        parser.error(f"{checkout} has no scenarios/configs/{asked.scenario}.json")
    logging.disable(logging.WARNING)
    with asked.file.resolve().open("w", encoding="utf-8") as out:
        for trace in run(checkout, asked.scenario, asked.seed, asked.steps):
            out.write(json.dumps(trace, allow_nan=False) + "\n")
            out.flush()


if __name__ == "__main__":
    main()
