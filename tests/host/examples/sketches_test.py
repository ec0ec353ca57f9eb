"""Runs the example scripts against stub modules, by a clock of the test's.

usage: sketches_test.py FOLDER
"""
import pathlib
import sys
import types
import unittest

FOLDER = pathlib.Path(sys.argv.pop(1))


class Over(BaseException):
    """The script runs for ever; its clock ends it."""


class Robot:
    """A console that says lines at their times, and what the script does with it: milliseconds."""

    def __init__(self, said, end, portion):
        self.bytes = sorted(said)
        self.end = end
        self.portion = portion
        self.now = 0
        self.written = []
        self.duty = {}
        self.changes = []  # (ms, motor, duty)

    def time(self):
        return self.now

    def read(self):
        """The bytes that have come; each look takes a millisecond."""
        self.now += 1
        if self.now > self.end:
            raise Over
        if self.bytes and self.bytes[0][0] <= self.now:
            when, text = self.bytes.pop(0)
            if text[self.portion:]:
                self.bytes.insert(0, (when, text[self.portion:]))
            return text[: self.portion]
        return None

    def set_duty(self, motor, duty):
        if self.duty.get(motor) != duty:
            self.changes.append((self.now, motor, duty))
        self.duty[motor] = duty


def micropython(robot):
    machine = types.ModuleType("machine")
    machine.Pin = lambda number: number

    class PWM:
        def __init__(self, pin, freq, duty_u16):
            self.pin = pin
            robot.set_duty(pin, duty_u16)

        def duty_u16(self, duty):
            robot.set_duty(self.pin, duty)

    class UART:
        def __init__(self, _number, baud, tx, rx):
            assert (baud, tx, rx) == (115200, 4, 5)

        def read(self):
            return robot.read()

        def write(self, text):
            robot.written.append((robot.now, text))

    machine.PWM, machine.UART = PWM, UART
    time = types.ModuleType("time")
    time.ticks_ms = robot.time
    time.ticks_diff = lambda a, b: a - b
    return {"machine": machine, "time": time}


def circuitpython(robot):
    board, busio, pwmio = (types.ModuleType(name) for name in ("board", "busio", "pwmio"))
    for number in (4, 5, 14, 15):
        setattr(board, f"GP{number}", number)

    class UART:
        def __init__(self, tx, rx, baudrate, timeout):
            assert (baudrate, tx, rx, timeout) == (115200, 4, 5, 0)

        def read(self, count):
            assert robot.portion <= count
            return robot.read()

        def write(self, text):
            robot.written.append((robot.now, text))

    class PWMOut:
        def __init__(self, pin):
            self.pin = pin
            robot.set_duty(pin, 0)

        def __setattr__(self, name, value):
            object.__setattr__(self, name, value)
            if name == "duty_cycle":
                robot.set_duty(self.pin, value)

    busio.UART, pwmio.PWMOut = UART, PWMOut
    time = types.ModuleType("time")
    time.monotonic = lambda: robot.now / 1000
    return {"board": board, "busio": busio, "pwmio": pwmio, "time": time}


SCRIPTS = {"stop_motors_micropython.py": micropython, "stop_motors_circuitpython.py": circuitpython}


def beat(t, level="clear", camera="ok", odometry="ok"):
    return (t, f"$FPALV,{t / 1000:.4f},{level},{camera},{odometry}*0000\r\n".encode())


def beats(begin, end, *words):
    return [beat(t, *words) for t in range(begin, end, 100)]


def play(name, said, end, portion=64):
    """Runs the script of that name against what the console says, and returns the robot."""
    robot = Robot(said, end, portion)
    modules = SCRIPTS[name](robot)
    before = {module: sys.modules.get(module) for module in modules}
    sys.modules.update(modules)
    try:
        exec(compile((FOLDER / name).read_text(), name, "exec"), {})
    except Over:
        pass
    finally:
        for module, old in before.items():
            if old is None:
                del sys.modules[module]
            else:
                sys.modules[module] = old
    return robot


class Sketches(unittest.TestCase):
    def play_all(self, said, end, portion=64):
        for name in SCRIPTS:
            with self.subTest(name):
                yield play(name, said, end, portion)

    def spans(self, robot):
        """(from, to) of each time in which the motors turn; both alike."""
        self.assertEqual({motor for _, motor, _ in robot.changes}, {14, 15})
        left, right = ([(t, duty) for t, motor, duty in robot.changes if motor == one] for one in (14, 15))
        self.assertEqual(left, right)
        self.assertEqual(left[0][1], 0, "off at first")
        times = [t for t, _ in left[1:]] + [None]
        return list(zip(times[0::2], times[1::2]))

    def test_they_turn_while_the_heartbeat_comes(self):
        for portion in (1, 7, 64):
            for robot in self.play_all(beats(500, 3000, "warn"), 2900, portion):
                ((begin, end),) = self.spans(robot)
                self.assertIsNone(end)
                self.assertLess(begin, 550)

    def test_silence_stops_them(self):
        for robot in self.play_all(beats(500, 1001), 3000):
            ((_, end),) = self.spans(robot)
            self.assertGreater(end, 1250)
            self.assertLess(end, 1320)

    def test_stop_blind_and_a_missing_sensor_stop_them_at_once(self):
        reasons = (("stop",), ("blind",), ("sxop",), ("clear", "silent"), ("clear", "unready"), ("clear", "absent"),
                   ("clear", "ok", "silent"), ("clear", "ok", "absent"))
        for words in reasons:
            said = beats(500, 1000) + beats(1000, 2000, *words) + beats(2000, 2500)
            for robot in self.play_all(said, 2450):
                first, second = self.spans(robot)
                self.assertLess(first[1], 1050, words)
                self.assertGreater(second[0], 1990, words)

    def test_an_empty_view_is_no_fault(self):
        for robot in self.play_all(beats(500, 2000, "clear", "empty"), 1950):
            self.assertEqual(len(self.spans(robot)), 1)

    def test_other_lines_are_no_heartbeat(self):
        other = b"$FPODO,1.0000,0.0000,0.0000,0.0000*0000\r\nREADY\r\n$FPALV\r\n" + b"x" * 500
        for robot in self.play_all(beats(500, 1000) + [(t, other) for t in range(1000, 3000, 50)], 3000):
            ((_, end),) = self.spans(robot)
            self.assertLess(end, 1320)

    def test_they_ask_for_the_heartbeat(self):
        for robot in self.play_all(beats(2500, 4000), 3900):
            self.assertGreaterEqual(len(robot.written), 2)
            self.assertEqual({text for _, text in robot.written}, {b"\rmode log\r"})
            self.assertLess(max(t for t, _ in robot.written), 2600)

    def test_they_have_twenty_lines_at_most(self):
        for name in SCRIPTS:
            self.assertLessEqual(len((FOLDER / name).read_text().splitlines()), 20)


unittest.main()
