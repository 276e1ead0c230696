// The demands of a cell whose efforts are chosen: its columns, enclosed once, and what a choice makes of them.
// Private to loci/tasks/.
#pragma once

#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "loci/tasks/effort_proof.hpp"

namespace clearloci::loci::pose {

template <class Form>
class EffortCellOf {
 public:
  using Cell = PoseCellOf<Form>;
  /// How far each parameter of the box moves what is in doubt.
  using Spreads = std::array<double, Form::noises>;

  /// Whether |A| does not vanish in a box that can be assembled; else what is in doubt.
  bool enter(const EffortStatics& statics, const PoseChart& chart, const PoseBox& box) {
    statics_ = &statics;
    Cell& cell = cells_.try_emplace(&statics, statics.statics).first->second;
    const CellAnswers::State state = cell.enter(chart, box);
    outside_ = state == CellAnswers::State::outside;
    if (state != CellAnswers::State::proven) {
      spreads_ = cell.spreads();
      return false;
    }
    forms_.clear();
    for (const core::PoseDemand& demand : statics.demands) {
      std::vector<std::vector<Form>>& parts = forms_.emplace_back();
      for (const core::LinearRow& row : demand.components) {
        std::vector<Form>& columns = parts.emplace_back();
        for (std::size_t c = 0; c < statics.statics.loads; ++c) columns.push_back(cell.sum_of(row, c));
      }
    }
    return true;
  }

  /// Whether no pose of the box can be assembled.
  bool is_outside() const { return outside_; }

  /// At the middle of the box.
  EffortColumns columns() const {
    EffortColumns all;
    for (const auto& parts : forms_) {
      auto& load_columns = all.emplace_back();
      for (const std::vector<Form>& columns : parts) {
        std::vector<double>& values = load_columns.emplace_back();
        for (const Form& column : columns) values.push_back(column.c);
      }
    }
    return all;
  }

  bool keeps(const EffortChoice& choice) {
    for (std::size_t d = 0; d < forms_.size(); ++d)
      if (!keeps(d, choice, choice.ways[d])) return false;
    return true;
  }

  /// Whether a demand is above its least along a way under all loads, with what was chosen here or in another cell.
  bool keeps(std::size_t demand, const EffortChoice& choice, const std::vector<double>& way) {
    const std::vector<Form> along = along_way(demand, way);
    double beside = 0;
    Spreads moves{};
    for (const core::LoadBall& ball : statics_->balls) {
      double square = 0;
      for (std::size_t c = ball.first; c < ball.first + ball.count; ++c) {
        const Form efforts = with_efforts(along, statics_->bases + statics_->efforts + c,
                                          choice.gains.empty() ? std::vector<double>() : choice.gains[c]);
        square += efforts.magnitude() * efforts.magnitude();
        for (std::size_t p = 0; p < Form::noises; ++p) moves[p] += ball.radius * std::abs(efforts.a[p]);
      }
      beside += ball.radius * std::sqrt(square) * (1 + 0x1p-46);
    }
    for (std::size_t base = 0; base < statics_->bases; ++base) {
      const Form efforts = with_efforts(along, base, choice.efforts[base]);
      // A way is a unit vector to some roundings.
      const double low = efforts.lower() - beside, rounding = (std::abs(efforts.c) + beside) * 0x1p-46;
      if (low - rounding > statics_->leasts[demand]) continue;
      for (std::size_t p = 0; p < Form::noises; ++p) spreads_[p] = std::abs(efforts.a[p]) + moves[p];
      return false;
    }
    return true;
  }

  /// The same at the middle of the box, in doubles, without what loads may differ by.
  bool seems_to_keep(const EffortChoice& choice) const {
    for (std::size_t d = 0; d < forms_.size(); ++d)
      for (std::size_t base = 0; base < statics_->bases; ++base) {
        double value = 0;
        for (std::size_t k = 0; k < choice.ways[d].size(); ++k) {
          double part = forms_[d][k][base].c;
          for (std::size_t j = 0; j < statics_->efforts; ++j)
            part += choice.efforts[base][j] * forms_[d][k][statics_->bases + j].c;
          value += choice.ways[d][k] * part;
        }
        if (!(value > statics_->leasts[d])) return false;
      }
    return true;
  }

  /// Of what was in doubt last.
  const Spreads& spreads() const { return spreads_; }

 private:
  std::vector<Form> along_way(std::size_t demand, const std::vector<double>& way) const {
    std::vector<Form> along;
    for (std::size_t c = 0; c < statics_->statics.loads; ++c) {
      SumOf<Form> sum;
      for (std::size_t k = 0; k < way.size(); ++k) sum.add(way[k], forms_[demand][k][c]);
      along.push_back(sum.result());
    }
    return along;
  }

  Form with_efforts(const std::vector<Form>& along, std::size_t column, const std::vector<double>& efforts) const {
    SumOf<Form> sum;
    sum.add(1, along[column]);
    for (std::size_t j = 0; j < efforts.size(); ++j) sum.add(efforts[j], along[statics_->bases + j]);
    return sum.result();
  }

  std::map<const EffortStatics*, Cell> cells_;
  const EffortStatics* statics_ = nullptr;
  std::vector<std::vector<std::vector<Form>>> forms_;  ///< demand, component, column
  Spreads spreads_{};
  bool outside_ = false;
};

}  // namespace clearloci::loci::pose
