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
        self.assertFalse(offences_of("loci/sheet/a.cpp", '#include "loci/trace.hpp"\n#include "core/polynomial.hpp"\n'))

    def test_third_parties_keep_their_place(self):
        self.assertTrue(offences_of("core/a.cpp", "#include <fmt/format.h>\n"))
        self.assertTrue(offences_of("loci/a.hpp", "#include <CGAL/Gmpz.h>\n"))
        self.assertFalse(offences_of("loci/a.cpp", "#include <CGAL/Gmpz.h>\n"))
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
