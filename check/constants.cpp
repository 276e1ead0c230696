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
    for (Expression& own : all) (*this)(own);
  }
  void operator()(mechanism::VectorExpression& vector) const {
    (*this)(vector.numbers);
    for (mechanism::VectorExpression& own : vector.arguments) (*this)(own);
  }
  void operator()(mechanism::ExplicitPoint& own) const { (*this)(own.coordinates); }
  void operator()(mechanism::DyadPoint& own) const {
    (*this)(own.from_length);
    (*this)(own.to_length);
    if (own.axis) (*this)(*own.axis);
  }
  void operator()(mechanism::OffsetPoint& own) const {
    (*this)(own.along);
    (*this)(own.left);
  }
  void operator()(mechanism::MeanPoint& /*own*/) const {}
  void operator()(mechanism::SliderPoint& own) const {
    (*this)(own.along);
    (*this)(own.length);
  }
  void operator()(mechanism::ShiftedPoint& own) const { (*this)(own.by); }
  void operator()(mechanism::CrossingPoint& own) const {
    (*this)(own.along_first);
    (*this)(own.along_second);
  }
  void operator()(mechanism::GroupPoint& /*own*/) const {}

 private:
  Expression folded(const Expression& e) const {
    if (!varies_(e)) return Expression::number(mechanism::value_of(e, m_));
    if (e.arguments().empty()) return e;
    std::vector<Expression> parts;
    for (const Expression& own : e.arguments()) parts.push_back(folded(own));
    return Expression::apply(e.kind(), std::move(parts));
  }

  const Mechanism& m_;
  const Varying& varies_;
};

}  // namespace

Varying::Varying(const Mechanism& m, std::vector<std::string> names) : names_(names.begin(), names.end()) {
  // Parameters stand behind those that they are made of.
  for (const mechanism::Parameter& own : m.parameters)
    if ((*this)(own.expression)) names_.insert(own.name);
}

bool Varying::operator()(const Expression& e) const {
  if (e.kind() == Expression::Kind::symbol) return names_.contains(e.name());
  return std::any_of(e.arguments().begin(), e.arguments().end(), [&](const Expression& own) { return (*this)(own); });
}

void fold_constants(Mechanism& m, const Varying& varies) {
  const Mechanism whole = m;
  const Folding fold(whole, varies);
  for (mechanism::Point& point : m.points) std::visit(fold, point.form);
  for (mechanism::Group& group : m.groups) {
    for (mechanism::Group::Distance& own : group.distances) fold(own.length);
    for (mechanism::Group::Line& own : group.lines) fold(own.along);
  }
}

}  // namespace clearloci::check
