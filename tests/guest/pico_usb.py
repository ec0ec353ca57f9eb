#!/usr/bin/env python3
"""usage: pico_usb.py SOURCE NODE USBIP.mjs IMAGE.uf2 PYTHON [TEST...]

Runs pico_usb_test.py, or these tests of it, in the guest, on whose second serial line an emulated Pico is a USB device. Exit status: the guest's.
"""

import os
import pathlib
import subprocess
import sys
import tempfile


def main():
    if len(sys.argv) < 6:
        sys.exit(__doc__.strip())
    source, node, program, image, python, *tests = sys.argv[1:]
    test = pathlib.Path(__file__).with_name("pico_usb_test.py")
    with tempfile.TemporaryDirectory() as folder:
        socket = os.path.join(folder, "line")
        device = subprocess.Popen([node, program, image, socket], stdout=subprocess.PIPE, text=True)
        try:
            if device.stdout.readline() != "listening\n":
                sys.exit("pico_usb: the emulated Pico did not start")
            guest = [f"{source}/toolchain/guest/run", "--line", socket, " ".join([python, "-B", str(test), *tests])]
            return subprocess.run(guest, check=False).returncode
        finally:
            device.kill()
            device.wait()


if __name__ == "__main__":
    sys.exit(main())
