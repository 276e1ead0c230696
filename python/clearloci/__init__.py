"""Discontinuity loci of parallel mechanisms with joint clearances.

    import clearloci as cl

    m = cl.read("five_bar.yaml")
    loci = m.loci(working_mode="all")
    loci.plot()
    zones = m.zones()
    answer = m.verify({"box": {"x": [0.1, 0.4], "y": [-0.8, -0.6]}, "margin": 0.01})

Units are SI throughout: m, rad, N, N m. Names and defaults are those of the command line.
"""

from . import _needs  # first: says in a line what is missing
from ._clearloci import InputError, LimitReached, __version__
from .answers import Curve, Loci, Surface, Validation, Verification, Zone, Zones
from .design import Designs, design
from .model import Model, parse, read
from .motion import CoordinateErrors, ErrorMap, ErrorVolume, Pose, Trajectory
from .poses import PoseVerification, PoseZone, PoseZones

__all__ = [
    "CoordinateErrors",
    "Curve",
    "Designs",
    "ErrorMap",
    "ErrorVolume",
    "InputError",
    "LimitReached",
    "Loci",
    "Model",
    "Pose",
    "PoseVerification",
    "PoseZone",
    "PoseZones",
    "Surface",
    "Trajectory",
    "Validation",
    "Verification",
    "Zone",
    "Zones",
    "__version__",
    "design",
    "parse",
    "read",
]

del _needs
