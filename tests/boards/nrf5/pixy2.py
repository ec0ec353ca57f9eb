"""A Pixy2 on a bus, by the vendor's serial protocol reference: enough of it for one camera that sees boxes."""

import collections
import struct

FRAME_SECONDS = 1 / 50
BUSY = -2
VERSION = struct.pack("<HBBH10s", 0x2200, 3, 0, 20, b"general")


class Pixy2:
    address = 0x54

    def __init__(self, view):
        """`view(seconds)`: [(signature, x1, y1, x2, y2)], both ends inside."""
        self.view = view
        self.asked = bytearray()
        self.answers = collections.deque()
        self.told = -1  # the last frame

    def write(self, byte, seconds):
        self.asked.append(byte)
        start = self.asked.find(b"\xaf\xc1")
        if start < 0 or len(self.asked) < start + 6:
            return
        kind, length = self.asked[start + 2:start + 4]
        data = bytes(self.asked[start + 6:start + 6 + length])
        if len(data) == length:
            self.asked.clear()
            self.answer(*self.reply(kind, seconds))

    def read(self, _seconds):
        return self.answers.popleft() if self.answers else 0

    def answer(self, kind, data):
        self.answers.clear()
        self.answers.extend(struct.pack("<BBBBH", 0xAF, 0xC1, kind, len(data), sum(data)) + data)

    def reply(self, kind, seconds):
        if kind == 0x0E:
            return 0x0F, VERSION
        if kind == 0x0C:
            return 0x0D, struct.pack("<HH", 316, 208)
        if kind != 0x20:
            return 0x01, struct.pack("<i", 1)
        frame = int(seconds / FRAME_SECONDS)
        if frame == self.told:
            return 0x03, struct.pack("<b", BUSY)
        self.told = frame
        return 0x21, b"".join(self.block(*box) for box in self.view(frame * FRAME_SECONDS))

    @staticmethod
    def block(signature, x1, y1, x2, y2):
        width, height = x2 - x1 + 1, y2 - y1
        return struct.pack("<HHHHHhBB", signature, x1 + width // 2, y1 + height // 2, width, height, 0, 1, 1)
