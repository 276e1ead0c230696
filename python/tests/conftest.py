import os
import pathlib

import clearloci as cl
import pytest

SOURCE = pathlib.Path(os.environ["CLEARLOCI_SOURCE_DIR"])
EXAMPLES = SOURCE / "examples"


@pytest.fixture(scope="session")
def five_bar():
    return cl.read(EXAMPLES / "five_bar.yaml")
