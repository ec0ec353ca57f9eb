"""Obstacle maps and alerts from coloured blobs and wheel odometry.

    import fencepost
    run = fencepost.replay(fencepost.recording("go_around.log"))
    print(run)

`replay` runs the robot's loop on a log, and `Core` is that loop in a program of yours. `read` and `records` give a log's
records as they are. `simulate` drives a robot through a scene, and `evaluate` compares a map with the truth.
Metres, radians, seconds and pixels everywhere. Standard library only; what is called an array is a memoryview, which
numpy.asarray takes without a copy.
"""
from ._interface import version
from ._program import ProgramError, evaluate, recording, recordings, simulate
from .core import Box, Camera, Core, Heard, Refused, Seen
from .stream import Camera as CameraRecord
from .stream import (Alert, Blob, CalibrationDoubt, Car, Digest, Frame, Header, Heartbeat, Link, Log, Object, Odometry,
                      Position, Reader, Sectors, Setting, Signature, SpeedLimit, Status, Way, Ways, crc, read, records,
                      result)
from .runs import Grid, Mapped, Run, replay

__all__ = ["Alert", "Blob", "Box", "CalibrationDoubt", "Camera", "CameraRecord", "Car", "Core", "Digest", "Frame",
           "Grid", "Header", "Heard", "Heartbeat", "Link", "Log", "Mapped", "Object", "Odometry", "Position",
           "ProgramError", "Reader", "Refused", "Run", "Sectors", "Seen", "Setting", "Signature", "SpeedLimit",
           "Status", "Way", "Ways", "crc",
           "evaluate", "read", "recording", "recordings", "records", "replay", "result", "simulate", "version"]
