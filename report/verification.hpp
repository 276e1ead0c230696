// The answer of `clearloci verify` as a text, as JSON (results.md, verify.json) and as a picture.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "clearloci/verify.hpp"
#include "report/picture.hpp"

namespace clearloci::report {

/// The first line of an answer, in the plane and over other coordinates.
const char* verdict_line(core::Verdict verdict);

/// "f_A1 f_B1 vanish under the load (0, -100) N".
/// The witness in these units (in_file_units); SI where none are given.
std::string witness_words(const core::TaskWitness& witness, const core::Units& units = {});

/// Of an answer with a witness, in the units of its mechanism file.
std::string shown_witness_words(const core::Verification& result);

nlohmann::ordered_json verification_object(const core::Verification& result);

/// A line a fact. `fit`: a place was looked for. Ends with a newline.
std::string verification_text(const core::Verification& result, bool fit);

/// The zones with the task over them, and its witness or what is nearest.
std::string verification_picture(const core::Verification& result, PictureFormat format);

}  // namespace clearloci::report
