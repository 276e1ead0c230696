#include "loci/curves/pose_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace clearloci::loci::pose {
namespace {

Pose pose_between(const Pose& a, const Pose& b, double part) {
  Pose at(a.size());
  for (std::size_t c = 0; c < a.size(); ++c) at[c] = a[c] + part * (b[c] - a[c]);
  return at;
}

}  // namespace

double FieldSample::product(const FieldQuantity& quantity, const FieldSample& a, const FieldSample& b) {
  double sum = 0;
  for (std::size_t k = quantity.first; k < quantity.first + quantity.count; ++k) sum += a.values[k] * b.values[k];
  return sum;
}

double FieldSample::size(const FieldQuantity& quantity) const { return std::sqrt(product(quantity, *this, *this)); }

PoseField::PoseField(const core::PoseStatics& statics, double scale)
    : statics_(statics), scale_(scale), point_(statics) {
  quantities_.push_back({Doubt::singularity, -1, 0, 1});
  std::size_t first = 1;
  for (std::size_t d = 0; d < statics.demands.size(); ++d) {
    leasts_.push_back(core::to_double(statics.demands[d].demand.least));
    const std::size_t count = leasts_.back() > 0 ? 1 : statics.demands[d].components.size();
    quantities_.push_back({Doubt::demand, static_cast<int>(d), first, count});
    first += count;
  }
}

std::optional<FieldSample> PoseField::solved(const Pose& pose, core::BlockUnknowns unknowns) {
  const auto at = point_.at(pose, unknowns);
  if (!at) return std::nullopt;
  logarithm_ = at->logarithm;
  const double determinant = at->determinant * std::exp(at->logarithm - scale_);
  FieldSample sample;
  sample.unknowns = std::move(unknowns);
  sample.orientation = at->orientation;
  sample.least_closure = std::numeric_limits<double>::infinity();
  for (const double closure : at->closures) sample.least_closure = std::min(sample.least_closure, closure);
  sample.values.push_back(determinant);
  for (std::size_t d = 0; d < leasts_.size(); ++d) {
    const std::vector<double>& components = at->components[d].front();
    if (leasts_[d] > 0) {
      double square = -leasts_[d] * leasts_[d];
      for (const double component : components) square += component * component;
      sample.values.push_back(square * determinant * determinant);
      continue;
    }
    for (const double component : components) sample.values.push_back(component * determinant);
  }
  return sample;
}

std::optional<FieldSample> PoseField::at(const Pose& pose) {
  if (statics_.program.blocks.empty()) return solved(pose, {});
  std::optional<core::BlockUnknowns> start = statics_.sheet.start ? statics_.sheet.start(pose) : std::nullopt;
  return start ? solved(pose, std::move(*start)) : std::nullopt;
}

std::optional<FieldSample> PoseField::at(const Pose& pose, const FieldSample& nearby) {
  std::optional<FieldSample> found = solved(pose, nearby.unknowns);
  if (found && found->orientation == nearby.orientation) return found;
  return statics_.program.blocks.empty() ? std::nullopt : at(pose);
}

std::optional<Pose> zero_between(PoseField& field, const FieldQuantity& quantity, const Pose& a,
                                 const FieldSample& at_a, const Pose& b, const FieldSample& at_b) {
  // The part along a's direction, by false position with halved ends (Illinois).
  const double square = FieldSample::product(quantity, at_a, at_a);
  double low = 0, high = 1, at_low = 1, at_high = FieldSample::product(quantity, at_a, at_b) / square;
  if (!(at_high < 0)) return std::nullopt;
  constexpr int most = 80;
  constexpr double finest = 1e-15, vanishing = 1e-6;
  FieldSample nearby = at_a;
  double part = 0, before = -1, left = 1;
  int side = 0;
  for (int i = 0; i < most && std::abs(part - before) > finest; ++i) {
    before = part;
    part = (low * at_high - high * at_low) / (at_high - at_low);
    std::optional<FieldSample> now = field.at(pose_between(a, b, part), nearby);
    if (!now) return std::nullopt;
    const double value = FieldSample::product(quantity, at_a, *now) / square;
    nearby = std::move(*now);
    left = nearby.size(quantity);
    if (value == 0) break;
    if (value > 0) {
      low = part, at_low = value;
      if (side > 0) at_high /= 2;
      side = 1;
    } else {
      high = part, at_high = value;
      if (side < 0) at_low /= 2;
      side = -1;
    }
  }
  if (left > vanishing * std::min(at_a.size(quantity), at_b.size(quantity))) return std::nullopt;
  return pose_between(a, b, part);
}

FieldEnd end_between(PoseField& field, const Pose& inside, const FieldSample& at_inside, const Pose& outside) {
  FieldEnd end{inside, at_inside, false};
  // Beside a dead centre Newton's iteration converges over a part of what is left only.
  constexpr double finest = 1e-14, longer = 1.5;
  for (double part = 0, step = 0.5; step > finest && part + step < 1;) {
    const Pose pose = pose_between(inside, outside, part + step);
    if (std::optional<FieldSample> now = field.at(pose, end.sample)) {
      part += step;
      end.at = pose;
      end.sample = std::move(*now);
      step = std::min(longer * step, 0.5 * (1 - part));
    } else {
      step /= 2;
    }
  }
  constexpr double vanishing = 1e-6;
  end.closure =
      std::isfinite(at_inside.least_closure) && end.sample.least_closure <= vanishing * at_inside.least_closure;
  return end;
}

}  // namespace clearloci::loci::pose
