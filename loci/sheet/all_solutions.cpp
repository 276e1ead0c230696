#include "loci/sheet/all_solutions.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/errors.hpp"
#include "loci/numbers/numbers.hpp"
#include "loci/sheet/pose_forms.hpp"

namespace clearloci::loci::pose {
namespace {

using Box = std::vector<std::array<double, 2>>;
using Form = FlatAffine;

class Search {
 public:
  Search(const core::PoseProgram& program, const Pose& at)
      : block_(program.blocks.front()), at_(at), program_(program) {
    program_.steps.resize(static_cast<std::size_t>(block_.end));
    program_.blocks.resize(1);
    forms_.emplace(program_);
    values_.emplace(program_);
  }

  AllSolutions run(const Box& whole, long most_boxes) {
    std::vector<Box> open = {whole};
    AllSolutions result;
    result.complete = true;
    double size = 0;
    for (const auto& [low, high] : whole) size = std::max(size, high - low);
    for (long count = 0; !open.empty(); ++count) {
      Box box = std::move(open.back());
      open.pop_back();
      if (count == most_boxes) {
        result.complete = false;
        break;
      }
      if (is_done(box, result.found)) continue;
      const std::size_t widest = widest_of(box);
      const double middle = 0.5 * (box[widest][0] + box[widest][1]);
      constexpr double finest = 1e-9;  // of the box: there solutions meet, or lie at its side
      if (!(box[widest][1] - box[widest][0] > finest * size)) {
        result.complete = false;
        continue;
      }
      Box other = box;
      box[widest][1] = other[widest][0] = middle;
      open.push_back(std::move(other));
      open.push_back(std::move(box));
    }
    std::sort(result.found.begin(), result.found.end());
    return result;
  }

 private:
  static std::size_t widest_of(const Box& box) {
    std::size_t widest = 0;
    for (std::size_t k = 1; k < box.size(); ++k)
      if (box[k][1] - box[k][0] > box[widest][1] - box[widest][0]) widest = k;
    return widest;
  }

  /// Whether a box holds nothing more than is known. It is made smaller where no solution is near a side.
  bool is_done(Box& box, std::vector<core::BlockUnknowns>& found) {
    const std::size_t n = box.size();
    std::vector<Form> unknowns(n);
    std::vector<double> centre(n), radius(n);
    // A little more than the box, so that solutions on its sides are inside.
    constexpr double margin = 1.0625;
    for (std::size_t k = 0; k < n; ++k) {
      centre[k] = 0.5 * (box[k][0] + box[k][1]);
      radius[k] = margin * std::max(box[k][1] - centre[k], centre[k] - box[k][0]) + 1e-300;
      unknowns[k] = Form(centre[k]);
      unknowns[k].r = radius[k];
    }
    if (forms_->put(at_, unknowns) != PoseForms<Form>::Outcome::complete) return false;
    for (const int equation : block_.equations)
      if (!(*forms_)[equation].contains_zero()) return true;
    std::vector<Form> jacobian;
    std::vector<double> middle, inverse(n * n);
    for (const int own : block_.jacobian) {
      jacobian.push_back((*forms_)[own]);
      middle.push_back(jacobian.back().c);
    }
    if (!loci::invert(middle, inverse, n)) return false;
    for (std::size_t k = 0; k < n; ++k) unknowns[k] = Form(centre[k]);
    if (forms_->put(at_, unknowns) != PoseForms<Form>::Outcome::complete) return false;
    bool inside = true;
    for (std::size_t i = 0; i < n; ++i) {
      SumOf<Form> moved;
      for (std::size_t j = 0; j < n; ++j) moved.add(-inverse[i * n + j], (*forms_)[block_.equations[j]]);
      const Form step = moved.result();
      double beside = 0;
      for (std::size_t k = 0; k < n; ++k) {
        SumOf<Form> entry;
        if (i == k) entry.add(1, Form(1.0));
        for (std::size_t j = 0; j < n; ++j) entry.add(-inverse[i * n + j], jacobian[j * n + k]);
        beside += entry.result().magnitude() * radius[k];
      }
      beside *= 1 + static_cast<double>(n + 8) * 0x1p-51;
      const double low = centre[i] + step.lower() - beside, high = centre[i] + step.upper() + beside;
      const double rounding = Form::slack(std::abs(centre[i]) + std::abs(low) + std::abs(high));
      inside = inside && low - rounding > centre[i] - radius[i] && high + rounding < centre[i] + radius[i];
      box[i] = {std::max(box[i][0], low - rounding), std::min(box[i][1], high + rounding)};
      if (box[i][0] > box[i][1]) return true;
    }
    if (!inside) return false;
    add(centre, found);
    return true;
  }

  void add(core::BlockUnknowns solution, std::vector<core::BlockUnknowns>& found) {
    if (!values_->close(at_, solution)) return;
    constexpr double same = 1e-9;
    for (const core::BlockUnknowns& own : found) {
      double apart = 0, size = 0;
      for (std::size_t k = 0; k < own.size(); ++k) {
        apart = std::max(apart, std::abs(own[k] - solution[k]));
        size = std::max(size, std::abs(own[k]));
      }
      if (apart <= same * size) return;
    }
    found.push_back(std::move(solution));
  }

  core::PoseProgram::Block block_;
  Pose at_;
  core::PoseProgram program_;
  std::optional<PoseForms<Form>> forms_;
  std::optional<core::PoseValues> values_;
};

}  // namespace

AllSolutions all_solutions(const core::PoseProgram& program, const Pose& at, const Box& box, long most_boxes) {
  core::ensure(program.blocks.size() == 1 && box.size() == program.blocks.front().unknowns.size(),
               "one block, with a range for every unknown");
  return Search(program, at).run(box, most_boxes);
}

}  // namespace clearloci::loci::pose
