"""kind: fidelity. A robot as it looks, as it collides, and as more and more spheres, side by side in one picture."""

from __future__ import annotations

from typing import Any

from ... import _core
from ..._model import SphereModel
from ..._plugins import registry
from ..._robot import load
from ..experiment import Bench, Experiment, Outcome, Section, Source, short, table
from ..inputs import read_candidates
from ..models import made
from ..stages import Call
from ..values import expect_map, integer, number, read_value, refuse_unknown_keys, required, required_counts

_PICTURE = "fidelity.png"
_SNAPSHOTS = "snapshots: {size: [2520, 720]}"


class Fidelity(Experiment):
    """A picture of models."""

    kind = "fidelity"

    def __init__(self, source: Source) -> None:
        root, findings = source.root, source.findings
        source.values([], ["robot", "method", "spheres", "snapshots"])
        robot = required(root, "robot", "robot: FILE.urdf", findings)
        self.robot = read_candidates(robot, "robot", findings, source.folder)
        self.method = source.stages.method(root)
        self.spheres = required_counts(root, "spheres", "spheres: [11, 22]", 1, 1e5, findings)
        self.size = [1280, 960]
        self.pose: dict[str, float] = {}
        self.renderer = Call("snapshot.osmesa", "renderer")
        self._read_snapshots(source)

    def stages(self) -> set[str]:
        assert self.method is not None
        return {self.renderer.stage} | self.method.names

    def run(self, bench: Bench) -> Outcome:
        assert self.method is not None
        chosen, urdf = self.robot.resolve()
        robot = load(urdf)
        panels: list[tuple[str, _core.Robot, _core.SphereFile | None]] = [("visual geometry", load(urdf, geometry="visual")._core, None),
                                         ("collision geometry", robot._core, None)]  # fmt: skip
        rows = []
        for count in self.spheres:
            done = made(urdf, self.method, count)
            model: SphereModel = done.model
            panels.append((f"{model.count} spheres", robot._core, model._sphere_file()))
            figures = done.total
            rows.append([str(count), str(figures.spheres), f"{figures.excess:.4f}", f"{figures.excess_standard_error:.4f}",
                         f"{1e3 * figures.protrusion_mean_m:.3f}", f"{1e3 * figures.protrusion_max_m:.3f}",
                         "yes" if done.certified else "no"])  # fmt: skip
            bench.tell(f"{self.name}: {figures.spheres} spheres, excess {short(figures.excess)}")
        png = _core.side_by_side(registry(), panels, self.pose, self.title, self.size[0], self.size[1],
                                 self.renderer.stage, self.renderer.given)  # fmt: skip
        figures_table = table(["spheres", "made", "excess", "excess error", "mean protrusion, mm",
                               "largest protrusion, mm", "certified"], rows)  # fmt: skip
        text = (
            f"{chosen}, spheres by {self.method.label}; the colour is the radius. Excess is the volume of the spheres outside "
            "the robot in units of the robot's; protrusion is the distance of the spheres' exposed surface from the robot."
        )
        return Outcome(figures_table, [Section("", text, _PICTURE, figures_table)], pictures={_PICTURE: png})

    def _read_snapshots(self, source: Source) -> None:
        findings = source.findings
        value = required(source.root, "snapshots", _SNAPSHOTS, findings)
        if value is None or not expect_map(value, "snapshots", _SNAPSHOTS, findings):
            return
        refuse_unknown_keys(value, "snapshots", ["size", "pose", "renderer"], findings)
        size, pose, renderer = value.find("size"), value.find("pose"), value.find("renderer")
        if size is not None:
            pixels = [read_value(item, integer("size", 1280, 16, 8192), "snapshots", findings) for item in size.as_list()]
            if len(pixels) == 2:
                self.size = pixels
            else:
                findings.error(
                    size.where, "wrong-type",
                    f"'size' expects two numbers of pixels, got {size.description}; remedy: write size: [1280, 960]",
                )  # fmt: skip
        if pose is not None and expect_map(pose, "pose", "pose: {elbow: 0.5}", findings):
            for key, item in pose.pairs():
                joint = read_value(item, number(key.text, 0, -1e3, 1e3), "pose", findings)
                self.pose[key.text] = joint or 0.0
        call = None if renderer is None else source.stages.call(renderer, "renderer")
        if renderer is not None and call is not None:
            if call[0].kind == "renderer":
                self.renderer = call[0]
            else:
                findings.error(
                    renderer.where, "wrong-kind", f"'{call[0].stage}' is a {call[0].kind}; 'renderer' expects a renderer"
                )
