// The units in which a mechanism file is written and in which tables, pictures and drawings speak. Values of the
// library are SI: metres, radians, newtons, kilograms.
#pragma once

#include <string>

namespace clearloci::inline core {

/// `size`: one of it in SI units, 0.001 of "mm".
struct Unit {
  std::string name;
  double size = 1;
};

struct Units {
  bool declared = false;  ///< by the file; else all are SI, and tables and pictures choose what reads best
  Unit length{"m"}, angle{"rad"}, force{"N"}, mass{"kg"};
  bool angle_declared = false;  ///< by the file; else tables show degrees
};

}  // namespace clearloci::inline core
