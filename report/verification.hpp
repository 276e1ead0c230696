// The answer of `clearloci verify` as a text, as JSON (results.md, verify.json) and as a picture.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "clearloci/verify.hpp"
#include "report/picture.hpp"

namespace clearloci::report {

/// "f_A1 f_B1 vanish under the load (0, -100) N", in these units; SI where none are given. `of_angles`: distances are.
std::string witness_words(const core::TaskWitness& witness, const core::Units& units = {}, bool of_angles = false);

/// Of an answer with a witness, in the units of its mechanism file.
std::string shown_witness_words(const core::Verification& result);

nlohmann::ordered_json verification_object(const core::Verification& result);

/// A line a fact. Ends with a newline.
std::string verification_text(const core::Verification& result);

/// Over two lengths the zones with the task over them; else what the task is seen as along all coordinates but one or
/// two (task_panels.hpp). With the witness or what is nearest.
std::string verification_picture(const core::Verification& result, PictureFormat format);

}  // namespace clearloci::report
