"""A log through the robot's own loop: its map and alerts as values, arrays and a picture."""
import array
import functools
import json
import os
import pathlib
import re
import tempfile
import typing

from . import _program
from .stream import Alert, Way

Ring = typing.List[typing.Tuple[float, float]]


class Mapped(typing.NamedTuple):
    """An object of the map at the end of a run. Place and radius are None where nothing is known of them."""
    id: int
    signature: int
    name: str
    state: str
    views: int
    x: typing.Optional[float]
    y: typing.Optional[float]
    radius: typing.Optional[float]
    z_min: float
    z_max: float
    confidence: float
    outline: Ring  # of the hybrid, else of the cylinder; closed, counter-clockwise; may be empty


class Grid(typing.NamedTuple):
    """The map in cells. `cells[row, column]`: 100 occupied, 0 free, -1 unknown; row 0 has the smallest y."""
    resolution: float  # m, of a cell
    x: float  # m, of the lower left corner
    y: float
    cells: memoryview


class Run:
    """A replayed log. `document` is all of the result, as results.md describes; print() shows alerts and objects."""

    def __init__(self, document: typing.Dict[str, typing.Any], log: _program.LogSource,
                 options: typing.Tuple[str, ...] = ()) -> None:
        self.document = document
        self._log, self._options = log, options

    @property
    def digest(self) -> str:
        """Of all that the map has been through."""
        return str(self.document["digest"])

    @functools.cached_property
    def objects(self) -> typing.List[Mapped]:
        """The objects of the map."""
        return [_mapped(item) for item in self.document["objects"]]

    @functools.cached_property
    def alerts(self) -> typing.List[Alert]:
        """Every alert in order. Id and signature are 0 where it is no object of the map."""
        colours = {item["id"]: item["signature"] for item in self.document["objects"]}
        return [Alert(at["t"], at["level"], at["id"], colours.get(at["id"], 0), at["bearing"], at["distance"], at["ttc"],
                      at["confidence"]) for at in self.document["alerts"]]

    @functools.cached_property
    def path(self) -> memoryview:
        """Where the robot was: an array of rows t, x, y, heading."""
        rows = self.document["path"]
        numbers = array.array("d", (number for row in rows for number in row))
        flat = memoryview(numbers)
        return flat.cast("B").cast("d", shape=[len(rows), 4]) if rows else flat

    @property
    def sectors(self) -> typing.List[typing.Optional[float]]:
        """36 distances all around at the end, the first straight ahead, counter-clockwise; None: unknown."""
        found = self.document["sectors"]
        return list(found["distances"]) if found else []

    @property
    def ways(self) -> typing.List[Way]:
        """How far and how fast the robot may go at the end: see Core.ways()."""
        found = self.document["ways"]
        return [Way(**way) for way in found["ways"]] if found else []

    @property
    def speed_limit(self) -> typing.Optional[float]:
        """How fast the robot might have been at the end: see Core.speed_limit."""
        return typing.cast(typing.Optional[float], self.document["speed_limit"])

    def grid(self, resolution: float = 0.02) -> Grid:
        """The map in cells of so many metres, as `fencepost export --format nav2` writes it."""
        with tempfile.TemporaryDirectory() as folder:
            name, given = _program.source(self._log)
            words = pathlib.Path(folder, "map.yaml")
            _program.ask("export", name, "--format", "nav2", "--resolution", str(resolution), "-o", str(words),
                         *self._options, given=given)
            origin = re.search(r"origin: \[([-\d.]+), ([-\d.]+)", words.read_text())
            _, size, _, pixels = words.with_suffix(".pgm").read_bytes().split(b"\n", 3)
        columns, rows = (int(number) for number in size.split())
        values = {0: 100, 254: 0}
        lines = (pixels[at * columns:(at + 1) * columns] for at in reversed(range(rows)))
        cells = array.array("b", (values.get(pixel, -1) for line in lines for pixel in line))
        assert origin is not None
        return Grid(resolution, float(origin[1]), float(origin[2]),
                    memoryview(cells).cast("B").cast("b", shape=[rows, columns]))

    def svg(self) -> str:
        """The map as a picture."""
        name, given = _program.source(self._log)
        return _program.ask("export", name, "--format", "svg", "-o", "-", *self._options, given=given).decode()

    def _repr_svg_(self) -> str:
        return self.svg()

    def __str__(self) -> str:
        lines = ["%d alerts, %d objects, digest %s" % (len(self.alerts), len(self.objects), self.digest)]
        names = {item.id: item.name for item in self.objects}
        for alert in self.alerts:
            what = names.get(alert.id, "something") if alert.id else "something"
            place = "" if alert.distance is None else "  %-8s  %.2f m" % (what, alert.distance)
            lines.append("%10.3f s  %-6s%s" % (alert.t, alert.level.upper(), place))
        for item in self.objects:
            place = "place unknown"
            if item.x is not None and item.y is not None and item.radius is not None:
                place = "at (%.2f, %.2f) m, radius %.2f m" % (item.x, item.y, item.radius)
            lines.append("object %d: %s, %s, confidence %.2f" % (item.id, item.name, place, item.confidence))
        return "\n".join(lines)

    def __repr__(self) -> str:
        return "<fencepost.Run: %d objects, %d alerts>" % (len(self.objects), len(self.alerts))


def _mapped(item: typing.Mapping[str, typing.Any]) -> Mapped:
    cylinder = item["models"]["cylinder"]
    outline: Ring = []
    for model in ("cylinder", "hybrid"):
        geometry = item["models"].get(model, {}).get("geometry")
        if geometry:
            polygon = geometry["coordinates"] if geometry["type"] == "Polygon" else geometry["coordinates"][0]
            outline = [(x, y) for x, y in polygon[0]]
    name = item["name"] if item["name"] is not None else "sig %d" % item["signature"]
    return Mapped(item["id"], item["signature"], name, item["state"], item["views"], cylinder["x"], cylinder["y"],
                  cylinder["radius"], item["z_min"], item["z_max"], item["confidence"], outline)


def replay(log: _program.LogSource, profile: typing.Optional[str] = None,
           camera: typing.Union[None, str, "os.PathLike[str]"] = None) -> Run:
    """A log, packed or not, as a file or bytes, through the robot's own loop.

    `profile`: micro, small or full, by default the log's; `camera`: a calibration for logs without one.
    """
    options: typing.Tuple[str, ...] = ()
    if profile is not None:
        options += ("--profile", profile)
    if camera is not None:
        options += ("--camera", os.fspath(camera))
    name, given = _program.source(log)
    return Run(json.loads(_program.ask("replay", "--json", name, *options, given=given)), log, options)
