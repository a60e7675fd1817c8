"""Plots of an audit as SVG, whose points lead to their rides; the same audit, the same bytes."""

import io
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Final

from xavi_dialogue.audit.audit import Audit, Looked
from xavi_dialogue.audit.errors import needing

with needing("audit", "pip install matplotlib"):
    import matplotlib as mpl
    from matplotlib.figure import Figure

if TYPE_CHECKING:
    from matplotlib.axes import Axes

MOST: Final = 12  # scenarios that have a colour or row of their own
OTHERS: Final = "others"
#: Paul Tol's muted colours, which colour-blind people can tell apart; the last is of the others.
COLOURS: Final = (
    *("#332288", "#88CCEE", "#44AA99", "#117733", "#999933", "#DDCC77", "#CC6677", "#882255"),
    *("#AA4499", "#6699CC", "#661100", "#888888", "#DDDDDD"),
)
SETTINGS: Final = {
    "font.family": "sans-serif", "font.size": 9, "svg.fonttype": "none", "svg.hashsalt": "xavi",
    "text.parse_math": False, "axes.spines.top": False, "axes.spines.right": False,
}  # fmt: skip
KINDS: Final = ("answer", "clarification", "refusal", "not asked")
KIND_COLOURS: Final = ("#44AA99", "#DDCC77", "#CC6677", "#DDDDDD")


def plots(audit: Audit) -> tuple[tuple[str, str], ...]:
    """Return plots with their captions."""
    if not audit.rides:
        return ()
    with mpl.rc_context(SETTINGS):  # type: ignore[arg-type]
        found = [
            (_risks(audit.rides), "Each ride: its hardest braking and its closest call. "
             "A point leads to its ride; rides without a value stand at the edge."),
            (_answers(audit), "What became of each question."),
            (_decisions(audit.rides), "Decisions whose two best options were as good as each "
             "other within the error of the comparison, as a share of those with a choice."),
            (_mistakes(audit.rides), "Wrong predictions for each ride, and whether the truth "
             "would have changed the decision."),
        ]  # fmt: skip
    return tuple((svg, caption) for svg, caption in found)


def anchor(ride: int) -> str:
    """Return the anchor of a ride on the page, by its index."""
    return f"ride-{ride}"


def _groups(rides: Sequence[Looked]) -> dict[str, list[int]]:
    """Return the indices of rides by scenario, the rarest together."""
    found: dict[str, list[int]] = {}
    for k, one in enumerate(rides):
        found.setdefault(one.facts.scenario, []).append(k)
    if len(found) > MOST:
        frequent = sorted(found, key=lambda name: -len(found[name]))[: MOST - 1]
        rest = [k for name in found if name not in frequent for k in found[name]]
        found = {**{name: found[name] for name in found if name in frequent}, OTHERS: rest}
    return found


def _risks(rides: Sequence[Looked]) -> str:
    figure, axes = _figure(3.6)
    for colour, (name, members) in zip(COLOURS, _groups(rides).items(), strict=False):
        facts = [rides[k].facts for k in members]
        x = [one.braking.value if one.braking else 0.0 for one in facts]
        y = [0.0 if one.collision else one.time_to_collision.value if one.time_to_collision
             else 10.5 for one in facts]  # fmt: skip
        points = axes.scatter(x, y, s=22, color=colour, label=_short(name), alpha=0.75, lw=0.3,
                              edgecolor="black")  # fmt: skip
        points.set_urls([f"#{anchor(k)}" for k in members])
    axes.set_xlabel("hardest braking [m/s²]")
    axes.set_ylabel("least time to a collision [s]")
    axes.set_yticks([0, 2, 4, 6, 8, 10.5], ["0", "2", "4", "6", "8", "over 10"])
    axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), frameon=False)
    return _svg(figure)


def _answers(audit: Audit) -> str:
    names = [str(one) for one in audit.questions]
    counts = {kind: [0] * len(names) for kind in KINDS}
    for ride in audit.rides:
        for k, answer in enumerate(ride.answers):
            counts[answer.kind or "not asked"][k] += 1
    return _bars(names, counts, KIND_COLOURS, "rides")


def _decisions(rides: Sequence[Looked]) -> str:
    names, shares = [], []
    for name, members in _groups(rides).items():
        every = [choice for k in members for choice in rides[k].facts.choices]
        names.append(name)
        shares.append(100.0 * sum(one.close for one in every) / max(len(every), 1))
    return _bars(names, {"close decisions": shares}, COLOURS[1:2], "% of decisions")


def _mistakes(rides: Sequence[Looked]) -> str:
    kinds = {True: "mattered", None: "cannot be told", False: "made no difference"}
    names = list(_groups(rides))
    counts = {label: [0.0] * len(names) for label in kinds.values()}
    for row, members in enumerate(_groups(rides).values()):
        for k in members:
            for wrong in rides[k].facts.mistakes:
                counts[kinds[wrong.mattered]][row] += 1.0 / len(members)
    return _bars(names, counts, ("#CC6677", "#DDDDDD", "#88CCEE"), "wrong predictions per ride")


def _bars(names: Sequence[str], values: dict[str, Any], colours: Sequence[str], label: str) -> str:
    figure, axes = _figure(0.9 + 0.32 * len(names))
    left = [0.0] * len(names)
    rows = range(len(names))
    for colour, (what, widths) in zip(colours, values.items(), strict=True):
        axes.barh(rows, widths, left=left, color=colour, label=what, height=0.7)
        left = [a + b for a, b in zip(left, widths, strict=True)]
    axes.set_yticks(list(rows), [_short(name) for name in names])
    axes.invert_yaxis()
    axes.set_xlabel(label)
    if len(values) > 1:
        axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), frameon=False)
    return _svg(figure)


def _short(name: str) -> str:
    return name if len(name) <= 48 else f"…{name[-47:]}"


def _figure(height: float) -> tuple[Figure, "Axes"]:
    figure = Figure(figsize=(7.6, height), layout="constrained")
    return figure, figure.subplots()


def _svg(figure: Figure) -> str:
    sink = io.StringIO()
    figure.savefig(sink, format="svg", metadata={"Date": None, "Creator": None})
    text = sink.getvalue()
    return text[text.index("<svg") :]
