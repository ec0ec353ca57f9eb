# Fencepost's frames from a MaixCAM: one $FPFRM line a picture, on its UART 0 (A16 sends), 115200 baud.
# MaixPy 4; run it from MaixVision, or install it as an app that starts by itself. THRESHOLDS: one colour a line, as
# the app "Find Blobs" shows them; the first is signature 1.
from maix import app, camera, time, uart

THRESHOLDS = [
    [0, 80, 40, 80, 10, 80],  # red: L, A and B, least and greatest
    [0, 80, -120, -10, 0, 30],  # green
]
MOST = 16  # blobs a line


def crc16(text):
    crc = 0xFFFF
    for c in text.encode():
        crc ^= c << 8
        for _ in range(8):
            crc = (crc << 1 ^ 0x1021 if crc & 0x8000 else crc << 1) & 0xFFFF
    return crc


def blob_fields(blob, signature):
    x, y, w, h = blob[0], blob[1], blob[2], blob[3]
    middle = (signature, x, y, x + w - 1, y + h - 1, blob.cx(), blob.cy(), blob.pixels())
    return ",%d,%d,%d,%d,%d,%.1f,%.1f,%d," % middle


def frame_line(ms, number, seen):
    """seen: (blob, signature)"""
    seen = sorted(seen, key=lambda one: -one[0].pixels())[:MOST]
    body = "FPFRM,%d.%04d,%d,%d%s" % (ms // 1000 % 900000, ms % 1000 * 10, number, len(seen), "".join(blob_fields(*one) for one in seen))
    return "$%s*%04X\r\n" % (body, crc16(body))


picture_of = camera.Camera(320, 240)
port = uart.UART("/dev/ttyS0", 115200)
number = 0
while not app.need_exit():
    number = (number + 1) & 0xFFFFFFFF
    picture, ms = picture_of.read(), time.ticks_ms()
    seen = []
    for index, threshold in enumerate(THRESHOLDS):
        found = picture.find_blobs([threshold], area_threshold=40, pixels_threshold=40)
        seen += [(blob, index + 1) for blob in found]
    port.write_str(frame_line(ms, number, seen))
