"""Sends the poses of a robot that you push by hand along a ruler, 0.1 m a second, and prints its answers.

usage: python push.py PORT [CAMERA [HEIGHT]] [--stay]

PORT as COM5, /dev/ttyACM0 or /dev/tty.usbmodem1101; --lines in its place prints what would be sent.
CAMERA is pixy2 or pixy2.1, HEIGHT that of its lens above the floor, in metres.
--stay sends the camera's height alone, to a robot whose wheels count.
Needs pyserial: python -m pip install pyserial
"""
import binascii
import sys
import time

FOCAL = {"pixy2": 273.66, "pixy2.1": 188.30}  # of the delivered lenses, in pixels

words = [word for word in sys.argv[1:] if word != "--stay"]
stay = len(words) < len(sys.argv) - 1
if not words or len(words) > 3 or words[1:2] and words[1] not in FOCAL:
    sys.exit(__doc__)
camera = words[1] if len(words) > 1 else "pixy2"
try:
    height = float(words[2]) if len(words) > 2 else 0.12
except ValueError:
    sys.exit(f"'{words[2]}' is no height in metres, such as 0.12")
port = None
if words[0] != "--lines":
    import serial
    try:
        port = serial.Serial(words[0], 115200, timeout=0)
    except serial.SerialException as problem:
        sys.exit(f"{problem}\nIs it plugged in, and has another program the port open? Close its console first.")


def say(body):
    line = f"${body}*{binascii.crc_hqx(body.encode(), 0xFFFF):04X}\n"  # CRC-16/CCITT, begun with ones
    if port is None:
        print(line, end="", flush=True)
    else:
        port.write(line.encode())


focal = FOCAL[camera]
say(f"FPCAM,{camera},316,208,{focal:.2f},{focal:.2f},157.50,103.50,0.0000,0.0000,0.0000,{height:.4f},0.0000,0.0000,0.0330")
say("FPSIG,1,d02020,red")
if port is not None:
    print("Sent." if stay else "Push in 3 s.", flush=True)
start = time.monotonic() + 3
while (t := time.monotonic() - start) < (-2 if stay else 8):
    if not stay:
        say(f"FPODO,,{min(max(0.1 * t, 0), 0.6):.4f},0.0000,0.0000")  # time: now; x ahead, y to the left, heading
    time.sleep(0.05)
    if port is not None:
        print(port.read(4096).decode(errors="replace").replace("\r", ""), end="", flush=True)
