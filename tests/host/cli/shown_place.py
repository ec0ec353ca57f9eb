"""Where what a document shows is run: a folder with the program and the sources' folder `host` in it."""

import contextlib
import os
import tempfile
from pathlib import Path


@contextlib.contextmanager
def shown_place(program, sources):
    """(folder, environment), in which `fencepost` is the program, without colours."""
    with tempfile.TemporaryDirectory() as folder:
        os.symlink(Path(sources).resolve() / "host", Path(folder) / "host")
        os.symlink(Path(program).resolve(), Path(folder) / "fencepost")
        yield folder, dict(os.environ, PATH=f"{folder}:{os.environ['PATH']}", TERM="dumb", NO_COLOR="1")
