#include "loci/tasks/pose_proof.hpp"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <map>
#include <mutex>
#include <utility>

#include "loci/search/search.hpp"
#include "loci/tasks/pose_parts.hpp"

namespace clearloci::loci::pose {
namespace {

/// Cells to be handed out to threads.
constexpr std::size_t enough_parts = 256;
/// Suspects of one kind that a witness could not confirm, until no more are shown to it.
constexpr int most_in_vain = 8;
/// Cells in doubt between two whose middle is looked at.
constexpr int between_looks = 4;
/// So little of what is usual is no direction.
constexpr double no_direction = 1e-9;

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// What poses have in common where nothing vanishes between them.
class Signs {
 public:
  explicit Signs(const core::PoseStatics& statics) : statics_(statics) {}

  /// Suspects at a pose, against the first poses that were seen.
  template <class Cell>
  std::vector<PoseSuspect> seen(Cell& cell, const Pose& pose) {
    const std::optional<CellAnswers::At> now = cell.at(pose);
    if (!now) return {{Doubt::workspace, -1, pose}};
    const std::lock_guard lock(mutex_);
    if (!first_) {
      first_ = {pose, now->determinant};
      for (const auto& component : now->components) bases_.push_back({pose, component});
    }
    std::vector<PoseSuspect> all;
    if (first_->second != now->determinant) all.push_back({Doubt::singularity, -1, pose, first_->first});
    for (std::size_t d = 0; d < statics_.demands.size(); ++d) {
      const double least = core::to_double(statics_.demands[d].demand.least);
      const auto& component = now->components[d];
      if (statics_.demands[d].demand.bound) {
        const auto is_beyond = [](const std::vector<double>& of_load) { return of_load.front() < 0; };
        if (std::any_of(component.begin(), component.end(), is_beyond))
          all.push_back({Doubt::demand, static_cast<int>(d), pose});
        continue;
      }
      if (least > 0 && CellAnswers::size_of(component) < least)
        all.push_back({Doubt::demand, static_cast<int>(d), pose});
      // Between two loads it may point the other way at one of them.
      const bool turned =
          component.size() > 1 && component.front().size() == 1 && component.front()[0] * component.back()[0] < 0;
      Base& base_of_demand = bases_[d];
      bool opposite = turned;
      if (is_rounding(base_of_demand.components, component)) {
        base_of_demand = {pose, component};
      } else {
        for (std::size_t load = 0; load < component.size(); ++load) {
          const std::vector<double>&here = component[load], &there = base_of_demand.components[load];
          opposite =
              opposite || dot(here, there) < -(1 - no_direction) * std::sqrt(dot(here, here) * dot(there, there));
        }
      }
      if (opposite)
        all.push_back(
            {Doubt::demand, static_cast<int>(d), pose, turned ? std::nullopt : std::optional(base_of_demand.at)});
    }
    return all;
  }

 private:
  /// Of a demand: a pose at which it is more than what rounding leaves of it at a zero, and its components there, load
  /// by load.
  struct Base {
    Pose at;
    std::vector<std::vector<double>> components;
  };

  static bool is_rounding(const std::vector<std::vector<double>>& base, const std::vector<std::vector<double>>& now) {
    constexpr double rounding = 1e-10;
    const double size = CellAnswers::size_of(base);
    return size < rounding * CellAnswers::size_of(now);
  }

  const core::PoseStatics& statics_;
  std::mutex mutex_;
  std::optional<std::pair<Pose, int>> first_;  ///< and the sign of |A| there
  std::vector<Base> bases_;
};

template <class Cell>
class Search {
 public:
  Search(const core::PoseStatics& statics, const PoseRegion& region, double margin, const PoseRefuted& refuted,
         const SearchBudget& budget)
      : statics_(statics),
        region_(region),
        margin_(margin),
        reach_(margin + region.hair()),
        refuted_(refuted),
        meter_(budget),
        signs_(statics),
        pieces_(region.pieces(margin)) {}

  CoverProof run() {
    Cell cell(statics_);
    for (const Pose& pose : region_.samples())
      if (look(cell, pose)) return finished();
    BoxSearch<PieceBox> parts(SearchOrder::breadth_first);
    for (const PosePiece& piece : pieces_) parts.push({&piece, piece.box});
    while (!parts.empty() && parts.size() < enough_parts && !meter_.is_stopped()) visit(cell, parts.take(), parts);
    tbb::enumerable_thread_specific<Cell> cells([&] { return Cell(statics_); });
    look_in_parts(parts.size(), 1, cells, [&](Cell& candidate, std::size_t i) {
      BoxSearch<PieceBox> left(SearchOrder::depth_first);
      left.push(std::move(parts[i].box));
      while (!left.empty() && !meter_.is_stopped()) visit(candidate, left.take(), left);
      for (const auto& part : left) leave_open(part.box);
    });
    return finished();
  }

 private:
  void visit(Cell& cell, const PieceBox& part, BoxSearch<PieceBox>& left) {
    if (region_.distance(*part.piece, part.box) > reach_) return;
    if (!meter_.begin()) return leave_open(part);
    const CellAnswers::State state = cell.enter(part.piece->chart, part.box);
    if (state == CellAnswers::State::proven) return;
    const int along = chosen(cell, part);
    const bool fine = along < 0;
    if (fine || state == CellAnswers::State::outside || ++doubts_ % between_looks == 0) {
      // The cell is entered again at its middle: what it said is known by now.
      const Pose pose = pose_of(part);
      if (region_.distance(pose) <= margin_ * (1 - 1e-9) + region_.hair() && look(cell, pose)) return;
    }
    if (fine) return leave_open(part);
    auto [low, high] = halves_of(part, static_cast<std::size_t>(along));
    left.push(std::move(high));
    left.push(std::move(low));
  }

  void leave_open(const PieceBox& part) {
    const std::lock_guard lock(mutex_);
    proof_.leave_open(poses_of(part));
    constexpr std::size_t most_open = 1000;  // the search ends where it stays open again and again
    if (proof_.open >= most_open) meter_.stop();
  }

  /// Whether the task is refuted by what a pose looks like.
  bool look(Cell& cell, const Pose& pose) {
    for (const PoseSuspect& suspect : signs_.seen(cell, pose)) {
      const std::lock_guard lock(mutex_);
      if (is_refuted()) return true;
      int& vain = in_vain_[{suspect.kind, suspect.demand}];
      if (vain >= most_in_vain) continue;
      if (refuted_(suspect)) {
        proof_.verdict = core::Verdict::refuted;
        meter_.stop();
        return true;
      }
      ++vain;
    }
    return false;
  }

  bool is_refuted() const { return proof_.verdict == core::Verdict::refuted; }

  CoverProof finished() {
    proof_.cost = meter_.cost();
    if (!is_refuted() && proof_.open == 0) proof_.verdict = core::Verdict::verified;
    return std::move(proof_);
  }

  const core::PoseStatics& statics_;
  const PoseRegion& region_;
  double margin_, reach_;
  const PoseRefuted& refuted_;
  SearchMeter meter_;
  Signs signs_;
  std::vector<PosePiece> pieces_;
  std::mutex mutex_;
  std::atomic<int> doubts_ = 0;
  std::map<std::pair<Doubt, int>, int> in_vain_;
  CoverProof proof_;
};

template <class Cell>
std::vector<double> least_by(const core::PoseStatics& statics, const PoseRegion& region, const std::vector<double>& met,
                             double accuracy, const SearchBudget& budget) {
  const std::vector<PosePiece> pieces = region.pieces(0);
  const std::size_t demands = statics.demands.size();
  std::vector<double> proven = met;
  const auto share = [&](const std::vector<double>& least) {
    double worst = 1;
    for (std::size_t d = 0; d < demands; ++d)
      if (met[d] > 0) worst = std::min(worst, least[d] / met[d]);
    return worst;
  };
  std::mutex mutex;
  std::vector<double> done = met;  // of the cells that are not looked at further
  const auto keep = [&](const std::vector<double>& least) {
    const std::lock_guard lock(mutex);
    for (std::size_t d = 0; d < demands; ++d) done[d] = std::min(done[d], least[d]);
  };
  // A cell is cut until every reaction in it has nearly the least that was met anywhere.
  SearchMeter meter(budget);
  BoxSearch<PieceBox> left(SearchOrder::least_key_first);
  for (const PosePiece& piece : pieces) left.push({&piece, piece.box});
  tbb::enumerable_thread_specific<Cell> cells([&] { return Cell(statics); });
  while (!left.empty()) {
    constexpr std::size_t at_once = 64, at_a_time = 8;
    const auto some = left.take(at_once, std::numeric_limits<double>::infinity());
    const bool last = !meter.begin(static_cast<long>(some.size()));
    struct Cut {
      int along = -1;
      double share = 0;
    };
    std::vector<Cut> cuts(some.size());
    look_in_parts(some.size(), at_a_time, cells, [&](Cell& cell, std::size_t i) {
      const PieceBox& part = some[i].box;
      if (region.distance(*part.piece, part.box) > region.hair()) return;
      const bool good = cell.enter(part.piece->chart, part.box) == CellAnswers::State::proven;
      const std::vector<double> least = good ? cell.least_sizes() : std::vector<double>(demands, 0.0);
      cuts[i].share = share(least);
      if (!last && cuts[i].share < 1 - accuracy) cuts[i].along = chosen(cell, part);
      if (cuts[i].along < 0) keep(least);
    });
    for (std::size_t i = 0; i < some.size(); ++i)
      if (cuts[i].along >= 0)
        for (PieceBox& half : halves_of(some[i].box, static_cast<std::size_t>(cuts[i].along)))
          left.push(std::move(half), cuts[i].share);
  }
  for (std::size_t d = 0; d < demands; ++d) proven[d] = std::max(0.0, std::min(proven[d], done[d]));
  return proven;
}

}  // namespace

CoverProof prove_poses(const core::PoseStatics& statics, const PoseRegion& region, double margin,
                       const PoseRefuted& refuted, const SearchBudget& budget) {
  return with_products(region) ? Search<PoseCell>(statics, region, margin, refuted, budget).run()
                               : Search<PoseCellOf<FlatAffine>>(statics, region, margin, refuted, budget).run();
}

double pose_clearance(const core::PoseStatics& statics, const PoseRegion& region, double from, double limit,
                      double accuracy, const SearchBudget& budget) {
  // What looks like failing is enough here: it ends an attempt.
  const PoseRefuted any = [](const PoseSuspect&) { return true; };
  constexpr int most_attempts = 40;
  // Wider margins take many times the cells: small steps first, so that something is proven before they run out.
  double proven = from, too_far = limit, part = 1.0 / 16;
  long cells = 0;
  for (int attempt = 0; attempt < most_attempts && proven < (1 - accuracy) * too_far; ++attempt) {
    SearchBudget left = budget;
    left.most_cells -= cells;
    if (left.most_cells <= 0 || left.is_out_of_time()) break;
    const double margin = proven + part * (too_far - proven);
    const CoverProof proof = prove_poses(statics, region, margin, any, left);
    cells += proof.cost.cells;
    (proof.verdict == core::Verdict::verified ? proven : too_far) = margin;
    part = std::min(0.5, 2 * part);
  }
  return proven;
}

std::vector<double> least_sizes(const core::PoseStatics& statics, const PoseRegion& region,
                                const std::vector<double>& met, double accuracy, const SearchBudget& budget) {
  return with_products(region) ? least_by<PoseCell>(statics, region, met, accuracy, budget)
                               : least_by<PoseCellOf<FlatAffine>>(statics, region, met, accuracy, budget);
}

}  // namespace clearloci::loci::pose
