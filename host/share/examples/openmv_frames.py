# Fencepost's frames from an OpenMV: one $FPFRM line a picture, on its USB port and on pin P4, 115200 baud.
# MicroPython of firmware 4 or 5; save it on the camera as main.py. THRESHOLDS: one colour a line, from OpenMV IDE's
# threshold editor; the first is signature 1.
import sensor
from time import ticks_ms
try:  # a camera with an STM32
    from pyb import UART
    uart = UART(3, 115200)
except ImportError:  # RT1062, AE3
    from machine import UART
    uart = UART(1, 115200)

THRESHOLDS = [
    (30, 100, 15, 127, 15, 127),  # red: L, A and B, least and greatest
    (30, 100, -64, -8, -32, 32),  # green
]
MOST = 16  # blobs a line


def crc16(text):
    crc = 0xFFFF
    for c in text.encode():
        crc ^= c << 8
        for _ in range(8):
            crc = (crc << 1 ^ 0x1021 if crc & 0x8000 else crc << 1) & 0xFFFF
    return crc


def value(field):  # a blob has methods on firmware 4, plain values on firmware 5
    return field() if callable(field) else field


def blob_fields(blob):
    x, y, w, h = value(blob.rect)
    signature = 1
    while not value(blob.code) >> (signature - 1) & 1:  # code: one bit a threshold
        signature += 1
    middle = (signature, x, y, x + w - 1, y + h - 1, value(blob.cxf), value(blob.cyf), value(blob.pixels))
    return ",%d,%d,%d,%d,%d,%.1f,%.1f,%d," % middle


def frame_line(ms, number, blobs):
    blobs = sorted(blobs, key=lambda blob: -value(blob.pixels))[:MOST]
    body = "FPFRM,%d.%04d,%d,%d%s" % (ms // 1000 % 900000, ms % 1000 * 10, number, len(blobs), "".join(blob_fields(blob) for blob in blobs))
    return "$%s*%04X\r\n" % (body, crc16(body))


sensor.reset()
sensor.set_pixformat(sensor.RGB565)
sensor.set_framesize(sensor.QVGA)  # 320 x 240
sensor.skip_frames(time=2000)
sensor.set_auto_gain(False)  # colours stay what they are
sensor.set_auto_whitebal(False)
number = 0
while True:
    number = (number + 1) & 0xFFFFFFFF
    picture, ms = sensor.snapshot(), ticks_ms()
    line = frame_line(ms, number, picture.find_blobs(THRESHOLDS, pixels_threshold=40, area_threshold=40, merge=False))
    print(line, end="")
    uart.write(line)
