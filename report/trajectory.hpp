// The answer of `clearloci trajectory` as JSON and as a text, and its tables.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "clearloci/trajectory.hpp"

namespace clearloci::report {

/// The motion, its stages, the contact losses and the samples.
nlohmann::ordered_json trajectory_object(const core::TrajectoryResult& result);

/// A table of stages and one of contact losses. Ends with a newline.
std::string trajectory_text(const core::TrajectoryResult& result);

/// period, distance, dx, dy, dalpha.
core::Table sweep_table(const core::TrajectoryResult& result);

/// In the units of the mechanism file, which the heads of the columns then say.
std::string shown_csv(const core::Table& table, const core::Units& units);

}  // namespace clearloci::report
