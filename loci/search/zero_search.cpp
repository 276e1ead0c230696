#include "loci/search/zero_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "core/errors.hpp"
#include "core/parts.hpp"
#include "loci/search/second_look.hpp"

namespace clearloci::loci::sheet {

namespace {

// Cells are examined this much larger on every side, relative to their width, so that a zero on a common edge lies well
// inside the box of either neighbour and is certified there.
constexpr double inflation = 0.1;
// On lifted cells s^2 varies as much as x and y do, so that a box of their proportions does not contract however small
// it is; wider ones in x and y do.
constexpr int most_widenings = 2;
constexpr double hopeless = 16;          // an image this much wider than its box comes from a singular Jacobian
constexpr double hardly_narrower = 0.5;  // than its box in any coordinate: hardly any box around that one does
constexpr double thinnest_root = 0.01;   // relative to the cell; then the cell is cut next
constexpr double lifted_inflation = 0.6, root_inflation = 0.2;
// Cells within this factor of the smallest size are worth the price of multi-precision.
constexpr double near_smallest = 1e4;
// Cells this much wider than the smallest that cannot be told anything about may be next to a touch. Where it is none,
// trials say nothing for long.
constexpr double worth_a_touch = 1e10;
constexpr std::size_t most_touch_trials = 256;
// Enough that what is left of them after a first look fills batches again.
constexpr std::size_t cells_at_a_time = 64;
// Of searches side by side; more would only fill memory.
constexpr std::size_t searches_at_a_time = 256;
// Times the budget of live cells that are borne while ever fewer of them are left.
constexpr std::size_t most_patience = 4;
// Fewer than these are looked at one by one.
constexpr std::size_t few_candidates = 3;

// What mean-value forms leave of a cell is not made more slender than this. Where it is so much smaller in both
// coordinates it is looked at again before it is cut.
constexpr double thinnest = 1.0 / 16, much_smaller = 0.5;
constexpr int sweeps = 2;

const Interval everything(-std::numeric_limits<double>::max(), std::numeric_limits<double>::max());

Interval inflated(const Interval& a, double share) {
  const double margin = share * a.width();
  return {a.lower() - margin, a.upper() + margin};
}

bool is_much_smaller(const PlaneCell& part, const PlaneCell& whole) {
  return part.x.width() <= much_smaller * whole.x.width() && part.y.width() <= much_smaller * whole.y.width();
}

}  // namespace

ZeroSearch::ZeroSearch(const SheetProgram& program, const core::WorkingMode& mode, System system)
    : program_(&program),
      system_(std::move(system)),
      cell_(program, mode),
      is_smooth_worthwhile_(is_smooth_worthwhile(program)) {
  core::ensure(system_.functions.size() == system_.free.size(), "as many functions as unknowns");
}

FoundZeros ZeroSearch::run(const std::vector<PlaneCell>& seeds, const Limits& limits) {
  return std::move(run_each({seeds}, limits).front());
}

std::vector<FoundZeros> ZeroSearch::run_each(const std::vector<std::vector<PlaneCell>>& seeds, const Limits& limits) {
  limits_ = limits;
  std::vector<FoundZeros> result;
  for (std::size_t first = 0; first < seeds.size(); first += searches_at_a_time)
    run_some(std::span(seeds).subspan(first, std::min(searches_at_a_time, seeds.size() - first)), result);
  return result;
}

void ZeroSearch::run_some(std::span<const std::vector<PlaneCell>> seeds, std::vector<FoundZeros>& result) {
  states_.assign(seeds.size(), {});
  std::vector<Box> live, next;
  for (std::size_t search = 0; search < seeds.size(); ++search) {
    states_[search].seeds = seeds[search].size();
    for (const PlaneCell& seed : seeds[search]) live.push_back({seed, {}, search});
  }
  bool stopped = false;
  while (!stopped) {
    give_up(live);
    if (live.empty()) break;
    next.clear();
    for (std::size_t i = 0; i < live.size() && !stopped; i += cells_at_a_time) {
      stopped = limits_.stop && limits_.stop();
      if (!stopped) examine(live.data() + i, live.data() + std::min(i + cells_at_a_time, live.size()), next);
    }
    if (!stopped) std::swap(live, next);
  }
  for (const Box& box : live) {
    states_[box.search].gave_up = true;
    states_[box.search].undecided.push_back(box.cell);
  }
  for (State& state : states_) result.push_back(found(state));
}

void ZeroSearch::give_up(std::vector<Box>& live) {
  for (State& state : states_) {
    state.before = {state.before[1], state.live};
    state.live = 0;
  }
  for (const Box& box : live) ++states_[box.search].live;
  if (!is_smooth_worthwhile_ && live.size() > many_live_cells && is_second_look_worthwhile(*program_)) {
    is_smooth_worthwhile_ = true;
    return;  // what it leaves of these is not known yet
  }
  // Along a curve a halving of both sides leaves twice as many, less ends; where fewer are left the end is near. What
  // one halving leaves depends on how the curve runs.
  const auto has_too_many = [&](const Box& box) {
    const State& state = states_[box.search];
    const std::size_t most = limits_.most_cells + state.seeds;
    return state.live > most && (state.live > most_patience * most || 9 * state.live > 16 * state.before[0]);
  };
  for (const Box& box : live)
    if (has_too_many(box)) {
      states_[box.search].gave_up = true;
      states_[box.search].undecided.push_back(box.cell);
    }
  std::erase_if(live, has_too_many);
}

FoundZeros ZeroSearch::found(State& state) {
  FoundZeros result;
  result.gave_up = state.gave_up;
  result.undecided = std::move(state.undecided);
  result.touches = std::move(state.touches);
  for (CertifiedZero& zero : state.zeros) result.enclosures.push_back(std::move(zero.enclosure));
  return result;
}

template <class Show>
void ZeroSearch::enclose(const Group& group, Extent extent, bool with_slopes, const Show& show) {
  constexpr std::size_t size = SheetCells::size;
  if (group.size() < few_candidates) {
    for (const std::size_t index : group) {
      Candidate& candidate = candidates_[index];
      const Box& searched = *candidate.searched;
      const bool entered = extent == Extent::cell
                               ? cell_.enter(std::array{searched.cell.x, searched.cell.y}, searched.roots)
                               : cell_.enter_local(candidate.box, candidate.lifted);
      if (entered && with_slopes) cell_.differentiate();
      show(candidate, cell_, entered);
    }
    return;
  }
  if (!side_by_side_) side_by_side_.emplace(*program_, mode());
  for (std::size_t first = 0; first < group.size(); first += size) {
    const std::size_t count = std::min(size, group.size() - first);
    std::array<SheetCells::Target, size> places;
    std::array<std::array<Interval, 2>, size> ranges;
    for (std::size_t lane = 0; lane < count; ++lane) {
      const Candidate& candidate = candidates_[group[first + lane]];
      ranges[lane] = {candidate.searched->cell.x, candidate.searched->cell.y};
      if (extent == Extent::cell)
        places[lane] = {ranges[lane], &candidate.searched->roots};
      else
        places[lane] = {{}, nullptr, &candidate.box, &candidate.lifted};
    }
    side_by_side_->enter(places, count);
    if (with_slopes) side_by_side_->differentiate();
    for (std::size_t lane = 0; lane < count; ++lane)
      show(candidates_[group[first + lane]], (*side_by_side_)[lane], side_by_side_->inside(lane));
  }
}

template <class Function>
bool ZeroSearch::excludes_zero(const Function& enclosure) const {
  const auto excludes = [&](int f) { return !enclosure(f).contains_zero(); };
  return std::any_of(system_.functions.begin(), system_.functions.end(), excludes) ||
         std::any_of(system_.also.begin(), system_.also.end(), excludes);
}

void ZeroSearch::exclude_by_values(Candidate& candidate, const SheetCell& cell, bool inside) {
  candidate.excluded = !inside || excludes_zero([&](int f) { return cell.value(f); });
  if (candidate.excluded) return;
  const PlaneCell& place = candidate.searched->cell;
  candidate.all.reserve(2 + static_cast<std::size_t>(program_->roots()));
  candidate.all.assign({place.x, place.y});
  for (int j = 0; j < program_->roots(); ++j) candidate.all.push_back(cell.root(j));
  candidate.lifted = cell.lifted();
  candidate.axis = place.x.width() > place.y.width() ? 0 : 1;
  candidate.roots = candidate.searched->roots;
  for (const int j : candidate.lifted) {
    candidate.roots.resize(static_cast<std::size_t>(program_->roots()), everything);
    candidate.roots[static_cast<std::size_t>(j)] = cell.root(j);
  }
}

/// Of a lifted cell.
void ZeroSearch::exclude_by_slopes(Candidate& candidate, const SheetCell& cell) {
  candidate.excluded = excludes_zero([&](int f) { return cell.centred(f); });
  if (!candidate.excluded) candidate.axis = axis_to_cut(cell, candidate.searched->cell);
}

void ZeroSearch::put_box_around(Candidate& candidate) const {
  candidate.box.clear();
  candidate.box.reserve(2 + candidate.lifted.size());
  const auto is_free = [&](std::size_t c) {
    return c >= 2 || std::find(system_.free.begin(), system_.free.end(), static_cast<int>(c)) != system_.free.end();
  };
  for (std::size_t c = 0; c < 2 + candidate.lifted.size(); ++c) {
    const double share = candidate.lifted.empty() ? inflation : c < 2 ? lifted_inflation : root_inflation;
    const Interval& local = candidate.all[c < 2 ? c : 2 + static_cast<std::size_t>(candidate.lifted[c - 2])];
    candidate.box.push_back(is_free(c) ? inflated(local, share) : local);
  }
}

void ZeroSearch::count_in_box(Candidate& candidate, SheetCell& cell, bool has_box) {
  candidate.has_box = has_box;
  candidate.count = ZeroCount::unknown;
  if (!has_box) return;
  if (width(candidate.searched->cell) < near_smallest * limits_.smallest &&
      std::any_of(system_.functions.begin(), system_.functions.end(),
                  [&](int f) { return cell.rounding_dominates(f); }))
    cell.sharpen_middle();
  candidate.excluded = excludes_zero([&](int f) { return cell.centred(f); });
  if (candidate.excluded) return;
  candidate.count = krawczyk(cell, system_, candidate.image);
  candidate.excluded = candidate.count == ZeroCount::none;
  // Where a root is lifted, and where curves may touch, cells keep the proportions that boxes around them need.
  if (candidate.count == ZeroCount::unknown && cell.lifted().empty() &&
      width(candidate.searched->cell) > worth_a_touch * limits_.smallest)
    contract(candidate, cell);
}

/// Each equation, linear but for its slopes, is solved for each coordinate along which it is proven to change.
/// Required: no root of the cell is lifted.
void ZeroSearch::contract(Candidate& candidate, const SheetCell& cell) const {
  constexpr int n = 2;
  std::array<Interval, n> places, offsets, terms;
  const auto put = [&](int c, const Interval& place) {
    places[c] = place;
    offsets[c] = place - Interval(cell.middle(c));
  };
  for (int c = 0; c < n; ++c) put(c, candidate.all[c]);
  const auto solve = [&](int f) {
    for (int c = 0; c < n; ++c) terms[c] = cell.slope(f, c) * offsets[c];
    for (int c = 0; c < n; ++c) {
      if (places[c].width() == 0 || cell.slope(f, c).contains_zero()) continue;
      const Interval rest = cell.middle_value(f) + terms[1 - c];
      const Interval solved = Interval(cell.middle(c)) - rest * inverse(cell.slope(f, c));
      if (disjoint(solved, places[c])) return false;
      put(c, meet(solved, places[c]));
      terms[c] = cell.slope(f, c) * offsets[c];
    }
    return true;
  };
  const auto solve_all = [&] {
    for (const std::vector<int>* functions : {&system_.functions, &system_.also})
      if (!std::all_of(functions->begin(), functions->end(), solve)) return false;
    return true;
  };
  for (int sweep = 0; sweep < sweeps && !candidate.excluded; ++sweep) candidate.excluded = !solve_all();
  if (candidate.excluded) return;
  std::vector<Interval> left = candidate.all;
  std::copy_n(places.begin(), n, left.begin());
  leave(candidate, left);
}

void ZeroSearch::examine(const Box* first, const Box* last, std::vector<Box>& next) {
  const auto count = static_cast<std::size_t>(last - first);
  candidates_.resize(std::max(candidates_.size(), count));
  Group open(count), chosen;
  chosen.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    open[i] = i;
    candidates_[i].searched = first + i;
  }
  const auto those = [&](const auto& condition) -> const Group& {
    chosen.clear();
    for (const std::size_t i : open)
      if (condition(candidates_[i])) chosen.push_back(i);
    return chosen;
  };
  const auto drop_excluded = [&] { std::erase_if(open, [&](std::size_t i) { return candidates_[i].excluded; }); };
  enclose(open, Extent::cell, false, [&](Candidate& candidate, const SheetCell& cell, bool inside) {
    exclude_by_values(candidate, cell, inside);
  });
  for (const std::size_t i : open) candidates_[i].excluded = candidates_[i].excluded || known(candidates_[i]);
  drop_excluded();
  if (is_smooth_worthwhile_) {
    contract_by_forms(open);
    drop_excluded();
  }
  enclose(those([](const Candidate& candidate) { return !candidate.lifted.empty(); }), Extent::cell, true,
          [&](Candidate& candidate, const SheetCell& cell, bool) { exclude_by_slopes(candidate, cell); });
  drop_excluded();
  for (const std::size_t i : open) put_box_around(candidates_[i]);
  enclose(open, Extent::box, true,
          [&](Candidate& candidate, SheetCell& cell, bool has_box) { count_in_box(candidate, cell, has_box); });
  drop_excluded();
  // Dearer than all before, and small cells seldom need it.
  exclude_smoothly(those([](const Candidate& candidate) { return candidate.count == ZeroCount::unknown; }));
  drop_excluded();
  for (int trial = 0; trial < most_widenings; ++trial) {
    const Group& wider = those([](Candidate& candidate) {
      return candidate.has_box && candidate.count == ZeroCount::unknown && widen(candidate);
    });
    enclose(wider, Extent::box, true, [&](Candidate& candidate, const SheetCell& cell, bool has_box) {
      const ZeroCount found = has_box ? krawczyk(cell, system_, candidate.image) : ZeroCount::unknown;
      candidate.count = found == ZeroCount::none ? ZeroCount::unknown : found;
    });
  }
  narrow_all(
      those([&](const Candidate& candidate) { return candidate.count == ZeroCount::unique && !known(candidate); }));
  for (const std::size_t i : open) settle(candidates_[i], next);
}

void ZeroSearch::settle(Candidate& candidate, std::vector<Box>& next) {
  const Box& searched = *candidate.searched;
  const PlaneCell cell = {candidate.all[0], candidate.all[1]};  // what may hold zeros
  if (known(candidate)) return;                                 // since those before it were settled
  if (candidate.count == ZeroCount::unique && accept(candidate)) return;
  if (settle_touch(searched, candidate.roots, candidate.lifted) && known(candidate)) return;
  if (width(searched.cell) < limits_.smallest)
    states_[searched.search].undecided.push_back(cell);
  else if (is_much_smaller(cell, searched.cell))
    next.push_back({cell, std::move(candidate.roots), searched.search});
  else
    split({cell, std::move(candidate.roots), searched.search}, candidate.axis, next);
}

bool ZeroSearch::settle_touch(const Box& box, const std::vector<Interval>& roots, const std::vector<int>& lifted) {
  const PlaneCell& cell = box.cell;
  State& state = states_[box.search];
  if (limits_.touches == nullptr || width(cell) > std::min(worth_a_touch * limits_.smallest, limits_.widest_at_touch))
    return false;
  if (state.touch_trials++ >= most_touch_trials) return false;
  std::vector<Interval> local = {cell.x, cell.y};
  for (const int j : lifted) local.push_back(roots[static_cast<std::size_t>(j)]);
  std::optional<Touch> touch = limits_.touches->around(local, lifted);
  if (!touch) return false;
  const bool is_settled = std::any_of(state.settled.begin(), state.settled.end(), [&](const CertifiedZero& other) {
    return !touch->enclosure.empty() && owns(other, touch->enclosure);
  });
  state.settled.push_back({lifted, touch->box, touch->enclosure});
  if (!touch->enclosure.empty() && !is_settled) state.touches.push_back(std::move(*touch));
  return true;
}

template <std::size_t N>
void ZeroSearch::contract_by_forms(const Group& group, std::optional<FormCells<N>>& cells) {
  using Cells = FormCells<N>;
  Group own;
  for (const std::size_t i : group)
    if (candidates_[i].lifted.size() == N - 2) own.push_back(i);
  if (own.empty()) return;
  if (!cells) cells.emplace(*program_, mode());
  for (std::size_t first = 0; first < own.size(); first += Cells::size) {
    const std::size_t count = std::min(Cells::size, own.size() - first);
    std::array<typename Cells::Place, Cells::size> places;
    for (std::size_t lane = 0; lane < count; ++lane) {
      const Candidate& candidate = candidates_[own[first + lane]];
      places[lane] = {&candidate.all, &candidate.lifted};
    }
    cells->enter(places, count);
    for (std::size_t lane = 0; lane < count; ++lane) {
      Candidate& candidate = candidates_[own[first + lane]];
      std::vector<Interval> left = candidate.all;
      candidate.excluded = !cells->contract(lane, system_, left);
      if (!candidate.excluded) leave(candidate, left);
    }
  }
}

/// `left`: enclosures of all variables.
void ZeroSearch::leave(Candidate& candidate, const std::vector<Interval>& left) {
  const double least = thinnest * std::max(left[0].width(), left[1].width());
  for (const std::size_t c : {0u, 1u}) {
    const double middle = left[c].middle();
    candidate.all[c] = meet(hull(left[c], Interval(middle - 0.5 * least, middle + 0.5 * least)), candidate.all[c]);
  }
  candidate.axis = candidate.all[0].width() > candidate.all[1].width() ? 0 : 1;
  for (const int root : candidate.lifted) {
    const auto j = static_cast<std::size_t>(root);
    candidate.roots[j] = candidate.all[2 + j] = left[2 + j];
  }
}

void ZeroSearch::contract_by_forms(const Group& group) {
  contract_by_forms(group, forms_);
  contract_by_forms(group, forms_at_rims_);
  contract_by_forms(group, forms_at_corners_);
}

void ZeroSearch::exclude_smoothly(const Group& group) {
  if (!is_smooth_worthwhile_ || group.empty()) return;
  const auto exclude = [&](Candidate& candidate, SmoothCell::Standing place, const auto& excludes) {
    candidate.excluded = place == SmoothCell::Standing::outside ||
                         std::any_of(system_.functions.begin(), system_.functions.end(), excludes) ||
                         std::any_of(system_.also.begin(), system_.also.end(), excludes);
  };
  if (group.size() < few_candidates) {
    if (!smooth_) smooth_.emplace(*program_, mode());
    for (const std::size_t i : group) {
      const PlaneCell& cell = candidates_[i].searched->cell;
      exclude(candidates_[i], smooth_->enter(cell.x, cell.y), [this](int f) { return smooth_->excludes(f); });
    }
    return;
  }
  constexpr std::size_t size = SmoothCells::size;
  if (!smooth_side_by_side_) smooth_side_by_side_.emplace(*program_, mode());
  std::array<std::array<Interval, 2>, size> ranges;
  for (std::size_t first = 0; first < group.size(); first += size) {
    const std::size_t count = std::min(size, group.size() - first);
    for (std::size_t lane = 0; lane < count; ++lane) {
      const PlaneCell& cell = candidates_[group[first + lane]].searched->cell;
      ranges[lane] = {cell.x, cell.y};
    }
    smooth_side_by_side_->enter(ranges, count);
    for (std::size_t lane = 0; lane < count; ++lane)
      exclude(candidates_[group[first + lane]], smooth_side_by_side_->place(lane),
              [&](int f) { return smooth_side_by_side_->excludes(lane, f); });
  }
}

/// A root whose range makes a function vary more than the cell's extent does is cut before the cell.
int ZeroSearch::axis_to_cut(const SheetCell& cell, const PlaneCell& place) const {
  for (std::size_t l = 0; l < cell.lifted().size(); ++l) {
    if (cell.local(2 + static_cast<int>(l)).width() < thinnest_root * width(place)) continue;
    for (const int f : system_.functions) {
      double plain = 0;
      for (const int c : system_.free) plain += cell.slope(f, c).magnitude() * cell.local(c).width();
      const int c = 2 + static_cast<int>(l);
      if (cell.slope(f, c).magnitude() * cell.local(c).width() > 2 * plain) return 2 + cell.lifted()[l];
    }
  }
  return place.x.width() > place.y.width() ? 0 : 1;
}

/// A box of the wrong proportions does not contract; one that also holds its image may. The box only grows, so that a
/// count of it is one of the cell.
bool ZeroSearch::widen(Candidate& candidate) {
  std::vector<Interval>&box = candidate.box, &image = candidate.image;
  if (image.empty()) return false;
  // By how much the widths of a box grow at least is no more than the spectral radius (Collatz, Wielandt), which only
  // grows with the box.
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (std::size_t c = 0; c < box.size(); ++c) {
    if (box[c].width() == 0) continue;
    const double ratio = image[c].width() / box[c].width();
    least = std::min(least, ratio);
    most = std::max(most, ratio);
  }
  if (least > hardly_narrower || most > hopeless) {
    image.clear();
    return false;
  }
  for (std::size_t c = 0; c < box.size(); ++c)
    if (box[c].width() > 0) box[c] = inflated(hull(box[c], image[c]), inflation);
  image.clear();
  return true;
}

/// The box of `zero` holds whatever zero lies in `all` (an enclosure of all variables).
bool ZeroSearch::owns(const CertifiedZero& zero, const std::vector<Interval>& all) const {
  for (const int c : system_.free)
    if (!inside(all[c], zero.unique[c])) return false;
  for (std::size_t l = 0; l < zero.lifted.size(); ++l)
    if (!inside(all[2 + zero.lifted[l]], zero.unique[2 + l])) return false;
  return true;
}

/// All of its cell lies in the box of a zero that is known already.
bool ZeroSearch::known(const Candidate& candidate) const {
  const State& state = states_[candidate.searched->search];
  const auto owns_all = [&](const CertifiedZero& zero) { return owns(zero, candidate.all); };
  return std::any_of(state.zeros.begin(), state.zeros.end(), owns_all) ||
         std::any_of(state.settled.begin(), state.settled.end(), owns_all);
}

double ZeroSearch::width(const PlaneCell& cell) const { return std::max(cell.x.width(), cell.y.width()); }

void ZeroSearch::split(const Box& box, int axis, std::vector<Box>& next) {
  Box halves[2] = {box, box};
  const auto range = [&](Box& half) -> Interval& {
    return axis == 0 ? half.cell.x : axis == 1 ? half.cell.y : half.roots[axis - 2];
  };
  const Interval whole = range(halves[0]);
  range(halves[0]) = {whole.lower(), whole.middle()};
  range(halves[1]) = {whole.middle(), whole.upper()};
  for (Box& half : halves) next.push_back(std::move(half));
}

void ZeroSearch::narrow_all(const Group& group) {
  if (group.size() < few_candidates) {
    for (const std::size_t i : group) {
      Candidate& candidate = candidates_[i];
      narrow(cell_, system_, candidate.box, candidate.lifted, limits_.accuracy, candidate.image);
    }
    return;
  }
  std::vector<Narrowing> active;
  for (const std::size_t i : group) {
    Candidate& candidate = candidates_[i];
    active.emplace_back(system_, candidate.box, candidate.lifted, limits_.accuracy, candidate.image);
  }
  constexpr std::size_t size = SheetCells::size;
  if (!side_by_side_) side_by_side_.emplace(*program_, mode());
  while (!active.empty()) {
    for (std::size_t first = 0; first < active.size(); first += size) {
      const std::size_t count = std::min(size, active.size() - first);
      std::array<SheetCells::Target, size> places;
      for (std::size_t lane = 0; lane < count; ++lane) {
        const Narrowing& narrowing = active[first + lane];
        places[lane] = {{}, nullptr, &narrowing.place(), &narrowing.lifted()};
      }
      side_by_side_->enter(places, count);
      side_by_side_->differentiate();
      for (std::size_t lane = 0; lane < count; ++lane)
        active[first + lane].take((*side_by_side_)[lane], side_by_side_->inside(lane));
    }
    std::erase_if(active, [](const Narrowing& narrowing) { return narrowing.is_done(); });
  }
}

/// Keeps the zero in the candidate's box if it lies in the cell and on the mode's sheet. False: rounding does not tell
/// whether it is a new one.
bool ZeroSearch::accept(const Candidate& candidate) {
  const std::vector<int>& lifted = candidate.lifted;
  const std::vector<Interval>& enclosure = candidate.image;
  const PlaneCell& cell = candidate.searched->cell;
  State& state = states_[candidate.searched->search];
  if (disjoint(enclosure[0], cell.x) || disjoint(enclosure[1], cell.y)) return true;
  for (std::size_t l = 0; l < lifted.size(); ++l)
    if (enclosure[2 + l].sign() == -mode()[lifted[l]]) return true;
  CertifiedZero zero{lifted, candidate.box, {enclosure[0], enclosure[1]}};
  if (!cell_.enter_local(enclosure, lifted)) return false;
  for (int j = 0; j < program_->roots(); ++j) zero.enclosure.push_back(cell_.root(j));
  for (const CertifiedZero& place : state.settled)
    if (owns(place, zero.enclosure)) return true;
  for (const CertifiedZero& other : state.zeros) {
    if (owns(other, zero.enclosure) || owns(zero, other.enclosure)) return true;
    if (!disjoint(other.enclosure[0], zero.enclosure[0]) && !disjoint(other.enclosure[1], zero.enclosure[1]))
      return false;
  }
  state.zeros.push_back(std::move(zero));
  return true;
}

namespace {

/// Thousands of cells are merged on a raster first, so that comparing them stays cheap.
std::vector<PlaneCell> rastered(const std::vector<PlaneCell>& cells) {
  constexpr std::size_t few = 2000;
  constexpr double raster = 64;
  if (cells.size() <= few) return cells;
  PlaneCell all = cells.front();
  for (const PlaneCell& cell : cells) all = {hull(all.x, cell.x), hull(all.y, cell.y)};
  const double step = std::max(all.x.width(), all.y.width()) / raster;
  std::map<std::pair<int, int>, PlaneCell> merged;
  for (const PlaneCell& cell : cells) {
    const std::pair<int, int> place = {static_cast<int>((cell.x.middle() - all.x.lower()) / step),
                                       static_cast<int>((cell.y.middle() - all.y.lower()) / step)};
    const auto [it, added] = merged.try_emplace(place, cell);
    if (!added) it->second = {hull(it->second.x, cell.x), hull(it->second.y, cell.y)};
  }
  std::vector<PlaneCell> result;
  for (const auto& [place, cell] : merged) result.push_back(cell);
  return result;
}

}  // namespace

std::vector<PlaneCell> clusters(std::vector<PlaneCell> cells) {
  cells = rastered(cells);
  std::sort(cells.begin(), cells.end(), [](const PlaneCell& a, const PlaneCell& b) {
    return a.x.lower() != b.x.lower() ? a.x.lower() < b.x.lower() : a.y.lower() < b.y.lower();
  });
  core::Parts<std::size_t> parts(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i)
    for (std::size_t k = i + 1; k < cells.size() && cells[k].x.lower() <= cells[i].x.upper(); ++k)
      if (!disjoint(cells[i].y, cells[k].y)) {
        const std::size_t a = parts.of(i), b = parts.of(k);
        parts.join(std::min(a, b), std::max(a, b));
      }
  std::vector<PlaneCell> result;
  std::vector<std::size_t> index(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::size_t root = parts.of(i);
    if (root == i) {
      index[i] = result.size();
      result.push_back(cells[i]);
    } else {
      PlaneCell& cluster = result[index[root]];
      cluster = {hull(cluster.x, cells[i].x), hull(cluster.y, cells[i].y)};
    }
  }
  return result;
}

}  // namespace clearloci::loci::sheet
