#include "loci/tasks/effort_proof.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "loci/tasks/effort_cell.hpp"
#include "loci/tasks/pose_parts.hpp"

namespace clearloci::loci::pose {
namespace {

/// Poses of a piece, with parts of the designs that together are all.
struct EffortPart {
  std::size_t piece = 0;
  PoseBox box;
  std::vector<PoseBox> designs;
  const EffortStatics* statics = nullptr;  ///< what was chosen for the part that it was cut from
  EffortChoice choice = {};
};

bool touch(const PoseBox& a, const PoseBox& b) {
  for (std::size_t p = 0; p < a.size(); ++p)
    if (a[p][0] > b[p][1] || b[p][0] > a[p][1]) return false;
  return true;
}

template <class Form>
class EffortSearch {
 public:
  EffortSearch(EffortChooser& chooser, const PoseRegion& region, PoseBox designs, double margin,
               const SearchBudget& budget)
      : chooser_(chooser),
        region_(region),
        designs_(std::move(designs)),
        margin_(margin),
        meter_(budget),
        pieces_(region.pieces(margin)) {
    for (const PosePiece& piece : pieces_) wider_.push_back(with_designs(piece));
  }

  EffortProof run() {
    for (const Pose& pose : region_.samples())
      if (refuted(pose)) return finished();
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      EffortPart part{i, pieces_[i].box, {designs_}};
      choose_one_for_all(part);
      left_.push(std::move(part));
    }
    while (!left_.empty()) {
      while (!left_.empty() && !is_refuted()) visit(left_.take());
      if (is_refuted() || proof_.open > 0) return finished();
      cut_where_efforts_do_not_join();
    }
    return finished();
  }

 private:
  using Box = std::vector<std::array<double, 2>>;

  /// Efforts that seem good at the middle and the corners of a piece: cells that share them need no joining.
  void choose_one_for_all(EffortPart& part) {
    const EffortStatics* const statics = chooser_.statics_at(middle(part));
    std::vector<EffortColumns> columns;
    constexpr std::size_t most_corners = 16;
    const std::size_t corners = std::min(most_corners, std::size_t{1} << part.box.size());
    EffortPart point = part;
    for (std::size_t corner = 0; corner <= corners; ++corner) {
      for (std::size_t p = 0; p < part.box.size(); ++p) {
        const double at = corner == corners ? 0.5 * (part.box[p][0] + part.box[p][1]) : part.box[p][corner >> p & 1];
        point.box[p] = {at, at};
      }
      if (region_.distance(pieces_[part.piece], point.box) > margin_ + region_.hair()) continue;
      if (statics == nullptr || chooser_.statics_at(middle(point)) != statics) return;
      if (!joint_.enter(*statics, wider_[part.piece].chart, together(point.box, middles(designs_)))) return;
      columns.push_back(joint_.columns());
    }
    const std::optional<EffortChoice> choice = chooser_.choose(*statics, columns);
    if (!choice) return;
    part.statics = statics;
    part.choice = *choice;
  }

  static PoseBox middles(PoseBox box) {
    for (auto& [low, high] : box) low = high = 0.5 * (low + high);
    return box;
  }

  bool is_refuted() const { return proof_.verdict == core::Verdict::refuted; }

  bool refuted(const Pose& pose) {
    if (!chooser_.refutes(pose)) return false;
    proof_.verdict = core::Verdict::refuted;
    return true;
  }

  PosePiece with_designs(PosePiece piece) const {
    const std::size_t poses = piece.chart.base.size();
    piece.chart.base.resize(poses + designs_.size(), 0.0);
    for (Pose& way : piece.chart.ways) way.resize(piece.chart.base.size(), 0.0);
    for (std::size_t v = 0; v < designs_.size(); ++v) {
      Pose way(piece.chart.base.size(), 0.0);
      way[poses + v] = 1;
      piece.chart.ways.push_back(std::move(way));
      piece.box.push_back(designs_[v]);
    }
    return piece;
  }

  static Box together(Box box, const Box& design) {
    box.insert(box.end(), design.begin(), design.end());
    return box;
  }

  Pose middle(const EffortPart& part) const { return pieces_[part.piece].chart.at(middle_of(part.box)); }

  void visit(const EffortPart& part) {
    const PosePiece& piece = pieces_[part.piece];
    if (region_.distance(piece, part.box) > margin_ + region_.hair()) return;
    if (!meter_.begin()) return leave_open(part);
    const Pose pose = middle(part);
    const EffortStatics* const statics = chooser_.statics_at(pose);
    if (statics == nullptr) return without_choice(part, pose);
    std::vector<EffortColumns> columns;
    std::vector<EffortCellOf<Form>> cells(part.designs.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const Box box = together(part.box, part.designs[i]);
      if (!cells[i].enter(*statics, wider_[part.piece].chart, box))
        return cells[i].is_outside() ? without_choice(part, pose) : cut_by(part, i, cells[i].spreads());
      columns.push_back(cells[i].columns());
    }
    if (part.statics == statics) {
      const EffortChoice turned = chooser_.turned(*statics, columns, part.choice);
      if (keeps(cells, turned)) return keep(part, statics, turned);
      // What seems good at the middle of a large cell is proven in smaller ones.
      constexpr double large = 1.0 / 16;
      const int along = widest(part);
      if (along >= 0 && share(part, static_cast<std::size_t>(along)) > large && seem_to_keep(cells, turned))
        return cut_where_open(part, cells, turned);
    }
    const std::optional<EffortChoice> choice = chooser_.choose(*statics, columns);
    if (!choice) return without_choice(part, pose);
    if (keeps(cells, *choice)) return keep(part, statics, *choice);
    EffortPart effort_part = part;
    effort_part.statics = statics;
    effort_part.choice = *choice;
    cut_where_open(effort_part, cells, *choice);
  }

  void cut_where_open(const EffortPart& part, std::vector<EffortCellOf<Form>>& cells, const EffortChoice& choice) {
    for (std::size_t i = 0; i < cells.size(); ++i)
      if (!cells[i].keeps(choice)) return cut_by(part, i, cells[i].spreads());
  }

  static bool seem_to_keep(const std::vector<EffortCellOf<Form>>& cells, const EffortChoice& choice) {
    return std::all_of(cells.begin(), cells.end(),
                       [&](const EffortCellOf<Form>& cell) { return cell.seems_to_keep(choice); });
  }

  static bool keeps(std::vector<EffortCellOf<Form>>& cells, const EffortChoice& choice) {
    return std::all_of(cells.begin(), cells.end(), [&](EffortCellOf<Form>& cell) { return cell.keeps(choice); });
  }

  void keep(EffortPart part, const EffortStatics* statics, const EffortChoice& choice) {
    part.statics = statics;
    part.choice = choice;
    kept_.push_back(std::move(part));
  }

  void without_choice(const EffortPart& part, const Pose& pose) {
    const bool in_task = region_.distance(pose) <= margin_ * (1 - 1e-9) + region_.hair();
    if (in_task && refuted(pose)) return;
    // Where the chooser finds nothing in small cells either, none of the others makes a proof.
    constexpr double small = 1.0 / 256;
    const int along = widest(part);
    if (along >= 0 && share(part, static_cast<std::size_t>(along)) > small) return cut(part, along);
    leave_open(part);
    for (const auto& other : left_) leave_open(other.box);
    left_.clear();
  }

  double share(const EffortPart& part, std::size_t p) const {
    const auto& whole = pieces_[part.piece].box[p];
    return (part.box[p][1] - part.box[p][0]) / (whole[1] - whole[0]);
  }

  int widest(const EffortPart& part) const {
    int best = -1;
    double most = finest;
    for (std::size_t p = 0; p < part.box.size(); ++p) {
      const double halved = share(part, p);
      if (!(halved > most)) continue;
      most = halved;
      best = static_cast<int>(p);
    }
    return best;
  }

  /// Where a design moves what is in doubt most, the designs are cut: what is chosen stays that of all.
  void cut_by(EffortPart part, std::size_t design, const typename EffortCellOf<Form>::Spreads& spreads) {
    struct Moved {
      const typename EffortCellOf<Form>::Spreads& all;
      const typename EffortCellOf<Form>::Spreads& spreads() const { return all; }
    };
    constexpr std::size_t most_designs = 64;
    const int along = chosen(Moved{spreads}, PieceBox{&wider_[part.piece], together(part.box, part.designs[design])});
    const auto poses = static_cast<int>(part.box.size());
    if (along < poses || part.designs.size() >= most_designs) return cut(part, along < poses ? along : widest(part));
    const auto v = static_cast<std::size_t>(along - poses);
    auto [low, high] = halves_of(part.designs[design], v);
    part.designs[design] = std::move(low);
    part.designs.push_back(std::move(high));
    left_.push(std::move(part));
  }

  void cut(const EffortPart& part, int along) {
    if (along < 0) return leave_open(part);
    EffortPart first = part, second = part;
    auto [low, high] = halves_of(part.box, static_cast<std::size_t>(along));
    first.box = std::move(low);
    second.box = std::move(high);
    left_.push(std::move(second));
    left_.push(std::move(first));
  }

  void leave_open(const EffortPart& part) { proof_.leave_open(poses_of(part)); }

  PoseBox poses_of(const EffortPart& part) const { return pose::poses_of({&pieces_[part.piece], part.box}); }

  /// Which other cells each cell touches.
  std::vector<std::vector<std::size_t>> neighbours() const {
    std::vector<PoseBox> boxes;
    for (const EffortPart& part : kept_) boxes.push_back(poses_of(part));
    std::vector<std::size_t> order(kept_.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return boxes[a].front()[0] < boxes[b].front()[0]; });
    std::vector<std::vector<std::size_t>> all(kept_.size());
    for (std::size_t i = 0; i < order.size(); ++i)
      for (std::size_t k = i + 1; k < order.size(); ++k) {
        const std::size_t a = order[i], b = order[k];
        if (boxes[b].front()[0] > boxes[a].front()[1]) break;
        const EffortChoice &one = kept_[a].choice, &other = kept_[b].choice;
        const bool same =
            kept_[a].statics == kept_[b].statics && one.efforts == other.efforts && one.gains == other.gains;
        if (same || !touch(boxes[a], boxes[b])) continue;
        all[a].push_back(b);
        all[b].push_back(a);
      }
    return all;
  }

  /// Cells that touch and whose efforts are not proven to join are cut further.
  void cut_where_efforts_do_not_join() {
    const bool several = std::any_of(kept_.begin(), kept_.end(), [](const EffortPart& part) {
      const auto& all = part.statics->demands;
      return std::any_of(all.begin(), all.end(), [](const auto& each) { return each.components.size() > 1; });
    });
    if (!several) return;
    const std::vector<std::vector<std::size_t>> near = neighbours();
    std::vector<std::optional<std::size_t>> apart(kept_.size());  // from which other cell
    for (std::size_t j = 0; j < kept_.size(); ++j)
      for (const std::size_t i : without_common_way(j, near[j])) {
        if (!apart[i]) apart[i] = j;
        if (!apart[j]) apart[j] = i;
      }
    std::vector<EffortPart> joined;
    for (std::size_t i = 0; i < kept_.size(); ++i) {
      if (!apart[i]) {
        joined.push_back(kept_[i]);
        continue;
      }
      // Each half tries what is chosen in the cell before it, then anew.
      EffortPart part = kept_[i];
      part.statics = *apart[i] < i ? kept_[*apart[i]].statics : nullptr;
      if (*apart[i] < i) part.choice = kept_[*apart[i]].choice;
      cut(part, widest(part));
    }
    kept_ = std::move(joined);
  }

  /// Those of the neighbours of a cell along whose ways its own efforts are not proven good where the two meet.
  std::vector<std::size_t> without_common_way(std::size_t j, const std::vector<std::size_t>& near) {
    std::vector<std::size_t> left = near;
    const EffortPart& part = kept_[j];
    keep_apart(part, part.box, left);
    std::vector<std::size_t> apart;
    for (const std::size_t i : left) {
      std::vector<std::size_t> one = {i};
      if (kept_[i].piece == part.piece) {
        Box common = part.box;
        for (std::size_t p = 0; p < common.size(); ++p)
          common[p] = {std::max(common[p][0], kept_[i].box[p][0]), std::min(common[p][1], kept_[i].box[p][1])};
        keep_apart(part, common, one);
      }
      if (!one.empty()) apart.push_back(i);
    }
    return apart;
  }

  /// Leaves those of `others` along whose ways the efforts of a cell are not proven good in a box.
  void keep_apart(const EffortPart& part, const Box& box, std::vector<std::size_t>& others) {
    std::vector<std::size_t> good = others;
    for (std::size_t i = 0; i < part.designs.size() && !good.empty(); ++i) {
      if (!joint_.enter(*part.statics, wider_[part.piece].chart, together(box, part.designs[i]))) return;
      std::erase_if(good, [&](std::size_t other) { return !has_common_ways(part, kept_[other]); });
    }
    std::erase_if(others, [&](std::size_t i) { return std::find(good.begin(), good.end(), i) != good.end(); });
  }

  bool has_common_ways(const EffortPart& part, const EffortPart& other) {
    for (std::size_t d = 0; d < part.statics->demands.size(); ++d) {
      const core::PoseDemand& demand = part.statics->demands[d];
      if (demand.components.size() == 1) continue;
      const auto& all = other.statics->demands;
      const auto same = std::find_if(all.begin(), all.end(), [&](const core::PoseDemand& each) {
        return each.demand.joint == demand.demand.joint && each.demand.quantity == demand.demand.quantity;
      });
      if (same == all.end()) return false;
      if (!joint_.keeps(d, part.choice, other.choice.ways[static_cast<std::size_t>(same - all.begin())])) return false;
    }
    return true;
  }

  EffortProof finished() {
    proof_.cost = meter_.cost();
    if (!is_refuted() && proof_.open == 0) proof_.verdict = core::Verdict::verified;
    EffortProof result{std::move(proof_), {}};
    if (result.proof.verdict != core::Verdict::verified) return result;
    for (EffortPart& part : kept_) {
      EffortCell& cell = result.cells.emplace_back();
      cell.poses = poses_of(part);
      cell.statics = part.statics;
      cell.choice = std::move(part.choice);
    }
    return result;
  }

  EffortChooser& chooser_;
  const PoseRegion& region_;
  PoseBox designs_;
  double margin_;
  SearchMeter meter_;
  std::vector<PosePiece> pieces_, wider_;
  BoxSearch<EffortPart> left_{SearchOrder::depth_first};
  std::vector<EffortPart> kept_;
  EffortCellOf<Form> joint_;
  CoverProof proof_;
};

}  // namespace

EffortProof prove_with_efforts(EffortChooser& chooser, const PoseRegion& region, const PoseBox& designs, double margin,
                               const SearchBudget& budget) {
  const bool products = region.coordinates() + designs.size() <= Affine::curved;
  return products ? EffortSearch<Affine>(chooser, region, designs, margin, budget).run()
                  : EffortSearch<FlatAffine>(chooser, region, designs, margin, budget).run();
}

}  // namespace clearloci::loci::pose
