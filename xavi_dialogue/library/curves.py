"""Beliefs over time: what was expected of a road user, decision by decision."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from html import escape

import numpy as np
from numpy.typing import NDArray

from planner.record.trace import PlanTrace
from xavi_dialogue.library.pictures import Picture

WIDTH, HEIGHT = 620, 220  # [px]
LEFT, RIGHT, ABOVE, BELOW = 44, 200, 12, 34  # [px] around the curves
COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#6b6b6b")
TICKS = 6  # greatest number of times that are written below


@dataclass(frozen=True, eq=False)
class Curves:
    """The probability of each goal of one road user over a ride; 0 where it is not considered."""

    vehicle: int  # the number of the road user
    goals: tuple[str, ...]  # in words; the one that was once the likeliest first
    times: NDArray[np.float64] = field(repr=False)  # [s] of the decisions, [T]
    probabilities: NDArray[np.float64] = field(repr=False)  # [T, goals]

    @property
    def picture(self) -> Picture:
        """The curves as a picture."""
        return Picture(_chart(self), f"What was expected of vehicle {self.vehicle}.")

    def _repr_html_(self) -> str:
        return self.picture._repr_html_()


def curves(traces: Sequence[PlanTrace], vehicle: int) -> Curves | None:
    """Return the beliefs about a road user; None if there are none."""
    times, rows = [], []
    for trace in traces:
        for known in trace.predictions:
            if known.vehicle == vehicle:
                row: dict[str, float] = {}
                for goal in known.goals:
                    row[goal.place] = row.get(goal.place, 0.0) + goal.probability
                times.append(trace.sim_time)
                rows.append(row)
    if not rows:
        return None
    peaks: dict[str, float] = {}
    for row in rows:
        for place, chance in row.items():
            peaks[place] = max(chance, peaks.get(place, 0.0))
    goals = tuple(sorted(peaks, key=lambda place: (-peaks[place], place)))
    table = np.array([[row.get(place, 0.0) for place in goals] for row in rows])
    return Curves(vehicle, goals, np.array(times), table)


def _chart(shown: Curves) -> str:
    first, last = float(shown.times[0]), float(shown.times[-1])
    span = max(last - first, 1.0)
    wide, tall = WIDTH - LEFT - RIGHT, HEIGHT - ABOVE - BELOW

    def at(time: float, chance: float) -> str:
        return f"{LEFT + wide * (time - first) / span:.1f},{ABOVE + tall * (1.0 - chance):.1f}"

    parts = []
    for share in (0.0, 0.5, 1.0):
        begin, end = at(first, share), at(first + span, share)
        parts.append(f'<polyline points="{begin} {end}" stroke="#d0d4da"/>')
        x, y = LEFT - 6, float(begin.split(",")[1]) + 4
        parts.append(f'<text x="{x}" y="{y}" text-anchor="end">{share:.0%}</text>')
    step = max(round(span / TICKS), 1)
    for time in range(round(first), round(first + span) + 1, step):
        across, down = at(time, 0.0).split(",")
        parts.append(
            f'<text x="{across}" y="{float(down) + 18}" text-anchor="middle">{time} s</text>'
        )
    for k, goal in enumerate(shown.goals):
        colour = COLOURS[k % len(COLOURS)]
        row = zip(shown.times, shown.probabilities[:, k], strict=True)
        points = " ".join(at(float(time), float(chance)) for time, chance in row)
        dashes = "" if k < len(COLOURS) else ' stroke-dasharray="5 3"'
        parts.append(f'<polyline points="{points}" stroke="{colour}" stroke-width="2"{dashes}/>')
        x, y = WIDTH - RIGHT + 14, ABOVE + 14 + 17 * k
        parts.append(f'<text x="{x}" y="{y}" fill="{colour}">{escape(goal)}</text>')
    high = max(HEIGHT, ABOVE + 17 * len(shown.goals) + 10)
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {high}" width="{WIDTH}"'
        f' height="{high}" style="max-width:100%;height:auto;background:#ffffff" role="img">'
        f'<g fill="none">{_lines(parts)}</g>'
        f'<g font-family="sans-serif" font-size="12" fill="#15181c">{_texts(parts)}</g></svg>'
    )


def _lines(parts: Sequence[str]) -> str:
    return "".join(part for part in parts if part.startswith("<polyline"))


def _texts(parts: Sequence[str]) -> str:
    return "".join(part for part in parts if part.startswith("<text"))
