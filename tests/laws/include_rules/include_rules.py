"""Data goes one way: which folder may include which, and where third parties may show.

symbolic/, loci/ and numeric/ never include one another; that is what makes numeric/ a witness.
Usage: include_rules.py REPOSITORY; exit status 1 and one line an offence.
"""

import pathlib
import re
import sys

FOLDERS = {"core", "mechanism", "symbolic", "loci", "numeric", "check", "analysis", "studies", "report", "workbench", "cli"}
# Public headers, of which core/ is made: they include the standard library, GMP's numbers and one another.
PUBLIC = "clearloci"
MAY_INCLUDE = {
    "core": set(),
    "mechanism": {"core"},
    "symbolic": {"core", "mechanism"},
    "loci": {"core"},
    "numeric": {"core", "mechanism"},
    "check": {"core", "mechanism"},
    "analysis": {"core", "mechanism", "symbolic", "loci", "numeric"},
    "studies": {"core", "mechanism", "analysis", "loci"},
    "report": {"core", "analysis"},
    "workbench": {"report"},
    "cli": FOLDERS,
}

# Rooms of a folder: which of its rooms each may include. What stands in the folder itself may include them all, and is
# included by none. From outside a room, in the folder or elsewhere, its door alone is seen: <folder>/<room>/<room>.hpp.
# Benchmarks and tests may look inside.
ROOMS = {
    "loci": {
        "numbers": set(),
        "sheet": {"numbers"},
        "search": {"numbers", "sheet"},
        "curves": {"numbers", "sheet", "search"},
        "points": {"numbers", "sheet", "search", "curves"},
        "surfaces": {"numbers", "sheet", "search", "curves"},
        "zones": {"numbers", "sheet", "search", "curves"},
        "tasks": {"numbers", "sheet", "search", "curves"},
    },
}

# Third party: (the beginning of its headers' names, folders whose headers and sources may include it, folders whose
# sources alone may). Of a folder with rooms these are its rooms.
THIRD_PARTIES = {
    "GMP": (("gmp.h", "gmpxx.h"), FOLDERS, set()),
    "MPFR": (("mpfr.h",), set(), {"symbolic", "mechanism"}),
    "MPFI": (("mpfi.h", "mpfi_io.h"), set(), {"check"}),
    "yaml-cpp": (("yaml-cpp/",), set(), {"mechanism"}),
    "pugixml": (("pugixml.hpp",), set(), {"mechanism"}),
    "GiNaC": (("ginac/",), set(), {"symbolic", "mechanism"}),
    "CLN": (("cln/",), set(), {"symbolic", "mechanism"}),
    "FLINT": (("flint/",), set(), {"symbolic", "loci/numbers"}),
    "CGAL": (("CGAL/",), set(), {"loci/curves", "loci/zones"}),
    "Boost": (("boost/",), set(), {"workbench"}),
    "Eigen": (("Eigen/",), {"numeric"}, set()),
    "TBB": (("tbb/", "oneapi/tbb"), {"numeric"}, {"loci/search", "loci/zones", "loci/tasks"}),
    "MPI": (("mpi.h",), set(), {"studies"}),
    "NLopt": (("nlopt.h",), set(), {"studies"}),
    "Cairo": (("cairo",), set(), {"report"}),
    "nlohmann-json": (("nlohmann/",), {"report", "workbench", "cli"}, {"check"}),
    "fmt": (("fmt/",), {"report", "workbench", "cli"}, {"check"}),
    "cpp-httplib": (("httplib.h",), set(), set()),  # its client asks in tests alone
    "CLI11": (("CLI/",), {"cli"}, set()),
}

# A header whose opening comment says "Private to <folder>/" is seen by that folder's sources alone and is not installed;
# what a folder's sources may include, it may include too. Benchmarks and tests may look inside.
PRIVATE = "Private to "

INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.MULTILINE)


def is_private(text):
    return any(line.startswith("//") and PRIVATE in line for line in text.splitlines())


def public_offences_of(path, text):
    """Lines that say what the public header `path` must not include."""
    return [
        f"{path}: a public header must not include {included}"
        for included in INCLUDE.findall(text)
        if not included.startswith(PUBLIC + "/") and included != "gmpxx.h" and ("/" in included or "." in included)
    ]


def room_of(path):
    """The room that a file is in; None where it is in none."""
    parts = path.split("/")
    rooms = ROOMS.get(parts[0], {})
    return parts[1] if len(parts) > 2 and parts[1] in rooms else None


def is_misplaced(path):
    """Whether a file is in a folder below one with rooms that is no room."""
    parts = path.split("/")
    return parts[0] in ROOMS and len(parts) > 2 and parts[1] not in ROOMS[parts[0]]


def room_offences(path, included):
    """What an include says against the order of rooms, or against their doors."""
    folder, target = path.split("/")[0], included.split("/")[0]
    if target not in ROOMS:
        return []
    own, other = room_of(path) if folder == target else None, room_of(included)
    if own is not None and other is None:
        return [f"{path}: {target}/{own}/ must not include {included}, which is above it"]
    door = f"{target}/{other}/{other}.hpp"
    if own is not None and own == other:
        return [f"{path}: a header must not include its own room's door"] if path.endswith(".hpp") and included == door else []
    if own is not None and other not in ROOMS[target][own]:
        return [f"{path}: {target}/{own}/ must not include {included}"]
    if other is not None and included != door:
        return [f"{path}: {included} is behind the door {door}"]
    return []


def offences_of(path, text, private_headers=frozenset()):
    """Lines that say what `path` (relative, with /) must not include."""
    folder = path.split("/")[0]
    place = f"{folder}/{room_of(path)}" if room_of(path) else folder
    if folder == "include":
        return public_offences_of(path, text)
    is_public_header = path.endswith(".hpp") and not is_private(text)
    found = [f"{path}: in none of the rooms of {folder}/"] if is_misplaced(path) else []
    for included in INCLUDE.findall(text):
        target = included.split("/")[0]
        if "/" in included and target in FOLDERS:
            if target != folder and target not in MAY_INCLUDE[folder]:
                found.append(f"{path}: {folder}/ must not include {included}")
            if included in private_headers and target != folder:
                found.append(f"{path}: {included} is private to {target}/")
            if included in private_headers and is_public_header:
                found.append(f"{path}: a public header includes the private {included}")
            found += room_offences(path, included)
            continue
        if ".." in included.split("/"):
            found.append(f"{path}: {included}: includes are written from the root of the repository")
        for name, (prefixes, everywhere, sources_only) in THIRD_PARTIES.items():
            if not included.startswith(prefixes):
                continue
            in_headers = folder in everywhere or place in everywhere
            if not in_headers and not (place in sources_only and not is_public_header):
                kind = "a public header" if is_public_header else "a source"
                found.append(f"{path}: {name} must not show in {kind} of {place}/")
    return found


def offences(root):
    texts = {
        path.relative_to(root).as_posix(): path.read_text(encoding="utf-8")
        for folder in sorted(FOLDERS | {"include"})
        for path in sorted((root / folder).rglob("*.[ch]pp"))
    }
    private_headers = {path for path, text in texts.items() if path.endswith(".hpp") and is_private(text)}
    return [offence for path, text in texts.items() for offence in offences_of(path, text, private_headers)]


if __name__ == "__main__":
    lines = offences(pathlib.Path(sys.argv[1]))
    print("\n".join(lines) if lines else "every include is allowed")
    sys.exit(1 if lines else 0)
