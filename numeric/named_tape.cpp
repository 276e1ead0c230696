#include "numeric/named_tape.hpp"

#include "core/errors.hpp"

namespace clearloci::numeric {

NamedTape::NamedTape(const mechanism::Mechanism& mechanism) {
  for (const auto& parameter : mechanism.parameters)
    names_[parameter.name] = compile(core::Expression::number(parameter.value));
  int input = 0;
  for (const auto& coordinate : mechanism.coordinates) names_[coordinate.name] = builder_.input(input++);
  for (const int dyad : mechanism::dyad_points(mechanism)) sign_of_[dyad] = builder_.input(input++);
  first_unknown_ = input;
}

Register NamedTape::compile(const core::Expression& expression) {
  return builder_.compile(expression, [this](const std::string& name) {
    const auto found = names_.find(name);
    core::ensure(found != names_.end(), "an expression of a mechanism uses no unknown name");
    return found->second;
  });
}

}  // namespace clearloci::numeric
