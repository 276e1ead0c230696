#include "loci/tasks/choice_proof.hpp"

#include <chrono>
#include <map>
#include <utility>

#include "loci/tasks/pose_parts.hpp"

namespace clearloci::loci::pose {
namespace {

template <class Cell>
class ChoiceSearch {
 public:
  ChoiceSearch(PoseChooser& chooser, const PoseRegion& region, double margin, const PoseEffort& effort)
      : chooser_(chooser), region_(region), margin_(margin), effort_(effort), pieces_(region.pieces(margin)) {}

  PoseProof run() {
    for (const Pose& pose : region_.samples())
      if (refuted(pose)) return finished();
    std::vector<PieceBox> stack;
    for (const PosePiece& piece : pieces_) stack.push_back({&piece, piece.box});
    while (!stack.empty() && proof_.verdict != core::Verdict::refuted) {
      const PieceBox part = std::move(stack.back());
      stack.pop_back();
      visit(part, stack);
    }
    return finished();
  }

 private:
  bool refuted(const Pose& pose) {
    if (chooser_.choose(pose) || !chooser_.refutes(pose)) return false;
    proof_.verdict = core::Verdict::refuted;
    return true;
  }

  void visit(const PieceBox& part, std::vector<PieceBox>& left) {
    if (region_.distance(*part.piece, part.box) > margin_ + region_.hair()) return;
    if (out_of_effort()) return leave_open(part);
    const Pose pose = pose_of(part);
    const std::optional<PoseChoice> choice = chooser_.choose(pose);
    if (!choice) {
      const bool in_task = region_.distance(pose) <= margin_ * (1 - 1e-9) + region_.hair();
      if (in_task && refuted(pose)) return;
      return cut(widest(part), part, left);
    }
    Cell& cell = cell_of(*choice->statics);
    const PoseChart chart = extended(part.piece->chart, choice->values);
    if (cell.enter(chart, part.box) == CellAnswers::State::proven) return;
    cut(chosen(cell, part), part, left);
  }

  static PoseChart extended(PoseChart chart, const std::vector<double>& values) {
    chart.base.insert(chart.base.end(), values.begin(), values.end());
    for (Pose& way : chart.ways) way.resize(chart.base.size(), 0.0);
    return chart;
  }

  Cell& cell_of(const core::PoseStatics& statics) {
    const auto known = cells_.find(&statics);
    return known != cells_.end() ? known->second : cells_.try_emplace(&statics, statics).first->second;
  }

  static int widest(const PieceBox& part) {
    int best = -1;
    double most = finest;
    for (std::size_t p = 0; p < part.box.size(); ++p) {
      const auto& whole = part.piece->box[p];
      const double share = (part.box[p][1] - part.box[p][0]) / (whole[1] - whole[0]);
      if (!(share > most)) continue;
      most = share;
      best = static_cast<int>(p);
    }
    return best;
  }

  void cut(int along, const PieceBox& part, std::vector<PieceBox>& left) {
    if (along < 0) return leave_open(part);
    const auto& [low, high] = part.box[static_cast<std::size_t>(along)];
    auto [first, second] = halves(part, static_cast<std::size_t>(along), 0.5 * (low + high));
    left.push_back(std::move(second));
    left.push_back(std::move(first));
  }

  bool out_of_effort() {
    ++proof_.cells;
    proof_.out_of_cells = proof_.out_of_cells || proof_.cells > effort_.most_cells;
    proof_.out_of_time =
        proof_.out_of_time || (effort_.deadline && std::chrono::steady_clock::now() >= *effort_.deadline);
    return proof_.out_of_cells || proof_.out_of_time;
  }

  void leave_open(const PieceBox& part) {
    ++proof_.open;
    widen(part, proof_.lower, proof_.upper);
  }

  PoseProof finished() {
    if (proof_.verdict != core::Verdict::refuted && proof_.open == 0) proof_.verdict = core::Verdict::verified;
    return std::move(proof_);
  }

  PoseChooser& chooser_;
  const PoseRegion& region_;
  double margin_;
  const PoseEffort& effort_;
  std::vector<PosePiece> pieces_;
  std::map<const core::PoseStatics*, Cell> cells_;
  PoseProof proof_;
};

}  // namespace

PoseProof prove_with_choice(PoseChooser& chooser, const PoseRegion& region, double margin, const PoseEffort& effort) {
  return with_products(region) ? ChoiceSearch<PoseCell>(chooser, region, margin, effort).run()
                               : ChoiceSearch<PoseCellOf<FlatAffine>>(chooser, region, margin, effort).run();
}

}  // namespace clearloci::loci::pose
