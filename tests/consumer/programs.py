"""Writes the sources of the outside project: the README's program, every installed header alone, and the examples of
the headers' opening comments, each in a function of its own.

Usage: programs.py README INSTALLED_HEADERS FOLDER
"""

import pathlib
import re
import sys

EXAMPLE = "//     "


def readme_program(readme):
    programs = re.findall(r"^```cpp\n(.*?)^```$", readme, re.MULTILINE | re.DOTALL)
    if len(programs) != 1:
        sys.exit(f"the README has {len(programs)} programs")
    return programs[0]


def example_of(header):
    """The indented lines of the comment that opens the header."""
    opening = header.split("#pragma once")[0].splitlines()
    return [line[len(EXAMPLE) :] for line in opening if line.startswith(EXAMPLE)]


def main(readme, headers, folder):
    folder.mkdir(parents=True)
    (folder / "loci_of.cpp").write_text(readme_program(readme.read_text(encoding="utf-8")), encoding="utf-8")
    for header in sorted(headers.rglob("*")):
        name = header.relative_to(headers.parent).as_posix()
        lines = [f"#include <{name}>"]
        example = example_of(header.read_text(encoding="utf-8"))
        if example:
            lines += ["#include <clearloci/mechanism.hpp>", "#include <iostream>", "", f"void example_of_{header.stem}() {{", *example, "}"]
        (folder / f"header_{header.stem}.cpp").write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main(*(pathlib.Path(argument) for argument in sys.argv[1:]))
