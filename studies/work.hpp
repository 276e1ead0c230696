// Work handed out in pieces: to the threads of this process, and to the ranks of others (StudyOptions::ranks). What
// comes back is the same whoever did it, in whatever order. Private to studies/.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "clearloci/study.hpp"

namespace clearloci {

/// What becomes of one item: a design by its index, a cell by its path.
using Worker = std::function<core::StudyDesign(std::uint64_t item)>;

struct Work {
  std::size_t figures = 0;                                    ///< of every result
  std::function<Worker()> worker;                             ///< one a thread
  std::function<std::optional<std::uint64_t>()> next;         ///< the items, one at a time; of rank 0
  std::function<void(std::vector<core::StudyDesign>)> found;  ///< called by one thread at a time; of rank 0
};

/// Until there is no next item. False: the deadline came first. Of rank 0.
bool do_work(const Work& work, const StudyOptions& options);

/// Works for rank 0 until that says there is no more: of every other rank.
void serve(const Work& work, const StudyOptions& options);

/// Tells the other ranks that there is no more.
void dismiss(const StudyOptions& options);

}  // namespace clearloci
