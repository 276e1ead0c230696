#include "loci/tasks/pose_displacement.hpp"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/errors.hpp"
#include "loci/search/search.hpp"
#include "loci/tasks/pose_parts.hpp"

namespace clearloci::loci::pose {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Poses under a part of the loads between the first and the last.
struct LoadedPart {
  PieceBox part;
  double from = 0, to = 0;
};

/// How far the end effector is displaced over a cell that was entered last.
template <class Cell, class Form>
class Displacement {
 public:
  Displacement(const core::PoseStatics& statics, std::size_t loads, const std::vector<PoseTakeUp>& take_ups)
      : loads_(loads), units_(statics.loads - loads), take_ups_(take_ups) {}

  /// |dp|^2, m^2.
  Form square(const Cell& cell, double from, double to) const {
    std::vector<Form> moved(units_);
    for (const PoseTakeUp& take_up : take_ups_) {
      const std::vector<Form> taken = direction(cell, take_up, from, to);
      const Form clearance = within(take_up.clearance);
      for (std::size_t u = 0; u < units_; ++u) {
        Form along;
        for (std::size_t i = 0; i < taken.size(); ++i)
          along = along + cell.sum_of(take_up.reaction[i], loads_ + u) * taken[i];
        moved[u] = moved[u] + clearance * along;
      }
    }
    Form sum;
    for (const Form& form : moved) sum = sum + squared(form);
    return sum;
  }

 private:
  /// Anything between two numbers.
  static Form within(const std::array<double, 2>& range) {
    Form form(range[0] + 0.5 * (range[1] - range[0]));
    form.r = std::max(range[1] - form.c, form.c - range[0]) * (1 + 0x1p-50);
    if (form.r > 0) form.r += Form::slack(std::abs(form.c));
    return form;
  }

  /// c / |c| of every component, under some of the loads.
  std::vector<Form> direction(const Cell& cell, const PoseTakeUp& take_up, double from, double to) const {
    std::vector<Form> c;
    for (const core::LinearRow& row : take_up.reaction) {
      const Form first = cell.sum_of(row, 0);
      // Affine between the first load and the last.
      c.push_back(loads_ == 1 ? first : first + within({from, to}) * (cell.sum_of(row, 1) - first));
    }
    if (c.size() == 1) {
      if (c[0].lower() > 0) return {Form(1.0)};
      if (c[0].upper() < 0) return {Form(-1.0)};
      return {within({-1, 1})};
    }
    Form square;
    for (const Form& form : c) square = square + squared(form);
    if (!(square.lower() > 0)) return std::vector<Form>(c.size(), within({-1, 1}));
    const Form per_size = inverse(square_root(square));
    for (Form& form : c) {
      form = form * per_size;
      if (form.magnitude() > 2) form = within({-1, 1});
    }
    return c;
  }

  std::size_t loads_, units_;
  const std::vector<PoseTakeUp>& take_ups_;
};

constexpr long part_of_a_bound = 10;

double root_above(double square) { return std::sqrt(std::max(0.0, square)) * (1 + 0x1p-50); }

template <class Cell, class Form>
class DisplacementSearch {
 public:
  DisplacementSearch(const core::PoseStatics& statics, std::size_t loads, const std::vector<PoseTakeUp>& take_ups,
                     const PoseRegion& region, double margin, double allowed, double accuracy,
                     const SearchBudget& budget)
      : displacement_(statics, loads, take_ups),
        ranged_(loads > 1),
        region_(region),
        reach_(margin + region.hair()),
        allowed_(allowed),
        accuracy_(accuracy),
        budget_(budget),
        meter_(budget),
        cells_([&statics] { return Cell(statics); }),
        pieces_(region.pieces(margin)) {}

  PoseDisplacement run() {
    for (const PosePiece& piece : pieces_) left_.push({{&piece, piece.box}, 0, ranged_ ? 1.0 : 0.0}, -infinite);
    double most_of_finest = 0;
    while (!left_.empty() && most_left() > enough() && found_.met <= allowed_) {
      // Where the verdict is known, a closer bound is worth a part of the cells.
      if (most_left() <= allowed_ && meter_.cost().cells >= budget_.most_cells / part_of_a_bound) break;
      if (!step(most_of_finest)) break;
    }
    found_.most = std::max(most_of_finest, left_.empty() ? 0.0 : most_left());
    for (const auto& [key, loaded] : left_)
      if (-key > allowed_) leave_open(loaded.part);
    found_.proof.cost = meter_.cost();
    return found_;
  }

 private:
  /// What is found of a part.
  struct Seen {
    bool inside = false;  ///< poses of the task, that may be assembled
    double most = infinite;
    std::optional<double> met = {};  ///< at its middle
    int along = -1;                  ///< where to cut it; -1: it is too fine
    bool cut_loads = false;
  };

  double most_left() const { return -left_.next().key; }

  double enough() const {
    const double near = found_.met * (1 + accuracy_);
    return found_.met <= allowed_ ? std::min(near, allowed_) : near;
  }

  /// The parts of the largest bounds, looked at side by side; what is merged of them does not depend on threads. False
  /// where the budget is spent.
  bool step(double& most_of_finest) {
    constexpr std::size_t at_once = 64;
    if (!meter_.begin(0)) return false;
    const auto some = left_.take(at_once, -enough());
    meter_.add(static_cast<long>(some.size()));
    std::vector<Seen> seen(some.size());
    run_in_order(some.size(), [&](std::size_t i) { seen[i] = look(cells_.local(), some[i].box); });
    for (std::size_t i = 0; i < some.size(); ++i) {
      const Seen& sighting = seen[i];
      if (!sighting.inside) continue;
      const LoadedPart& loaded = some[i].box;
      if (sighting.met && *sighting.met > found_.met) {
        found_.met = *sighting.met;
        found_.at = pose_of(loaded.part);
        found_.load = 0.5 * (loaded.from + loaded.to);
      }
      const double most = std::min(sighting.most, -some[i].key);
      if (sighting.cut_loads) {
        const double middle = 0.5 * (loaded.from + loaded.to);
        left_.push({loaded.part, loaded.from, middle}, -most);
        left_.push({loaded.part, middle, loaded.to}, -most);
      } else if (sighting.along >= 0) {
        for (PieceBox& half : halves_of(loaded.part, static_cast<std::size_t>(sighting.along)))
          left_.push({std::move(half), loaded.from, loaded.to}, -most);
      } else {
        most_of_finest = std::max(most_of_finest, most);
        if (most > allowed_) leave_open(loaded.part);
      }
    }
    return true;
  }

  void leave_open(const PieceBox& part) { found_.proof.leave_open(poses_of(part)); }

  Seen look(Cell& cell, const LoadedPart& loaded) const {
    const PieceBox& part = loaded.part;
    if (region_.distance(*part.piece, part.box) > reach_) return {};
    const CellAnswers::State state = cell.enter(part.piece->chart, part.box);
    if (state == CellAnswers::State::outside) return {};
    Seen seen{.inside = true};
    if (state != CellAnswers::State::proven) {
      seen.along = chosen(cell, part);
      return seen;
    }
    const Form square = displacement_.square(cell, loaded.from, loaded.to);
    if (std::isfinite(square.upper())) seen.most = root_above(square.upper());
    if (region_.distance(pose_of(part)) <= reach_) {
      const PoseBox point = point_of(part.box);
      const double middle = 0.5 * (loaded.from + loaded.to);
      if (cell.enter(part.piece->chart, point) == CellAnswers::State::proven)
        seen.met = std::sqrt(std::max(0.0, displacement_.square(cell, middle, middle).lower()));
    }
    const Moves moves{square.a};
    seen.along = chosen(moves, part);
    seen.cut_loads = loaded.to > loaded.from && loaded.to - loaded.from >= widest(part);
    return seen;
  }

  struct Moves {
    std::array<double, Form::noises> of_square;
    std::array<double, Form::noises> spreads() const {
      std::array<double, Form::noises> sizes{};
      for (std::size_t p = 0; p < sizes.size(); ++p) sizes[p] = std::abs(of_square[p]);
      return sizes;
    }
  };

  static PoseBox point_of(const PoseBox& box) {
    PoseBox point = box;
    const std::vector<double> middle = middle_of(box);
    for (std::size_t p = 0; p < point.size(); ++p) point[p] = {middle[p], middle[p]};
    return point;
  }

  /// The largest width of a part, as a share of its piece's.
  static double widest(const PieceBox& part) {
    double most = 0;
    for (std::size_t p = 0; p < part.box.size(); ++p) {
      const auto& whole = part.piece->box[p];
      if (whole[1] > whole[0]) most = std::max(most, (part.box[p][1] - part.box[p][0]) / (whole[1] - whole[0]));
    }
    return most;
  }

  Displacement<Cell, Form> displacement_;
  bool ranged_;
  const PoseRegion& region_;
  double reach_, allowed_, accuracy_;
  const SearchBudget& budget_;
  SearchMeter meter_;
  tbb::enumerable_thread_specific<Cell> cells_;
  std::vector<PosePiece> pieces_;
  BoxSearch<LoadedPart> left_{SearchOrder::least_key_first};  ///< keys: bounds, negated
  PoseDisplacement found_;
};

}  // namespace

PoseDisplacement most_displaced(const core::PoseStatics& statics, std::size_t loads,
                                const std::vector<PoseTakeUp>& take_ups, const PoseRegion& region, double margin,
                                double allowed, double accuracy, const SearchBudget& budget) {
  core::ensure(statics.demands.empty() && loads >= 1 && loads <= 2 && loads < statics.loads,
               "loads, and unit forces behind them");
  return with_products(region)
             ? DisplacementSearch<PoseCell, Affine>(statics, loads, take_ups, region, margin, allowed, accuracy, budget)
                   .run()
             : DisplacementSearch<PoseCellOf<FlatAffine>, FlatAffine>(statics, loads, take_ups, region, margin, allowed,
                                                                      accuracy, budget)
                   .run();
}

}  // namespace clearloci::loci::pose
