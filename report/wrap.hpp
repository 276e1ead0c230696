// Breaking a text into lines, whatever the measure of a line is: columns of a terminal or points on paper.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace clearloci::report {

using Measure = std::function<double(std::string_view)>;

/// `text` (UTF-8) broken at spaces so that no line measures more than `width`; a word that alone measures more is cut
/// between characters. Always at least one line; a line has at least one character.
std::vector<std::string> wrap(std::string_view text, double width, const Measure& measure);

}  // namespace clearloci::report
