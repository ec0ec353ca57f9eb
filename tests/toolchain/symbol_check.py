#!/usr/bin/env python3
"""usage: symbol_check.py [--allow NAME]... FILE...

The robot's libraries and objects ask for no heap, exceptions, run-time types, guarded statics, printf, standard
streams and strings. Nor do they ask for a function of libm that differs between C libraries. FILE: .a or .o, in any
mixture.
"""

import re
import subprocess
import sys

BANNED = {
    "heap": r"operator (?:new|delete).*|(?:__libc_)?(?:malloc|calloc|realloc|free|aligned_alloc|posix_memalign)",
    "exceptions": r"__cxa_(?!atexit|guard|pure_virtual).*|_Unwind_.*|__gxx_personality.*|std::__throw_.*|std::terminate\(\)",
    "run-time types": r"__dynamic_cast|typeinfo .*|vtable for (?:__cxxabiv1|std)::.*",
    "guarded statics": r"guard variable .*|__cxa_guard_.*",
    "destructors at exit": r"__cxa_atexit|atexit",
    "printf and scanf": r"(?:__isoc99_)?v?(?:f|s|sn|as|d)?(?:printf|scanf)(?:_chk)?|__v?(?:f|s|sn)?printf_chk|puts|putchar|fwrite",
    "streams, strings, locales": r"(?:VTT for |guard variable for )?std::(?:__cxx11::)?(?:basic_(?!string_view)|ios_base|locale|cout|cerr).*",
    "assert of the C library": r"__assert_fail|__assert_func|abort",
    "libm that differs between C libraries": r"(?:a?(?:sin|cos|tan)h?|atan2|sincos|exp|exp2|expm1|log|log2|log10|log1p|pow|"
    r"hypot|cbrt|erf|erfc|tgamma|lgamma)[fl]?",
}
BANNED = {name: re.compile(f"(?:{pattern})$") for name, pattern in BANNED.items()}


def undefined_symbols(file):
    """(member, symbol) for each; an object that another member of the same library defines is no better."""
    done = subprocess.run(["nm", "-u", "-C", file], capture_output=True, text=True, check=True)
    member = file
    for line in done.stdout.splitlines():
        if line.endswith(":") and not line.startswith(" "):
            member = f"{file}({line[:-1]})"
        elif match := re.match(r"\s+[Uwv] (.*)", line):
            yield member, match.group(1).split("@")[0]


def main():
    arguments = sys.argv[1:]
    allowed = set()
    while arguments[:1] == ["--allow"]:
        allowed.add(arguments[1])
        arguments = arguments[2:]
    if not arguments or arguments[0].startswith("-"):
        print(__doc__.strip(), file=sys.stderr)
        return 2
    seen = 0
    faults = set()
    for file in arguments:
        for member, symbol in undefined_symbols(file):
            seen += 1
            for name, pattern in BANNED.items():
                if pattern.match(symbol) and symbol not in allowed:
                    faults.add(f"{member}: {symbol}: {name}")
    print(*sorted(faults), sep="\n", end="\n" if faults else "")
    print(f"{seen} undefined symbols in {len(arguments)} files, {len(faults)} banned")
    if seen == 0:
        print("nothing was checked", file=sys.stderr)
    return 1 if faults or seen == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
