#include "tests/symbolic/witness.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/errors.hpp"
#include "numeric/reactions.hpp"
#include "symbolic/determinants.hpp"
#include "symbolic/elimination.hpp"
#include "symbolic/locus_problem.hpp"

namespace clearloci::symbolic {
namespace {

double evaluated(const FactoredPoly& p, const std::vector<double>& at) {
  double value = core::to_double(p.constant);
  for (const PolyFactor& factor : p.factors)
    value *= std::pow(core::evaluate(factor.poly.plain(), std::span<const double>(at)), factor.multiplicity);
  return value;
}

/// The value of every ring variable in a posture; roots are left 0, for natural polynomials hold none.
std::vector<double> natural_values(const Geometry& geometry, const std::vector<double>& pose,
                                   const numeric::Posture& posture) {
  const Ring& ring = geometry.ring();
  std::vector<double> values(static_cast<std::size_t>(ring.size()), 0.0);
  const auto& coordinates = geometry.mechanism().coordinates;
  for (std::size_t i = 0; i < pose.size(); ++i) {
    values[i] = geometry.charts()[i] ? core::parameter_at(*geometry.charts()[i], pose[i]) : pose[i];
    if (!geometry.charts()[i]) continue;
    values[static_cast<std::size_t>(ring.index("cos(" + coordinates[i].name + ")"))] = std::cos(pose[i]);
    values[static_cast<std::size_t>(ring.index("sin(" + coordinates[i].name + ")"))] = std::sin(pose[i]);
  }
  for (const ConstructedPoint& c : geometry.constructed()) {
    values[static_cast<std::size_t>(c.x)] = posture.points[static_cast<std::size_t>(c.point)][0];
    values[static_cast<std::size_t>(c.y)] = posture.points[static_cast<std::size_t>(c.point)][1];
  }
  for (const InverseLength& length : geometry.inverse_lengths()) {
    double square = 0;
    for (const GiNaC::ex& component : geometry.vector(length.along))
      square += std::pow(core::evaluate(geometry.poly(component).plain(), std::span<const double>(values)), 2);
    values[static_cast<std::size_t>(length.variable)] = 1 / std::sqrt(square);
  }
  for (const TorsionAngle& angle : geometry.torsion_angles()) {
    const auto part = [&](std::size_t i) {
      return core::evaluate(geometry.poly(angle.way[i]).plain(), std::span<const double>(values));
    };
    values[static_cast<std::size_t>(angle.variable)] = std::atan2(part(1), part(0));
  }
  return values;
}

/// Coordinates and roots: each root from its square, with the sign of the mode.
std::vector<double> tower_values(const Geometry& geometry, const std::vector<double>& natural,
                                 const std::vector<int>& mode) {
  std::vector<double> values = natural;
  std::size_t side = 0;
  for (const TowerRoot& root : geometry.roots()) {
    if (root.is_angle()) {
      const auto part = [&](std::size_t i) {
        return core::evaluate(root.cosine_and_sine[i].plain(), std::span<const double>(values));
      };
      values[static_cast<std::size_t>(root.variable)] = core::angle_shift + std::atan2(part(1), part(0));
      continue;
    }
    const double square = core::evaluate(root.square.plain(), std::span<const double>(values));
    const int sign = root.role == core::RootRole::working_mode ? mode[side++] : 1;
    values[static_cast<std::size_t>(root.variable)] = sign * std::sqrt(std::max(0.0, square));
  }
  return values;
}

/// What a value that is zero in exact arithmetic may come to: the sum of its terms' sizes, times a few roundings.
double noise(const Poly& p, const std::vector<double>& at) {
  double size = 0;
  for (const core::Term& term : p.plain().terms) {
    double product = std::abs(core::to_double(term.coefficient));
    for (std::size_t i = 0; i < at.size(); ++i) product *= std::pow(std::abs(at[i]), term.exponents[i]);
    size += product;
  }
  return 1e-9 * size;
}

class Witness {
 public:
  explicit Witness(const mechanism::Mechanism& m) : m_(m), model_(numeric::compile(m)) {}

  int hold(const Charts& charts, const std::vector<double>& pose, const std::vector<int>& mode) {
    const numeric::Posture posture = numeric::posture(model_, pose, mode);
    if (!posture.reachable()) return 0;
    const Geometry geometry(m_, false, charts);
    const FactoredDeterminants determinants = factored_determinants(geometry);
    const std::vector<double> natural = natural_values(geometry, pose, posture);
    const double determinant = evaluated(determinants.determinant, natural);
    const numeric::Reactions reactions = numeric::solve_reactions(model_, posture);
    if (reactions.condition > 1e6) return 0;
    const double largest = reactions.values.cwiseAbs().maxCoeff();
    for (std::size_t k = 0; k < determinants.numerators.size(); ++k) {
      const double exact = evaluated(determinants.numerators[k], natural) / determinant;
      const double scale = unit_size(geometry, natural, determinants.equations.unknowns[k]);
      EXPECT_NEAR(exact * scale, reactions.values[static_cast<Eigen::Index>(k)], 1e-7 * (1 + largest))
          << determinants.equations.unknown_names[k];
    }
    hold_tower(geometry, determinants, natural, mode);
    return 1;
  }

  const numeric::NumericModel& model() const { return model_; }

 private:
  /// The length of the axis that is the unit of an exact column along or across it.
  double unit_size(const Geometry& geometry, const std::vector<double>& natural,
                   const mechanism::Unknown& unknown) const {
    if (unknown.quantity != core::Quantity::N && unknown.quantity != core::Quantity::F) return 1;
    double squared = 0;
    for (const GiNaC::ex& component : geometry.vector(m_.joints[static_cast<std::size_t>(unknown.joint)].axes.at(0))) {
      const double value = core::evaluate(geometry.poly(component).plain(), std::span<const double>(natural));
      squared += value * value;
    }
    return std::sqrt(squared);
  }

  void hold_tower(const Geometry& geometry, const FactoredDeterminants& determinants,
                  const std::vector<double>& natural, const std::vector<int>& mode) const {
    const Elimination elimination(geometry);
    const std::vector<double> values = tower_values(geometry, natural, mode);
    const auto compare = [&](const FactoredPoly& product) {
      for (const PolyFactor& factor : product.factors) {
        const double direct = core::evaluate(factor.poly.plain(), std::span<const double>(natural));
        const Poly& sheet = elimination.over_tower(factor.poly);
        const double over = core::evaluate(sheet.plain(), std::span<const double>(values));
        if (std::abs(direct) < noise(factor.poly, natural) || std::abs(over) < noise(sheet, values)) continue;
        EXPECT_EQ(direct > 0, over > 0);
      }
    };
    compare(determinants.determinant);
    for (const FactoredPoly& numerator : determinants.numerators) compare(numerator);
  }

  const mechanism::Mechanism& m_;
  numeric::NumericModel model_;
};

}  // namespace

int hold_against_witness(const mechanism::Mechanism& m) {
  Witness witness(m);
  std::mt19937 random(20110401);
  int compared = 0;
  constexpr int tries = 40;
  for (int i = 0; i < tries; ++i) {
    std::vector<double> pose;
    Charts charts(m.coordinates.size());
    for (std::size_t c = 0; c < m.coordinates.size(); ++c) {
      const double lower = core::to_double(m.coordinates[c].lower), upper = core::to_double(m.coordinates[c].upper);
      pose.push_back(std::uniform_real_distribution<double>(lower, upper)(random));
      if (m.coordinates[c].angle) charts[c] = core::AngleChart{static_cast<int>(std::floor(pose[c] / M_PI + 0.5))};
    }
    std::vector<int> mode;
    for (std::size_t d = 0; d < witness.model().dyads.size(); ++d) mode.push_back(random() % 2 == 0 ? 1 : -1);
    compared += witness.hold(charts, pose, mode);
    if (compared == 12) break;
  }
  return compared;
}

}  // namespace clearloci::symbolic
