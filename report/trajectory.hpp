// The answer of `clearloci trajectory` as JSON, as a text, as tables and as pictures.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "clearloci/trajectory.hpp"

namespace clearloci::report {

/// The motion, its stages, the contact losses and the samples.
nlohmann::ordered_json trajectory_object(const core::TrajectoryResult& result);

/// A table of stages and one of contact losses. Ends with a newline.
std::string trajectory_text(const core::TrajectoryResult& result);

/// period, distance, dx, dy, dalpha.
core::Table sweep_table(const core::TrajectoryResult& result);

/// Writes trajectory.json, and what is asked for of csv (trajectory.csv, and periods.csv of a sweep), png, svg, pdf.
/// Returns the files. `progress` may be empty.
std::vector<std::filesystem::path> write_trajectory(
    const core::TrajectoryResult& result, const std::filesystem::path& directory, const std::set<std::string>& formats,
    const std::function<void(double fraction, std::string_view stage)>& progress = {});

}  // namespace clearloci::report
