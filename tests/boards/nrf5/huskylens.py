"""A HuskyLens 1 on a bus, by the vendor's protocol 0.5.1: enough of it for one camera that has learned colours."""

import collections
import struct

FRAME_SECONDS = 1 / 30
COLOUR = struct.pack("<H", 4)  # the algorithm that tells blocks of a colour


class HuskyLens:
    address = 0x32

    def __init__(self, view):
        """`view(seconds)`: [(id, x1, y1, x2, y2)], both ends inside."""
        self.view = view
        self.asked = bytearray()
        self.answers = collections.deque()
        self.algorithm = b""

    def write(self, byte, seconds):
        self.asked.append(byte)
        start = self.asked.find(b"\x55\xaa\x11")
        if start < 0 or len(self.asked) < start + 4:
            return
        end = start + 6 + self.asked[start + 3]
        if len(self.asked) < end:
            return
        question = bytes(self.asked[start:end])
        self.asked.clear()
        if sum(question[:-1]) & 0xFF == question[-1]:
            self.answers.clear()
            self.answers.extend(self.reply(question[4], question[5:-1], seconds))

    def read(self, _seconds):
        return self.answers.popleft() if self.answers else 0

    def reply(self, command, data, seconds):
        if command == 0x2C:
            return self.framed(0x2E)
        if command == 0x2D:
            self.algorithm = data
            return self.framed(0x2E)
        if command not in (0x20, 0x21):
            return b""
        frame = int(seconds / FRAME_SECONDS)
        blocks = [self.block(*box) for box in self.view(frame * FRAME_SECONDS)] if self.algorithm == COLOUR else []
        learned = 1
        return self.framed(0x29, struct.pack("<HHHHH", len(blocks), learned, frame & 0xFFFF, 0, 0)) + b"".join(blocks)

    def block(self, number, x1, y1, x2, y2):
        width, height = x2 - x1 + 1, y2 - y1 + 1
        return self.framed(0x2A, struct.pack("<HHHHH", x1 + width // 2, y1 + height // 2, width, height, number))

    @staticmethod
    def framed(command, data=b""):
        frame = struct.pack("<BBBBB", 0x55, 0xAA, 0x11, len(data), command) + data
        return frame + bytes([sum(frame) & 0xFF])
