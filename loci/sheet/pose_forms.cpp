#include "loci/sheet/pose_forms.hpp"

#include <algorithm>
#include <cmath>

#include "core/pose_values.hpp"
#include "loci/numbers/numbers.hpp"

namespace clearloci::loci::pose {
namespace {

using Operation = core::PoseProgram::Operation;

/// pi to half a unit in the last place.
template <class Form>
Form enclosed_pi() {
  Form form(3.14159265358979312);
  form.r = 0x1p-52;
  return form;
}

template <class Form>
bool is_finite(const Form& x) {
  return std::isfinite(x.c) && std::isfinite(x.radius());
}

/// Of the numbers of x that are not negative.
template <class Form>
Form any_root_up_to(const Form& x) {
  const double half = 0.5 * std::sqrt(std::max(0.0, x.upper())) * (1 + 0x1p-50);
  Form form(half);
  form.r = half * (1 + 0x1p-50) + Form::slack(half);
  return form;
}

}  // namespace

template <class Form>
PoseForms<Form>::PoseForms(const core::PoseProgram& program)
    : program_(&program), registers_(program.steps.size()), varies_(program.steps.size()) {
  for (std::size_t i = 0; i < registers_.size(); ++i) {
    const core::PoseProgram::Step& step = program.steps[i];
    if (step.operation == Operation::constant) registers_[i] = nearest<Form>(step.value);
    if (step.operation == Operation::pi) registers_[i] = enclosed_pi<Form>();
    varies_[i] = step.varies ? 1 : 0;
  }
}

template <class Form>
typename PoseForms<Form>::Outcome PoseForms<Form>::run(const PoseChart& chart, const PoseBox& box,
                                                       std::span<const double> starts, std::vector<Form>* boundaries) {
  int done = 0;
  std::size_t first = 0;
  unique_.clear();
  for (const core::PoseProgram::Block& block : program_->blocks) {
    // Of a root that may be zero no block closes with a proof.
    if (const Outcome outcome = run_steps(done, block.begin, chart, box, nullptr); outcome != Outcome::complete)
      return outcome;
    if (const Outcome outcome = close(block, chart, box, starts.subspan(first, block.unknowns.size()));
        outcome != Outcome::complete)
      return outcome;
    done = block.begin;
    first += block.unknowns.size();
  }
  return run_steps(done, static_cast<int>(registers_.size()), chart, box, boundaries);
}

template <class Form>
typename PoseForms<Form>::Outcome PoseForms<Form>::put(const Pose& at, std::span<const Form> unknowns) {
  auto unknown = unknowns.begin();
  for (const core::PoseProgram::Block& block : program_->blocks)
    for (const int step : block.unknowns) (*this)[step] = *unknown++;
  return run_steps(0, program_->blocks.back().end, {at, {}}, {}, nullptr);
}

template <class Form>
typename PoseForms<Form>::Outcome PoseForms<Form>::run_steps(int from, int to, const PoseChart& chart,
                                                             const PoseBox& box, std::vector<Form>* boundaries) {
  const auto in_doubt = [&](const Form& form) {
    doubt_ = form;
    return Outcome::in_doubt;
  };
  for (auto i = static_cast<std::size_t>(from); i < static_cast<std::size_t>(to); ++i) {
    const core::PoseProgram::Step& step = program_->steps[i];
    const Form& x = registers_[static_cast<std::size_t>(step.first)];
    const Form& y = registers_[static_cast<std::size_t>(step.second)];
    switch (step.operation) {
      case Operation::constant:
      case Operation::pi:
      case Operation::unknown:
        break;
      case Operation::coordinate: {
        if (coordinate_ != nullptr) {
          registers_[i] = *coordinate_;
          break;
        }
        const auto q = static_cast<std::size_t>(step.first);
        SumOf<Form> sum;
        sum.add(1, Form(chart.base[q]));
        for (std::size_t p = 0; p < box.size(); ++p) {
          if (chart.ways[p][q] == 0) continue;
          const auto& [low, high] = box[p];
          Form parameter(low + 0.5 * (high - low));
          parameter.a[p] = std::max(high - parameter.c, parameter.c - low);
          if (parameter.a[p] > 0) parameter.r = Form::slack(std::abs(high) + std::abs(low));
          sum.add(chart.ways[p][q], parameter);
        }
        registers_[i] = sum.result();
        break;
      }
      case Operation::add:
        registers_[i] = x + y;
        break;
      case Operation::subtract:
        registers_[i] = x - y;
        break;
      case Operation::multiply:
        registers_[i] = x * y;
        break;
      case Operation::square:
        registers_[i] = squared(x);
        break;
      case Operation::inverse:
        if (x.contains_zero()) return in_doubt(x);
        registers_[i] = inverse(x);
        break;
      case Operation::square_root:
        if (x.upper() < 0) return Outcome::outside;
        if (x.lower() > 0) {
          registers_[i] = square_root(x);
          break;
        }
        if (boundaries == nullptr || !is_finite(x)) return in_doubt(x);
        boundaries->push_back(x);
        registers_[i] = any_root_up_to(x);
        break;
      case Operation::cosine:
        registers_[i] = cosine(x);
        break;
      case Operation::sine:
        registers_[i] = sine(x);
        break;
      case Operation::angle: {
        constexpr double half_turn = 3.14159265358979312;  // just below: there the angle is cut
        const std::optional<Form> angle = angle_of(x, y);
        if (!angle || !(angle->lower() > -half_turn && angle->upper() < half_turn)) return in_doubt(angle ? *angle : y);
        registers_[i] = *angle;
        break;
      }
    }
  }
  return Outcome::complete;
}

/// With the unknowns enclosed by u_0 + D in the registers: whether the operator stays inside D. `rest`: what of it is
/// beside -Y g.
template <class Form>
bool PoseForms<Form>::contracts(const std::vector<int>& jacobian, const std::vector<double>& inverse,
                                const std::vector<Form>& moved, const std::vector<double>& radius,
                                std::vector<double>& rest) {
  const std::size_t n = radius.size();
  std::array<double, Form::noises> spreads{};
  std::vector<double> error(n * n);
  const double roundings = 1 + static_cast<double>(n + 8) * 0x1p-51;
  bool inside = true;
  for (std::size_t i = 0; i < n; ++i) {
    double beside = 0;
    for (std::size_t k = 0; k < n; ++k) {
      SumOf<Form> sum;
      if (i == k) sum.add(1, Form(1.0));
      for (std::size_t j = 0; j < n; ++j)
        if (const Form& entry = (*this)[jacobian[j * n + k]]; entry.c != 0 || entry.radius() > 0)
          sum.add(-inverse[i * n + j], entry);
      const Form e = sum.result();
      error[i * n + k] = e.magnitude();
      beside += error[i * n + k] * radius[k];
      for (std::size_t p = 0; p < Form::noises; ++p) spreads[p] += std::abs(e.a[p]);
    }
    rest[i] = beside * roundings;
    inside = inside && (moved[i].magnitude() + rest[i]) * (1 + 0x1p-50) < radius[i];
  }
  // The solution is in what D was mapped to: once more from there.
  std::vector<double> mapped(n);
  for (std::size_t k = 0; k < n; ++k) mapped[k] = (moved[k].magnitude() + rest[k]) * (1 + 0x1p-50);
  for (std::size_t i = 0; inside && i < n; ++i) {
    double beside = 0;
    for (std::size_t k = 0; k < n; ++k) beside += error[i * n + k] * mapped[k];
    rest[i] = beside * roundings;
  }
  doubt_ = Form();
  doubt_.a = spreads;
  return inside;
}

/// `put(middle, radius)` evaluates the equations with unknowns in middle + [-radius, radius]. `middle`: at first the
/// solution at the cell's middle.
template <class Form>
template <class Put>
typename PoseForms<Form>::Outcome PoseForms<Form>::krawczyk(const std::vector<int>& jacobian,
                                                            const std::vector<int>& equations, const Put& put,
                                                            std::vector<Form>& middle, std::vector<Form>& result,
                                                            std::vector<Unique>& unique) {
  constexpr int iterations = 3;      // orders of the cell that u_0 holds
  constexpr double finest = 2.5e-9;  // of the unknowns' size: above what rounding leaves of a solution near its end
  constexpr std::array<double, 2> widths = {2, 8};
  const std::size_t n = middle.size();
  std::vector<Form> moved(n);
  std::vector<double> inverse(n * n), radius(n, 0.0), rest(n);
  std::vector<double> centres;
  for (const Form& form : middle) centres.push_back(form.c);
  const double size = core::size_of(*program_, centres);
  for (int step = 0; step <= iterations; ++step) {
    if (put(middle, radius) != Outcome::complete) return Outcome::in_doubt;
    if (step == 0) {
      std::vector<double> at_middle;
      for (const int slope_step : jacobian) at_middle.push_back((*this)[slope_step].c);
      if (!loci::invert(at_middle, inverse, n)) {
        doubt_ = Form();
        doubt_.a.fill(1);
        return Outcome::in_doubt;
      }
    }
    for (std::size_t i = 0; i < n; ++i) {
      SumOf<Form> sum;
      for (std::size_t j = 0; j < n; ++j) sum.add(inverse[i * n + j], (*this)[equations[j]]);
      moved[i] = sum.result();
    }
    // Where Newton's iteration does not settle no box is mapped into itself.
    if (step > 0)
      for (const Form& form : moved)
        if (!(form.magnitude() < 0.25 * size)) return Outcome::in_doubt;
    if (step == iterations) break;
    for (std::size_t i = 0; i < n; ++i) {
      middle[i] = middle[i] - moved[i];
      middle[i].r = 0;
    }
  }
  for (const double width : widths) {
    for (std::size_t i = 0; i < n; ++i)
      radius[i] = std::max(width * moved[i].magnitude(), std::max(width, 4.0) * finest * size);
    if (put(middle, radius) != Outcome::complete || !contracts(jacobian, inverse, moved, radius, rest)) continue;
    result.clear();
    for (std::size_t i = 0; i < n; ++i) {
      unique.push_back({middle[i], radius[i]});
      Form form = middle[i] - moved[i];
      form.r = form.r * (1 + 0x1p-50) + rest[i] * (1 + 0x1p-50);
      result.push_back(form);
    }
    return Outcome::complete;
  }
  return Outcome::in_doubt;
}

namespace {

template <class Form>
Form widened(Form form, double radius) {
  if (radius > 0) form.r += radius + Form::slack(std::abs(form.c));
  return form;
}

}  // namespace

template <class Form>
typename PoseForms<Form>::Outcome PoseForms<Form>::close(const core::PoseProgram::Block& block, const PoseChart& chart,
                                                         const PoseBox& box, std::span<const double> start) {
  std::vector<Form> middle, result;
  for (const double component : start) middle.emplace_back(component);
  const auto put = [&](const std::vector<Form>& unknowns, const std::vector<double>& radius) {
    for (std::size_t k = 0; k < unknowns.size(); ++k) (*this)[block.unknowns[k]] = widened(unknowns[k], radius[k]);
    return run_steps(block.begin, block.end, chart, box, nullptr);
  };
  const Outcome outcome = krawczyk(block.jacobian, block.equations, put, middle, result, unique_);
  for (std::size_t k = 0; k < result.size(); ++k) (*this)[block.unknowns[k]] = result[k];
  return outcome;
}

template <class Form>
bool PoseForms<Form>::turn(double q, std::span<const double> start, std::size_t k, double half) {
  const core::PoseProgram::Block& block = program_->blocks.front();
  const std::size_t n = start.size();
  std::vector<Form> middle, result;
  for (const double component : start) middle.emplace_back(component);
  middle[k] = Form(q);
  Form parameter(start[k]);
  parameter.a[0] = half;
  if (half > 0) parameter.r = Form::slack(std::abs(start[k]) + half);
  std::vector<int> jacobian = block.jacobian;
  for (std::size_t i = 0; i < n; ++i) jacobian[i * n + k] = block.rates[i];
  Form coordinate;
  const auto put = [&](const std::vector<Form>& unknowns, const std::vector<double>& radius) {
    for (std::size_t j = 0; j < n; ++j)
      if (j != k) (*this)[block.unknowns[j]] = widened(unknowns[j], radius[j]);
    (*this)[block.unknowns[k]] = parameter;
    coordinate = widened(unknowns[k], radius[k]);
    return run_steps(0, block.end, {}, {}, nullptr);
  };
  coordinate_ = &coordinate;
  turned_.clear();
  const Outcome outcome = krawczyk(jacobian, block.equations, put, middle, result, turned_);
  if (outcome == Outcome::complete) {
    (void)put(result, std::vector<double>(n, 0.0));
    turned_coordinate_ = result[k];
  }
  coordinate_ = nullptr;
  return outcome == Outcome::complete;
}

template <class Form>
int PoseForms<Form>::orientation() const {
  const core::PoseProgram::Block& block = program_->blocks.front();
  const std::size_t n = block.unknowns.size();
  std::vector<double> middle, inverse(n * n);
  for (const int slope_step : block.jacobian) middle.push_back((*this)[slope_step].c);
  int sign = 0;
  if (!loci::invert(middle, inverse, n, 0, &sign)) return 0;
  for (std::size_t i = 0; i < n; ++i) {
    double row = 0;
    for (std::size_t k = 0; k < n; ++k) {
      SumOf<Form> sum;
      if (i == k) sum.add(1, Form(1.0));
      for (std::size_t j = 0; j < n; ++j) sum.add(-inverse[i * n + j], (*this)[block.jacobian[j * n + k]]);
      row += sum.result().magnitude();
    }
    if (!(row * (1 + 0x1p-40) < 1)) return 0;
  }
  return sign;
}

template class PoseForms<Affine>;
template class PoseForms<FlatAffine>;

}  // namespace clearloci::loci::pose
