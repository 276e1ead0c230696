// Symmetric designs hold against the witness: legs alike, kites, motors on one axis, blocks on one rail, with weights
// and without. On these numerators and |A| vanish together along curves (method.md section 10): no reaction is said to
// vanish that does not, and none vanishes without being named. In the environment: CLEARLOCI_DESIGNS=n tries n designs
// a family, CLEARLOCI_FIRST=i begins with the i-th, CLEARLOCI_KEEP=folder keeps the files of those that fail,
// CLEARLOCI_PATIENCE=s waits s seconds for each.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iostream>

#include "analysis/loci.hpp"
#include "core/errors.hpp"
#include "tests/laws/lattice_designs.hpp"

namespace clearloci {
namespace {

int from_environment(const char* name, int usual) {
  const char* wanted = std::getenv(name);
  return wanted != nullptr ? std::atoi(wanted) : usual;
}

struct Tally {
  int tried = 0, refused = 0, late = 0, uncertified = 0;
  std::size_t edges = 0, arcs = 0, arcs_undecided = 0;
};

/// What the witness disputes, a line each; none where it disputes nothing.
std::string disputes(const numeric::ValidationReport& report) {
  std::ostringstream text;
  text.precision(12);
  const std::size_t edges = report.disputed - report.disputed_arcs.size();
  if (edges > 0) {
    const numeric::DisputedEdge& edge = report.disputed_edges.front();
    text << edges << " edges, the first of " << edge.reaction.joint << "." << core::to_string(edge.reaction.quantity)
         << " from (" << edge.from[0] << ", " << edge.from[1] << ")\n";
  }
  for (const numeric::DisputedArc& arc : report.disputed_arcs)
    text << arc.reaction.joint << "." << core::to_string(arc.reaction.quantity) << " along " << arc.curve << " at ("
         << arc.at[0] << ", " << arc.at[1] << ")"
         << (arc.unbounded ? " grows"
             : arc.claimed ? " does not vanish"
                           : " vanishes and is not named")
         << "\n";
  return text.str();
}

class SymmetricDesigns : public testing::TestWithParam<test::Family> {};

TEST_P(SymmetricDesigns, HoldAgainstTheWitness) {
  constexpr int seed = 20261122;
  const int first = from_environment("CLEARLOCI_FIRST", 0), designs = from_environment("CLEARLOCI_DESIGNS", 8);
  Tally tally;
  for (int i = first; i < first + designs; ++i) {
    std::seed_seq sequence{seed, static_cast<int>(GetParam()), i};
    std::mt19937 random(sequence);
    const bool weights = i % 2 == 1;
    const std::string text = i % 4 < 3 ? test::lattice_design(random, GetParam(), weights)
                                       : test::generic_design(random, GetParam(), weights);
    std::string fault;
    ++tally.tried;
    try {
      LociRequest request;
      request.deadline =
          std::chrono::steady_clock::now() + std::chrono::seconds(from_environment("CLEARLOCI_PATIENCE", 60));
      const mechanism::Mechanism mechanism = mechanism::parse_mechanism(text, "symmetric.yaml");
      const Validation validation = validate_loci(mechanism, request, {60, 60});
      if (validation.map.out_of_time) {
        ++tally.late;
        continue;
      }
      for (const core::LocusCurve& curve : validation.map.curves)
        if (!curve.certified) {
          ++tally.uncertified;
          break;
        }
      tally.edges += validation.report.held;
      tally.arcs += validation.report.arcs_held;
      tally.arcs_undecided += validation.report.arcs_undecided;
      fault = disputes(validation.report);
    } catch (const core::LimitReached&) {
      ++tally.late;
    } catch (const core::InputError& refused) {
      // Out of reach all over the box, or singular in every pose.
      const std::string why = refused.what();
      ++tally.refused;
      if (why.find("unreachable") == std::string::npos && why.find("singular in every pose") == std::string::npos)
        fault = "refused: " + why;
    } catch (const std::exception& error) {
      fault = error.what();
    }
    if (fault.empty()) continue;
    ADD_FAILURE() << "design " << i << "\n" << fault << text;
    if (const char* keep = std::getenv("CLEARLOCI_KEEP"))
      std::ofstream(std::string(keep) + "/" + test::to_string(GetParam()) + " " + std::to_string(i) + ".yaml") << text;
  }
  std::cout << test::to_string(GetParam()) << ": " << tally.tried << " designs, " << tally.refused << " refused, "
            << tally.late << " not done in time, " << tally.uncertified << " not certified; " << tally.edges
            << " edges and " << tally.arcs << " claims along arcs held, " << tally.arcs_undecided << " claims undecided"
            << std::endl;
  // Else the law would have been about nothing.
  if (tally.refused + tally.late < tally.tried) {
    EXPECT_GT(tally.edges, 0u);
  }
}

INSTANTIATE_TEST_SUITE_P(Families, SymmetricDesigns,
                         testing::Values(test::Family::mirrored, test::Family::kite, test::Family::coaxial,
                                         test::Family::one_rail),
                         [](const auto& test) {
                           std::string name = test::to_string(test.param);
                           for (char& c : name)
                             if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
                           return name;
                         });

}  // namespace
}  // namespace clearloci
