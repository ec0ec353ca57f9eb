"""The second serial line of an nRF52833, which reads and writes memory by itself: by its product specification, UARTE."""

import collections

LINE = 0x40028000
START_RECEIVING, STOP_RECEIVING, START_SENDING, STOP_SENDING = 0x000, 0x004, 0x008, 0x00C
RECEIVED, SENT, ERROR, RECEIVING_STOPPED, SENDING_STOPPED = 0x110, 0x120, 0x124, 0x144, 0x158
ERROR_SOURCE, ENABLE, PIN_SEND, PIN_RECEIVE, BAUD = 0x480, 0x500, 0x50C, 0x514, 0x524
RECEIVES_TO, RECEIVES_BYTES, SENDS_FROM, SENDS_BYTES = 0x534, 0x538, 0x544, 0x548
ENABLED, FIFO = 8, 6
OVERRUN, FRAMING = 1, 4
TASKS = (START_RECEIVING, STOP_RECEIVING, START_SENDING, STOP_SENDING)


class DmaLine:
    """Its wires have a device at their end, if any: `write(byte, seconds)` and `answers`, as on the bus."""

    def __init__(self, part, device=None):
        self.part, self.device = part, device
        self.fifo, self.coming = collections.deque(), collections.deque()  # bytes; None: one with a broken stop bit
        self.next_byte = self.sent_at = None
        self.receives = self.transfers = False  # the wire is looked at; bytes go to memory
        self.stored = 0
        self.bauds = set()

    def word(self, register):
        return self.part.words.get(LINE + register, 0)

    def happens(self, event):
        self.part.words[LINE + event] = 1

    def baud(self):
        divider = int(2**32 / max(self.word(BAUD), 1))
        return 16e6 / divider

    def feed(self, data, now):
        if not self.coming:
            self.next_byte = now
        self.coming.extend(data)

    def in_memory(self, address, count):
        """Of the part's own memory: it cannot reach the flash."""
        if not 0x20000000 <= address <= address + count <= 0x20000000 + self.part.RAM_SIZE:
            self.part.fault(f"the second line is given {count} bytes at {address:08x}, which it cannot reach")

    def write(self, register, value):
        part = self.part
        if register in TASKS and value and self.word(ENABLE) != ENABLED:
            part.fault("a task of the second line, which is off")
            return None
        if register == ENABLE:
            self.enable(value)
        elif register == START_RECEIVING and value:
            self.in_memory(self.word(RECEIVES_TO), self.word(RECEIVES_BYTES))
            if self.transfers:
                part.fault("the second line receives already")
            self.receives = self.transfers = True
            self.stored = 0
            self.store()
        elif register == STOP_RECEIVING and value:
            self.receives = self.transfers = False
            self.happens(RECEIVING_STOPPED)
        elif register == START_SENDING and value:
            self.send()
        elif register == STOP_SENDING and value:
            self.sent_at = None
            self.happens(SENDING_STOPPED)
        elif register == ERROR_SOURCE:
            part.words[LINE + register] = self.word(register) & ~value
            return True
        return None

    def enable(self, value):
        part = self.part
        if value not in (0, ENABLED):
            part.fault(f"the second line is enabled by {value}")
        if not value and (self.receives or self.sent_at is not None):
            part.fault("the second line is switched off while it works")
        if value and part.pin(self.word(PIN_SEND)) != (True, 1):
            part.fault("the second line is enabled before its pin is high")
        if value and part.pin(self.word(PIN_RECEIVE))[0]:
            part.fault("the second line receives at an output")

    def send(self):
        part, address = self.part, self.word(SENDS_FROM)
        if self.word(SENDS_BYTES) != 1:
            part.fault("the second line sends more than is modelled")
        if self.sent_at is not None:
            part.fault("a byte is sent before the last one has gone")
        self.in_memory(address, 1)
        self.bauds.add(round(self.baud()))
        self.sent_at = part.seconds + 10 / self.baud()
        if self.device is not None:
            self.device.write(part.uc.mem_read(address, 1)[0], part.seconds)
            answers = getattr(self.device, "answers", ())
            self.feed(list(answers), part.seconds + 20 / self.baud())
            if answers:
                answers.clear()

    def store(self):
        while self.transfers and self.fifo:
            self.part.uc.mem_write(self.word(RECEIVES_TO) + self.stored, bytes([self.fifo.popleft()]))
            self.stored += 1
            if self.stored == self.word(RECEIVES_BYTES):
                self.transfers = False
                self.happens(RECEIVED)

    def error(self, source):
        self.part.words[LINE + ERROR_SOURCE] = self.word(ERROR_SOURCE) | source
        self.happens(ERROR)

    def move(self):
        """Takes and sends until now."""
        now = self.part.seconds
        while self.coming and self.next_byte <= now:
            byte = self.coming.popleft()
            self.next_byte += 10 / self.baud()
            if not self.receives:
                continue
            if byte is None:
                self.error(FRAMING)  # it is not stored
            elif len(self.fifo) == FIFO:
                self.error(OVERRUN)
            else:
                self.fifo.append(byte)
                self.store()
        if self.sent_at is not None and self.sent_at <= now:
            self.sent_at = None
            self.happens(SENT)

    def next_times(self):
        return [self.sent_at, self.next_byte if self.coming else None]
