"""Stub cameras of the vendors' modules, for MicroPython and CPython: three pictures, then the script ends."""
import sys
from collections import namedtuple


class Over(Exception):
    """The scripts run for ever."""


class Module:
    pass


# x, y, w, h, signature, pixels, centroid
PICTURES = [
    [],
    [(168, 66, 64, 48, 1, 2500, (200.44, 89.5))],
    [(0, 0, 320, 240, 2, 70000, (159.5, 119.5))]
    + [(10 * i, 20, 5 + i, 9, 1 + i % 2, 30 + i, (10.0 * i + 2, 24.0)) for i in range(20)],
]
shown = []
written = []


class Blob:
    """As OpenMV's firmware 4 and MaixPy have it: methods, and an index."""

    def __init__(self, x, y, w, h, signature, pixels, centroid):
        self.box, self.signature, self.area, self.centroid = (x, y, w, h), signature, pixels, centroid

    def __getitem__(self, i):
        return self.box[i]

    def rect(self):
        return self.box

    def pixels(self):
        return self.area

    def code(self):
        return 1 << (self.signature - 1)

    def cxf(self):
        return self.centroid[0]

    def cyf(self):
        return self.centroid[1]

    def cx(self):
        return int(self.centroid[0] + 0.5)

    def cy(self):
        return int(self.centroid[1] + 0.5)


Fields = namedtuple("Fields", ("x", "y", "w", "h", "cx", "cy", "pixels", "code", "cxf", "cyf", "rect"))


def fields_of(x, y, w, h, signature, pixels, centroid):
    """As OpenMV's firmware 5 has a blob: a tuple whose fields have names."""
    cx, cy = centroid
    return Fields(x, y, w, h, int(cx + 0.5), int(cy + 0.5), pixels, 1 << (signature - 1), cx, cy, (x, y, w, h))


class Picture:
    blob = Blob

    def __init__(self, blobs):
        self.blobs = blobs

    def find_blobs(self, thresholds, pixels_threshold=10, area_threshold=10, merge=False):
        """One threshold: its sign of A says which colour it is, the first or the second."""
        assert not merge and all(len(t) == 6 for t in thresholds)
        seen = [self.blob(*b) for b in self.blobs]
        if len(thresholds) == 1:
            return [b for b in seen if b.signature == (1 if thresholds[0][2] > 0 else 2)]
        return seen


def ticks_ms():
    return 9_000_005_000 + 40 * len(shown)


def next_picture():
    if len(shown) == len(PICTURES):
        raise Over
    shown.append(None)
    return Picture(PICTURES[len(shown) - 1])


def openmv(uart_module="pyb", uart_number=3):
    sensor, serial, time = Module(), Module(), Module()
    time.ticks_ms = ticks_ms
    sensor.RGB565, sensor.QVGA = 2, 4
    settings = {}
    sensor.reset = lambda: None
    sensor.set_pixformat = lambda value: settings.update(format=value)
    sensor.set_framesize = lambda value: settings.update(size=value)
    sensor.skip_frames = lambda time: None
    sensor.set_auto_gain = lambda on: settings.update(gain=on)
    sensor.set_auto_whitebal = lambda on: settings.update(white=on)

    def snapshot():
        assert settings == {"format": 2, "size": 4, "gain": False, "white": False}
        return next_picture()

    sensor.snapshot = snapshot

    class Uart:
        def __init__(self, number, baud):
            assert (number, baud) == (uart_number, 115200)

        def write(self, text):
            written.append(text)

    serial.UART = Uart
    sys.modules.update({"sensor": sensor, uart_module: serial, "time": time})


def openmv5():
    """Firmware 5 on a camera without an STM32."""
    Picture.blob = staticmethod(fields_of)
    openmv("machine", 1)


def maixcam():
    maix, app, camera, time, uart = Module(), Module(), Module(), Module(), Module()
    time.ticks_ms = ticks_ms
    app.need_exit = lambda: False

    class Camera:
        def __init__(self, width, height):
            assert (width, height) == (320, 240)

        def read(self):
            return next_picture()

    class Uart:
        def __init__(self, path, baud):
            assert (path, baud) == ("/dev/ttyS0", 115200)

        def write_str(self, text):
            written.append(text)

    camera.Camera, uart.UART = Camera, Uart
    maix.app, maix.camera, maix.time, maix.uart = app, camera, time, uart
    sys.modules["maix"] = maix


def vex():
    module = Module()

    class Colordesc:
        def __init__(self, index, red, green, blue, hue, saturation):
            assert 1 <= index <= 7 and 0 < saturation < 1
            self.index = index

    class AiVision:
        def __init__(self, port, *colours):
            assert [c.index for c in colours] == [1, 2]
            self.picture = None

        def take_snapshot(self, colour, count=8):
            if colour.index == 1:
                self.picture = next_picture()
            found = []
            for x, y, w, h, signature, _, _ in self.picture.blobs:
                thing = Module()
                thing.originX, thing.originY, thing.width, thing.height = x, y, w, h
                if signature == colour.index:
                    found.append(thing)
            return found[:count]

    module.Colordesc, module.AiVision, module.MSEC, module.Ports = Colordesc, AiVision, 0, Module()
    module.Ports.PORT1 = 1

    class Brain:
        def __init__(self):
            self.timer = Module()
            self.timer.time = lambda unit: ticks_ms()

    module.Brain = Brain
    module.wait = lambda time, unit: None
    sys.modules["vex"] = module


def run(script, camera):
    {"openmv": openmv, "openmv5": openmv5, "maixcam": maixcam, "vex": vex}[camera]()
    try:
        exec(script, {"__name__": "__main__"})
    except Over:
        pass
    for text in written:
        print("uart", repr(text))
