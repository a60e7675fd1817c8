"""The causal queries again, by brute force: plain loops over the rollouts and all samples.

Nothing here uses the causal room; a row is (plan, sample, rollout, draws, drawn by the search).
"""

import itertools
import math

import numpy as np

COMPONENTS = ("time", "jerk", "angular-acceleration", "curvature")
OUTCOMES = ("done", "collision", "termination", "dead")


def prior_of(trace, given=None):
    """p(S) of every joint sample there is, each a tuple of (vehicle, goal, trajectory)."""
    sides = []
    for known in sorted(trace.predictions, key=lambda p: p.vehicle):
        side = {}
        for g in range(len(known.goals)):
            for t in range(len(known.goals[g].trajectories)):
                if given is None or known.vehicle not in given or (g, t) in given[known.vehicle]:
                    chance = known.goals[g].probability * known.goals[g].trajectories[t].probability
                    side[known.vehicle, g, t] = chance
        if given is not None and known.vehicle in given:
            whole = sum(side.values())
            side = {key: chance / whole for key, chance in side.items()}
        sides.append(side)
    found = {}
    for joint in itertools.product(*sides):
        found[joint] = math.prod(side[one] for side, one in zip(sides, joint, strict=True))
    return found


def rows_of(trace, given=None):
    allowed = prior_of(trace, given)
    rows = []
    for r in trace.rollouts:
        plan = tuple(a.action for a in r.actions)
        joint = tuple(sorted((s.vehicle, s.goal, s.trajectory) for s in r.samples))
        if joint not in allowed:
            continue
        for row in rows:
            if row[0] == plan and row[1] == joint:
                row[3] += 1
                row[4] += 0 if r.forced else 1
                break
        else:
            rows.append([plan, joint, r, 1, 0 if r.forced else 1])
    return rows


def weights_of(samples, mass, prior):
    """Weights of {sample: draws} that stand for some prior mass.

    The prior, and a share of the rest by the odds (1 - pi) / pi of being undrawn, pi being the
    chance of having been drawn.
    """
    n = sum(samples.values())
    rest = mass - sum(prior[j] for j in samples)
    if rest <= 1e-9:
        return {j: prior[j] for j in samples}
    odds = {}
    for j in samples:
        missed = (1.0 - min(prior[j] / mass, 1.0)) ** n
        odds[j] = prior[j] / mass * missed / (1.0 - missed)
    if sum(odds.values()) == 0.0:
        return {j: prior[j] for j in samples}
    return {j: prior[j] + rest * odds[j] / sum(odds.values()) for j in samples}


def mixture(trace, plan, given=None):
    """[(weight, row)] of a plan, None where some sample goes beyond it alone."""
    prior, rows = prior_of(trace, given), rows_of(trace, given)
    here = [row for row in rows if row[0] == plan]
    for row in rows:
        longer = len(row[0]) > len(plan) and row[0][: len(plan)] == plan
        if longer and not any(other[1] == row[1] for other in here):
            return None
    mass, found = 1.0, []
    for depth in range(len(plan) + 1):
        through, ends = {}, []
        for row in rows:
            if row[0][:depth] == plan[:depth]:
                through[row[1]] = through.get(row[1], 0) + row[3]
            if row[0] == plan[:depth]:
                ends.append(row)
        weights = weights_of(through, mass, prior)
        for row in ends:
            found.append((weights[row[1]], row))
        ended = [row[1] for row in ends]
        mass = sum(w for j, w in weights.items() if j not in ended)
    total = sum(w for w, _ in found)
    return [(w / total, row) for w, row in found] if total > 0.0 else None


def intervene(trace, do, given=None, support=0.5):
    """(plan, [(weight, row)]) of the best plan with these actions at these depths, or None."""
    prior = prior_of(trace, given)
    candidates = []
    for plan in dict.fromkeys(row[0] for row in rows_of(trace, given)):
        if any(depth <= len(plan) and plan[depth - 1] != a for depth, a in do.items()):
            continue
        rows = mixture(trace, plan, given)
        if rows is not None:
            covered = sum(prior[row[1]] for _, row in rows)
            candidates.append((sum(w * row[2].reward for w, row in rows), covered, plan, rows))
    if not candidates:
        return None
    compared = [tuple(a.action for a in r.actions) for r in trace.rollouts if r.weight is not None]
    candidates = [c for c in candidates if c[2] in compared] or candidates
    most = max(c[1] for c in candidates)
    known = [c for c in candidates if c[1] >= support * most]
    best = known[0]
    for candidate in known[1:]:
        if candidate[:2] > best[:2]:
            best = candidate
    return best[2], best[3]


def outcomes(rows):
    return {o: sum(w for w, row in rows if row[2].outcome == o) for o in OUTCOMES}


def values_of(rows, name):
    every = [(w, row[1], row[2].components[name]) for w, row in rows]
    return [one for one in every if one[2] is not None]


def expectation(rows, name):
    there = values_of(rows, name)
    if sum(w for w, _, _ in there) <= 0.0:
        return None
    return sum(w * v for w, _, v in there) / sum(w for w, _, _ in there)


def collisions(rows):
    found = {}
    for w, row in rows:
        if row[2].outcome == "collision":
            found[row[2].collided_with] = found.get(row[2].collided_with, 0.0) + w
    return found


def effect(foil, fact, name):
    """(delta, low, high, n, distinct) or None."""
    there, here = values_of(foil, name), values_of(fact, name)
    if expectation(foil, name) is None or expectation(fact, name) is None:
        return None
    delta = expectation(foil, name) - expectation(fact, name)
    pairs = [(w, v, u, b) for w, j, v in there for u, k, b in here if j == k]
    part_there = sum(p[0] for p in pairs) / sum(w for w, _, _ in there)
    part_here = sum(p[2] for p in pairs) / sum(w for w, _, _ in here)
    if min(part_there, part_here) >= 0.5:
        cloud = [(v - b, w) for w, v, _, b in pairs]
    else:
        cloud = [(v - b, w * u) for w, _, v in there for u, _, b in here]
    low, high = percentile(cloud, 0.05), percentile(cloud, 0.95)
    n = sum(1 for _, row in foil + fact if row[2].components[name] is not None)
    distinct = len({j for _, j, _ in there} | {j for _, j, _ in here})
    return delta, min(low, delta), max(high, delta), n, distinct


def percentile(cloud, share):
    whole, reached = sum(w for _, w in cloud), 0.0
    for value, weight in sorted(cloud):
        reached += weight
        if reached >= whole * (share - 1e-9):
            return value
    return max(cloud)[0]


def hold_ups(rows, window=None):
    """{vehicle: (how, share, duration, speed_from, speed_to, choice)}."""
    found = {}
    for vehicle in sorted({h.vehicle for _, row in rows for h in row[2].held_up}):
        met, by_kind, longest, choices = 0.0, {}, [], {}
        for w, row in rows:
            stretches = [
                h
                for h in row[2].held_up
                if h.vehicle == vehicle
                and (window is None or not (h.since > window[1] or h.until < window[0]))
            ]
            if stretches and w > 0.0:
                met += w
                choice = next((g, t) for v, g, t in row[1] if v == vehicle)
                choices[choice] = choices.get(choice, 0.0) + w
                for h in stretches:
                    by_kind[h.how] = by_kind.get(h.how, 0.0) + w * (h.until - h.since)
                longest.append((w, stretches))
        if met <= 0.0:
            continue
        how = max(by_kind, key=by_kind.get)
        tops = []
        for w, stretches in longest:
            alike = [h for h in stretches if h.how == how]
            if alike:
                top = max(alike, key=lambda h: h.until - h.since)
                tops.append((top.speed_to, top.speed_from, w))
        duration = sum(by_kind.values()) / met
        mass = sum(w for *_, w in tops)
        enough = [t for t in tops if sum(w for *s, w in tops if s <= [*t[:2]]) > 0.5 * mass - 1e-9]
        lowest, start, _ = min(enough)
        speeds = (start, lowest)
        found[vehicle] = (how, met, duration, *speeds, max(choices, key=choices.get))
    return found


def seen(trace, actions=None, choices=None, outcome=None, given=None):
    """(p(evidence), [(p(row | evidence), row)]) under p(S) p(Omega | S) p(R, O | Omega, S)."""
    prior = prior_of(trace, given)
    rows = [row for row in rows_of(trace, given) if row[4] > 0]
    drawn = {}
    for row in rows:
        drawn[row[1]] = drawn.get(row[1], 0) + row[4]
    if not drawn:
        return 0.0, []
    weights = weights_of(drawn, 1.0, prior)
    whole = sum(weights.values())
    kept = []
    for row in rows:
        fits = outcome is None or row[2].outcome == outcome
        for depth, action in (actions or {}).items():
            fits &= (row[0][depth - 1] if depth <= len(row[0]) else None) == action
        for v, g, t in row[1]:
            fits &= v not in (choices or {}) or (g, t) in choices[v]
        if fits:
            kept.append((weights[row[1]] / whole * row[4] / drawn[row[1]], row))
    chance = sum(w for w, _ in kept)
    return chance, [(w / chance, row) for w, row in kept] if chance > 0.0 else []


def marginal(rows, key):
    found = {}
    for w, row in rows:
        found[key(row)] = found.get(key(row), 0.0) + w
    return found


def influence(trace, vehicle, sides, beta=1.0):
    """Mutual information [bit] of option and choice.

    sides: [(weight, row)] per option. The action values come from a weighted least-squares fit of
    the rewards.
    """
    chances, names = _choices_of(trace, vehicle)
    return _information([_fit(side, names, vehicle, chances) for side in sides], chances, beta)


def chance_information(trace, vehicle, sides, shuffles, beta=1.0):
    """The statistic of the randomisation test, and the same under shuffled draws.

    shuffles: per option a [N, P] array of permutations of its draws.
    """
    chances, names = _choices_of(trace, vehicle)

    def told(column):
        columns = []
        for side, shuffled in zip(sides, shuffles, strict=True):
            order = None if column is None else shuffled[:, column]
            columns.append(_means(side, names, vehicle, chances, order))
        return _information(columns, chances, beta)

    return told(None), [told(column) for column in range(shuffles[0].shape[1])]


def _choices_of(trace, vehicle):
    chances = {}
    for joint, p in prior_of(trace).items():
        choice = next((g, t) for v, g, t in joint if v == vehicle)
        chances[choice] = chances.get(choice, 0.0) + p
    return chances, sorted({one for joint in prior_of(trace) for one in joint})


def _information(columns, chances, beta):
    """Mutual information [bit]; columns: per option the action value of each choice."""
    total, pooled, rows = 0.0, [0.0] * len(columns), []
    for c, chance in enumerate(chances.values()):
        top = max(column[c] for column in columns)
        odds = [math.exp(beta * (column[c] - top)) for column in columns]
        rows.append([odd / sum(odds) for odd in odds])
        pooled = [a + chance * b for a, b in zip(pooled, rows[-1], strict=True)]
    for chance, row in zip(chances.values(), rows, strict=True):
        total += chance * sum(
            p * math.log2(p / q) for p, q in zip(row, pooled, strict=True) if p > 0.0
        )
    return total


def _rows(side, names, vehicle, chances):
    """Per draw: reward, weight, the others' choices with a constant, and the vehicle's own."""
    y, w, other, own = [], [], [], []
    for weight, row in side:
        for _ in range(row[3]):
            y.append(row[2].reward)
            w.append(weight / row[3])
            other.append([1.0] + [float(n in row[1]) for n in names if n[0] != vehicle])
            own.append([float((vehicle, *c) in row[1]) for c in chances])
    return np.array(y), np.array(w), np.array(other), np.array(own)


def _fit(side, names, vehicle, chances):
    """Q(o, c) for every choice c of a vehicle, the other vehicles held as they are."""
    y, w, other, own = _rows(side, names, vehicle, chances)
    root = np.sqrt(w)[:, None]
    beyond = own - other @ np.linalg.lstsq(root * other, root * own, rcond=1e-6)[0]
    beyond[np.abs(beyond) < 1e-9] = 0.0
    slopes = np.linalg.lstsq(root * beyond, root[:, 0] * y, rcond=1e-6)[0]
    return _about(float(np.sum(w * y)), slopes, chances)


def _means(side, names, vehicle, chances, order):
    """The same from plain means, by choice, of what the others' choices leave of the rewards."""
    y, w, other, own = _rows(side, names, vehicle, chances)
    rest = y - other @ np.linalg.lstsq(other, y, rcond=1e-6)[0]
    rest = rest if order is None else rest[order]
    means = [float(np.mean(rest[mine > 0.5])) if np.any(mine > 0.5) else 0.0 for mine in own.T]
    return _about(float(np.sum(w * y)), means, chances)


def _about(mean, slopes, chances):
    """Action values about a mean, of which the slopes' own mean is none."""
    centre = sum(p * slope for p, slope in zip(chances.values(), slopes, strict=True))
    return [mean + float(slope - centre) for slope in slopes]
