// loci.json (results.md): the whole result, for programs to read.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/locus_map.hpp"

namespace clearloci::report {

/// The object of results.md, keys in its order. Besides the keys shown there: `cause` after `factor`, `multiplicity` in
/// a vanishing reaction where it is above 1, `working_mode` in an isolated point, and before `timing`
/// `workspace` (`working_mode`, `rings`: to be filled by the even-odd rule) and `notes` (sentences).
/// With one free coordinate a point has its `factor` and `cause`, and `reachable` lists the intervals of each mode
/// (`working_mode`, `from`, `to`); `units` says where a coordinate is in rad.
/// A closed form is null, {"line": {"a", "b", "c"}}, {"circle": {"centre", "radius"}} or {"conic": {"type",
/// "coefficients", "centre", "semi_axes", "angle"}}. A circle whose radius is irrational has `radius` as a rounded
/// number and its square, exactly, as `radius_squared`.
nlohmann::ordered_json loci_object(const core::LocusMap& map);

/// A JSON value as a text to read: objects a key a line, an array that holds no object on one line. Numbers read back
/// as the same double. Ends with a newline.
std::string json_text(const nlohmann::ordered_json& value);

/// {"B1": "right", "B2": "left"}.
nlohmann::ordered_json mode_object(const core::TowerNames& tower, const core::WorkingMode& mode);

/// {"L": "1/2", "k": "3 N/mm"}.
nlohmann::ordered_json parameters_object(const std::vector<std::pair<std::string, std::string>>& parameters);

/// [{"joint": "A1", "quantity": "f"}, ...].
nlohmann::ordered_json vanishing_array(const std::vector<core::Vanishing>& vanishing);

}  // namespace clearloci::report
