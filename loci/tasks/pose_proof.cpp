#include "loci/tasks/pose_proof.hpp"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <atomic>
#include <deque>
#include <map>
#include <mutex>
#include <queue>
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

  /// Suspects at a pose, against the first pose that was seen.
  template <class Cell>
  std::vector<PoseSuspect> seen(Cell& cell, const Pose& pose) {
    const std::optional<CellAnswers::At> now = cell.at(pose);
    if (!now) return {{Doubt::workspace, -1, pose}};
    const std::lock_guard lock(mutex_);
    if (!first_) {
      first_ = {pose, *now};
    }
    std::vector<PoseSuspect> all;
    const auto& [base, then] = *first_;
    if (then.determinant != now->determinant) all.push_back({Doubt::singularity, -1, pose, base});
    for (std::size_t d = 0; d < statics_.demands.size(); ++d) {
      const double least = core::to_double(statics_.demands[d].demand.least);
      const auto& own = now->components[d];
      if (statics_.demands[d].demand.bound) {
        const auto is_beyond = [](const std::vector<double>& of_load) { return of_load.front() < 0; };
        if (std::any_of(own.begin(), own.end(), is_beyond)) all.push_back({Doubt::demand, static_cast<int>(d), pose});
        continue;
      }
      if (least > 0 && CellAnswers::size_of(own) < least) all.push_back({Doubt::demand, static_cast<int>(d), pose});
      // Between two loads it may point the other way at one of them.
      const bool turned = own.size() > 1 && own.front().size() == 1 && own.front()[0] * own.back()[0] < 0;
      bool opposite = turned;
      for (std::size_t load = 0; load < own.size(); ++load) {
        const double together = dot(own[load], then.components[d][load]);
        const double sizes =
            std::sqrt(dot(own[load], own[load]) * dot(then.components[d][load], then.components[d][load]));
        opposite = opposite || together < -(1 - no_direction) * sizes;
      }
      if (opposite)
        all.push_back({Doubt::demand, static_cast<int>(d), pose, turned ? std::nullopt : std::optional(base)});
    }
    return all;
  }

 private:
  const core::PoseStatics& statics_;
  std::mutex mutex_;
  std::optional<std::pair<Pose, CellAnswers::At>> first_;
};

template <class Cell>
class Search {
 public:
  Search(const core::PoseStatics& statics, const PoseRegion& region, double margin, const PoseRefuted& refuted,
         const PoseEffort& effort)
      : statics_(statics),
        region_(region),
        margin_(margin),
        reach_(margin + region.hair()),
        refuted_(refuted),
        effort_(effort),
        signs_(statics),
        pieces_(region.pieces(margin)) {}

  PoseProof run() {
    Cell cell(statics_);
    for (const Pose& pose : region_.samples())
      if (look(cell, pose)) return finished();
    std::deque<PieceBox> parts;
    for (const PosePiece& piece : pieces_) parts.push_back({&piece, piece.box});
    while (!parts.empty() && parts.size() < enough_parts && !stopped_) {
      const PieceBox part = std::move(parts.front());
      parts.pop_front();
      std::vector<PieceBox> left;
      visit(cell, part, left);
      for (PieceBox& own : left) parts.push_back(std::move(own));
    }
    tbb::enumerable_thread_specific<Cell> cells([&] { return Cell(statics_); });
    run_in_order(parts.size(), [&](std::size_t i) {
      Cell& own = cells.local();
      own.forget();
      std::vector<PieceBox> stack = {parts[i]};
      while (!stack.empty()) {
        const PieceBox part = std::move(stack.back());
        stack.pop_back();
        if (stopped_) {
          leave_open(part);
          continue;
        }
        visit(own, part, stack);
      }
    });
    return finished();
  }

 private:
  void visit(Cell& cell, const PieceBox& part, std::vector<PieceBox>& left) {
    if (region_.distance(*part.piece, part.box) > reach_) return;
    if (out_of_effort()) return leave_open(part);
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
    const double at =
        0.5 * (part.box[static_cast<std::size_t>(along)][0] + part.box[static_cast<std::size_t>(along)][1]);
    auto [low, high] = halves(part, static_cast<std::size_t>(along), at);
    left.push_back(std::move(high));
    left.push_back(std::move(low));
  }

  bool out_of_effort() {
    const long own = ++cells_;
    if (own > effort_.most_cells) out_of_cells_ = true;
    constexpr long between_clocks = 64;
    if (effort_.deadline && own % between_clocks == 0 && std::chrono::steady_clock::now() >= *effort_.deadline)
      out_of_time_ = true;
    if (out_of_cells_ || out_of_time_) stopped_ = true;
    return stopped_;
  }

  void leave_open(const PieceBox& part) {
    const std::lock_guard lock(mutex_);
    ++open_;
    widen(part, lower_, upper_);
    constexpr std::size_t most_open = 1000;  // the search ends where it stays open again and again
    if (open_ >= most_open) stopped_ = true;
  }

  /// Whether the task is refuted by what a pose looks like.
  bool look(Cell& cell, const Pose& pose) {
    for (const PoseSuspect& suspect : signs_.seen(cell, pose)) {
      const std::lock_guard lock(mutex_);
      if (refuted_found_) return true;
      int& vain = in_vain_[{suspect.kind, suspect.demand}];
      if (vain >= most_in_vain) continue;
      if (refuted_(suspect)) {
        refuted_found_ = true;
        stopped_ = true;
        return true;
      }
      ++vain;
    }
    return false;
  }

  PoseProof finished() {
    PoseProof proof;
    proof.cells = cells_;
    proof.open = open_;
    proof.lower = lower_;
    proof.upper = upper_;
    proof.out_of_time = out_of_time_;
    proof.out_of_cells = out_of_cells_;
    proof.verdict = refuted_found_ ? core::Verdict::refuted
                    : open_ == 0   ? core::Verdict::verified
                                   : core::Verdict::undecided;
    return proof;
  }

  const core::PoseStatics& statics_;
  const PoseRegion& region_;
  double margin_, reach_;
  const PoseRefuted& refuted_;
  const PoseEffort& effort_;
  Signs signs_;
  std::vector<PosePiece> pieces_;
  std::mutex mutex_;
  std::atomic<long> cells_ = 0;
  std::atomic<int> doubts_ = 0;
  std::atomic<bool> stopped_ = false, out_of_time_ = false, out_of_cells_ = false;
  bool refuted_found_ = false;
  std::map<std::pair<Doubt, int>, int> in_vain_;
  std::size_t open_ = 0;
  Pose lower_, upper_;
};

/// Parts by a number, the least first, looked at some at a time on all cores until `done`.
template <class Cell, class Better>
class BestFirst {
 public:
  struct Item {
    double key = 0;
    PieceBox part;
  };
  explicit BestFirst(const core::PoseStatics& statics) : cells_([&statics] { return Cell(statics); }) {}

  void push(double key, PieceBox part) { queue_.push({key, std::move(part)}); }
  bool empty() const { return queue_.empty(); }
  double least() const { return queue_.top().key; }
  long looked_at() const { return looked_at_; }

  /// `look(cell, item, out)`: what is to be looked at further.
  template <class Look>
  void step(const Look& look) {
    constexpr std::size_t at_once = 64, at_a_time = 8;
    std::vector<Item> items;
    while (!queue_.empty() && items.size() < at_once) {
      items.push_back(queue_.top());
      queue_.pop();
    }
    looked_at_ += static_cast<long>(items.size());
    std::vector<std::vector<Item>> found(items.size());
    run_in_order((items.size() + at_a_time - 1) / at_a_time, [&](std::size_t part) {
      Cell& cell = cells_.local();
      cell.forget();
      for (std::size_t i = part * at_a_time; i < std::min(items.size(), (part + 1) * at_a_time); ++i)
        look(cell, items[i], found[i]);
    });
    for (std::vector<Item>& own : found)
      for (Item& item : own) queue_.push(std::move(item));
  }

 private:
  std::priority_queue<Item, std::vector<Item>, Better> queue_;
  tbb::enumerable_thread_specific<Cell> cells_;
  long looked_at_ = 0;
};

struct LargerKey {
  template <class Item>
  bool operator()(const Item& a, const Item& b) const {
    return a.key > b.key;
  }
};

template <class Cell>
std::vector<double> least_by(const core::PoseStatics& statics, const PoseRegion& region, const std::vector<double>& met,
                             double accuracy, const PoseEffort& effort) {
  const std::vector<PosePiece> pieces = region.pieces(0);
  const std::size_t demands = statics.demands.size();
  std::vector<double> proven = met;
  // A cell is cut until every reaction in it has nearly the least that was met anywhere.
  using Queue = BestFirst<Cell, LargerKey>;
  Queue queue(statics);
  const auto share = [&](const std::vector<double>& least) {
    double worst = 1;
    for (std::size_t d = 0; d < demands; ++d)
      if (met[d] > 0) worst = std::min(worst, least[d] / met[d]);
    return worst;
  };
  std::mutex mutex;
  std::vector<double> done = met;  // of the cells that are not looked at further
  for (const PosePiece& piece : pieces) queue.push(0, {&piece, piece.box});
  const auto keep = [&](const std::vector<double>& least) {
    const std::lock_guard lock(mutex);
    for (std::size_t d = 0; d < demands; ++d) done[d] = std::min(done[d], least[d]);
  };
  while (!queue.empty()) {
    const bool last = over(effort, queue.looked_at());
    queue.step([&](Cell& cell, const typename Queue::Item& item, std::vector<typename Queue::Item>& found) {
      const PieceBox& part = item.part;
      if (region.distance(*part.piece, part.box) > region.hair()) return;
      const bool good = cell.enter(part.piece->chart, part.box) == CellAnswers::State::proven;
      const std::vector<double> least = good ? cell.least_sizes() : std::vector<double>(demands, 0.0);
      const double own = share(least);
      const int along = last || own >= 1 - accuracy ? -1 : chosen(cell, part);
      if (along < 0) return keep(least);
      const auto parameter = static_cast<std::size_t>(along);
      const double at = 0.5 * (part.box[parameter][0] + part.box[parameter][1]);
      auto [low, high] = halves(part, parameter, at);
      found.push_back({own, std::move(low)});
      found.push_back({own, std::move(high)});
    });
  }
  for (std::size_t d = 0; d < demands; ++d) proven[d] = std::max(0.0, std::min(proven[d], done[d]));
  return proven;
}

}  // namespace

PoseProof prove_poses(const core::PoseStatics& statics, const PoseRegion& region, double margin,
                      const PoseRefuted& refuted, const PoseEffort& effort) {
  return with_products(region) ? Search<PoseCell>(statics, region, margin, refuted, effort).run()
                               : Search<PoseCellOf<FlatAffine>>(statics, region, margin, refuted, effort).run();
}

double pose_clearance(const core::PoseStatics& statics, const PoseRegion& region, double from, double limit,
                      double accuracy, const PoseEffort& effort) {
  // What looks like failing is enough here: it ends an attempt.
  const PoseRefuted any = [](const PoseSuspect&) { return true; };
  constexpr int most_attempts = 40;
  // Wider margins take many times the cells: small steps first, so that something is proven before they run out.
  double proven = from, too_far = limit, part = 1.0 / 16;
  long cells = 0;
  for (int attempt = 0; attempt < most_attempts && proven < (1 - accuracy) * too_far; ++attempt) {
    PoseEffort left = effort;
    left.most_cells -= cells;
    if (left.most_cells <= 0 || (effort.deadline && std::chrono::steady_clock::now() >= *effort.deadline)) break;
    const double margin = proven + part * (too_far - proven);
    const PoseProof proof = prove_poses(statics, region, margin, any, left);
    cells += proof.cells;
    (proof.verdict == core::Verdict::verified ? proven : too_far) = margin;
    part = std::min(0.5, 2 * part);
  }
  return proven;
}

std::vector<double> least_sizes(const core::PoseStatics& statics, const PoseRegion& region,
                                const std::vector<double>& met, double accuracy, const PoseEffort& effort) {
  return with_products(region) ? least_by<PoseCell>(statics, region, met, accuracy, effort)
                               : least_by<PoseCellOf<FlatAffine>>(statics, region, met, accuracy, effort);
}

}  // namespace clearloci::loci::pose
