"""What the module cannot do without: where it is missing, an ImportError of one line says so and how to get it."""

import sys
from pathlib import Path

try:
    import numpy  # noqa: F401
except ModuleNotFoundError:
    raise ImportError(
        "clearloci needs NumPy, which this Python does not have: apt-get install python3-numpy, "
        "or in a virtual environment pip install numpy"
    ) from None

try:
    from . import _clearloci  # noqa: F401
except ImportError as error:
    built = sorted(Path(__file__).parent.glob("_clearloci*.so"))
    version = ".".join(map(str, sys.version_info[:2]))
    if not built:
        raise ImportError("the compiled part of clearloci is not built: script/build --python builds it") from None
    if "cannot import name" in str(error):
        raise ImportError(
            f"the compiled part of clearloci, {built[0].name}, is not for this Python {version}: use /usr/bin/python3, "
            "or run pip install --no-build-isolation . with this one"
        ) from None
    raise
