# Two motors of an H-bridge turn while Fencepost's heartbeat says that the robot may drive. CircuitPython.
import board, busio, pwmio
from time import monotonic
console = busio.UART(board.GP4, board.GP5, baudrate=115200, timeout=0)
enable = [pwmio.PWMOut(board.GP14), pwmio.PWMOut(board.GP15)]  # ENA, ENB of the bridge; IN1 to IN4: ahead
heard, asked, may, rest = monotonic(), 0, False, b""
while True:
    lines = (rest[-99:] + (console.read(64) or b"")).split(b"\n")
    rest = lines.pop()
    for line in lines:  # $FPALV,12.4000,warn,ok,ok*703A: time, level, camera, odometry
        words = line.split(b"*")[0].split(b",")
        if words[0] == b"$FPALV" and len(words) == 5:
            heard = monotonic()
            may = words[2] in (b"clear", b"notice", b"warn") and words[3] in (b"ok", b"empty") and words[4] == b"ok"
    may = may and monotonic() - heard < 0.3
    if monotonic() - heard > 0.3 and monotonic() - asked > 1:
        asked = monotonic()
        console.write(b"\rmode log\r")
    for motor in enable:
        motor.duty_cycle = 30000 if may else 0
