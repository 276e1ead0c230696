"""The checker of include rules finds what it should and nothing else."""

import unittest

from include_rules import offences_of


class IncludeRules(unittest.TestCase):
    def test_the_witness_stays_independent(self):
        for folder, other in [("numeric", "symbolic"), ("numeric", "loci"), ("symbolic", "numeric"), ("loci", "symbolic")]:
            text = f'#include "{other}/anything.hpp"\n'
            self.assertEqual(len(offences_of(f"{folder}/a.cpp", text)), 1, (folder, other))

    def test_nothing_includes_against_the_stream(self):
        self.assertTrue(offences_of("core/a.hpp", '#include "mechanism/mechanism.hpp"\n'))
        self.assertTrue(offences_of("report/a.cpp", '#  include "cli/program.hpp"\n'))
        self.assertFalse(offences_of("cli/a.cpp", '#include "report/files.hpp"\n#include "numeric/a.hpp"\n'))
        self.assertFalse(offences_of("loci/sheet/a.cpp", '#include "loci/sheet/b.hpp"\n#include "core/polynomial.hpp"\n'))

    def test_rooms_are_entered_one_way(self):
        rooms = ["numbers", "sheet", "search", "curves", "zones"]
        for k, lower in enumerate(rooms):
            for upper in rooms[k + 1 :]:
                down, up = f'#include "loci/{lower}/{lower}.hpp"\n', f'#include "loci/{upper}/{upper}.hpp"\n'
                self.assertFalse(offences_of(f"loci/{upper}/a.cpp", down), (lower, upper))
                self.assertEqual(len(offences_of(f"loci/{lower}/a.cpp", up)), 1, (lower, upper))
        for one, other in [("zones", "tasks"), ("tasks", "zones"), ("points", "surfaces"), ("surfaces", "points")]:
            self.assertTrue(offences_of(f"loci/{one}/a.hpp", f'#include "loci/{other}/{other}.hpp"\n'), (one, other))
        self.assertTrue(offences_of("loci/curves/a.cpp", '#include "loci/trace.hpp"\n'))
        self.assertFalse(offences_of("loci/trace.cpp", '#include "loci/trace.hpp"\n#include "loci/zones/zones.hpp"\n'))

    def test_rooms_are_entered_by_their_doors(self):
        for place in ["loci/curves/a.cpp", "loci/trace.cpp", "analysis/a.cpp"]:
            self.assertEqual(len(offences_of(place, '#include "loci/sheet/star.hpp"\n')), 1, place)
            self.assertFalse(offences_of(place, '#include "loci/sheet/sheet.hpp"\n'), place)
        self.assertFalse(offences_of("loci/sheet/a.hpp", '#include "loci/sheet/star.hpp"\n'))
        self.assertTrue(offences_of("loci/sheet/a.hpp", '#include "loci/sheet/sheet.hpp"\n'))
        self.assertFalse(offences_of("analysis/a.hpp", '#include "loci/trace.hpp"\n'))
        self.assertTrue(offences_of("loci/attic/a.hpp", ""))

    def test_third_parties_keep_their_place(self):
        self.assertTrue(offences_of("core/a.cpp", "#include <fmt/format.h>\n"))
        self.assertTrue(offences_of("loci/zones/a.hpp", "#include <CGAL/Gmpz.h>\n"))
        self.assertFalse(offences_of("loci/zones/a.cpp", "#include <CGAL/Gmpz.h>\n"))
        self.assertTrue(offences_of("loci/sheet/a.cpp", "#include <CGAL/Gmpz.h>\n"))
        self.assertTrue(offences_of("numeric/a.cpp", "#include <ginac/ginac.h>\n"))
        self.assertTrue(offences_of("symbolic/a.hpp", "#include <flint/fmpz.h>\n"))

    def test_public_headers_know_no_folder(self):
        for included in ["core/errors.hpp", "Eigen/Core", "nlohmann/json.hpp", "gmp.h"]:
            self.assertTrue(offences_of("include/clearloci/a.hpp", f'#include "{included}"\n'), included)
        self.assertFalse(
            offences_of("include/clearloci/a.hpp", '#include <gmpxx.h>\n#include <vector>\n#include "clearloci/b.hpp"\n')
        )
        self.assertFalse(offences_of("core/a.hpp", '#include "clearloci/b.hpp"\n'))

    def test_private_headers_stay_private(self):
        private = {"symbolic/ring.hpp"}
        text = '#include "symbolic/ring.hpp"\n'
        self.assertTrue(offences_of("cli/a.cpp", text, private))
        self.assertTrue(offences_of("symbolic/a.hpp", text, private))
        self.assertFalse(offences_of("symbolic/a.cpp", text, private))
        self.assertFalse(offences_of("symbolic/a.hpp", "// Private to symbolic/.\n" + text, private))
        self.assertFalse(offences_of("symbolic/a.hpp", "// Private to symbolic/.\n#include <flint/fmpz.h>\n"))

    def test_what_is_no_include_is_not_judged(self):
        self.assertFalse(offences_of("core/a.cpp", '// #include "cli/x.hpp" is not allowed\n#include <vector>\n'))


if __name__ == "__main__":
    unittest.main()
