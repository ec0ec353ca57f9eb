# Fencepost's frames from a VEX AI Vision sensor: one $FPFRM line a snapshot, printed on the Brain's USB port.
# VEXcode Python for V5 and EXP. COLOURS: as the AI Vision utility shows them; Colordesc 1 is signature 1.
from vex import MSEC, AiVision, Brain, Colordesc, Ports, wait

COLOURS = [
    Colordesc(1, 200, 40, 40, 15, 0.30),  # red: number, red, green, blue, hue's range, saturation's range
    Colordesc(2, 40, 160, 60, 15, 0.30),  # green
]
PORT = Ports.PORT1
MOST = 16  # blobs a line


def crc16(text):
    crc = 0xFFFF
    for c in text.encode():
        crc ^= c << 8
        for _ in range(8):
            crc = (crc << 1 ^ 0x1021 if crc & 0x8000 else crc << 1) & 0xFFFF
    return crc


def blob_fields(blob, signature):
    x, y, w, h = blob.originX, blob.originY, blob.width, blob.height
    # It tells no area, and as its middle the box's.
    middle = (signature, x, y, x + w - 1, y + h - 1, x + (w - 1) / 2, y + (h - 1) / 2)
    return ",%d,%d,%d,%d,%d,%.1f,%.1f,0," % middle


def frame_line(ms, number, seen):
    """seen: (object, signature)"""
    seen = [one for one in seen if one[0].width > 0 and one[0].height > 0]
    seen = sorted(seen, key=lambda one: -one[0].width * one[0].height)[:MOST]
    body = "FPFRM,%d.%04d,%d,%d%s" % (ms // 1000 % 900000, ms % 1000 * 10, number, len(seen), "".join([blob_fields(*one) for one in seen]))
    return "$%s*%04X\r\n" % (body, crc16(body))


brain = Brain()
camera = AiVision(PORT, *COLOURS)
number = 0
while True:
    number = (number + 1) & 0xFFFFFFFF
    seen, ms = [], brain.timer.time(MSEC)
    for index, colour in enumerate(COLOURS):
        seen += [(blob, index + 1) for blob in camera.take_snapshot(colour, MOST) or ()]
    print(frame_line(int(ms), number, seen), end="")
    wait(20, MSEC)
