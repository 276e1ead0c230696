"""Every citation of a page of this repository can be followed: the page is there, and so is the section.

A citation is the name of a page, alone or with `section 4`, `sections 1 to 5`, or the bare number of the section:
"method.md section 8", "docs/background/exactness.md", "method.md 6". Usage: citations.py REPOSITORY; exit status 1 and one
line a citation that leads nowhere. A bare name is enough, as no two pages of docs/ have the same name. Of pages the links
and the source files that they name in backquotes are there, too.
"""

import pathlib
import re
import subprocess
import sys

TEXTS = (".hpp", ".cpp", ".py", ".md", ".cmake", ".txt", ".sh", ".yaml", ".ts")
PAGE = re.compile(r"(?<![\w/.-])((?:[\w.-]+/)*[\w-]+\.md)\b(?:,?\s+(?:sections?\s+)?(\d+)(?:\s+to\s+(\d+))?(?![\d.]*\d))?")
LINK = re.compile(r"\]\(([^)#\s]+)(?:#[^)]*)?\)")
# In backquotes, with the folder from the root and an ending of sources.
SOURCE = re.compile(r"`((?:[\w-]+/)+[\w.-]+\.(?:hpp|cpp|py|ts|cmake|txt|json))`")
HEADING = re.compile(r"^#+ (\d+)\. ", re.MULTILINE)
# Words that look like pages and are none: what a program writes, or a page of somebody else's.
ELSEWHERE = {"DEVELOPERS.md"}
# Where files are installed.
INSTALLED = ("share/clearloci/",)


def page_of(root, citing, name):
    """Where a cited page is: beside the page that cites it, in a folder of docs/, or from the root."""
    for folder in (root / pathlib.PurePosixPath(citing).parent, *sorted((root / "docs").glob("*/")), root):
        if (folder / name).is_file():
            return folder / name
    return None


def comment_joined(text):
    """Lines of a comment as one, so that a citation may be broken between them."""
    return re.sub(r"\n[ \t]*(?://+|#|\*)?[ \t]*", " ", text)


def dead_citations(root, citing, text):
    found = []
    for name, first, last in PAGE.findall(comment_joined(text)):
        if name in ELSEWHERE:
            continue
        page = page_of(root, citing, name)
        if page is None:
            found.append(f"{citing}: there is no {name}")
            continue
        if not first:
            continue
        sections = set(HEADING.findall(page.read_text(encoding="utf-8")))
        for number in range(int(first), int(last or first) + 1):
            if sections and str(number) not in sections:
                found.append(f"{citing}: {name} has no section {number}")
    return found


def dead_links(root, citing, text):
    """Links of a page to files of the repository, and sources that it names, that are not there."""
    found = []
    prose = re.sub(r"^```.*?^```$", "", text, flags=re.MULTILINE | re.DOTALL)
    folder = root / pathlib.PurePosixPath(citing).parent
    for target in LINK.findall(prose):
        if not target.startswith(("http:", "https:")) and not (folder / target).exists():
            found.append(f"{citing}: a link to {target}, which is not there")
    for name in SOURCE.findall(prose):
        if name.startswith(INSTALLED):
            continue
        if (root / name.partition("/")[0]).is_dir() and not (root / name).exists():
            found.append(f"{citing}: there is no {name}")
    return found


def equal_names(root):
    """Pages of docs/ that share a name: a bare name would not tell them apart."""
    pages = {}
    for page in sorted((root / "docs").glob("**/*.md")):
        pages.setdefault(page.name, []).append(str(page.relative_to(root)))
    return [f"one name: {', '.join(same)}" for same in pages.values() if len(same) > 1]


def main(root):
    files = subprocess.run(["git", "-C", root, "ls-files"], capture_output=True, text=True, check=True).stdout.split("\n")
    found = equal_names(root)
    for name in files:
        if name.endswith(TEXTS) and not name.startswith("tests/laws/citations/") and (root / name).is_file():
            text = (root / name).read_text(encoding="utf-8", errors="replace")
            found += dead_citations(root, name, text)
            if name.endswith(".md"):
                found += dead_links(root, name, text)
    for line in found:
        print(line)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
