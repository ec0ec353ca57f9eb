"""The robot's loop in a program of yours, by the C interface."""
import ctypes
import math
import typing

from . import _interface as c
from . import stream

Corners = typing.Sequence[float]  # signature, left, top, right, bottom: what Box is


class Refused(ValueError):
    """An input that the core did not take; it changed nothing."""


class Heard(typing.NamedTuple):
    """An alert of a Core. Distance and bearing are from the robot's origin; `ttc` is None when not closing."""
    t: float
    level: str
    id: int
    signature: int
    bearing: float
    distance: float
    ttc: typing.Optional[float]
    confidence: float
    sentence: str


class Seen(typing.NamedTuple):
    """An object of a Core's map."""
    id: int
    signature: int
    confirmed: bool
    lost: bool
    views: int
    x: float
    y: float
    radius: float
    z_min: float
    z_max: float
    distance: float
    bearing: float
    confidence: float


class Box(typing.NamedTuple):
    """A box of the camera, px; both corners belong to it."""
    signature: int
    left: int
    top: int
    right: int
    bottom: int

    @staticmethod
    def centred(signature: int, cx: float, cy: float, width: float, height: float) -> "Box":
        """A box by its middle and size, px: 9 columns around 20 are 16 to 24."""
        box = c.library().box_centred(signature, cx, cy, width, height)
        return Box(box.signature, box.left, box.top, box.right, box.bottom)


class Camera(typing.NamedTuple):
    """The camera and where it is mounted on the robot: px, m, rad; latency in s. A `pitch` of None is unknown."""
    width: int
    height: int
    fx: float
    fy: float
    cx: float
    cy: float
    k1: float = 0.0
    x: float = 0.0
    y: float = 0.0
    z: float = 0.0
    yaw: float = 0.0
    pitch: typing.Optional[float] = 0.0
    fisheye: bool = False
    latency: float = 0.0

    @staticmethod
    def _of(camera: c.Camera, mount: typing.Mapping[str, typing.Any]) -> "Camera":
        values = {name: getattr(camera, name) for name in Camera._fields}
        return Camera(**{**values, "latency": camera.latency * 1e-6, **mount})

    @staticmethod
    def pinhole(width: int, height: int, degrees: float, **mount: typing.Any) -> "Camera":
        """An ordinary lens that sees so many degrees across the width; `mount`: z=0.12 and other fields."""
        camera = c.library().pinhole(width, height, degrees)
        if camera.width < 2:
            raise ValueError("no pinhole of %s columns sees %s degrees across; it is 1 to 170" % (width, degrees))
        return Camera._of(camera, mount)

    @staticmethod
    def delivered(name: str, **mount: typing.Any) -> "Camera":
        """The camera as its maker delivers it: "pixy2", "huskylens" and others; `mount`: z=0.12 and other fields."""
        camera = c.library().delivered_camera(name.encode())
        if camera.width == 0:
            raise ValueError("no camera is called '%s'; fencepost run --help lists them, such as pixy2" % name)
        return Camera._of(camera, mount)


class Core:
    """One robot: odometry and boxes in, alerts and a map out.

        core = fencepost.Core(fencepost.Camera.pinhole(640, 480, 62, z=0.12))
        core.odometry(0.00, x=0, y=0, heading=0)
        for alert in core.boxes(0.02, [fencepost.Box.centred(1, 320, 300, 40, 60)]):
            print(alert.sentence)
        motors(core.may_drive(0.02))

    Times are seconds of one clock, not negative, in order for each kind of input. `odometry`, `boxes` and `step` return
    the alerts that they caused and raise Refused where an input cannot be. One thread at a time may call a core.
    """

    def __init__(self, camera: typing.Optional[Camera] = None, size: str = "full",
                 log: typing.Optional[typing.BinaryIO] = None) -> None:
        """`size`: micro, small or full, which is 4, 8 or 64 objects. `log` gets what `replay` plays again."""
        if size not in ("micro", "small", "full"):
            raise ValueError("'%s' is no size; take micro, small or full" % size)
        self._library = c.library()
        capacity = getattr(self._library, size)()
        count = self._library.bytes(capacity)
        self._memory = (ctypes.c_uint64 * (count // 8 + 1))()
        self._capacity: int = self._library.capacity_objects(capacity)
        self._core = self._library.init(ctypes.addressof(self._memory), ctypes.sizeof(self._memory), capacity)
        self._heard: typing.List[Heard] = []
        self._logged: typing.List[bytes] = []
        self._log = log
        self._hear, self._keep = c.AlertFunction(self._take_alert), c.LogFunction(self._take_log)
        self._library.on_alert(self._core, self._hear, None)
        if log is not None:
            self._library.on_log(self._core, self._keep, None)
        if camera is not None:
            self.set_camera(camera)

    def _take_alert(self, _context: typing.Any, pointer: typing.Any) -> None:
        alert = pointer.contents
        self._heard.append(Heard(alert.time * 1e-6, c.LEVELS[alert.level], alert.object, alert.signature, alert.bearing,
                                 alert.distance, alert.contact if alert.contact >= 0 else None, alert.confidence,
                                 alert.sentence.decode(errors="replace")))

    def _take_log(self, _context: typing.Any, text: typing.Any, size: int) -> None:
        self._logged.append(ctypes.string_at(text, size))

    def _done(self, answer: int, what: str) -> typing.List[Heard]:
        heard, self._heard = self._heard, []
        logged, self._logged = self._logged, []
        if self._log is not None:
            self._log.write(b"".join(logged))
        if answer != 0:
            raise Refused("%s: %s" % (what, self._library.answer_text(answer).decode()))
        return heard

    def set_camera(self, camera: Camera) -> None:
        """In force for the boxes after it."""
        values = camera._asdict()
        values["pitch_unknown"] = values["pitch"] is None
        values["pitch"] = values["pitch"] or 0.0
        values["latency"] = _micros(camera.latency)
        for name in ("width", "height"):
            if not 0 <= values[name] <= 0xFFFF:
                raise Refused("%s: a size is 2 to 65535 px" % (camera,))
        self._done(self._library.set_camera(self._core, ctypes.byref(c.Camera(**values))), str(camera))

    def set(self, key: str, value: typing.Union[float, str]) -> None:
        """A setting of the console, such as "robot.width", 0.18 or "correct.pose", "off"."""
        if isinstance(value, str):
            answer = self._library.set(self._core, key.encode(), value.encode())
        else:
            answer = self._library.set_number(self._core, key.encode(), value)
        self._done(answer, "%s = %s" % (key, value))

    def colour(self, signature: int, name: str = "", rgb: str = "000000", size: float = 0.0, pad: int = 0) -> None:
        """Describes the things of a colour, for the boxes after it. Reports draw them in `rgb`. `size`, m, is their
        diameter, or 1.27 times a square block's side. `pad`, px: their boxes are so much too wide on each side."""
        what = "colour %s" % signature
        try:
            red, green, blue = bytes.fromhex(rgb)
        except ValueError:
            raise Refused("%s: '%s' is not six hex digits, such as d02020" % (what, rgb)) from None
        if not 0 <= signature <= 255 or abs(pad) > 100:
            raise Refused("%s, pad %s: a signature is 0 to 255, a pad -100 to 100 px" % (what, pad))
        given = c.Colour(signature, red, green, blue, pad, size, name.encode())
        self._done(self._library.set_colour(self._core, ctypes.byref(given)), "%s, size %s m" % (what, size))

    def name(self, signature: int, name: str) -> None:
        """A colour's name alone, in sentences; at most 32 bytes of UTF-8."""
        self._done(self._library.set_name(self._core, signature, name.encode()), "name %s" % name)

    def odometry(self, t: float, x: float, y: float, heading: float) -> typing.List[Heard]:
        """Where the wheels say that the robot is, in a frame that stays; 20 to 100 times a second."""
        return self._done(self._library.odometry(self._core, _micros(t), c.Pose(x, y, heading)),
                          "odometry at %s s, (%s, %s, %s)" % (t, x, y, heading))

    def boxes(self, t: float, boxes: typing.Sequence[typing.Union[Box, Corners]] = ()) -> typing.List[Heard]:
        """A frame of the camera, also one without boxes; `t`: when its first byte came."""
        array = (c.Box * len(boxes))()
        for i, box in enumerate(boxes):
            signature, *corners = (int(number) for number in box)
            if len(corners) != 4 or not 0 <= signature <= 255 or any(abs(number) > 0x7FFF for number in corners):
                raise Refused("%s is no box: it is signature (0 to 255), left, top, right, bottom" % (box,))
            array[i] = c.Box(signature, *corners)
        return self._done(self._library.boxes(self._core, _micros(t), array, len(boxes)), "boxes at %s s" % t)

    def step(self, t: float) -> typing.List[Heard]:
        """Time has passed: call it in each turn, at least ten times a second."""
        return self._done(self._library.step(self._core, _micros(t)), "step to %s s" % t)

    def restart(self) -> None:
        """A new run: the map is empty and time begins again; camera, names and settings stay."""
        self._done(self._library.restart(self._core), "restart")

    def may_drive(self, t: float) -> bool:
        """May the motors run? Not while anything says stop, an input is missing or step() was not called for 0.3 s."""
        return bool(self._library.may_drive(self._core, _micros(t)))

    @property
    def level(self) -> str:
        """The highest alert in force: clear, notice, warn, stop or blind."""
        return c.LEVELS[self._library.level_in_force(self._core)]

    @property
    def speed_limit(self) -> typing.Optional[float]:
        """m/s, the largest speed from which the robot still stops in front of what it knows; None: not known."""
        limit = self._library.speed_limit(self._core)
        return limit if limit >= 0 else None

    @property
    def objects(self) -> typing.List[Seen]:
        """The objects of the map."""
        array = (c.Object * self._capacity)()
        count = self._library.objects(self._core, array, len(array))
        return [Seen(*(getattr(item, name) for name in Seen._fields)) for item in array[:count]]

    def outline(self, id: int) -> typing.List[typing.Tuple[float, float]]:
        """Corners of that object's outline in the map, counter-clockwise; empty if it is not known yet."""
        array = (c.Point * c.MAX_CORNERS)()
        return [(point.x, point.y) for point in array[:self._library.outline(self._core, id, array, len(array))]]

    @property
    def sectors(self) -> typing.List[typing.Optional[float]]:
        """36 distances all around, the first straight ahead, counter-clockwise; None: unknown. Empty without odometry."""
        array = (ctypes.c_float * c.SECTORS)()
        return [at if at >= 0 else None for at in array[:self._library.sectors(self._core, array, len(array))]]

    def ways(self, right: typing.Iterable[int] = (), left: typing.Iterable[int] = ()) -> typing.List[stream.Way]:
        """How far and how fast the robot may go: on the spot, seven arcs forward from the left to the right, back. Colours
        in `right` have to be passed on their right, those in `left` on their left. Empty without odometry."""
        sides = [(signature, True) for signature in right] + [(signature, False) for signature in left]
        rules = (c.PassingRule * len(sides))(*sides)
        array = (c.Way * c.WAYS)()
        count = self._library.ways(self._core, array, len(array), rules if sides else None, len(sides))
        return [stream.Way(c.MOTIONS[way.motion], way.curvature, way.free, way.speed, c.WAY_ENDS[way.end])
                for way in array[:count]]

    @property
    def pose(self) -> typing.Optional[typing.Tuple[float, float, float]]:
        """Where the robot is in the map: x, y, heading. None: no odometry yet."""
        pose = c.Pose()
        return (pose.x, pose.y, pose.heading) if self._library.where(self._core, ctypes.byref(pose)) else None

    @property
    def digest(self) -> str:
        """Of all that the map has been through, as `fencepost replay` prints it."""
        return "%016x" % self._library.digest(self._core)

    def __repr__(self) -> str:
        return "<fencepost.Core: %s, %d objects>" % (self.level, len(self.objects))


def _micros(seconds: float) -> int:
    if not math.isfinite(seconds) or abs(seconds) > 1e9:
        raise Refused("%s s is no time" % seconds)
    return round(seconds * 1e6)
