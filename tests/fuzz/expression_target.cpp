#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "mechanism/evaluate.hpp"
#include "mechanism/read.hpp"
#include "tests/fuzz/property.hpp"
#include "tests/fuzz/targets.hpp"

namespace clearloci::fuzz {
namespace {

/// L = 1/2, a = 30 deg, q = sqrt(2) + 1: a rational, an angle and a radical to meet in expressions.
const std::vector<mechanism::Parameter>& parameters() {
  static const std::vector<mechanism::Parameter> parameters = [] {
    std::vector<mechanism::Parameter> list;
    for (const auto& [name, text] : {std::pair{"L", "1/2"}, {"a", "30 deg"}, {"q", "sqrt(2) + 1"}}) {
      mechanism::Parameter parameter;
      parameter.name = name;
      parameter.expression = mechanism::parse_expression(text, {"parameters", 1, 1});
      const mechanism::ExactValue value = mechanism::evaluate(parameter.expression, list);
      parameter.value = value.value;
      parameter.exact = value.exact;
      list.push_back(parameter);
    }
    return list;
  }();
  return parameters;
}

/// The value, or nothing where there is none (a division by zero, an unknown name).
struct Evaluated {
  std::optional<mechanism::ExactValue> value;
  bool too_large = false;  ///< a step has more bits or roots than numbers may have
};

Evaluated evaluated(const core::Expression& expression) {
  try {
    return {mechanism::evaluate(expression, parameters())};
  } catch (const std::domain_error& error) {
    return {{}, std::string_view(error.what()).find("a number of more than") != std::string_view::npos};
  } catch (const std::out_of_range&) {
    return {};
  }
}

}  // namespace

void expression_target(std::string_view bytes) {
  const std::string text(bytes);
  const core::SourcePosition where{"e", 1, 1};
  const auto read = value_or_complaint([&] { return mechanism::parse_expression(text, where); });
  if (!read) return;
  const std::string printed = core::to_string(*read);
  // The parser bounds the text it takes, and 1e4000 is shorter than its digits.
  const auto again = value_or_complaint([&] { return mechanism::parse_expression(printed, where); });
  if (!again) {
    require(printed.size() > text.size(), "what is printed can be read: " + printed);
    return;
  }
  require(core::to_string(*again) == printed, "printed and read again it prints the same: " + printed);
  require(core::symbols(*again) == core::symbols(*read), "printed and read again it has the same symbols: " + printed);
  const auto [value, too_large] = evaluated(*read);
  const auto [same, same_too_large] = evaluated(*again);
  // a*(b/c) is printed as a*b/c, whose steps may grow beyond the limit of bits where the other's do not.
  if (too_large || same_too_large) return;
  require(value.has_value() == same.has_value(), "printed and read again it has a value as before: " + printed);
  if (value) require(value->value == same->value, "printed and read again it has the same value: " + printed);
}

}  // namespace clearloci::fuzz
