"""The reader of records against the program: the same records, the same counts, the same reasons."""
import gzip
import io
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

SHARE, PROGRAM = pathlib.Path(sys.argv[1]), sys.argv[2]
sys.path.insert(0, str(SHARE / "python"))
from fencepost import stream as fencepost  # noqa: E402  (what works as a file alone)
LOGS = sorted((SHARE / "recordings").glob("*.log"))


def line(body):
    return f"${body}*{fencepost.crc(body)}\r\n".encode("latin-1")


def feed(data):
    reader = fencepost.Reader()
    records = list(reader.feed(data))
    reader.finish()
    return records, reader


def counted_by_the_program(path):
    done = subprocess.run([PROGRAM, "replay", "--json", path], capture_output=True, check=False)
    return json.loads(done.stdout)["log"] if done.stdout else None


class Lines(unittest.TestCase):
    def test_the_crc_is_the_standard_one(self):
        self.assertEqual(fencepost.crc("123456789"), "29B1")

    def test_every_example_of_the_document_is_read(self):
        examples = re.findall(r"\$FP[A-Z]{3},[^`\n]*?\*[0-9A-F]{4}", (SHARE / "doc" / "stream.md").read_text())
        kinds = set()
        for example in examples:
            records, reader = feed(example.encode() + b"\n")
            self.assertEqual((len(records), reader.rejected), (1, {}), example)
            kinds.add(type(records[0]))
        self.assertGreaterEqual(kinds, set(fencepost.KINDS.values()) - {fencepost.Setting} - {fencepost.Sectors, fencepost.Ways})

    def test_a_frame_has_its_blobs(self):
        (frame,), _ = feed(line("FPFRM,12.3600,617,2,1,10,20,40,60,25.0,40.0,950,d02020,2,100,22,131,80,115.5,51.0,0,"))
        self.assertEqual((frame.t, frame.frame, len(frame.blobs)), (12.36, 617, 2))
        self.assertEqual(frame.blobs[0], fencepost.Blob(1, 10, 20, 40, 60, 25.0, 40.0, 950, "d02020"))
        self.assertIsNone(frame.blobs[1].rgb)
        self.assertIsNone(frame.blobs[1].track)

    def test_blobs_of_a_camera_that_tracks_have_ids(self):
        (frame,), _ = feed(line("FPFRM,12.4000,620,2,1,10,20,40,60,25.0,40.0,950,d02020,7,"
                                "2,100,22,131,80,115.5,51.0,0,,"))
        self.assertEqual([blob.track for blob in frame.blobs], [7, None])
        self.assertEqual(frame.blobs[1].x1, 100)

    def test_a_blind_robot_has_no_numbers(self):
        (alert,), _ = feed(line("FPALR,13.1000,blind,0,0,,,,"))
        self.assertEqual((alert.level, alert.bearing, alert.distance, alert.ttc), ("blind", None, None, None))

    def test_sectors_may_be_unknown(self):
        (sectors,), _ = feed(line("FPSEC,13.1000,4,0.5000,,,1.2500"))
        self.assertEqual(sectors.distances, (0.5, None, None, 1.25))

    def test_a_speed_limit_may_be_unknown(self):
        limits, _ = feed(line("FPSPD,12.4000,0.3500") + line("FPSPD,12.5000,"))
        self.assertEqual([limit.speed for limit in limits], [0.35, None])

    def test_ways_have_their_fields(self):
        (ways,), _ = feed(line("FPWAY,13.1000,2,spin,0.00,3.1416,3.9270,nothing,back,0.00,0.0000,0.0000,unknown"))
        self.assertEqual(ways.ways[0], fencepost.Way("spin", 0.0, 3.1416, 3.927, "nothing"))
        self.assertEqual(ways.ways[1].end, "unknown")
        self.assertEqual(feed(line("FPWAY,13.1000,2,spin,0.00,3.1416,3.9270,nothing"))[1].rejected, {"fields": 1})

    def test_text_is_unescaped(self):
        (signature,), _ = feed(line("FPSIG,1,d02020,a%2Cb%25"))
        self.assertEqual(signature.name, "a,b%")

    def test_a_signature_may_have_a_width_and_a_pad(self):
        signatures, _ = feed(line("FPSIG,1,d02020,red") + line("FPSIG,1,d02020,red,0.064") + line("FPSIG,1,d02020,red,,-3"))
        self.assertEqual([(one.width, one.pad) for one in signatures], [(None, 0), (0.064, 0), (None, -3)])
        self.assertEqual(feed(line("FPSIG,1,d02020,red,0.064,2,1"))[1].rejected, {"fields": 1})

    def test_it_tells_why_a_line_is_bad(self):
        for bad, reason in ((b"$FPODO,1.0,0.0,0.0,0.0*0000\n", "crc"), (b"$FPODO,1.0\n", "crc"),
                            (line("FPXYZ,1"), "kind"), (line("FPODO,1.0000,0.0000,0.0000"), "fields"),
                            (line("FPODO,1.0000,0.0000,x,0.0000"), "number"), (line("FPODO,1.0000,,0.0000,0.0000"), "number"),
                            (line("FPODO,1.0000,+1.0000,0.0000,0.0000"), "number"),
                            (line("FPODO,1.0000,1e3,0.0000,0.0000"), "number"), (line("FPODO,1.0000,nan,0.0000,0.0000"), "number"),
                            (line("FPFRM,1.0000,1,2,1,10,20,40,60,25.0,40.0,950,"), "fields"),
                            (line("FPFRM,1.0000,1,2,1,0,0,1,1,0,0,0,,7,1,0,0,1,1,0,0,0,"), "fields"),
                            (line("FPSIG,1,d02020,%"), "number"), (line("FPHDR,2,a,b,c,d"), "format"),
                            (line("FPSIG,1,d02020," + "a" * 1100), "length"), (b"$FPODO,1.0", "truncated")):
            records, reader = feed(line("FPDIG,1,0123456789abcdef") + bad)
            self.assertEqual(len(records), 1, bad)
            self.assertEqual(dict(reader.rejected), {reason: 1}, bad)

    def test_what_is_no_record_is_foreign(self):
        records, reader = feed(b"READY\r\n\r\n$GPGGA,1\nx$FPDIG,1,2*0000\n")
        self.assertEqual((records, reader.foreign, dict(reader.rejected)), ([], 4, {}))

    def test_a_line_may_come_in_any_pieces(self):
        whole = (SHARE / "recordings" / "approach_stop.log").read_bytes()[:20000]
        expected, _ = feed(whole)
        for size in (1, 7, 1000):
            reader = fencepost.Reader()
            pieces = [record for at in range(0, len(whole), size) for record in reader.feed(whole[at:at + size])]
            self.assertEqual(pieces, expected)

    def test_an_endless_line_is_not_kept(self):
        class Endless(io.RawIOBase):
            left = 64 * 1024 * 1024

            def readline(self, size=-1):
                self.left -= size
                return b"x" * size if self.left > 0 else b""
        reader = fencepost.Reader()
        self.assertEqual(list(fencepost.records(Endless(), reader)), [])
        self.assertEqual(reader.foreign, 1)


class Logs(unittest.TestCase):
    def test_bundled_recordings_are_read_as_the_program_reads_them(self):
        self.assertGreater(len(LOGS), 5)
        for path in LOGS:
            log, counted = fencepost.read(path), counted_by_the_program(path)
            self.assertEqual((len(log.records), len(log.frames), log.foreign),
                             (counted["records"], counted["frames"], counted["foreign"]), path.name)
            self.assertEqual(log.rejected, {})

    def test_a_damaged_log_has_the_same_rejects(self):
        data = bytearray((SHARE / "recordings" / "blocks_arc.log").read_bytes())
        for at in range(500, len(data), 997):
            data[at] = ord("#")
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "damaged.log")
            path.write_bytes(data)
            log, counted = fencepost.read(path), counted_by_the_program(path)
        self.assertGreater(log.rejected["crc"], 20)
        told = {reason: count for reason, count in counted["rejected"].items() if count}
        # Which records come too late in their run is the program's to know.
        told.pop("time", None)
        self.assertEqual(log.rejected, told)
        self.assertEqual(log.foreign, counted["foreign"])

    def test_a_gzipped_log_is_the_same(self):
        path = SHARE / "recordings" / "blocks_arc.log"
        with tempfile.TemporaryDirectory() as folder:
            zipped = pathlib.Path(folder, "run.log.gz")
            zipped.write_bytes(gzip.compress(path.read_bytes()))
            self.assertEqual(fencepost.read(zipped).records, fencepost.read(path).records)

    def test_names_and_tables(self):
        log = fencepost.read(SHARE / "recordings" / "blocks_arc.log")
        self.assertEqual(log.name(1), "red")
        self.assertEqual(log.name(77), "sig 77")
        self.assertEqual(log.camera.model, "pixy2")
        self.assertEqual(log.odometry[0]._fields, ("t", "x", "y", "heading"))
        self.assertIn("75 frames", repr(log))

    def test_a_result_document_is_loaded(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "result.json")
            path.write_bytes(subprocess.run([PROGRAM, "replay", "--json", SHARE / "recordings" / "blocks_arc.log"],
                                            check=True, capture_output=True).stdout)
            self.assertEqual(len(fencepost.result(path)["objects"]), 3)
            path.write_text('{"format": 2}')
            with self.assertRaisesRegex(ValueError, "format 1: write it with"):
                fencepost.result(path)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
