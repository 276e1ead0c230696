#include "mechanism/assembly/smallest_group.hpp"

#include <algorithm>
#include <optional>

namespace clearloci::mechanism {
namespace {

class Matching {
 public:
  Matching(std::size_t points, std::size_t each, const std::vector<std::vector<std::size_t>>& equations)
      : each_(each), equations_(equations), matched_(points) {
    for (std::size_t e = 0; e < equations.size(); ++e) {
      seen_.assign(points, false);
      (void)place(e);
    }
  }

  /// The points that are determined with one, itself among them; nothing where some of them are not determined.
  std::optional<SmallestGroup> closure(std::size_t point) const {
    SmallestGroup group;
    std::vector<bool> in(matched_.size(), false);
    std::vector<std::size_t> open = {point};
    in[point] = true;
    while (!open.empty()) {
      const std::size_t next = open.back();
      open.pop_back();
      if (matched_[next].size() < each_) return std::nullopt;
      group.points.push_back(next);
      for (const std::size_t e : matched_[next]) {
        group.equations.push_back(e);
        for (const std::size_t other : equations_[e])
          if (!in[other]) {
            in[other] = true;
            open.push_back(other);
          }
      }
    }
    std::sort(group.points.begin(), group.points.end());
    std::sort(group.equations.begin(), group.equations.end());
    return group;
  }

 private:
  bool place(std::size_t equation) {
    for (const std::size_t point : equations_[equation]) {
      if (seen_[point]) continue;
      seen_[point] = true;
      if (matched_[point].size() < each_) {
        matched_[point].push_back(equation);
        return true;
      }
      for (std::size_t& other : matched_[point])
        if (place(other)) {
          other = equation;
          return true;
        }
    }
    return false;
  }

  std::size_t each_;
  const std::vector<std::vector<std::size_t>>& equations_;
  std::vector<std::vector<std::size_t>> matched_;  ///< to each point
  std::vector<bool> seen_;
};

}  // namespace

SmallestGroup smallest_group(std::size_t points, std::size_t each,
                             const std::vector<std::vector<std::size_t>>& equations) {
  const Matching matching(points, each, equations);
  SmallestGroup smallest;
  for (std::size_t p = 0; p < points; ++p)
    if (auto closure = matching.closure(p);
        closure && (smallest.points.empty() || closure->points.size() < smallest.points.size()))
      smallest = std::move(*closure);
  return smallest;
}

}  // namespace clearloci::mechanism
