"""The result document of every bundled recording against the installed schema; what it must not accept."""
import copy
import json
import pathlib
import subprocess
import sys
import unittest

import jsonschema

SHARE, PROGRAM = pathlib.Path(sys.argv[1]), sys.argv[2]
SCHEMA = json.loads((SHARE / "schema" / "result.schema.json").read_text())
LOGS = sorted((SHARE / "recordings").glob("*.log"))


def document_of(log):
    return json.loads(subprocess.run([PROGRAM, "replay", "--json", log], check=True, capture_output=True).stdout)


def everything_known(schema):
    """The same schema, but what it does not name is an error."""
    if isinstance(schema, list):
        return [everything_known(part) for part in schema]
    if not isinstance(schema, dict):
        return schema
    strict = {key: everything_known(part) for key, part in schema.items()}
    if isinstance(strict.get("properties"), dict) and "type" in strict and "additionalProperties" not in strict:
        strict["additionalProperties"] = False
    return strict


class Schema(unittest.TestCase):
    def test_it_is_a_schema(self):
        jsonschema.Draft202012Validator.check_schema(SCHEMA)

    def test_it_describes_every_key_of_all_bundled_recordings(self):
        self.assertGreater(len(LOGS), 5)
        validator = jsonschema.Draft202012Validator(everything_known(SCHEMA))
        for log in LOGS:
            with self.subTest(log=log.name):
                faults = [fault.json_path + ": " + fault.message[:200] for fault in validator.iter_errors(document_of(log))]
                self.assertEqual(faults, [])

    def test_what_is_wrong_is_refused(self):
        good = document_of(SHARE / "recordings" / "blocks_arc.log")
        validator = jsonschema.Draft202012Validator(SCHEMA)
        self.assertTrue(validator.is_valid(good))
        faults = {"no digest": lambda d: d.pop("digest"), "state": lambda d: d["objects"][0].update(state="seen"),
                  "an open ring": lambda d: d["objects"][0]["models"]["hybrid"]["geometry"].update(type="Ring"),
                  "a cylinder without radius": lambda d: d["objects"][0]["models"]["cylinder"].pop("radius"),
                  "a negative area": lambda d: d["objects"][0]["models"]["clip"].update(area=-1),
                  "a path of pairs": lambda d: d["path"].append([0, 0]), "rgb": lambda d: d["signatures"][0].update(rgb="red")}
        for name, plant in faults.items():
            with self.subTest(fault=name):
                bad = copy.deepcopy(good)
                plant(bad)
                self.assertFalse(validator.is_valid(bad))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
