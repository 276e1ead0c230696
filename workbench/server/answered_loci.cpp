#include "workbench/server/answered_loci.hpp"

#include <algorithm>
#include <utility>

namespace clearloci::workbench {
namespace {

/// Two for each of a few pages: what is shown, and what takes its place.
constexpr std::size_t most_kept = 8;

}  // namespace

std::string AnsweredLoci::keep(LocusMap map) {
  auto shared = std::make_shared<const LocusMap>(std::move(map));
  const std::lock_guard lock(mutex_);
  std::string name = std::to_string(++count_);
  entries_.push_back({name, std::move(shared)});
  if (entries_.size() > most_kept) entries_.pop_front();
  return name;
}

std::shared_ptr<const LocusMap> AnsweredLoci::find(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& one) { return one.name == name; });
  return found == entries_.end() ? nullptr : found->map;
}

}  // namespace clearloci::workbench
