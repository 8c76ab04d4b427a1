"""Line plots as SVG files, for pages in light and dark."""

from __future__ import annotations

import io
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

_GREY = "#808080"  # readable on light and on dark pages
_COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#b8860b", "#56b4e9", "#8060c0"]  # apart for those who see few
_MARKERS = "osD^v<>"


@dataclass
class Series:
    """A line. Series of one label in several panels share their look and their line in the legend."""

    label: str
    points: Sequence[tuple[float, float]]
    reference: bool = False  #: of another program: grey and dashed


@dataclass
class Panel:
    """Axes with a title, which may be empty."""

    series: list[Series] = field(default_factory=list)
    title: str = ""


@dataclass
class Plot:
    """Panels side by side that share both axes, which are logarithmic, and a legend."""

    title: str
    x: str  #: label
    y: str  #: label, with the unit
    panels: list[Panel]
    ticks: Sequence[float] = ()  #: values of x to be labelled; none: round ones


def _number(value: float, _: Any = None) -> str:
    """Return "100", "10k", "1M"; below 1 as many digits as it needs."""
    for unit, letter in ((1e9, "G"), (1e6, "M"), (1e4, "k")):
        if value >= unit:
            return f"{value / (1e3 if letter == 'k' else unit):g}{letter}"
    return f"{value:g}"


def _draw(axes: Any, panel: Panel, looks: dict[str, dict[str, Any]]) -> None:
    for series in panel.series:
        own = len([look for look in looks.values() if look["color"] != _GREY])
        look = {"color": _COLOURS[own % len(_COLOURS)], "marker": _MARKERS[own % len(_MARKERS)], "linestyle": "-"}
        if series.reference:
            look = {"color": _GREY, "marker": "x", "linestyle": "--"}
        look = looks.setdefault(series.label, look)
        shown = [(x, y) for x, y in series.points if x > 0 and y > 0]
        axes.plot([x for x, _ in shown], [y for _, y in shown], label=series.label, markersize=4, linewidth=1.5, **look)
    axes.set_title(panel.title, color=_GREY, fontsize=10)


def _scale(axes: Any, plot: Plot, empty: bool) -> None:
    from matplotlib.ticker import FixedLocator, FuncFormatter, LogLocator, NullFormatter, NullLocator  # type: ignore

    if empty:
        axes.set_xlim(1, 10)
        axes.set_ylim(1, 10)
    axes.set_xscale("log")
    axes.set_yscale("log")
    for axis in (axes.xaxis, axes.yaxis):
        low, high = axis.get_view_interval()
        axis.set_major_locator(LogLocator(subs=(1.0,) if high > 100 * low else (1.0, 2.0, 5.0)))
        axis.set_major_formatter(FuncFormatter(_number))
        axis.set_minor_formatter(NullFormatter())
    if plot.ticks:
        axes.xaxis.set_major_locator(FixedLocator(list(plot.ticks)))
        axes.xaxis.set_minor_locator(NullLocator())
    axes.grid(True, color=_GREY, alpha=0.25, linewidth=0.6)
    axes.tick_params(which="both", colors=_GREY)
    axes.set_xlabel(plot.x, color=_GREY)
    for side, spine in axes.spines.items():
        spine.set_visible(side in ("left", "bottom"))
        spine.set_color(_GREY)


def to_svg(plot: Plot) -> bytes:
    """Return a whole SVG file that needs no other. Equal plots give equal bytes. What a logarithm does not have is left
    out."""
    import matplotlib  # type: ignore  # a check of an experiment needs none
    from matplotlib.figure import Figure  # type: ignore

    panels = plot.panels or [Panel()]
    with matplotlib.rc_context({"svg.hashsalt": "foam", "svg.fonttype": "none", "text.parse_math": False}):
        figure = Figure(figsize=(max(7.0, 4.2 * len(panels)), 4.8), layout="constrained")
        grid = figure.subplots(1, len(panels), sharex=True, sharey=True, squeeze=False)[0]
        looks: dict[str, dict[str, Any]] = {}
        for axes, panel in zip(grid, panels):
            _draw(axes, panel, looks)
        empty = not any(len(line.get_xdata()) for axes in grid for line in axes.lines)
        for axes in grid:
            _scale(axes, plot, empty)
        grid[0].set_ylabel(plot.y, color=_GREY)
        figure.suptitle(plot.title, color=_GREY, fontsize=12)
        handles = {label: line for axes in grid for line, label in zip(*axes.get_legend_handles_labels())}
        if handles:
            figure.legend(handles.values(), handles, loc="upper center", bbox_to_anchor=(0.5, 0),
                          ncol=min(len(handles), 2 * len(panels)), labelcolor=_GREY, frameon=False, fontsize=9)  # fmt: skip
        svg = io.BytesIO()
        figure.savefig(svg, format="svg", transparent=True, bbox_inches="tight", metadata={"Date": None})
    return svg.getvalue()
