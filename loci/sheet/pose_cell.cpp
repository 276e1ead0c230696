#include "loci/sheet/pose_cell.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/errors.hpp"
#include "loci/numbers/numbers.hpp"

namespace clearloci::loci::pose {
namespace {

template <class Form>
bool is_finite(const Form& x) {
  return std::isfinite(x.c) && std::isfinite(x.radius());
}

/// A row's entries and what it adds up to are sums of so many roundings at most.
double rounded_up(double sum, std::size_t terms) { return sum * (1 + static_cast<double>(terms + 8) * 0x1p-51); }

/// The poses of a cell.
std::pair<Pose, Pose> around(const PoseChart& chart, const PoseBox& box) {
  Pose lower = chart.base, upper = chart.base;
  for (std::size_t p = 0; p < box.size(); ++p)
    for (std::size_t q = 0; q < lower.size(); ++q) {
      if (chart.ways[p][q] == 0) continue;
      const double a = chart.ways[p][q] * box[p][0], b = chart.ways[p][q] * box[p][1];
      lower[q] += std::min(a, b);
      upper[q] += std::max(a, b);
    }
  return {std::move(lower), std::move(upper)};
}

/// The point of the way from a to b that is nearest to the origin.
std::vector<double> nearest_to_origin(const std::vector<double>& a, const std::vector<double>& b) {
  double along = 0, length2 = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    along -= a[k] * (b[k] - a[k]);
    length2 += (b[k] - a[k]) * (b[k] - a[k]);
  }
  const double t = length2 > 0 ? std::clamp(along / length2, 0.0, 1.0) : 0.0;
  std::vector<double> point(a.size());
  for (std::size_t k = 0; k < a.size(); ++k) point[k] = a[k] + t * (b[k] - a[k]);
  return point;
}

/// The same forces, as at both ends of a rod without weight.
bool are_alike(const core::PoseDemand& a, const core::PoseDemand& b) {
  const auto same_term = [](const core::LinearRow::Term& s, const core::LinearRow::Term& t) {
    return s.unknown == t.unknown && s.step == t.step;
  };
  const auto same_row = [&](const core::LinearRow& s, const core::LinearRow& t) {
    return s.free == t.free && std::equal(s.terms.begin(), s.terms.end(), t.terms.begin(), t.terms.end(), same_term);
  };
  return a.demand.least == b.demand.least && a.demand.bound.has_value() == b.demand.bound.has_value() &&
         std::equal(a.components.begin(), a.components.end(), b.components.begin(), b.components.end(), same_row);
}

double length_of(const std::vector<double>& v) {
  double square = 0;
  for (const double component : v) square += component * component;
  return std::sqrt(square);
}

}  // namespace

template <class Form>
PoseCellOf<Form>::PoseCellOf(const core::PoseStatics& statics)
    : statics_(&statics),
      point_(statics),
      forms_(statics.program),
      n_(static_cast<std::size_t>(statics.unknowns)),
      columns_(n_) {
  for (std::size_t row = 0; row < n_; ++row)
    for (const core::LinearRow::Term& term : statics.equations[row].terms)
      columns_[static_cast<std::size_t>(term.unknown)].push_back({static_cast<int>(row), term.step});
  sizes_.resize(statics.program.steps.size());
  const auto list_steps = [this](const core::LinearRow& row) {
    for (const core::LinearRow::Term& term : row.terms) varying_.push_back(term.step);
    varying_.insert(varying_.end(), row.free.begin(), row.free.end());
  };
  for (const core::LinearRow& row : statics.equations) list_steps(row);
  for (const core::PoseDemand& demand : statics.demands)
    for (const core::LinearRow& row : demand.components) list_steps(row);
  std::sort(varying_.begin(), varying_.end());
  varying_.erase(std::unique(varying_.begin(), varying_.end()), varying_.end());
  std::erase_if(varying_, [this](int index) { return !forms_.varies(index); });
  for (const core::PoseDemand& demand : statics.demands)
    leasts_.push_back(std::nextafter(core::to_double(demand.demand.least), demand.demand.least > 0 ? 1e300 : 0.0));
  for (const core::PoseProgram::Step& step : statics.program.steps)
    if (step.operation == core::PoseProgram::Operation::square_root && step.varies) closures_.push_back(step.first);
  closures_.insert(closures_.end(), statics.positive.begin(), statics.positive.end());
  inverse_.resize(n_ * n_);
  error_.resize(n_ * n_);
  solution_.assign(statics.loads, std::vector<double>(n_));
  moved_.assign(statics.loads, std::vector<Form>(n_));
  rest_.assign(statics.loads, std::vector<double>(n_));
  least_.resize(statics.demands.size());
  kept_.resize(statics.demands.size());
  judged_.resize(statics.demands.size());
  by_load_.resize(statics.demands.size());
  for (auto demand = statics.demands.begin(); demand != statics.demands.end(); ++demand)
    alike_.push_back(
        static_cast<int>(std::find_if(statics.demands.begin(), demand,
                                      [&](const core::PoseDemand& other) { return are_alike(other, *demand); }) -
                         statics.demands.begin()));
}

template <class Form>
CellAnswers::State PoseCellOf<Form>::in_doubt(Doubt doubt, const Form& form, int demand) {
  doubt_ = doubt;
  demand_ = demand;
  for (std::size_t p = 0; p < Form::noises; ++p) spreads_[p] = std::abs(form.a[p]);
  return State::in_doubt;
}

template <class Form>
CellAnswers::State PoseCellOf<Form>::run(const PoseChart& chart, const PoseBox& box, std::vector<Form>* boundaries) {
  using Outcome = typename PoseForms<Form>::Outcome;
  core::BlockUnknowns starts;
  if (!statics_->program.blocks.empty()) {
    // What the sheet covers is told by its own cells, which are finer the nearer to its end.
    const auto [lower, upper] = around(chart, box);
    std::optional<core::BlockUnknowns> found;
    using Cover = core::BlockSheet::Cover;
    const Cover cover = statics_->sheet.cover ? statics_->sheet.cover(lower, upper) : Cover::some;
    if (cover == Cover::none) return State::outside;
    if (cover == Cover::all) found = statics_->sheet.start(chart.at(middle_of(box)));
    if (!found) {
      Form all;
      for (std::size_t p = 0; p < box.size(); ++p) all.a[p] = 1;
      return in_doubt(Doubt::workspace, all);
    }
    starts = std::move(*found);
  }
  switch (forms_.run(chart, box, starts, boundaries)) {
    case Outcome::outside:
      return State::outside;
    case Outcome::in_doubt:
      return in_doubt(Doubt::workspace, forms_.doubt());
    case Outcome::complete:
      break;
  }
  // The sheet's solution is the one that the cell has.
  const double size = core::size_of(statics_->program, starts);
  for (std::size_t k = 0; k < starts.size(); ++k) {
    const auto& [middle, radius] = forms_.unique()[k];
    if (!(std::abs(middle.c - starts[k]) + core::BlockSheet::accuracy * size < radius))
      return in_doubt(Doubt::workspace, middle);
  }
  for (const int positive_step : statics_->positive) {
    if (step(positive_step).upper() < 0) return State::outside;
    if (step(positive_step).lower() > 0) continue;
    if (boundaries == nullptr || !is_finite(step(positive_step)))
      return in_doubt(Doubt::workspace, step(positive_step));
    boundaries->push_back(step(positive_step));
  }
  std::fill(judged_.begin(), judged_.end(), Judged::not_yet);
  for (const int index : varying_) sizes_[static_cast<std::size_t>(index)] = step(index).size();
  return State::proven;
}

/// The inverse of A at the cell's middle.
template <class Form>
bool PoseCellOf<Form>::invert() {
  std::vector<double> a(n_ * n_, 0.0);
  for (std::size_t column = 0; column < n_; ++column)
    for (const Entry& entry : columns_[column])
      a[static_cast<std::size_t>(entry.row) * n_ + column] = step(entry.step).c;
  return loci::invert(a, inverse_, n_, 0, &determinant_);
}

template <class Form>
bool PoseCellOf<Form>::is_regular() {
  if (n_ == 0) return true;  // every pivot was a number
  std::array<double, Form::noises> moves{};
  for (std::size_t i = 0; i < n_; ++i)
    for (std::size_t j = 0; j < n_; ++j) {
      Sum sum;
      if (i == j) sum.add(1, Form(1.0));
      for (const Entry& entry : columns_[j])
        if (const double factor = inverse_at(i, static_cast<std::size_t>(entry.row)); factor != 0)
          add_step(sum, -factor, entry.step);
      const Form e = sum.result();
      error_[i * n_ + j] = e.magnitude();
      for (std::size_t p = 0; p < Form::noises; ++p) moves[p] += std::abs(e.a[p]);
    }
  // Towards the vector that |E| stretches most, kept off zero.
  std::vector<double> weights(n_, 1.0), stretched(n_);
  const auto stretch = [&] {
    for (std::size_t i = 0; i < n_; ++i) {
      double sum = 0;
      for (std::size_t j = 0; j < n_; ++j) sum += error_[i * n_ + j] * weights[j];
      stretched[i] = rounded_up(sum, n_);
    }
  };
  constexpr int steps = 4;
  constexpr double least_weight = 1e-4;
  for (int k = 0; k < steps; ++k) {
    stretch();
    const double most = *std::max_element(stretched.begin(), stretched.end());
    if (!(most > 0)) break;
    for (std::size_t i = 0; i < n_; ++i) weights[i] = std::max(stretched[i] / most, least_weight);
  }
  stretch();
  contraction_ = 0;
  for (std::size_t i = 0; i < n_; ++i) contraction_ = std::max(contraction_, stretched[i] / weights[i] * (1 + 0x1p-50));
  weights_ = std::move(weights);
  if (contraction_ < 1) return true;
  doubt_ = Doubt::singularity;
  demand_ = -1;
  spreads_ = moves;
  return false;
}

/// w_m under a load, and w - w_m in any pose of the cell: C r and what is added to it at most.
template <class Form>
void PoseCellOf<Form>::solve(std::size_t load) {
  std::vector<double>& w = solution_[load];
  for (std::size_t i = 0; i < n_; ++i) {
    w[i] = 0;
    for (std::size_t j = 0; j < n_; ++j) w[i] += inverse_at(i, j) * step(statics_->equations[j].free[load]).c;
  }
  std::vector<Form> residual;
  for (const core::LinearRow& row : statics_->equations) {
    Sum sum;
    add_step(sum, 1, row.free[load]);
    for (const core::LinearRow::Term& term : row.terms)
      add_step(sum, -w[static_cast<std::size_t>(term.unknown)], term.step);
    residual.push_back(sum.result());
  }
  std::vector<double> sizes;
  for (const Form& form : residual) sizes.push_back(form.size());
  std::vector<Form>& moved = moved_[load];
  std::vector<double>& rest = rest_[load];
  double largest = 0;
  for (std::size_t i = 0; i < n_; ++i) {
    Sum sum;
    for (std::size_t j = 0; j < n_; ++j) sum.add(inverse_at(i, j), residual[j], sizes[j]);
    moved[i] = sum.result();
    largest = std::max(largest, moved[i].magnitude() / weights_[i]);
  }
  largest = rounded_up(largest / (1 - contraction_), 8);
  for (std::size_t i = 0; i < n_; ++i) {
    double farther = 0;
    for (std::size_t j = 0; j < n_; ++j) farther += error_[i * n_ + j] * weights_[j] * largest;
    rest[i] = rounded_up(farther, n_);
  }
}

template <class Form>
std::vector<double> PoseCellOf<Form>::component_values(const core::PoseDemand& demand, std::size_t load) const {
  std::vector<double> values;
  for (const core::LinearRow& row : demand.components) {
    double value = forms_[row.free[load]].c;
    for (const core::LinearRow::Term& term : row.terms)
      value += forms_[term.step].c * solution_[load][static_cast<std::size_t>(term.unknown)];
    values.push_back(value);
  }
  return values;
}

template <class Form>
Form PoseCellOf<Form>::sum_of(const core::LinearRow& row, std::size_t load) const {
  Sum sum;
  add_step(sum, 1, row.free[load]);
  double beyond = 0;
  for (const core::LinearRow::Term& term : row.terms) {
    const auto j = static_cast<std::size_t>(term.unknown);
    const Form& factor = forms_[term.step];
    add_step(sum, solution_[load][j], term.step);
    sum.add(1, factor * moved_[load][j]);
    beyond += factor.magnitude() * rest_[load][j];
  }
  Form form = sum.result();
  form.r = (form.r + rounded_up(beyond, row.terms.size())) * (1 + 0x1p-40) + Form::slack(std::abs(form.c));
  return form;
}

template <class Form>
bool PoseCellOf<Form>::keeps(int index) {
  const auto demand = static_cast<std::size_t>(index);
  const int alike = alike_[demand];
  const auto first = static_cast<std::size_t>(alike);
  const bool is_known = judged_[first] != Judged::not_yet;
  if (!is_known) judged_[first] = judge(alike) ? Judged::kept : Judged::open;
  const bool kept = judged_[first] == Judged::kept;
  if (is_known && kept)
    for (const Form& value : by_load_[first]) add_spreads(value);
  if (!kept) demand_ = index;
  if (alike != index) {
    least_[demand] = least_[first];
    kept_[demand] = kept_[first];
    kept_[demand].demand = index;
  }
  return kept;
}

template <class Form>
void PoseCellOf<Form>::add_spreads(const Form& value) {
  const double usual = std::abs(value.c) + 0x1p-1000;
  for (std::size_t p = 0; p < Form::noises; ++p) spreads_[p] += std::abs(value.a[p]) / usual;
}

template <class Form>
typename PoseCellOf<Form>::Projection PoseCellOf<Form>::project(const core::PoseDemand& demand,
                                                                std::vector<double> n) const {
  Projection projection{std::move(n), std::vector<double>(n_, 0.0), {}};
  std::vector<Sum> sums(n_);
  std::vector<double> at_middle(n_, 0.0);
  for (std::size_t k = 0; k < projection.n.size(); ++k)
    for (const core::LinearRow::Term& term : demand.components[k].terms) {
      const auto j = static_cast<std::size_t>(term.unknown);
      add_step(sums[j], projection.n[k], term.step);
      at_middle[j] += projection.n[k] * forms_[term.step].c;
    }
  std::vector<double>& multipliers = projection.multipliers;
  for (std::size_t j = 0; j < n_; ++j)
    if (at_middle[j] != 0)
      for (std::size_t i = 0; i < n_; ++i) multipliers[i] += inverse_at(j, i) * at_middle[j];
  for (std::size_t j = 0; j < n_; ++j) {
    for (const Entry& entry : columns_[j])
      if (const double multiplier = multipliers[static_cast<std::size_t>(entry.row)]; multiplier != 0)
        add_step(sums[j], -multiplier, entry.step);
    projection.left.push_back(sums[j].result());
  }
  return projection;
}

template <class Form>
std::pair<Form, double> PoseCellOf<Form>::value_of(const Projection& projection, const core::PoseDemand& demand,
                                                   std::size_t load) const {
  Sum sum;
  for (std::size_t k = 0; k < projection.n.size(); ++k) add_step(sum, projection.n[k], demand.components[k].free[load]);
  for (std::size_t i = 0; i < n_; ++i)
    if (projection.multipliers[i] != 0) add_step(sum, projection.multipliers[i], statics_->equations[i].free[load]);
  double beyond = 0;
  for (std::size_t j = 0; j < n_; ++j) {
    sum.add(solution_[load][j], projection.left[j]);
    beyond += projection.left[j].magnitude() * rest_[load][j];
  }
  for (std::size_t j = 0; j < n_; ++j) sum.add(1, projection.left[j] * moved_[load][j]);
  return {sum.result(), rounded_up(beyond, n_)};
}

template <class Form>
bool PoseCellOf<Form>::is_below(int index) const {
  const auto demand = static_cast<std::size_t>(index);
  const core::PoseDemand& pose_demand = statics_->demands[demand];
  const double least = leasts_[demand] * (1 - 0x1p-40);
  if (!(least > 0)) return false;
  for (std::size_t load = 0; load < statics_->loads; ++load) {
    double squares = 0;
    for (std::size_t k = 0; k < pose_demand.components.size(); ++k) {
      std::vector<double> n(pose_demand.components.size(), 0.0);
      n[k] = 1;
      const auto [value, beyond] = value_of(project(pose_demand, std::move(n)), pose_demand, load);
      const double most = value.magnitude() + beyond;
      squares += most * most;
    }
    if (std::sqrt(squares) * (1 + 0x1p-40) < least) return true;
  }
  return false;
}

template <class Form>
bool PoseCellOf<Form>::judge(int index) {
  const core::PoseDemand& demand = statics_->demands[static_cast<std::size_t>(index)];
  const std::vector<double> first = component_values(demand, 0), last = component_values(demand, statics_->loads - 1);
  std::vector<double> n = nearest_to_origin(first, last);
  const double size = length_of(n);
  // Without a direction of its own any one does; what keeps to a bound is positive.
  for (std::size_t k = 0; k < n.size(); ++k)
    n[k] = demand.demand.bound ? 1.0 : size > 0 ? n[k] / size : (k == 0 ? 1.0 : 0.0);
  const Projection projection = project(demand, n);
  double& kept = least_[static_cast<std::size_t>(index)];
  kept = std::numeric_limits<double>::infinity();
  const double least = leasts_[static_cast<std::size_t>(index)];
  std::vector<Form>& values = by_load_[static_cast<std::size_t>(index)];
  values.clear();
  bool enough = true;
  for (std::size_t load = 0; load < statics_->loads; ++load) {
    const auto [value, beyond] = value_of(projection, demand, load);
    // n is a unit vector to some roundings.
    const double low = Form::down(value.lower() - beyond) * (1 - 0x1p-48);
    kept = std::min(kept, low);
    Open& open = kept_[static_cast<std::size_t>(index)];
    open = {value, least, index, n.size() != 1 ? 0 : n[0] > 0 ? 1 : -1};
    open.form.r = (open.form.r + beyond) * (1 + 0x1p-40) + Form::slack(std::abs(value.c));
    if (low > least) {
      if (enough) add_spreads(value);
      values.push_back(value);
      continue;
    }
    if (enough) in_doubt(Doubt::demand, value, index);
    enough = false;
    for (std::size_t j = 0; j < n_; ++j)
      for (std::size_t p = 0; p < Form::noises; ++p)
        spreads_[p] += 2 * std::abs(projection.left[j].a[p]) * (moved_[load][j].magnitude() + rest_[load][j]);
  }
  return enough;
}

/// Of a demand that was not kept: whether an effort is beyond its bound in all of the cell.
template <class Form>
bool PoseCellOf<Form>::is_beyond_bound(int demand) const {
  const auto index = static_cast<std::size_t>(demand);
  return statics_->demands[index].demand.bound && kept_[index].form.upper() < 0;
}

template <class Form>
CellAnswers::State PoseCellOf<Form>::enter(const PoseChart& chart, const PoseBox& box) {
  core::ensure(box.size() <= Form::noises, "a cell has no more parameters than forms have noises");
  chart_ = &chart;
  box_ = &box;
  doubt_ = Doubt::none;
  spreads_.fill(0);
  if (const State state = run(chart, box); state != State::proven) return state;
  if (!invert()) {
    doubt_ = Doubt::singularity;
    for (std::size_t p = 0; p < box.size(); ++p) spreads_[p] = 1;
    return State::in_doubt;
  }
  if (!is_regular()) return State::in_doubt;
  for (std::size_t load = 0; load < statics_->loads; ++load) solve(load);
  // The demand that failed last fails again, mostly.
  const auto count = static_cast<int>(statics_->demands.size());
  for (int k = 0; k < count; ++k)
    if (const int index = (first_ + k) % count; !keeps(index)) {
      first_ = index;
      return is_beyond_bound(index) ? State::outside : State::in_doubt;
    }
  return State::proven;
}

double CellAnswers::size_of(const std::vector<std::vector<double>>& by_load) {
  return length_of(nearest_to_origin(by_load.front(), by_load.back()));
}

CellAnswers::Signs CellAnswers::signs_of(const core::PoseStatics& statics, const At& at) {
  Signs signs;
  for (std::size_t d = 0; d < at.components.size(); ++d) {
    const double least = core::to_double(statics.demands[d].demand.least);
    const std::vector<double>& first = at.components[d].front();
    const int sign = first.size() == 1 ? (first[0] > 0 ? 1 : -1) : least > 0 ? 1 : 0;
    signs.push_back(size_of(at.components[d]) < least ? below * sign : sign);
  }
  signs.push_back(at.determinant);
  return signs;
}

template class PoseCellOf<Affine>;
template class PoseCellOf<FlatAffine>;

}  // namespace clearloci::loci::pose
