"""The program `fencepost`: where it is, and what it says as values."""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import typing

_INSIDE = pathlib.Path(__file__).parent / "_install"

Scene = typing.Union[str, "os.PathLike[str]", typing.Mapping[str, typing.Any]]
LogSource = typing.Union[str, "os.PathLike[str]", bytes]


class ProgramError(RuntimeError):
    """The program refused; its words."""


def program() -> str:
    """FENCEPOST_PROGRAM, the program inside the package, or that of the system."""
    inside = _INSIDE / "bin/fencepost"
    path = os.environ.get("FENCEPOST_PROGRAM") or (str(inside) if inside.is_file() else shutil.which("fencepost"))
    if path is None:
        raise ProgramError("the program fencepost is neither in %s nor on the PATH; install the wheel or the package "
                           "fencepost, or set FENCEPOST_PROGRAM to its path" % inside.parent)
    return path


def main() -> typing.NoReturn:
    """The program in the place of this process."""
    try:
        path = program()
    except ProgramError as error:
        sys.exit("fencepost: %s" % error)
    os.execv(path, ["fencepost", *sys.argv[1:]])


def ask(*arguments: str, given: bytes = b"", fine: typing.Container[int] = (0,)) -> bytes:
    """Runs the program; its standard output."""
    done = subprocess.run([program(), *arguments], input=given, capture_output=True, check=False)
    if done.returncode not in fine:
        said = done.stderr.decode(errors="replace").strip() or "exit status %d" % done.returncode
        raise ProgramError(said.removeprefix("fencepost: "))
    return done.stdout


def source(log: LogSource) -> typing.Tuple[str, bytes]:
    """The log's name for the program, and its standard input."""
    if isinstance(log, bytes):
        return "-", log
    path = os.fspath(log)
    return ("./" + path if path.startswith("-") else path), b""


def recordings() -> typing.List[str]:
    """The names of the bundled recordings."""
    return sorted(path.name for path in _recordings_folder().glob("*.log"))


def recording(name: str) -> pathlib.Path:
    """A bundled recording, or the scene beside it, by its name: "go_around.log", "go_around.json"."""
    path = _recordings_folder() / name
    if not path.is_file():
        raise FileNotFoundError("no bundled recording is called %s; there are %s" % (name, ", ".join(recordings())))
    return path


def _recordings_folder() -> pathlib.Path:
    chosen = os.environ.get("FENCEPOST_SHARE")
    beside = pathlib.Path(program()).resolve().parent.parent / "share/fencepost"
    places = [pathlib.Path(chosen)] if chosen else [beside, pathlib.Path(__file__).parents[2]]
    for place in places:
        if (place / "recordings").is_dir():
            return place / "recordings"
    raise FileNotFoundError("the bundled recordings are missing; looked in %s" % ", ".join(map(str, places)))


def simulate(scene: Scene, output: typing.Union[None, str, "os.PathLike[str]"] = None) -> bytes:
    """The log of a robot in a scene: a file, or what such a file contains as a dict. Also written to `output`."""
    if isinstance(scene, (str, os.PathLike)):
        log = ask("simulate", *source(scene)[:1])
    else:
        log = ask("simulate", "-", given=json.dumps(scene).encode())
    if output is not None:
        pathlib.Path(output).write_bytes(log)
    return log


def evaluate(log: typing.Union[str, "os.PathLike[str]"],
             scene: typing.Union[None, str, "os.PathLike[str]"] = None) -> typing.Dict[str, typing.Any]:
    """How far the map of a log is from the truth of a scene, by default the .json beside the log: evaluate.md."""
    more = () if scene is None else ("--scene", os.fspath(scene))
    measures: typing.Dict[str, typing.Any] = json.loads(ask("evaluate", "--json", source(log)[0], *more))
    return measures
