#include "core/shown_units.hpp"

#include <gtest/gtest.h>

namespace clearloci::core {
namespace {

Units millimetres() {
  Units units;
  units.declared = true;
  units.length = {"mm", 1e-3};
  units.force = {"kN", 1000};
  return units;
}

TEST(ShownUnits, ValuesAreToldInTheFilesUnits) {
  EXPECT_EQ(told(0.25, "m", millimetres()), "250 mm");
  EXPECT_EQ(told(20, "N", millimetres()), "0.02 kN");
  EXPECT_EQ(told(0.5, "m^2", millimetres()), "500000 mm^2");
  EXPECT_EQ(told(0.25, "m", {}), "0.25 m");
  EXPECT_EQ(told(3.14159265358979, "rad", millimetres()), "180 deg") << "unless the file says rad";
  EXPECT_EQ(told(-0.0, "m", {}), "0 m");
}

TEST(ShownUnits, SentencesAreToldInTheFilesUnits) {
  const Units mm = millimetres();
  EXPECT_EQ(in_file_units("an undecided cell on A, near (0.25, -0.7)", mm, {}),
            "an undecided cell on A, near (250, -700) mm");
  EXPECT_EQ(in_file_units("one near (0.25, 0.523598775598)", mm, {false, true}), "one near (250 mm, 30 deg)");
  EXPECT_EQ(in_file_units("open in [0.1, 0.2] x [-1e-3, 0.4]", mm, {}), "open in [100, 200] mm x [-1, 400] mm");
  EXPECT_EQ(in_file_units("zones of 0.5 m^2, 0.25 m wide, a force of 20 N", mm, {}),
            "zones of 500000 mm^2, 250 mm wide, a force of 0.02 kN");
  EXPECT_EQ(in_file_units("a couple of 3 N m; 12 mm; 2 links; f(x, y)", mm, {}),
            "a couple of 3 N m; 12 mm; 2 links; f(x, y)")
      << "what is no SI length, angle or force stays";
  EXPECT_EQ(in_file_units("near (0.25, -0.7)", {}, {}), "near (0.25, -0.7) m");
}

}  // namespace
}  // namespace clearloci::core
