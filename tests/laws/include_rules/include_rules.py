"""Data goes one way: which folder may include which, and where third parties may show.

symbolic/, loci/ and numeric/ never include one another; that is what makes numeric/ a witness.
Usage: include_rules.py REPOSITORY; exit status 1 and one line an offence.
"""

import pathlib
import re
import sys

FOLDERS = {"core", "mechanism", "symbolic", "loci", "numeric", "report", "cli"}
MAY_INCLUDE = {
    "core": set(),
    "mechanism": {"core"},
    "symbolic": {"core", "mechanism"},
    "loci": {"core"},
    "numeric": {"core", "mechanism"},
    "report": {"core"},
    "cli": FOLDERS,
}

# Third party: (the beginning of its headers' names, folders whose headers and sources may include it, folders whose
# sources alone may).
THIRD_PARTIES = {
    "GMP": (("gmp.h", "gmpxx.h"), FOLDERS, set()),
    "MPFR": (("mpfr.h", "mpfi.h"), set(), {"symbolic", "loci", "mechanism"}),
    "yaml-cpp": (("yaml-cpp/",), set(), {"mechanism"}),
    "GiNaC": (("ginac/",), {"symbolic"}, {"mechanism"}),
    "CLN": (("cln/",), {"symbolic"}, {"mechanism"}),
    "FLINT": (("flint/",), set(), {"symbolic"}),
    "CGAL": (("CGAL/", "boost/"), set(), {"loci"}),
    "Eigen": (("Eigen/",), {"numeric"}, set()),
    "TBB": (("tbb/", "oneapi/tbb"), {"numeric"}, set()),
    "cairomm": (("cairomm/", "cairo"), {"report"}, set()),
    "nlohmann-json": (("nlohmann/",), {"report", "cli"}, set()),
    "fmt": (("fmt/",), {"report", "cli"}, set()),
    "CLI11": (("CLI/",), {"cli"}, set()),
}

# Headers of symbolic/ that no other folder sees may use FLINT: they are not installed and only its sources include them.
PRIVATE_HEADERS = {"symbolic/ring.hpp": {"FLINT"}}

INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.MULTILINE)


def offences_of(path, text):
    """Lines that say what `path` (relative, with /) must not include."""
    folder = path.split("/")[0]
    is_header = path.endswith(".hpp")
    found = []
    for included in INCLUDE.findall(text):
        target = included.split("/")[0]
        if "/" in included and target in FOLDERS:
            if target != folder and target not in MAY_INCLUDE[folder]:
                found.append(f"{path}: {folder}/ must not include {included}")
            if included in PRIVATE_HEADERS and target != folder:
                found.append(f"{path}: {included} is private to {target}/")
            continue
        if ".." in included.split("/"):
            found.append(f"{path}: {included}: includes are written from the root of the repository")
        for name, (prefixes, everywhere, sources_only) in THIRD_PARTIES.items():
            if not included.startswith(prefixes):
                continue
            allowed = folder in everywhere or (folder in sources_only and not is_header)
            if not allowed and name not in PRIVATE_HEADERS.get(path, set()):
                found.append(f"{path}: {name} must not show in {'a header' if is_header else 'a source'} of {folder}/")
    return found


def offences(root):
    found = []
    for folder in sorted(FOLDERS):
        for path in sorted((root / folder).rglob("*.[ch]pp")):
            found += offences_of(path.relative_to(root).as_posix(), path.read_text(encoding="utf-8"))
    return found


if __name__ == "__main__":
    lines = offences(pathlib.Path(sys.argv[1]))
    print("\n".join(lines) if lines else "every include is allowed")
    sys.exit(1 if lines else 0)
