// Families of mechanisms: every shipped one against the numeric witness, and what is known of each by itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "mechanism/read.hpp"
#include "symbolic/determinants.hpp"
#include "symbolic/locus_problem.hpp"
#include "tests/symbolic/witness.hpp"

namespace clearloci::symbolic {
namespace {

mechanism::Mechanism example(const std::string& name) {
  return mechanism::read_mechanism(std::string(CLEARLOCI_SOURCE_DIR) + "/examples/" + name + ".yaml");
}

class Families : public testing::TestWithParam<std::string> {};

TEST_P(Families, AgreeWithTheWitness) { EXPECT_EQ(hold_against_witness(example(GetParam())), 12); }

INSTANTIATE_TEST_SUITE_P(Examples, Families,
                         testing::Values("prrrp", "rprpr", "five_bar_coupler", "slider_crank", "four_bar",
                                         "watt_six_bar", "stephenson_six_bar", "three_rpr", "three_rrr"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace clearloci::symbolic
