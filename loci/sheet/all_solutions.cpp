#include "loci/sheet/all_solutions.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "core/errors.hpp"
#include "loci/numbers/numbers.hpp"
#include "loci/sheet/pose_forms.hpp"

namespace clearloci::loci::pose {
namespace {

using Box = UnknownsBox;
using Form = FlatAffine;

class Search {
 public:
  Search(const core::PoseProgram& program, const Pose& at, const Box& before)
      : block_(program.blocks.back()), at_(at), program_(program) {
    program_.steps.resize(static_cast<std::size_t>(block_.end));
    for (const auto& [low, high] : before) {
      Form form(0.5 * (low + high));
      form.r = std::nextafter(std::max(high - form.c, form.c - low), HUGE_VAL);
      before_.push_back(form);
      middle_.push_back(form.c);
    }
    forms_.emplace(program_);
    values_.emplace(program_);
  }

  AllSolutions run(const Box& whole, const std::optional<std::size_t>& most) {
    for (const auto& [low, high] : whole) size_ = std::max(size_, high - low);
    AllSolutions result;
    // Boxes of many unknowns say nothing before there are too many of them.
    constexpr std::size_t few = 6;
    prune(whole, whole.size() > few ? 2000 : 200'000, result);
    if (!result.complete) search_from_places(whole, most, result.found);
    if (most && result.found.size() == *most) result.complete = true;
    std::sort(result.found.begin(), result.found.end());
    for (core::BlockUnknowns& unknowns : result.found) {
      result.enclosed.push_back(enclosure(unknowns));
      unknowns.insert(unknowns.begin(), middle_.begin(), middle_.end());
    }
    return result;
  }

 private:
  void prune(const Box& whole, long most_boxes, AllSolutions& result) {
    std::vector<Box> open = {whole};
    result.complete = true;
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
      if (!(box[widest][1] - box[widest][0] > finest * size_)) {
        result.complete = false;
        continue;
      }
      Box other = box;
      box[widest][1] = other[widest][0] = middle;
      open.push_back(std::move(other));
      open.push_back(std::move(box));
    }
  }

  /// Until many places in a row have led to nothing new.
  void search_from_places(const Box& whole, const std::optional<std::size_t>& most,
                          std::vector<core::BlockUnknowns>& found) {
    std::mt19937_64 random(1);
    const std::size_t patience = most ? 400 : 60;  // places for each solution that is known
    constexpr std::size_t most_places = 60'000;
    std::size_t in_vain = 0;
    for (std::size_t i = 0; i < most_places && in_vain < patience * (found.size() + 4); ++i) {
      if (most && found.size() == *most) return;
      core::BlockUnknowns place = i % 2 == 0 || found.empty() ? somewhere(whole, random) : near_one(found, random);
      const std::size_t before = found.size();
      if (converges(place)) prove(place, found);
      in_vain = found.size() > before ? 0 : in_vain + 1;
    }
  }

  static core::BlockUnknowns somewhere(const Box& whole, std::mt19937_64& random) {
    core::BlockUnknowns place;
    for (const auto& [low, high] : whole) place.push_back(std::uniform_real_distribution<double>(low, high)(random));
    return place;
  }

  /// What is near a solution nearly closes: often as near to others.
  core::BlockUnknowns near_one(const std::vector<core::BlockUnknowns>& found, std::mt19937_64& random) const {
    core::BlockUnknowns place = found[random() % found.size()];
    constexpr int finest = 8;
    const double reach = std::ldexp(size_, -1 - static_cast<int>(random() % finest));
    for (double& component : place) component += std::uniform_real_distribution<double>(-reach, reach)(random);
    return place;
  }

  /// Newton's iteration with steps of at most a quarter of the box.
  bool converges(core::BlockUnknowns& unknowns) {
    const std::size_t n = unknowns.size();
    constexpr int most_steps = 60;
    for (int i = 0; i < most_steps; ++i) {
      if (!values_->put(at_, behind_others(unknowns))) return false;
      std::vector<double> jacobian, step;
      for (const int slope_step : block_.jacobian) jacobian.push_back((*values_)[slope_step]);
      for (const int equation : block_.equations) step.push_back((*values_)[equation]);
      if (!core::solve_dense(jacobian, step)) return false;
      double longest = 0;
      for (const double component : step) longest = std::max(longest, std::abs(component));
      const double share = std::min(1.0, 0.25 * size_ / longest);
      for (std::size_t k = 0; k < n; ++k) unknowns[k] -= share * step[k];
      constexpr double near = 1e-9;  // of the box
      if (longest <= near * size_) return true;
    }
    return false;
  }

  /// In the largest of some boxes around a place that holds one solution alone.
  void prove(const core::BlockUnknowns& place, std::vector<core::BlockUnknowns>& found) {
    for (double part = 1e-3; part > 1e-10; part /= 4) {
      Box box;
      for (const double component : place) box.push_back({component - part * size_, component + part * size_});
      std::vector<core::BlockUnknowns> here;
      if (!is_done(box, here) || here.empty()) continue;
      return add(std::move(here.front()), found);
    }
  }

  static std::size_t widest_of(const Box& box) {
    std::size_t widest = 0;
    for (std::size_t k = 1; k < box.size(); ++k)
      if (box[k][1] - box[k][0] > box[widest][1] - box[widest][0]) widest = k;
    return widest;
  }

  core::BlockUnknowns behind_others(const core::BlockUnknowns& unknowns) const {
    core::BlockUnknowns all = middle_;
    all.insert(all.end(), unknowns.begin(), unknowns.end());
    return all;
  }

  typename PoseForms<Form>::Outcome put(const std::vector<Form>& forms) {
    std::vector<Form> all = before_;
    all.insert(all.end(), forms.begin(), forms.end());
    return forms_->put(at_, all);
  }

  /// Where a solution that is known is, as narrow as it is proven.
  Box enclosure(const core::BlockUnknowns& solution) {
    for (double part = 1e-13; part < 1e-4; part *= 10) {
      Box box;
      for (const double component : solution) box.push_back({component - part * size_, component + part * size_});
      std::vector<core::BlockUnknowns> here;
      if (is_done(box, here) && !here.empty()) return box;
    }
    return {};
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
    if (put(unknowns) != PoseForms<Form>::Outcome::complete) return false;
    for (const int equation : block_.equations)
      if (!(*forms_)[equation].contains_zero()) return true;
    std::vector<Form> jacobian;
    std::vector<double> middle, inverse(n * n);
    for (const int slope_step : block_.jacobian) {
      jacobian.push_back((*forms_)[slope_step]);
      middle.push_back(jacobian.back().c);
    }
    if (!loci::invert(middle, inverse, n)) return false;
    for (std::size_t k = 0; k < n; ++k) unknowns[k] = Form(centre[k]);
    if (put(unknowns) != PoseForms<Form>::Outcome::complete) return false;
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
    core::BlockUnknowns all = behind_others(solution);
    if (!values_->close(at_, all)) return;
    solution.assign(all.begin() + static_cast<std::ptrdiff_t>(middle_.size()), all.end());
    constexpr double same = 1e-9;
    for (const core::BlockUnknowns& unknowns : found) {
      double apart = 0, size = 0;
      for (std::size_t k = 0; k < unknowns.size(); ++k) {
        apart = std::max(apart, std::abs(unknowns[k] - solution[k]));
        size = std::max(size, std::abs(unknowns[k]));
      }
      if (apart <= same * size) return;
    }
    found.push_back(std::move(solution));
  }

  core::PoseProgram::Block block_;
  Pose at_;
  core::PoseProgram program_;
  std::vector<Form> before_;    ///< the unknowns of the blocks before
  core::BlockUnknowns middle_;  ///< of them
  double size_ = 0;             ///< of the box
  std::optional<PoseForms<Form>> forms_;
  std::optional<core::PoseValues> values_;
};

}  // namespace

AllSolutions all_solutions(const core::PoseProgram& program, const Pose& at, const UnknownsBox& before,
                           const UnknownsBox& box, std::optional<std::size_t> most) {
  std::size_t unknowns = 0;
  for (const core::PoseProgram::Block& block : program.blocks) unknowns += block.unknowns.size();
  core::ensure(!program.blocks.empty() && box.size() == program.blocks.back().unknowns.size() &&
                   before.size() + box.size() == unknowns,
               "a range for every unknown");
  return Search(program, at, before).run(box, most);
}

}  // namespace clearloci::loci::pose
