# Two motors of an H-bridge turn while Fencepost's heartbeat says that the robot may drive. MicroPython.
from machine import PWM, Pin, UART
from time import ticks_diff, ticks_ms
console = UART(1, 115200, tx=Pin(4), rx=Pin(5))
enable = [PWM(Pin(14), freq=1000, duty_u16=0), PWM(Pin(15), freq=1000, duty_u16=0)]  # ENA, ENB; IN1 to IN4: ahead
heard, asked, may, rest = ticks_ms(), 0, False, b""
while True:
    *lines, rest = (rest[-99:] + (console.read() or b"")).split(b"\n")
    for line in lines:  # $FPALV,12.4000,warn,ok,ok*703A: time, level, camera, odometry
        words = line.split(b"*")[0].split(b",")
        if words[0] == b"$FPALV" and len(words) == 5:
            heard = ticks_ms()
            may = words[2] in (b"clear", b"notice", b"warn") and words[3] in (b"ok", b"empty") and words[4] == b"ok"
    if ticks_diff(ticks_ms(), heard) > 300:
        may = False
        if ticks_diff(ticks_ms(), asked) > 1000:
            asked = ticks_ms()
            console.write(b"\rmode log\r")
    for motor in enable:
        motor.duty_u16(30000 if may else 0)
