"""fencepost.h by ctypes: structures, functions and where the shared library is."""
import ctypes
import ctypes.util
import os
import pathlib
import typing

HEADER = "0.1"  # the version whose structures these are; libraries with the same first two numbers have them
MAX_BOXES, MAX_CORNERS, SECTORS, WAYS = 16, 72, 36, 9
MOTIONS = ("forward", "back", "spin")
WAY_ENDS = ("nothing", "thing", "unknown")
LEVELS = ("clear", "notice", "warn", "stop", "blind")


class Camera(ctypes.Structure):
    _fields_ = [("width", ctypes.c_uint16), ("height", ctypes.c_uint16),
                *((name, ctypes.c_float) for name in ("fx", "fy", "cx", "cy", "k1", "x", "y", "z", "yaw", "pitch")),
                ("pitch_unknown", ctypes.c_bool), ("fisheye", ctypes.c_bool), ("latency", ctypes.c_int32)]


class Pose(ctypes.Structure):
    _fields_ = [(name, ctypes.c_float) for name in ("x", "y", "heading")]


class Point(ctypes.Structure):
    _fields_ = [("x", ctypes.c_float), ("y", ctypes.c_float)]


class Box(ctypes.Structure):
    _fields_ = [("signature", ctypes.c_uint8), *((name, ctypes.c_int16) for name in ("left", "top", "right", "bottom"))]


class Colour(ctypes.Structure):
    _fields_ = [*((name, ctypes.c_uint8) for name in ("signature", "red", "green", "blue")), ("pad", ctypes.c_int8),
                ("size", ctypes.c_float), ("name", ctypes.c_char_p)]


class Alert(ctypes.Structure):
    _fields_ = [("level", ctypes.c_int), ("object", ctypes.c_uint32), ("signature", ctypes.c_uint8),
                *((name, ctypes.c_float) for name in ("distance", "bearing", "contact", "confidence")),
                ("time", ctypes.c_int64), ("sentence", ctypes.c_char_p)]


class Object(ctypes.Structure):
    _fields_ = [("id", ctypes.c_uint32), ("signature", ctypes.c_uint8), ("confirmed", ctypes.c_bool),
                ("lost", ctypes.c_bool), ("views", ctypes.c_uint32),
                *((name, ctypes.c_float) for name in ("x", "y", "radius", "z_min", "z_max", "distance", "bearing",
                                                      "confidence"))]


class Way(ctypes.Structure):
    _fields_ = [("motion", ctypes.c_int), *((name, ctypes.c_float) for name in ("curvature", "free", "speed")),
                ("end", ctypes.c_int)]


class PassingRule(ctypes.Structure):
    _fields_ = [("signature", ctypes.c_uint8), ("on_the_right", ctypes.c_bool)]


AlertFunction = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.POINTER(Alert))
LogFunction = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.POINTER(ctypes.c_char), ctypes.c_size_t)

_HANDLE, _TEXT, _SIZE, _TIME = ctypes.c_void_p, ctypes.c_char_p, ctypes.c_size_t, ctypes.c_int64
_FUNCTIONS: typing.Dict[str, typing.Tuple[typing.Any, ...]] = {  # name: result, arguments
    "version": (_TEXT,),
    "answer_text": (_TEXT, ctypes.c_int),
    "micro": (_HANDLE,),
    "small": (_HANDLE,),
    "full": (_HANDLE,),
    "bytes": (_SIZE, _HANDLE),
    "capacity_objects": (_SIZE, _HANDLE),
    "init": (_HANDLE, _HANDLE, _SIZE, _HANDLE),
    "delivered_camera": (Camera, _TEXT),
    "pinhole": (Camera, ctypes.c_uint16, ctypes.c_uint16, ctypes.c_float),
    "box_centred": (Box, ctypes.c_uint8, *[ctypes.c_float] * 4),
    "set_camera": (ctypes.c_int, _HANDLE, ctypes.POINTER(Camera)),
    "set": (ctypes.c_int, _HANDLE, _TEXT, _TEXT),
    "set_number": (ctypes.c_int, _HANDLE, _TEXT, ctypes.c_float),
    "set_colour": (ctypes.c_int, _HANDLE, ctypes.POINTER(Colour)),
    "set_name": (ctypes.c_int, _HANDLE, ctypes.c_uint8, _TEXT),
    "on_alert": (ctypes.c_int, _HANDLE, AlertFunction, ctypes.c_void_p),
    "on_log": (ctypes.c_int, _HANDLE, LogFunction, ctypes.c_void_p),
    "odometry": (ctypes.c_int, _HANDLE, _TIME, Pose),
    "boxes": (ctypes.c_int, _HANDLE, _TIME, ctypes.POINTER(Box), _SIZE),
    "step": (ctypes.c_int, _HANDLE, _TIME),
    "restart": (ctypes.c_int, _HANDLE),
    "level_in_force": (ctypes.c_int, _HANDLE),
    "may_drive": (ctypes.c_bool, _HANDLE, _TIME),
    "speed_limit": (ctypes.c_float, _HANDLE),
    "objects": (_SIZE, _HANDLE, ctypes.POINTER(Object), _SIZE),
    "outline": (_SIZE, _HANDLE, ctypes.c_uint32, ctypes.POINTER(Point), _SIZE),
    "sectors": (_SIZE, _HANDLE, ctypes.POINTER(ctypes.c_float), _SIZE),
    "ways": (_SIZE, _HANDLE, ctypes.POINTER(Way), _SIZE, ctypes.POINTER(PassingRule), _SIZE),
    "where": (ctypes.c_bool, _HANDLE, ctypes.POINTER(Pose)),
    "digest": (ctypes.c_uint64, _HANDLE),
}


class Library:
    """The functions without their prefix: `library().version()`."""

    def __init__(self, path: str) -> None:
        loaded = ctypes.CDLL(path)
        for name, (result, *arguments) in _FUNCTIONS.items():
            function = getattr(loaded, "fencepost_" + name)
            function.restype, function.argtypes = result, arguments
            setattr(self, name, function)
        found = self.version().decode()
        if found.split(".")[:2] != HEADER.split("."):
            raise OSError("%s is of version %s, and this package is made for %s: install both of one version"
                          % (path, found, HEADER))

    def __getattr__(self, name: str) -> typing.Any:  # for type checkers: the functions are set above
        raise AttributeError(name)


_loaded: typing.Optional[Library] = None


def library() -> Library:
    """The shared library: FENCEPOST_LIBRARY's, the one inside the package, or the system's."""
    global _loaded
    if _loaded is None:
        inside = pathlib.Path(__file__).parent / "_install/lib/libfencepost.so"
        path = os.environ.get("FENCEPOST_LIBRARY") or (
            str(inside) if inside.is_file() else ctypes.util.find_library("fencepost"))
        if path is None:
            raise OSError("libfencepost.so is neither in %s nor in the system's folders; install the wheel or the package "
                          "libfencepost0.1, or set FENCEPOST_LIBRARY to its path" % inside.parent)
        _loaded = Library(path)
    return _loaded


def version() -> str:
    """The version of the library that is loaded."""
    return str(library().version().decode())
