// The answer of `clearloci verify` as a text, as JSON (results.md, verify.json) and as a picture.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <string>
#include <vector>

#include "clearloci/verify.hpp"

namespace clearloci::report {

/// "f_A1 f_B1 vanish under the load (0, -100) N".
std::string witness_words(const core::TaskWitness& witness);

nlohmann::ordered_json verification_object(const core::Verification& result);

/// A line a fact. `fit`: a place was looked for. Ends with a newline.
std::string verification_text(const core::Verification& result, bool fit);

/// Writes verify.json and the pictures asked for of svg, png, pdf. Returns the files.
std::vector<std::filesystem::path> write_verification(const core::Verification& result,
                                                      const std::filesystem::path& directory,
                                                      const std::set<std::string>& formats);

}  // namespace clearloci::report
