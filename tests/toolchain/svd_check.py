#!/usr/bin/env python3
"""usage: svd_check.py ROOT FOLDER

Compares the constants of hal/mcu/*/registers.hpp with what the vendors publish of their parts: SVD files, which this
repository does not have. FOLDER has those that there are. Each is named after its part, as its column is in the tables
tests/hal/mcu/registers, in upper or lower case. They are rp2040.svd, rp2350.svd (the Pico's SDK), stm32f405.svd, nrf51.svd, nrf52833.svd.
A table says what each constant is by the vendor's names:

  UART0                     A peripheral's address.
  P1-P0                     From one to another.
  UART0.ENABLE              A register's address, or offset where the constant is one.
  UART0.ENABLE.ENABLE       The bits of a field.
  UART0.ENABLE.ENABLE=4     A value in that field, by its number or by the vendor's name of it. Fields are added up with +.
  @UART0                    An interrupt's number.
  - why                     Not in the file.

An empty cell is as the one before it. Prints one line per fault; exit status 1 if there is any, 77 where FOLDER has none
of the files.
"""

import csv
import pathlib
import re
import sys
import xml.etree.ElementTree

TABLES = "tests/hal/mcu/registers"
CONSTANT = re.compile(r"inline constexpr std::uint\d+_t (k\w+)\s*=\s*([^;]+);")
OFFSETS_END = 0x10000  # a constant below is an offset in its peripheral
# Names that a vendor has changed: of files before and after version 2 of the Pico's SDK.
FORMERLY = {"USB": "USBCTRL_REGS", "USB_DPRAM": "USBCTRL_DPRAM"}


def number(text):
    text = text.strip().lower()
    if text.startswith("#"):
        return int(text[1:].replace("x", "0"), 2)
    return int(text.removeprefix("+"), 16 if text.startswith("0x") else 10)


def constants(header, known):
    """{name: value} of a header, by plain arithmetic; `known`: of headers that it includes."""
    text = re.sub(r"//[^\n]*", "", header.read_text(encoding="utf-8"))
    found = {}
    for name, expression in CONSTANT.findall(text):
        plain = re.sub(r"\w+::", "", expression)
        plain = re.sub(r"(?<=[0-9a-fA-F])'(?=[0-9a-fA-F])", "", plain)
        plain = re.sub(r"\b(0[xX][0-9a-fA-F]+|\d+)[uU]\b", r"\1", plain)
        found[name] = eval(plain, {"__builtins__": {}}, {**known, **found}) & 0xFFFFFFFF  # of our own headers
    return found


class Svd:
    """One file: peripherals, registers, fields, interrupts by their names."""

    def __init__(self, path):
        device = xml.etree.ElementTree.parse(path).getroot()
        self.peripherals = {p.findtext("name"): p for p in device.iter("peripheral")}
        self.interrupts = {i.findtext("name"): number(i.findtext("value")) for i in device.iter("interrupt")}

    def peripheral(self, name):
        found = self.peripherals.get(name, self.peripherals.get(FORMERLY.get(name)))
        if found is None:
            raise KeyError(f"no peripheral {name}")
        return found

    def base(self, name):
        return number(self.peripheral(name).findtext("baseAddress"))

    def registers_of(self, name):
        """{path: (offset, element)}; of an array, each with its index, too"""
        element = self.peripheral(name)
        found = {}
        if element.get("derivedFrom"):
            found.update(self.registers_of(element.get("derivedFrom")))
        for block in element.findall("registers"):
            self.collect(block, "", 0, found)
        return found

    def collect(self, block, prefix, offset, found):
        for kind in ("register", "cluster"):
            for element in block.findall(kind):
                if element.get("derivedFrom"):
                    self.derive(element, block, kind)
                for name, at in places(element):
                    path = prefix + name
                    found[path] = (offset + at, element)
                    if kind == "cluster":
                        self.collect(element, path + ".", offset + at, found)

    @staticmethod
    def derive(element, block, kind):
        source = element.attrib.pop("derivedFrom").split(".")[-1]
        for other in block.findall(kind):
            if other.findtext("name") == source:
                own = {child.tag for child in element}
                element.extend(child for child in other if child.tag not in own)

    def place(self, name):
        """(peripheral, offset, field element or None) of PERIPHERAL.REGISTER or PERIPHERAL.REGISTER.FIELD"""
        peripheral, *path = name.split(".")
        registers = self.registers_of(peripheral)
        for end in range(len(path), 0, -1):
            register = ".".join(path[:end])
            if register not in registers:
                continue
            offset, element = registers[register]
            if end == len(path):
                return peripheral, offset, None
            fields = {f.upper(): x for x in element.iter("field") for f, _ in places(x)}
            field = ".".join(path[end:])
            if field.upper() in fields:
                return peripheral, offset, fields[field.upper()]
            raise KeyError(f"no field {field} in {peripheral}.{register}")
        raise KeyError(f"no register {'.'.join(path)} in {peripheral}")

    def value(self, expression, is_offset):
        """The number that an expression of a table stands for."""
        if expression.startswith("@"):
            if expression[1:] not in self.interrupts:
                raise KeyError(f"no interrupt {expression[1:]}")
            return self.interrupts[expression[1:]]
        if " + " in expression:
            return sum(self.value(part.strip(), is_offset) for part in expression.split(" + "))
        name, _, wanted = expression.partition("=")
        if "." not in name:
            first, _, second = name.partition("-")
            return self.base(first) - (self.base(second) if second else 0)
        peripheral, offset, field = self.place(name)
        if field is None:
            return offset if is_offset else self.base(peripheral) + offset
        low, width = bits(field)
        return value_in(field, wanted) << low if wanted else ((1 << width) - 1) << low


def places(element):
    """[(name, offset)]: of an array its first without an index, and each with one"""
    name = element.findtext("name")
    at = number(element.findtext("addressOffset") or "0")
    if element.findtext("dim") is None:
        return [(name, at)]
    count, step = number(element.findtext("dim")), number(element.findtext("dimIncrement"))
    labels = [str(n) for n in range(count)]
    index = element.findtext("dimIndex")
    if index and "-" in index:
        first, last = index.split("-")
        labels = [str(n) for n in range(int(first), int(last) + 1)] if first.isdigit() else labels
    elif index:
        labels = index.split(",")
    each = [(name.replace("%s", label), at + n * step) for n, label in enumerate(labels)]
    return [(name.replace("[%s]", "").replace("%s", ""), at), *each]


def bits(field):
    """(lowest, how many)"""
    if field.findtext("bitOffset") is not None:
        return number(field.findtext("bitOffset")), number(field.findtext("bitWidth") or "1")
    if field.findtext("lsb") is not None:
        low, high = number(field.findtext("lsb")), number(field.findtext("msb"))
    else:
        high, low = map(int, field.findtext("bitRange").strip("[]").split(":"))
    return low, high - low + 1


def value_in(field, wanted):
    if re.fullmatch(r"\d+|0x[0-9a-fA-F]+", wanted):
        return number(wanted)
    for choice in field.iter("enumeratedValue"):
        if choice.findtext("name") == wanted:
            return number(choice.findtext("value"))
    raise KeyError(f"no value {wanted} in {field.findtext('name')}")


def rows_of(table):
    """[(constant, {part: expression})]"""
    with table.open(newline="", encoding="utf-8") as file:
        names, *rows = csv.reader(file)
    found = []
    for row in rows:
        cells = dict(zip(names[1:], row[1:]))
        last = ""
        for part in names[1:]:
            last = cells[part] = cells.get(part) or last
        found.append((row[0], cells))
    return names[1:], found


def compare(svd, rows, part, values, where):
    """(faults, how many constants were compared)"""
    faults, compared = [], 0
    for name, cells in rows:
        if cells[part].startswith("-"):
            if not cells[part][1:].strip():
                faults.append(f"{where}: {name}: no reason why it is not compared")
            continue
        if name not in values:
            continue
        try:
            published = svd.value(cells[part], values[name] < OFFSETS_END)
        except KeyError as error:
            faults.append(f"{where}: {name}: {part}: {error.args[0]}")
            continue
        compared += 1
        if published != values[name]:
            faults.append(f"{where}: {name} is 0x{values[name]:x}; {part} has 0x{published:x} for {cells[part]}")
    return faults, compared


def check(root, folder):
    """(faults, {part: how many were compared}, parts without a file)"""
    files = {path.stem.lower(): path for path in sorted(folder.glob("*")) if path.suffix.lower() == ".svd"}
    faults, compared, missing, known = [], {}, set(), {}
    for table in sorted((root / TABLES).glob("*.csv")):
        header = root / "hal/mcu" / table.stem / "registers.hpp"
        values = constants(header, known)
        known.update(values)
        where = str(header.relative_to(root))
        parts, rows = rows_of(table)
        named = {name for name, _ in rows}
        faults += [f"{where}: {name} is in no row of {TABLES}/{table.name}" for name in values if name not in named]
        faults += [f"{TABLES}/{table.name}: {name} is not in {where}" for name in sorted(named - set(values))]
        for part in parts:
            if part not in files:
                missing.add(part)
                continue
            more, count = compare(Svd(files[part]), rows, part, values, where)
            faults += more
            compared[part] = compared.get(part, 0) + count
    return faults, compared, sorted(missing)


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__.strip())
    root, folder = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
    if not folder.is_dir():
        sys.exit(f"svd_check: {folder} is no folder; give one with the vendors' SVD files")
    faults, compared, missing = check(root, folder)
    print(*faults, sep="\n", end="\n" if faults else "")
    for part in missing:
        print(f"NOT COMPARED: {part}: there is no {part}.svd in {folder}")
    for part, count in sorted(compared.items()):
        print(f"{part}: {count} constants compared")
    if not compared and not faults:
        return 77
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
