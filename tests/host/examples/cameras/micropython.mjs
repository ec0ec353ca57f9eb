// usage: micropython.mjs STUBS SCRIPT CAMERA: runs a camera's script on MicroPython with the stubs of CAMERA; what it prints.
import { readFileSync } from "node:fs";
import { loadMicroPython } from "@micropython/micropython-webassembly-pyscript";

const [stubs, script, camera] = process.argv.slice(2);
const python = await loadMicroPython({ stdout: (line) => console.log(line), linebuffer: true });
python.globals.set("script", readFileSync(script, "utf8"));
try {
  python.runPython(readFileSync(stubs, "utf8"));
  python.runPython(`run(script, "${camera}")`);
} catch (error) {
  console.error(error.message); // the rest of it is the whole interpreter
  process.exit(1);
}
