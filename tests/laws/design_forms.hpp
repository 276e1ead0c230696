// What mechanism files and requests may have besides a family's bare mechanism: every form of mechanism-file.md,
// and the options of the commands. The table says how often each is drawn; it is part of the run (exactness.md).
#pragma once

#include <array>
#include <bitset>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "clearloci/quantity.hpp"
#include "tests/laws/lattice_designs.hpp"

namespace clearloci::test {

enum class Form {
  weights,
  shifted,
  units,
  frame,
  repeat,
  parameters,
  irrational,
  spring,
  spring_length,
  spring_between,
  constant_pull,
  torsion,
  effort,
  limit_distance,
  limit_angle,
  pose_load,
  vector_load,
  arctangent_load,
  couple,
  point_masses,
  fit,
  no_guide_ends,
  no_clearance,
  relative_to,
  min_force,
  min_couple,
  quantity,
  joint,
  other_mode,
  all_modes,
  task_loads,
  task_least,
  task_tolerances,
  task_balls,
  task_error,
  driven_pins,
};

struct FormRow {
  Form form;
  const char* name;
  int one_in;  ///< design of so many, where the family can have it
};

inline constexpr std::array form_table = {
    FormRow{Form::weights, "weights", 3},
    FormRow{Form::shifted, "anywhere in the plane", 3},
    FormRow{Form::units, "units", 6},
    FormRow{Form::frame, "bases in a turned frame", 10},
    FormRow{Form::repeat, "repeat", 12},
    FormRow{Form::parameters, "parameters", 3},
    FormRow{Form::irrational, "irrational numbers", 10},
    FormRow{Form::spring, "spring without free length", 10},
    FormRow{Form::spring_length, "spring with free length", 14},
    FormRow{Form::spring_between, "spring between links", 14},
    FormRow{Form::constant_pull, "spring of constant force", 16},
    FormRow{Form::torsion, "torsion spring", 12},
    FormRow{Form::effort, "motor of known effort", 10},
    FormRow{Form::limit_distance, "limit of a distance", 12},
    FormRow{Form::limit_angle, "limit of an angle", 16},
    FormRow{Form::pose_load, "load of the pose", 10},
    FormRow{Form::vector_load, "load along a vector", 14},
    FormRow{Form::arctangent_load, "arc tangent in a load", 24},
    FormRow{Form::couple, "couple", 8},
    FormRow{Form::point_masses, "point masses", 8},
    FormRow{Form::fit, "fit of ISO 286", 10},
    FormRow{Form::no_guide_ends, "guide without ends", 6},
    FormRow{Form::no_clearance, "joint without clearance", 8},
    FormRow{Form::relative_to, "relative end effector", 12},
    FormRow{Form::min_force, "--min-force", 8},
    FormRow{Form::min_couple, "--min-couple", 12},
    FormRow{Form::quantity, "--quantity", 8},
    FormRow{Form::joint, "--joint", 12},
    FormRow{Form::other_mode, "--working-mode of its own", 6},
    FormRow{Form::all_modes, "--working-mode all", 8},
    FormRow{Form::task_loads, "task: range of loads", 6},
    FormRow{Form::task_least, "task: least force or couple", 4},
    FormRow{Form::task_tolerances, "task: tolerances", 6},
    FormRow{Form::task_balls, "task: balls of loads", 8},
    FormRow{Form::task_error, "task: pose error", 8},
    FormRow{Form::driven_pins, "telescopic legs driven in their pins", 5},
};

using FormSet = std::bitset<form_table.size()>;

inline bool has(const FormSet& forms, Form form) { return forms.test(static_cast<std::size_t>(form)); }

/// One design of the run: what is asked, and of which file.
struct LawDesign {
  int seed = 0, index = 0;
  Family family = Family::five_bar;
  bool lattice = false;
  FormSet forms;  ///< that it has
  std::string text;
  /// The same about the origin, and how far the other is from it in each coordinate, m: what the witness is compiled
  /// from, for doubles tell little apart far away.
  std::string home_text;
  std::vector<double> shift;
  std::optional<core::Rational> min_force, min_couple;
  std::vector<core::Quantity> quantities;  ///< empty: the usual ones
  std::vector<std::string> joints;         ///< empty: the usual ones
  std::vector<int> sides;                  ///< of another working mode; empty: the file's
  std::string side_names;                  ///< "left,ahead"
  bool all_modes = false;
  core::Rational unit = 1;                                     ///< of the file
  std::vector<std::pair<std::string, core::Rational>> values;  ///< parameters, in the file's unit
};

/// The index-th of a family, of a run's seed; every second one on the lattice. `forms`: those that may be drawn.
LawDesign law_design(int seed, Family family, int index, const FormSet& forms = FormSet().set());

/// Arguments of the command line that ask for the same.
std::string arguments_of(const LawDesign& design);

}  // namespace clearloci::test
