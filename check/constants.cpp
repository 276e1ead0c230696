#include "check/constants.hpp"

#include <algorithm>
#include <variant>

#include "mechanism/evaluate.hpp"

namespace clearloci::check {
namespace {

using core::Expression;
using mechanism::Mechanism;

class Folding {
 public:
  Folding(const Mechanism& m, const Varying& varies) : m_(m), varies_(varies) {}

  void operator()(Expression& e) const { e = folded(e); }
  void operator()(std::vector<Expression>& all) const {
    for (Expression& expression : all) (*this)(expression);
  }
  void operator()(mechanism::VectorExpression& vector) const {
    (*this)(vector.numbers);
    for (mechanism::VectorExpression& expression : vector.arguments) (*this)(expression);
  }
  void operator()(mechanism::ExplicitPoint& point) const { (*this)(point.coordinates); }
  void operator()(mechanism::DyadPoint& point) const {
    (*this)(point.from_length);
    (*this)(point.to_length);
    if (point.axis) (*this)(*point.axis);
  }
  void operator()(mechanism::OffsetPoint& point) const {
    (*this)(point.along);
    (*this)(point.left);
  }
  void operator()(mechanism::MeanPoint& /*own*/) const {}
  void operator()(mechanism::SliderPoint& point) const {
    (*this)(point.along);
    (*this)(point.length);
  }
  void operator()(mechanism::ShiftedPoint& point) const { (*this)(point.by); }
  void operator()(mechanism::CrossingPoint& point) const {
    (*this)(point.along_first);
    (*this)(point.along_second);
  }
  void operator()(mechanism::GroupPoint& /*own*/) const {}

 private:
  Expression folded(const Expression& e) const {
    if (!varies_(e)) return Expression::number(mechanism::value_of(e, m_));
    if (e.arguments().empty()) return e;
    std::vector<Expression> parts;
    for (const Expression& argument : e.arguments()) parts.push_back(folded(argument));
    return Expression::apply(e.kind(), std::move(parts));
  }

  const Mechanism& m_;
  const Varying& varies_;
};

}  // namespace

Varying::Varying(const Mechanism& m, std::vector<std::string> names) : names_(names.begin(), names.end()) {
  // Parameters stand behind those that they are made of.
  for (const mechanism::Parameter& parameter : m.parameters)
    if ((*this)(parameter.expression)) names_.insert(parameter.name);
}

bool Varying::operator()(const Expression& e) const {
  if (e.kind() == Expression::Kind::symbol) return names_.contains(e.name());
  return std::any_of(e.arguments().begin(), e.arguments().end(),
                     [&](const Expression& argument) { return (*this)(argument); });
}

void fold_constants(Mechanism& m, const Varying& varies) {
  const Mechanism whole = m;
  const Folding fold(whole, varies);
  for (mechanism::Point& point : m.points) std::visit(fold, point.form);
  for (mechanism::Group& group : m.groups) {
    for (mechanism::Group::Distance& distance : group.distances) fold(distance.length);
    for (mechanism::Group::Line& line : group.lines) fold(line.along);
  }
}

}  // namespace clearloci::check
