"""The checker of citations finds what it should and nothing else."""

import pathlib
import tempfile
import unittest

from citations import dead_citations, dead_links, equal_names


class Citations(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.root = pathlib.Path(self.folder.name)
        (self.root / "docs" / "background").mkdir(parents=True)
        (self.root / "docs" / "background" / "method.md").write_text("# The method\n\n## 1. Closure\n\n## 2. Statics\n")

    def dead(self, text):
        return dead_citations(self.root, "core/a.hpp", text)

    def test_a_page_that_is_there(self):
        self.assertEqual(self.dead("// (method.md section 2), docs/background/method.md, method.md sections 1 to 2, method.md 1"), [])

    def test_a_page_that_is_not(self):
        self.assertEqual(self.dead("// (results.md, zones.json)"), ["core/a.hpp: there is no results.md"])

    def test_a_page_in_another_folder(self):
        self.assertEqual(self.dead("// docs/method.md"), ["core/a.hpp: there is no docs/method.md"])

    def test_links_of_a_page(self):
        (self.root / "docs" / "guide").mkdir()
        links = "[a](../background/method.md#2-statics), [b](method.md), [c](https://x.org/y)\n```\n[d](none.md)\n```\n"
        self.assertEqual(dead_links(self.root, "docs/guide/b.md", links), ["docs/guide/b.md: a link to method.md, which is not there"])

    def test_sources_that_a_page_names(self):
        named = "`docs/background/method.txt`, `elsewhere/a.hpp`, `loci.json`"
        self.assertEqual(dead_links(self.root, "README.md", named), ["README.md: there is no docs/background/method.txt"])

    def test_pages_of_one_name(self):
        self.assertEqual(equal_names(self.root), [])
        (self.root / "docs" / "guide").mkdir()
        (self.root / "docs" / "guide" / "method.md").write_text("# Another\n")
        self.assertEqual(equal_names(self.root), ["one name: docs/background/method.md, docs/guide/method.md"])

    def test_a_section_that_is_not(self):
        self.assertEqual(self.dead("// method.md sections 2 to 3"), ["core/a.hpp: method.md has no section 3"])

    def test_a_citation_broken_between_lines(self):
        self.assertEqual(self.dead("// (paper (3); method.md\n// section 4)"), ["core/a.hpp: method.md has no section 4"])


if __name__ == "__main__":
    unittest.main()
