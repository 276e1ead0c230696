// Clearances from fits: the standard's tables, not its formulas.
#include "mechanism/fits.hpp"

#include <gtest/gtest.h>

#include "five_bar_text.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/read.hpp"

namespace clearloci::mechanism {
namespace {

struct Published {
  const char* fit;
  Rational millimetres;
  int least, largest;
};

TEST(Fits, AreThoseOfThePublishedTables) {
  // Limits of hole and shaft from ISO 286-2:2010, e.g. 25 H8/f7: +33/0 and -20/-41.
  const std::vector<Published> fits = {
      {"H7/g6", 12, 6, 35},     {"H7/h6", 12, 0, 29},   {"H8/f7", 25, 20, 74},      {"H7/f7", 10, 13, 43},
      {"H11/d11", 40, 80, 400}, {"H8/e8", 60, 60, 152}, {"H9/d9", 100, 120, 294},   {"G7/h6", 30, 7, 41},
      {"F8/h6", 50, 25, 80},    {"E9/h9", 18, 32, 118}, {"D10/h9", 6, 30, 108},     {"H6/g5", 3, 2, 12},
      {"H7/g6", 500, 20, 123},  {"H5/h5", 3, 0, 8},     {"H7/g6", {31, 10}, 4, 24}, {"F7/f7", 180, 86, 166},
  };
  for (const Published& one : fits) {
    const DiametralClearance clearance = diametral_clearance(one.fit, one.millimetres / 1000, {});
    EXPECT_EQ(clearance.least, one.least) << one.fit;
    EXPECT_EQ(clearance.largest, one.largest) << one.fit;
  }
}

TEST(Fits, UnknownOnesAreRefused) {
  for (const char* fit : {"H7", "H7/p6", "h7/g6", "H7/G6", "H12/g6", "H4/g6", "H7/g", "H07/g6", "", "/", "H7/g6/h6"})
    EXPECT_THROW((void)diametral_clearance(fit, Rational(12, 1000), {}), core::InputError) << fit;
  EXPECT_THROW((void)diametral_clearance("H7/g6", Rational(501, 1000), {}), core::InputError);
  EXPECT_THROW((void)diametral_clearance("H7/g6", 0, {}), core::InputError);
}

TEST(Fits, TheLargestRadialClearanceHoldsAndIsSaid) {
  const std::string text = with(five_bar_text, "radial: 10e-6, angular", "fit: H7/g6, diameter: 12 mm, angular");
  const Mechanism m = parse_mechanism(text, "m.yaml");
  EXPECT_EQ(value_of(m.joints[0].clearance->radial, m), Rational(7, 400000));
  EXPECT_EQ(m.joints[0].clearance->fit->least, Rational(3, 1000000));
  const std::string words =
      "H7/g6 at 12 mm: a radial clearance of 3 to 17.5 µm (ISO 286-1:2010), of which the largest is taken";
  EXPECT_EQ(fit_notes(m), std::vector<std::string>{"A1: " + words});
  const std::string two = with(text, "radial: 10e-6", "fit: H7/g6, diameter: 12 mm");
  EXPECT_EQ(fit_notes(parse_mechanism(two, "m.yaml")), std::vector<std::string>{"A1, B1: " + words});
}

TEST(Fits, WrongKeysGetClearMessages) {
  const auto complaint = [](const std::string& clearance) -> std::string {
    try {
      parse_mechanism(with(five_bar_text, "radial: 10e-6, angular: 0.5e-3", clearance), "m.yaml");
    } catch (const core::InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_NE(complaint("fit: H7/g6").find("'diameter' is missing"), std::string::npos);
  EXPECT_NE(complaint("diameter: 0.01").find("has a diameter but no fit"), std::string::npos);
  EXPECT_NE(complaint("fit: H7/g6, diameter: 0.01, radial: 1e-5").find("a radial clearance and a fit"),
            std::string::npos);
  EXPECT_NE(complaint("fit: H7/k6, diameter: 0.01").find("'H7/k6' is not a known clearance fit"), std::string::npos);
  EXPECT_NE(complaint("fitt: H7/g6, diameter: 0.01").find("did you mean 'fit'?"), std::string::npos);
}

}  // namespace
}  // namespace clearloci::mechanism
