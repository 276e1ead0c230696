#include "numeric/model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/errors.hpp"
#include "numeric/evaluator.hpp"
#include "numeric/group_solution.hpp"

namespace clearloci::numeric {

Posture posture(const NumericModel& model, std::span<const double> pose, std::span<const int> mode) {
  core::ensure(pose.size() == model.box.size(), "a pose has one value for each free coordinate");
  core::ensure(mode.size() == model.dyads.size(), "a working mode has one sign for each dyad");
  std::vector<double> inputs(pose.begin(), pose.end());
  inputs.insert(inputs.end(), mode.begin(), mode.end());
  inputs.resize(static_cast<std::size_t>(model.inputs()));
  place_groups(model, mode, inputs);
  std::vector<double> registers(static_cast<std::size_t>(model.posture_size));
  run<double, 1>(model.tape, 0, model.posture_size, inputs.data(), registers.data());

  const auto at = [&](Register r) { return registers[static_cast<std::size_t>(r)]; };
  const auto vector = [&](const Triple& v) { return Vector3d(at(v[0]), at(v[1]), at(v[2])); };
  Posture result;
  if (model.gravity) result.gravity = vector(*model.gravity);
  for (std::size_t i = 0; i < model.points.size(); ++i) {
    result.points.push_back(vector(model.points[i]));
    if (!result.points.back().allFinite() && !result.unreachable) result.unreachable = static_cast<int>(i);
  }
  for (std::size_t i = 0; i < model.slack.size() && !result.unreachable; ++i)
    for (const bool upper : {false, true})
      if (const auto& end = model.slack[i][upper ? 1 : 0]; end && !(at(*end) >= 0) && !result.broken)
        result.broken = LimitEnd{i, upper, at(*end)};
  for (std::size_t j = 0; j < model.axes.size(); ++j) {
    const auto &axis = model.axes[j], &couple = model.couple_axes[j];
    result.axes.push_back(axis ? vector(*axis) : Vector3d::Zero());
    result.couple_axes.push_back(couple ? vector(*couple) : Vector3d::Zero());
    // A universal joint with its axes in line bears no couple across both.
    if (!result.couple_axes.back().allFinite()) result.couple_axes.back().setZero();
    if (!result.axes.back().allFinite() && !result.undirected)
      result.undirected = static_cast<mechanism::JointIndex>(j);
  }
  for (const auto& load : model.loads) {
    const auto& link = model.mechanism.links[static_cast<std::size_t>(load.link)];
    const int place = load.at ? *load.at : link.centre_of_mass;  // a couple acts nowhere: any point of its link will do
    result.loads.push_back({load.link, result.points[static_cast<std::size_t>(place)], vector(load.force),
                            vector(load.couple), load.weight, load.inner, load.spring});
  }
  return result;
}

int column_of(const NumericModel& model, mechanism::JointIndex joint, core::Quantity quantity) {
  using core::Quantity;
  if (model.mechanism.space == mechanism::Space::spatial) {
    const auto& across = model.across[static_cast<std::size_t>(joint)];
    const auto component = [](Quantity x, int direction) {
      return static_cast<Quantity>(static_cast<int>(x) + direction);
    };
    if (quantity == Quantity::f1 || quantity == Quantity::f2)
      quantity = component(Quantity::fx, across[quantity == Quantity::f1 ? 0 : 1]);
    if (quantity == Quantity::m1 || quantity == Quantity::m2)
      quantity = component(Quantity::mx, across[quantity == Quantity::m1 ? 0 : 1]);
  }
  for (std::size_t k = 0; k < model.unknowns.size(); ++k)
    if (model.unknowns[k].joint == joint && model.unknowns[k].quantity == quantity) return static_cast<int>(k);
  return -1;
}

std::optional<LimitEnd> tightest_limit(const NumericModel& model, std::span<const double> pose,
                                       std::span<const int> mode) {
  Evaluator<double, 1> evaluator(model, mode, model.posture_size);
  for (std::size_t c = 0; c < pose.size(); ++c) evaluator.input(c, 0) = pose[c];
  evaluator.run_tape();
  std::optional<LimitEnd> tightest;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < model.slack.size(); ++i)
    for (const bool upper : {false, true}) {
      const auto& end = model.slack[i][upper ? 1 : 0];
      if (!end || !(evaluator.value(*end, 0) < least)) continue;
      least = evaluator.value(*end, 0);
      tightest = LimitEnd{i, upper, least};
    }
  return tightest;
}

double typical_length(const NumericModel& model, const Posture& p) {
  std::vector<double> lengths;
  for (const auto& link : model.mechanism.links) {
    if (link.points.size() < 2) continue;
    const auto& a = p.points[static_cast<std::size_t>(link.points[0])];
    const auto& b = p.points[static_cast<std::size_t>(link.points[1])];
    const double length = (b - a).norm();
    if (std::isfinite(length) && length > 0) lengths.push_back(length);
  }
  if (lengths.empty()) return 1;
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle;
}

std::vector<int> dyad_signs(const NumericModel& model, const core::TowerNames& tower, const core::WorkingMode& mode) {
  if (tower.roots.empty()) {
    core::ensure(mode.size() == model.dyads.size(), "a working mode has one sign for each dyad");
    return mode;
  }
  core::ensure(mode.size() == tower.roots.size(), "a working mode has one sign for each root of its tower");
  std::vector<int> signs;
  for (const int dyad : model.dyads) {
    const auto& name = model.mechanism.points[static_cast<std::size_t>(dyad)].name;
    const auto root = std::find_if(tower.roots.begin(), tower.roots.end(), [&](const core::RootNames& r) {
      return r.point == name && r.role == core::RootRole::working_mode;
    });
    if (root == tower.roots.end()) {
      throw core::InputError({model.mechanism.file, 0, 0}, "the loci know no working mode of point " + name,
                             "trace the loci of the same mechanism");
    }
    signs.push_back(mode[static_cast<std::size_t>(root - tower.roots.begin())]);
  }
  return signs;
}

}  // namespace clearloci::numeric
