#include "core/virtual_work.hpp"

#include <algorithm>

namespace clearloci::inline core {
namespace {

/// "along x", "about y": what a joint gives way to where a component alone is given up.
std::string way_of(Quantity quantity) {
  using Q = Quantity;
  switch (quantity) {
    case Q::fx:
    case Q::fy:
    case Q::fz:
      return std::string("along ") + to_string(quantity).back();
    case Q::mx:
    case Q::my:
    case Q::mz:
      return std::string("about ") + to_string(quantity).back();
    case Q::N:
      return "across its guide";
    case Q::T:
      return "by turning";
    case Q::end_ahead:
      return "at its end ahead";
    case Q::end_behind:
      return "at its end behind";
    case Q::f1:
    case Q::f2:
      return "across its axis";
    default:
      return "by turning across its axis";
  }
}

}  // namespace

std::string virtual_work_words(LocusKind kind, std::span<const Vanishing> vanishing) {
  if (kind == LocusKind::direct_singularity) return "the mechanism can move with its actuators locked";
  if (kind == LocusKind::workspace_boundary) return "a chain is stretched out or folded";
  const auto is_effort = [](const Vanishing& one) {
    return one.quantity == Quantity::M || one.quantity == Quantity::F;
  };
  const auto effort = std::find_if(vanishing.begin(), vanishing.end(), is_effort);
  if (effort != vanishing.end()) return "the loads do no work in the motion that " + effort->joint + " alone drives";
  if (vanishing.empty()) return "";
  const Vanishing& one = vanishing.front();
  if (one.quantity == Quantity::f)
    return "the loads do no work in any motion that " + one.joint + " coming apart would allow";
  return "the loads do no work in the motion of " + one.joint + " giving way " + way_of(one.quantity);
}

}  // namespace clearloci::inline core
