// The loci that were answered last, so that the next answer can begin with them, carried over to the new design.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <string>

#include "clearloci/loci.hpp"

namespace clearloci::workbench {

class AnsweredLoci {
 public:
  /// Returns the name by which the page asks for them. The oldest are forgotten.
  std::string keep(LocusMap map);
  /// Null where they are not known, or forgotten.
  std::shared_ptr<const LocusMap> find(const std::string& name) const;

 private:
  struct Entry {
    std::string name;
    std::shared_ptr<const LocusMap> map;
  };
  mutable std::mutex mutex_;
  std::deque<Entry> entries_;  ///< the newest last
  std::uint64_t count_ = 0;
};

}  // namespace clearloci::workbench
