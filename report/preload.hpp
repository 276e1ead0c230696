// What is known of the efforts that were free (clearloci/verify.hpp, PreloadAnswer; preload.md), as lines of the
// table and in verify.json; those that are feasible at one pose (clearloci/pose.hpp), in its text and in pose.json.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "clearloci/pose.hpp"
#include "clearloci/table.hpp"
#include "clearloci/verify.hpp"
#include "clearloci/zones.hpp"

namespace clearloci::report {

/// Without the head of each line: "B2 = -6.25 N m, the smallest that verifies; ...".
std::vector<std::string> preload_lines(const core::PreloadAnswer& preload, const core::Units& units);

/// Of a law by cells: from and to of every coordinate, then what is chosen in the cell, N or N m; under a range of
/// loads that of the first and the last. "nan": of a cable whose tension follows there. Parts of loads have gains.
core::Table law_table(const core::Verification& result);

nlohmann::ordered_json preload_object(const core::PreloadAnswer& preload);

/// "B2 = 0 N m; feasible", then a line each: "up to -6.08 N m, where M_A1 vanishes".
std::string feasible_efforts_text(const core::FeasibleEfforts& efforts, const core::Units& units);

/// {"effort": 0, "given": false, "within": null, "ranges": [{"from", "to", "below", "above"}], "never": []}; null at an
/// infinite end.
nlohmann::ordered_json feasible_efforts_object(const core::FeasibleEfforts& efforts);

/// At the sample of a zone: {"feasible", "smallest", "efforts"}, of every effort {"within", "ranges", "never"}; of one
/// free motor each range with its "signs".
nlohmann::ordered_json zone_preload_object(const core::ZonePreload& preload);

/// Of the zone of this name a line or more: "z1: B2 up to -6.08 N m (M_A1)".
std::string zone_preload_text(const std::string& zone, const core::ZonePreload& preload, const core::Units& units);

}  // namespace clearloci::report
