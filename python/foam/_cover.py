"""foam.Cover: elements that cover a mesh or points, with the proof."""

from __future__ import annotations

import os
import warnings
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, overload

import numpy as np

from . import _core
from ._elements import Elements, ShapedElement
from ._mesh import Mesh
from .errors import UsageError

if TYPE_CHECKING:
    from ._model import SphereModel
    from ._packages import MjSpec
    from ._results import Certificate


class Cover(Elements):
    """Convex elements that cover a mesh or points, with the proof: a sequence of records, spheres first.

    Covers can be pickled.
    """

    __slots__ = ("certified", "volume", "_region", "_volumes", "_shown", "_certificate")

    certified: bool  #: whether the mesh is proved to be covered: as a solid, with its inside, if it is closed
    volume: float  #: of the union of the elements, m³

    def __init__(
        self,
        spheres: Any,
        others: list[ShapedElement],
        certified: bool,
        volume: float,
        region: Mesh,
        volumes: tuple[float, float] | None = None,
    ):
        super().__init__(spheres, others)
        self.certified = certified
        self.volume = volume
        self._region = region
        self._volumes = volumes
        self._shown: SphereModel | None = None
        self._certificate: Certificate | None = None

    @property
    def excess(self) -> float:
        """The volume of the cover outside the mesh / the volume of the mesh; inf for a mesh without inside.

        Computed when it is first read, to about 0.1 % of the volume.
        """
        return self._measured()[0]

    @property
    def missing(self) -> float:
        """The volume of the mesh outside the cover / the volume of the mesh; 0 for a mesh without inside.

        0 for a closed mesh, by the proof; of an open one the surface is covered. Computed when it is first read.
        """
        return self._measured()[1]

    def _measured(self) -> tuple[float, float]:
        if self._volumes is None:
            if self._others:
                self._volumes = _core.volumes_of_elements(self._region._core, self.elements)
            else:
                self._volumes = _core.volumes_of_spheres(self._region._core, self._rows, self.volume)
        return self._volumes

    @property
    def certificate(self) -> Certificate:
        """The proof as foam.certify() gives it: what is proved, or where it fails. Made when it is first read."""
        if self._certificate is None:
            from ._judge import certify

            model = self.model()
            self._certificate = certify(model.robot, model)
        return self._certificate

    def model(self) -> SphereModel:
        """Return the cover as the model of a robot with one link, "mesh" or "points"."""
        if self._shown is None:
            from ._memory import source_of_region
            from ._model import SphereModel
            from ._robot import Robot

            with warnings.catch_warnings():  # of what the robot has beside the elements
                warnings.simplefilter("ignore")
                robot = Robot(source_of_region(self._region), None, 1.0, "collision", (), None)
            (link,) = robot.links
            self._shown = SphereModel({link: Elements(self._rows, self._others)}, robot, name=link)
        return self._shown

    def save(
        self, path: str | os.PathLike[str], *, format: str | None = None, into: str | os.PathLike[str] | None = None,
        set: Mapping[str, Any] | None = None,
    ) -> list[Path]:  # fmt: skip
        """Write the elements; return the files. Arguments and errors are those of SphereModel.save().

        A URDF has the elements as collision geometry, and no visual geometry: that of the file of a mesh comes along by
        foam.load(file).cover(…).save(…).
        """
        return self.model().save(path, format=format, into=into, set=set)

    @overload
    def to_mujoco(self) -> str: ...
    @overload
    def to_mujoco(self, spec: MjSpec, *, body: str, group: int = 3) -> int: ...
    def to_mujoco(self, spec: Any = None, *, body: str = "", group: int = 3) -> Any:
        """Put the elements into a body of a mujoco.MjSpec as geoms; return their number. Without a spec: an MJCF text.

        Errors and the rest as of SphereModel.to_mujoco().
        """
        model = self.model()
        if spec is None:
            return model.to_mujoco()
        names = [one.name for one in spec.bodies]
        if body not in names:
            raise UsageError(f"body: the MjSpec has no body '{body}'; there are: {', '.join(names)}")
        return model.to_mujoco(spec, bodies={model.name: body}, group=group)

    def picture(self, width: int = 960, height: int = 720) -> bytes:
        """Return a PNG: the geometry, translucent, over the elements."""
        return self.model().picture(width, height)

    def show(self, path: str | os.PathLike[str] | None = None, *, browse: bool = True) -> Path:
        """Open a page with a table and a picture in the browser; return its file. browse=False: only write it."""
        from . import _adapters

        return _adapters.show(self.model(), path, browse, self.certified)

    def _repr_html_(self) -> str:
        from . import _adapters

        return _adapters.page_of(self.model(), self.certified)

    def __reduce__(self) -> tuple[Any, ...]:
        rows = np.array(self._rows)
        return Cover, (rows, self._others, self.certified, self.volume, self._region, self._volumes)

    def __repr__(self) -> str:
        return f"<foam.Cover: {self._counts()}, {'certified' if self.certified else 'not certified'}>"
