"""Reads Fencepost's record stream: logs, gzipped logs, and a robot's console while it runs. Standard library only.
This file works alone, beside your script, as a module `stream`.

    import fencepost
    log = fencepost.read("run.log")
    [(alert.t, alert.level, alert.distance) for alert in log.alerts]

Each record is a named tuple whose fields are those of stream.md: metres, radians, seconds, pixels. Empty fields are None.
In a notebook, pandas.DataFrame(log.odometry) is a table. A live robot:

    for record in fencepost.records(serial.Serial("/dev/ttyACM0", 115200)): ...
"""
import binascii
import collections
import gzip
import json
import os
import typing

__all__ = ["Alert", "Blob", "CalibrationDoubt", "Camera", "Car", "Digest", "Frame", "Header", "Heartbeat", "Link", "Log",
           "Object", "Odometry", "Position", "Reader", "Sectors", "Setting", "Signature", "SpeedLimit", "Status", "Way",
           "Ways", "crc", "read", "records", "result"]

LONGEST = 1024  # characters of a line, its end included
FORMAT = 1


class Header(typing.NamedTuple):
    """FPHDR: a run starts."""
    format: int
    product: str
    version: str
    target: str
    profile: str


class Camera(typing.NamedTuple):
    """FPCAM: the calibration in force from here on; px, m, rad, s."""
    model: str
    width: int
    height: int
    fx: float
    fy: float
    cx: float
    cy: float
    k1: float
    mount_x: float
    mount_y: float
    mount_z: float
    mount_yaw: float
    mount_pitch: typing.Optional[float]
    latency: float
    lens: str = "pinhole"


class Signature(typing.NamedTuple):
    """FPSIG: a colour that the camera was taught."""
    signature: int
    rgb: str
    name: str
    width: typing.Optional[float] = None  # m, where configured
    pad: int = 0  # px that its boxes are too wide on each side


class Odometry(typing.NamedTuple):
    """FPODO: the robot's pose by odometry."""
    t: typing.Optional[float]
    x: float
    y: float
    heading: float


class Car(typing.NamedTuple):
    """FPCAR: what the wheels of a car tell."""
    t: typing.Optional[float]
    count: int  # type: ignore[assignment]
    steering: typing.Optional[float]
    yaw_rate: typing.Optional[float]


class Blob(typing.NamedTuple):
    """One box of a frame: both ends belong to it. A bearing has no width: x1 and x2 are None, cx is its column."""
    signature: int
    x1: typing.Optional[int]
    y1: int
    x2: typing.Optional[int]
    y2: int
    cx: float
    cy: float
    pixels: int
    rgb: typing.Optional[str]
    track: typing.Optional[int] = None  # id by a camera that tracks


class Frame(typing.NamedTuple):
    """FPFRM: what the camera saw; t is when its first byte arrived."""
    t: float
    frame: int
    blobs: typing.Tuple[Blob, ...]


class Position(typing.NamedTuple):
    """FPPOS: the pose after correction by landmarks."""
    t: float
    x: float
    y: float
    heading: float
    sigma_xy: float
    sigma_heading: float


class Object(typing.NamedTuple):
    """FPOBJ: the estimate of one object, map frame; bearing and distance from the robot."""
    t: float
    id: int
    signature: int
    views: int
    x: float
    y: float
    radius: float
    z_min: float
    z_max: float
    bearing: float
    distance: float
    confidence: float
    state: str


class Alert(typing.NamedTuple):
    """FPALR: clear, notice, warn, stop or blind. Of a blind robot no number is known."""
    t: float
    level: str
    id: int
    signature: int
    bearing: typing.Optional[float]
    distance: typing.Optional[float]
    ttc: typing.Optional[float]
    confidence: typing.Optional[float]


class Heartbeat(typing.NamedTuple):
    """FPALV: the robot is at work; the highest level in force."""
    t: float
    level: str
    camera: str
    odometry: str


class SpeedLimit(typing.NamedTuple):
    """FPSPD: the largest speed from which the robot still stops in front of what it knows; None: not known."""
    t: float
    speed: typing.Optional[float]


class CalibrationDoubt(typing.NamedTuple):
    """FPCAL: what the robot thinks of its camera."""
    t: float
    doubt: str
    factor: float


class Digest(typing.NamedTuple):
    """FPDIG: the digest of the state after a frame."""
    frame: int
    digest: str


class Link(typing.NamedTuple):
    """FPLNK: a device's link changed."""
    t: float
    device: str
    state: str
    detail: str


class Status(typing.NamedTuple):
    """FPSTA: counters since boot."""
    t: float
    frames: int
    blobs: int
    blobs_dropped: int
    odometry: int
    rejected: int
    refused: int
    records_dropped: int
    objects: int
    loop_us_max: int


class Setting(typing.NamedTuple):
    """FPCFG: a setting in force or changed."""
    key: str
    value: str


class Sectors(typing.NamedTuple):
    """FPSEC: nearest distance in equal sectors, the first straight ahead, counter-clockwise; None: unknown."""
    t: float
    distances: typing.Tuple[typing.Optional[float], ...]


class Way(typing.NamedTuple):
    """How far (m; on the spot rad) and how fast the robot may go forward, back or in a spin; `end`: what ends it."""
    motion: str
    curvature: float
    free: float
    speed: float
    end: str


class Ways(typing.NamedTuple):
    """FPWAY: the ways on from where the robot is: on the spot, forward from the left to the right, back."""
    t: float
    ways: typing.Tuple[Way, ...]


KINDS = {"HDR": Header, "CAM": Camera, "SIG": Signature, "ODO": Odometry, "CAR": Car, "FRM": Frame, "POS": Position,
         "OBJ": Object, "ALR": Alert, "ALV": Heartbeat, "CAL": CalibrationDoubt, "DIG": Digest, "LNK": Link,
         "STA": Status, "CFG": Setting, "SEC": Sectors, "WAY": Ways, "SPD": SpeedLimit}
Record = typing.Union[Header, Camera, Signature, Odometry, Car, Frame, Position, Object, Alert, Heartbeat, CalibrationDoubt,
                      Digest, Link, Status, Setting, Sectors, Ways, SpeedLimit]


class _Bad(Exception):
    """Its argument is the reason, as `log.rejected` counts it."""


def crc(text: str) -> str:
    """CRC-16/CCITT-FALSE of what stands between `$` and `*`, as it is written."""
    return "%04X" % binascii.crc_hqx(text.encode("latin-1"), 0xFFFF)


def _integer(field: str) -> int:
    if not field.lstrip("-").isdecimal() or not field.isascii() or field.startswith("--"):
        raise _Bad("number")
    return int(field)


def _float(field: str) -> float:
    whole, point, more = field.partition(".")
    if point and not (more.isdecimal() and more.isascii()):
        raise _Bad("number")
    _integer(whole)
    return float(field)


def _text(field: str) -> str:
    parts = field.split("%")
    try:
        return parts[0] + "".join(chr(int(part[:2], 16)) + part[2:] if len(part) > 1 else _raise() for part in parts[1:])
    except ValueError:
        raise _Bad("number") from None


def _raise() -> typing.NoReturn:
    raise _Bad("number")


def _optional(read: typing.Callable[[str], typing.Any]) -> typing.Callable[[str], typing.Any]:
    return lambda field: None if field == "" else read(field)


_READ: typing.Dict[typing.Any, typing.Callable[[str], typing.Any]] = {
    int: _integer, float: _float, str: _text, typing.Optional[int]: _optional(_integer),
    typing.Optional[float]: _optional(_float), typing.Optional[str]: _optional(_text)}


def _fields(kind: typing.Any, fields: typing.List[str]) -> typing.Any:
    """The named tuple of these fields; those with a default may be missing."""
    types = list(typing.get_type_hints(kind).values())
    if not len(types) - len(kind._field_defaults) <= len(fields) <= len(types):
        raise _Bad("fields")
    return kind(*(_READ[of](field) for of, field in zip(types, fields)))


def _items(of: type, fields: typing.List[str], first: int) -> typing.Tuple[typing.Any, ...]:
    """The list that ends a record: its items begin with field `first`, their count is the field before. Fields with a
    default may be missing, in all items."""
    if len(fields) < first:
        raise _Bad("fields")
    count = _integer(fields[first - 1])
    size = len(of._fields)  # type: ignore[attr-defined]
    if len(fields) != first + size * count:
        size -= len(of._field_defaults)  # type: ignore[attr-defined]
    if len(fields) != first + size * count:
        raise _Bad("fields")
    return tuple(_fields(of, fields[at:at + size]) for at in range(first, len(fields), size))


def _frame(fields: typing.List[str]) -> Frame:
    blobs = _items(Blob, fields, 3)
    if any((blob.x1 is None) != (blob.x2 is None) for blob in blobs):
        raise _Bad("number")
    return Frame(_float(fields[0]), _integer(fields[1]), blobs)


def _sectors(fields: typing.List[str]) -> Sectors:
    if len(fields) < 2 or len(fields) != 2 + _integer(fields[1]):
        raise _Bad("fields")
    return Sectors(_float(fields[0]), tuple(_READ[typing.Optional[float]](field) for field in fields[2:]))


def _ways(fields: typing.List[str]) -> Ways:
    ways = _items(Way, fields, 2)
    return Ways(_float(fields[0]), ways)


_LISTS: typing.Dict[type, typing.Callable[[typing.List[str]], "Record"]] = {
    Frame: _frame, Sectors: _sectors, Ways: _ways}


def _record(line: str) -> Record:
    """The record of a line that starts with $FP, without its end."""
    body, star, check = line[1:].partition("*")
    if not star or check != crc(body):
        raise _Bad("crc")
    kind = KINDS.get(body[2:5]) if body[5:6] in ("", ",") else None
    if kind is None:
        raise _Bad("kind")
    fields = body.split(",")[1:]
    if kind is Header and fields and fields[0] != str(FORMAT):
        raise _Bad("format")
    return _LISTS[kind](fields) if kind in _LISTS else typing.cast(Record, _fields(kind, fields))


class Reader:
    """Records out of bytes as they come. Lines that are not of the stream are counted in `foreign`, bad ones by reason
    in `rejected`; neither ends the reading. Of the rules of a log (order of times, boxes inside the image) it knows
    nothing: `fencepost replay` does."""

    def __init__(self) -> None:
        self.rejected: typing.Counter[str] = collections.Counter()
        self.foreign = 0
        self._rest = b""

    def feed(self, data: bytes) -> typing.Iterator[Record]:
        """The records that these bytes complete."""
        lines = (self._rest + data).split(b"\n")
        self._rest = lines.pop()[:LONGEST + 1]
        for line in lines:
            record = self._take(line + b"\n")
            if record is not None:
                yield record

    def finish(self) -> None:
        """There is no more: a last line without its end is not used."""
        if self._rest.startswith(b"$FP"):
            self.rejected["truncated"] += 1
        elif self._rest:
            self.foreign += 1
        self._rest = b""

    def _take(self, line: bytes) -> typing.Optional[Record]:
        if not line.startswith(b"$FP"):
            self.foreign += 1
            return None
        try:
            if len(line) > LONGEST:
                raise _Bad("length")
            return _record(line.rstrip(b"\n").removesuffix(b"\r").decode("latin-1"))
        except _Bad as bad:
            self.rejected[str(bad)] += 1
            return None


class Log:
    """All records of a log in order, and by kind: header, camera and signatures are those in force at its end."""

    def __init__(self, all_records: typing.List[Record], reader: Reader) -> None:
        self.records = all_records
        self.rejected = dict(reader.rejected)
        self.foreign = reader.foreign
        by_kind: typing.Dict[type, typing.List[typing.Any]] = collections.defaultdict(list)
        for record in all_records:
            by_kind[type(record)].append(record)
        self.headers: typing.List[Header] = by_kind[Header]
        self.header: typing.Optional[Header] = by_kind[Header][-1] if by_kind[Header] else None
        self.camera: typing.Optional[Camera] = by_kind[Camera][-1] if by_kind[Camera] else None
        self.signatures: typing.Dict[int, Signature] = {entry.signature: entry for entry in by_kind[Signature]}
        self.settings: typing.Dict[str, str] = {setting.key: setting.value for setting in by_kind[Setting]}
        self.odometry: typing.List[Odometry] = by_kind[Odometry]
        self.car: typing.List[Car] = by_kind[Car]
        self.frames: typing.List[Frame] = by_kind[Frame]
        self.positions: typing.List[Position] = by_kind[Position]
        self.objects: typing.List[Object] = by_kind[Object]
        self.alerts: typing.List[Alert] = by_kind[Alert]
        self.heartbeats: typing.List[Heartbeat] = by_kind[Heartbeat]
        self.links: typing.List[Link] = by_kind[Link]
        self.status: typing.List[Status] = by_kind[Status]
        self.digests: typing.List[Digest] = by_kind[Digest]
        self.doubts: typing.List[CalibrationDoubt] = by_kind[CalibrationDoubt]
        self.sectors: typing.List[Sectors] = by_kind[Sectors]
        self.ways: typing.List[Ways] = by_kind[Ways]
        self.speed_limits: typing.List[SpeedLimit] = by_kind[SpeedLimit]

    def name(self, signature: int) -> str:
        """The colour's name; `sig 7` where the log has none."""
        return self.signatures[signature].name if signature in self.signatures else "sig %d" % signature

    def __repr__(self) -> str:
        return "<fencepost.Log: %d records, %d frames, %d alerts>" % (len(self.records), len(self.frames),
                                                                     len(self.alerts))


def records(stream: typing.BinaryIO, reader: typing.Optional[Reader] = None) -> typing.Iterator[Record]:
    """The records of a binary stream as they come: an open file, a serial port, a socket's makefile("rb")."""
    reader = reader or Reader()
    for piece in iter(lambda: stream.readline(4 * LONGEST), b""):
        yield from reader.feed(piece)
    reader.finish()


def read(path: typing.Union[str, "os.PathLike[str]"]) -> Log:
    """A whole log, gzipped or not."""
    with open(path, "rb") as file:
        zipped = file.read(2) == b"\x1f\x8b"
    reader = Reader()
    with typing.cast(typing.BinaryIO, gzip.open(path) if zipped else open(path, "rb")) as file:
        return Log(list(records(file, reader)), reader)


def result(path: typing.Union[str, "os.PathLike[str]"]) -> typing.Dict[str, typing.Any]:
    """The document that `fencepost replay --json` writes."""
    with open(path, encoding="utf-8") as file:
        document: typing.Dict[str, typing.Any] = json.load(file)
    if document.get("format") != FORMAT:
        raise ValueError("%s: not a result of format %d: write it with fencepost replay --json LOG" % (path, FORMAT))
    return document
