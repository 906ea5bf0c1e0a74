#!/usr/bin/python3
"""Puts sources together that can be compiled as one, and writes a file that includes them.

usage: source_units.py FOLDER SIZE SOURCE...

Most of a compiler's time goes into the headers of the system, once for every source. In a unit of
SIZE sources they are read once. Sources of a unit have no name of an unnamed namespace, no test, no
alias and no main() in common. Writes FOLDER/unit_N.cpp (an unchanged file is not touched), removes what a
longer list left there, and prints the files. cmake/source_units.cmake calls it; scripts/tidy asks
for the same units.
"""
import argparse
import glob
import os
import re
import shlex

TYPE = re.compile(r"(?:template.*> )?(?:class|struct|enum class|enum|union) (\w+)")
# The name of a function, variable or constant: what stands before its arguments or value.
ENTITY = re.compile(r"(\w+)\s*(?:\[[^\]]*\])*\s*(?:\(|=|;|\{|$)")


def own_names(source):
    """Names that a source has for itself: of an unnamed namespace, a test, a macro, a using, main()."""
    names = set()
    is_unnamed = False
    with open(source, encoding="utf-8") as lines:
        for line in lines:
            if line.startswith(("namespace ", "}  // namespace")):
                is_unnamed = line.startswith("namespace {")
                continue
            match = re.match(r"(?:TYPED_)?TEST\w*\((\w+), *(\w+)|INSTANTIATE\w*\((\w+), *(\w+)", line)
            if match:
                names.add("_".join(filter(None, match.groups())))
                continue
            match = re.match(r"(?:#define |int (?=main\())(\w+)", line) or re.match(r"using (?:[\w:]+::)?(\w+)( =|;)", line)
            if not match and is_unnamed and re.match(r"(?!using )[A-Za-z]", line):
                match = TYPE.match(line) or ENTITY.search(line)
            if match:
                names.add(match[1])
    return names


def units_of(sources, size):
    """Lists of at most size sources that can stand in one unit, in the order of their first source."""
    units = []
    for source in sources:
        names = own_names(source)
        for unit, taken in units:
            if len(unit) < size and not names & taken:
                unit.append(source)
                taken |= names
                break
        else:
            units.append(([source], names))
    return [unit for unit, _ in units]


def included_sources(unit_file):
    """The sources that a written unit includes."""
    with open(unit_file, encoding="utf-8") as lines:
        names = re.findall(r'^#include "(.*)"$', lines.read(), flags=re.M)
    return [os.path.normpath(os.path.join(os.path.dirname(unit_file), name)) for name in names]


def compile_flags(database):
    """Source -> the arguments that clang needs, from a compilation database (of units, maybe)."""
    flags = {}
    for entry in database:
        words = shlex.split(entry["command"])
        while words[0].startswith("-") or not re.search(r"(\+\+|cc|cxx|clang)[-\d.]*$", words[0]) \
                or os.path.basename(words[0]) == "ccache":
            words.pop(0)
        kept = []
        skip = False
        for word in words[1:]:
            if skip or word == "-c" or word == entry["file"]:
                skip = False
            elif word == "-o":
                skip = True
            elif not re.match(r"-D\w+_EXPORTS$", word) and word not in ("-fPIC", "-fPIE"):
                kept.append(word)
        # The same for libraries and programs; headers of Qt want it.
        kept.append("-fPIC")
        file = os.path.realpath(entry["file"])
        is_unit = os.path.basename(os.path.dirname(os.path.dirname(file))) == "units"
        for source in included_sources(file) if is_unit else [file]:
            flags.setdefault(source, tuple(kept))
    return flags


def write_units(folder, size, sources):
    """Writes a file for each unit; returns the files."""
    os.makedirs(folder, exist_ok=True)
    files = []
    for number, unit in enumerate(units_of(sources, size)):
        file = os.path.join(folder, "unit_%d.cpp" % number)
        text = "".join('#include "%s"\n' % os.path.relpath(source, folder) for source in unit)
        if not os.path.exists(file) or open(file, encoding="utf-8").read() != text:
            with open(file, "w", encoding="utf-8") as out:
                out.write(text)
        files.append(file)
    for file in glob.glob(os.path.join(folder, "unit_*.cpp")):
        if file not in files:
            os.remove(file)
    return files


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", metavar="FOLDER")
    parser.add_argument("size", metavar="SIZE", type=int)
    parser.add_argument("sources", metavar="SOURCE", nargs="+")
    arguments = parser.parse_args()
    print(";".join(write_units(arguments.folder, arguments.size, arguments.sources)))


if __name__ == "__main__":
    main()
