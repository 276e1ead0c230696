#include "numeric/weighted_fit.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <limits>

namespace clearloci::numeric {

std::optional<std::vector<double>> weighted_fit(const std::vector<std::vector<double>>& rows,
                                                std::span<const std::array<double, 2>> bounds) {
  const auto places = static_cast<Eigen::Index>(rows.size()), columns = static_cast<Eigen::Index>(rows.front().size());
  Eigen::MatrixXd basis(places, columns);
  Eigen::VectorXd middle(places), half(places), weight = Eigen::VectorXd::Ones(places);
  for (Eigen::Index i = 0; i < places; ++i) {
    const auto k = static_cast<std::size_t>(i);
    for (Eigen::Index t = 0; t < columns; ++t) basis(i, t) = rows[k][static_cast<std::size_t>(t)];
    middle(i) = 0.5 * (bounds[k][0] + bounds[k][1]);
    half(i) = 0.5 * (bounds[k][1] - bounds[k][0]);
    if (!(half(i) > 0)) return std::nullopt;
  }
  constexpr double tiny = 1e-300, least_weight = 1e-12;
  Eigen::VectorXd scale(columns), best = Eigen::VectorXd::Zero(columns);
  for (Eigen::Index t = 0; t < columns; ++t) scale(t) = std::max(basis.col(t).cwiseAbs().maxCoeff(), tiny);
  double least = std::numeric_limits<double>::infinity();
  constexpr int steps = 150;
  for (int step = 0; step < steps; ++step) {
    const Eigen::VectorXd row = weight.cwiseSqrt().cwiseQuotient(half);
    const Eigen::MatrixXd left = row.asDiagonal() * basis * scale.cwiseInverse().asDiagonal();
    const Eigen::VectorXd found = left.colPivHouseholderQr().solve(row.cwiseProduct(middle)).cwiseQuotient(scale);
    const Eigen::VectorXd off = (basis * found - middle).cwiseQuotient(half).cwiseAbs();
    if (off.maxCoeff() < least) {
      least = off.maxCoeff();
      best = found;
    }
    weight = weight.cwiseProduct(off.array().max(least_weight).matrix());
    weight /= weight.maxCoeff();
    weight = weight.cwiseMax(least_weight);
  }
  return std::vector<double>(best.begin(), best.end());
}

}  // namespace clearloci::numeric
