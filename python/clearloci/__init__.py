"""Discontinuity loci of parallel mechanisms with joint clearances::

    import clearloci as cl

    m = cl.read("five_bar.yaml")
    loci = m.loci(working_mode="all")
    loci.plot()
    zones = m.zones()
    answer = m.verify({"box": {"x": [0.1, 0.4], "y": [-0.8, -0.6]}, "margin": 0.01})

    m.pose((0.25, -0.7)).error             # how far the clearances displace the end effector

Units are SI throughout: m, rad, N, N m. `help(cl.Model)` explains every method and its arguments. Answers have
their values as attributes, and the methods `table()`, `json()` and `export(folder, formats)`.
"""

from . import _needs  # first: says in a line what is missing
from ._clearloci import InputError, LimitReached, __version__
from .answers import Curve, Loci, Surface, Validation, Verification, Zone, ZonedMode, Zones
from .design import Designs, design
from .model import ImportedFile, Model, NormalizedFile, import_file, parse, read
from .motion import Errors, Pose, Trajectory

__all__ = [
    "Curve",
    "Designs",
    "Errors",
    "ImportedFile",
    "InputError",
    "LimitReached",
    "Loci",
    "Model",
    "NormalizedFile",
    "Pose",
    "Surface",
    "Trajectory",
    "Validation",
    "Verification",
    "Zone",
    "ZonedMode",
    "Zones",
    "__version__",
    "design",
    "import_file",
    "parse",
    "read",
]

del _needs
InputError.__module__ = LimitReached.__module__ = __name__  # where people find them
