"""The Pico's USB port as Linux sees it: with Linux's own drivers and tools, on the controller of an emulated part.

In the guest, whose /dev/ttyS1 is the other end of tests/boards/pico/usbip.mjs.
"""

import ctypes
import fcntl
import os
import pathlib
import queue
import re
import select
import socket
import struct
import subprocess
import termios
import threading
import time
import tty
import unittest

LINE = "/dev/ttyS1"
PORT = "/dev/ttyACM0"
CONTROLLER = pathlib.Path("/sys/devices/platform/vhci_hcd.0")
HEADER, WORD, SUBMITTED = 48, 0x46454E43, 3  # usbip.mjs
FULL_SPEED = 2
PATIENCE = 30  # s: an emulated processor beside a busy build
# As read here: an end of a line is one newline, whatever the port's settings were when it came.
VERSION = "fencepost 0.1.0 for pico, profile small, stream format 1\n"
FACTS = "fencepost 0.1.0 for pico, profile small\nreset: power on\npanic: none\n"
LAST_FACT = "panic: none\n"
# Of linux/usbdevice_fs.h.
USBDEVFS_CONTROL, USBDEVFS_BULK, USBDEVFS_CLAIM, USBDEVFS_CLEAR_HALT = 0xC0185500, 0xC0185502, 0x8004550F, 0x80045515
USBDEVFS_IOCTL, USBDEVFS_DISCONNECT = 0xC0105512, 0x5516
BULK_IN, BULK_OUT, DATA_INTERFACE = 0x82, 0x02, 1


def eventually(condition, what):
    deadline = time.monotonic() + PATIENCE
    while not (answer := condition()):
        if time.monotonic() > deadline:
            raise AssertionError(f"in {PATIENCE} s: not {what}")
        time.sleep(0.01)
    return answer


class Cable:
    """Between the kernel's USB/IP and the emulated Pico, with words of its own to that."""

    def __init__(self):
        self.line = os.open(LINE, os.O_RDWR | os.O_NOCTTY)
        tty.setraw(self.line)
        settings = termios.tcgetattr(self.line)
        settings[4] = settings[5] = termios.B115200
        termios.tcsetattr(self.line, termios.TCSANOW, settings)
        self.writing = threading.Lock()
        self.words = queue.Queue()
        self.kernel = None
        threading.Thread(target=self.from_device, daemon=True).start()

    def write(self, data):
        with self.writing:
            while data:
                data = data[os.write(self.line, data):]

    def read(self, count):
        data = b""
        while len(data) < count:
            data += os.read(self.line, count - len(data))
        return data

    def from_device(self):
        while True:
            header = self.read(HEADER)
            command, first, _, way, _, status, length = struct.unpack_from(">7i", header)
            rest = self.read(first if command == WORD else length if command == SUBMITTED and way and not status else 0)
            if command == WORD:
                self.words.put(rest.decode())
                continue
            try:
                self.kernel.sendall(header + rest)
            except OSError:  # unplugged meanwhile
                pass

    def from_kernel(self, kernel):
        try:
            while data := kernel.recv(65536):
                self.write(data)
        except OSError:  # unplugged
            pass

    def say(self, text):
        """And waits until it is done."""
        self.write(struct.pack(">2i40x", WORD, len(text)) + text.encode())
        self.await_word(text)

    def await_word(self, text):
        said = self.words.get(timeout=PATIENCE)
        assert said == text, f"'{said}' came, not '{text}'"

    def plug(self):
        self.say("plug")
        if self.kernel:
            self.kernel.close()
        self.kernel, end = socket.socketpair()
        self.forwarding = threading.Thread(target=self.from_kernel, args=(self.kernel,), daemon=True)
        self.forwarding.start()

        def attach():
            try:
                (CONTROLLER / "attach").write_text(f"0 {end.fileno()} {1 << 16 | 1} {FULL_SPEED}")
                return True
            except OSError:  # the port is free only a while after the last device left it
                return False
        eventually(attach, "attached")
        end.close()

    def pull(self):
        (CONTROLLER / "detach").write_text("0")
        self.kernel.shutdown(socket.SHUT_RDWR)
        # The answer to an earlier request must not reach the kernel after it has forgotten it: it then drops the new
        # connection.
        self.forwarding.join(PATIENCE)
        eventually(lambda: not os.path.exists(PORT), "gone")

    def unplug(self):
        self.pull()
        self.say("unplug")


class Terminal:
    """A program that has the port open."""

    def __init__(self, baud=termios.B115200):
        self.port = eventually(self.open, "open")
        tty.setraw(self.port, termios.TCSANOW)  # input that has come already stays
        settings = termios.tcgetattr(self.port)
        settings[4] = settings[5] = baud
        termios.tcsetattr(self.port, termios.TCSANOW, settings)

    @staticmethod
    def open():
        try:
            return os.open(PORT, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
        except OSError:
            return None

    def send(self, text):
        rest = text.encode()
        while rest:  # Linux may have no buffer left for a moment
            if not select.select([], [self.port], [], PATIENCE)[1]:
                raise AssertionError(f"the port takes nothing of {rest!r}")
            try:
                rest = rest[os.write(self.port, rest):]
            except BlockingIOError:
                time.sleep(0.01)

    def read_until(self, text):
        said = ""
        deadline = time.monotonic() + PATIENCE
        while text not in said:
            if not select.select([self.port], [], [], max(deadline - time.monotonic(), 0))[0]:
                raise AssertionError(f"no '{text}' in {said!r}")
            said = re.sub(r"[\r\n]+", "\n", said + os.read(self.port, 4096).decode())
        return said

    def is_full(self):
        """It has as much as the kernel keeps for one that does not read: 4 KB, 128 bytes kept free."""
        waiting = fcntl.ioctl(self.port, termios.FIONREAD, struct.pack("i", 0))
        return struct.unpack("i", waiting)[0] > 4096 - 128 - 64

    def ended(self):
        try:
            return os.read(self.port, 4096) == b""
        except BlockingIOError:
            return False
        except OSError:
            return True

    def __enter__(self):
        return self

    def __exit__(self, *_):
        os.close(self.port)


def usb_device():
    """(path in /dev, folder in /sys) of the Pico."""
    for folder in pathlib.Path("/sys/bus/usb/devices").glob("*"):
        if (folder / "idVendor").is_file() and (folder / "idVendor").read_text().strip() == "1209":
            bus, device = (int((folder / name).read_text()) for name in ("busnum", "devnum"))
            return f"/dev/bus/usb/{bus:03}/{device:03}", folder
    raise AssertionError("the device is not there")


def kernel_complaints():
    text = subprocess.run(["dmesg"], capture_output=True, text=True, check=True).stdout
    words = ("error", "fail", "warn", "unable", "invalid", "timeout", "not accepting")
    return [line for line in text.splitlines() if ("usb" in line or "cdc_acm" in line) and any(w in line.lower() for w in words)]


class PicoUsb(unittest.TestCase):
    cable = None

    @classmethod
    def setUpClass(cls):
        subprocess.run(["modprobe", "cdc-acm"], check=True)
        cls.cable = Cable()

    def setUp(self):
        subprocess.run(["dmesg", "-C"], check=True)
        self.plug()

    def plug(self):
        """The device says nothing of its own accord from now on; what it has said until then."""
        self.cable.plug()
        with Terminal() as terminal:  # a new port echoes until it is set up
            terminal.send("\rmode quiet\r")
            return terminal.read_until("mode is quiet\n")

    def tearDown(self):
        self.cable.unplug()
        self.cable.say("power")

    def test_it_is_linux_own_serial_port(self):
        driver = os.path.basename(os.readlink("/sys/class/tty/ttyACM0/device/driver"))
        self.assertEqual(driver, "cdc_acm")
        with Terminal() as terminal:
            self.assertEqual(terminal.read_until(LAST_FACT), FACTS)
            terminal.send("version\r")
            self.assertEqual(terminal.read_until("\n"), VERSION)
        self.assertEqual(kernel_complaints(), [])

    def test_its_descriptors_are_read_without_a_complaint(self):
        done = subprocess.run(["lsusb", "-v", "-d", "1209:0001"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        for fact in ("iManufacturer           1 Fencepost", "bInterfaceSubClass      2 Abstract (modem)", "bInterfaceClass        10 CDC Data",
                     "bMasterInterface        0", "wMaxPacketSize     0x0040  1x 64 bytes", "Device Status:     0x0000"):
            self.assertIn(fact, done.stdout)
        for word in ("warning", "invalid", "unrecognized", "unknown", "garbage", "missing", "couldn't", "too short"):
            self.assertNotIn(word, (done.stdout + done.stderr).lower())

    # The kernel takes what fits into its buffers and then fetches nothing more: the packet that waits on the device goes back.
    def test_nothing_is_lost_by_a_port_that_was_closed_unread(self):
        for _ in range(3):
            with Terminal() as terminal:
                terminal.send("help\r" * 3)
                eventually(terminal.is_full, "full")
            time.sleep(2)  # the rest of the answers goes to the serial line alone
            with Terminal() as terminal:  # the kernel may still hold what it took before
                self.assertTrue(terminal.read_until(LAST_FACT).endswith(FACTS))
                terminal.send("version\r")
                self.assertEqual(terminal.read_until("\n"), VERSION)

    def test_linux_clears_a_halt_and_goes_on(self):
        with Terminal() as terminal:
            terminal.read_until(LAST_FACT)
            for _ in range(3):
                self.cable.say("halt in")
                terminal.send("version\r")
                self.assertEqual(terminal.read_until("\n"), VERSION)

    def test_a_program_clears_halts(self):
        path, _ = usb_device()
        device = os.open(path, os.O_RDWR)

        def ask(request, layout, *values):
            return fcntl.ioctl(device, request, bytearray(struct.pack(layout, *values)))

        def bulk(endpoint, data, size):
            buffer = ctypes.create_string_buffer(data, size)
            count = ask(USBDEVFS_BULK, "IIIxxxxQ", endpoint, size, 1000 * PATIENCE, ctypes.addressof(buffer))
            return buffer.raw[:count]
        with Terminal() as terminal:  # it talks only to a port that is open
            terminal.read_until(LAST_FACT)
            ask(USBDEVFS_IOCTL, "iiQ", DATA_INTERFACE, USBDEVFS_DISCONNECT, 0)
            ask(USBDEVFS_CLAIM, "I", DATA_INTERFACE)
            ask(USBDEVFS_CONTROL, "BBHHHIxxxxQ", 0x21, 0x22, 1, 0, 0, 1000, 0)  # open, as cdc_acm says it
            for turn in range(3):
                for endpoint in (BULK_IN, BULK_OUT):
                    ask(USBDEVFS_CLEAR_HALT, "I", endpoint)
                bulk(BULK_OUT, b"version\r", 8)
                said = b""
                while not said.endswith(b"stream format 1\r\n"):
                    said += bulk(BULK_IN, b"", 64)
                self.assertEqual(said.decode().replace("\r", ""), VERSION if turn else FACTS + VERSION)
        os.close(device)

    def test_a_cable_that_is_pulled_and_put_back(self):
        for _ in range(3):
            with Terminal() as terminal:
                terminal.read_until(LAST_FACT)
                terminal.send("help\r")
                self.cable.unplug()
                eventually(terminal.ended, "notified that the port is gone")
            self.plug()
            with Terminal() as terminal:
                self.assertEqual(terminal.read_until(LAST_FACT), FACTS)

    # The questions are more than its queue for input holds; the answers fit into its queue for output and the kernel's
    # buffers. This guest is slow, and output that is not read for a tenth of a second counts as read by nobody.
    def test_as_much_at_once_as_a_program_writes(self):
        questions = 36
        with Terminal() as terminal:
            terminal.read_until(LAST_FACT)
            os.set_blocking(terminal.port, True)
            terminal.send("".join(f"get alert.stop{' ' * 20}\r" for _ in range(questions)) + "version\r")
            said = terminal.read_until(VERSION)
            answer = "alert.stop = 0.25 m (0.00..10.00 m), in the path and this near: stop\n"
            self.assertEqual(said.replace(answer, ""), VERSION)
            self.assertEqual(said.count(answer), questions)

    def test_1200_baud_opens_the_boot_loader(self):
        with Terminal(termios.B1200) as terminal:
            terminal.read_until(LAST_FACT)
        self.cable.await_word("loader")
        self.cable.pull()
        self.cable.say("power")
        self.assertIn("reset: power on\n", self.plug())

    def test_a_panic_is_read_after_the_reset(self):
        with Terminal() as terminal:
            terminal.read_until(LAST_FACT)
            self.cable.say("fault")
            self.cable.await_word("gone")
            self.cable.pull()
        self.assertRegex(self.plug(), "reset: panic\npanic: exception 3 at 200")


if __name__ == "__main__":
    unittest.main(verbosity=2)
