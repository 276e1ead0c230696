#include "mechanism/pose_steps.hpp"

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "mechanism/evaluate.hpp"

namespace clearloci::mechanism {

using core::Expression;
using core::Rational;

PoseSteps::PoseSteps(const Mechanism& mechanism) : m_(mechanism) {
  for (std::size_t c = 0; c < m_.coordinates.size(); ++c)
    symbols_[m_.coordinates[c].name] = builder_.coordinate(static_cast<int>(c));
}

int PoseSteps::symbol(const std::string& name) {
  if (const auto found = symbols_.find(name); found != symbols_.end()) return found->second;
  const auto parameter =
      std::find_if(m_.parameters.begin(), m_.parameters.end(), [&](const Parameter& p) { return p.name == name; });
  core::ensure(parameter != m_.parameters.end(), "a symbol is a coordinate or a parameter");
  // A parameter whose value is rational is that number, whatever roots it was written with.
  const int step =
      parameter->exact ? builder_.constant(parameter->value) : core::interpret(parameter->expression, *this);
  symbols_[name] = step;
  return step;
}

/// The step, or the rational number that it is: cos(90 deg) is 0.
int PoseSteps::exact(const Expression& e, int step) {
  if (builder_.is_number(step) || builder_.varies(step)) return step;
  const ExactValue value = evaluate(e, m_.parameters);
  return value.exact ? builder_.constant(value.value) : step;
}

int PoseSteps::power(int base, const Expression& whole_power) {
  const Rational value = value_of(whole_power.arguments()[1], m_), twice = 2 * value;
  core::ensure(twice.get_den() == 1, "exponents are whole or half of one");
  const bool whole = value.get_den() == 1;
  const Rational counted = abs(whole ? value : twice);
  const int root = whole ? base : builder_.square_root(base);
  const int raised = builder_.power(root, static_cast<int>(counted.get_num().get_si()));
  return value < 0 ? builder_.inverse(raised) : raised;
}

void PoseSteps::close(std::size_t group, const std::vector<int>& equations) {
  builder_.close(group, equations);
  core::PoseProgram::Block& block = builder_.block(group);
  block.name = m_.groups[group].name;
  if (m_.coordinates.size() == 1)
    for (const int equation : equations)
      block.rates.push_back(builder_.derivative(equation, symbols_.at(m_.coordinates.front().name)));
  for (const std::array<Rational, 3>& place : m_.groups[group].near)
    for (std::size_t i = 0; i < dimension(m_); ++i) {
      block.near.push_back(core::to_double(place[i]));
      block.size = std::max(block.size, std::abs(block.near.back()));
    }
  for (const Group::Distance& distance : m_.groups[group].distances)
    if (const int length = core::interpret(distance.length, *this); builder_.is_number(length))
      block.size = std::max(block.size, core::to_double(builder_.number(length)));
}

core::PoseProgram program_of(const Mechanism& mechanism, const core::PoseProgramBuilder& builder,
                             const std::vector<int*>& results) {
  core::PoseProgram program = builder.program(results);
  for (const Rational& value : mechanism.near) program.near.push_back(core::to_double(value));
  return program;
}

}  // namespace clearloci::mechanism
