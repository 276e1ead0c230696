// What an engine is: it finds the curves, isolated points and workspace regions of a problem over two free coordinates,
// and says how certain each is. What all engines have in common is done to what they found (loci/trace.cpp): workspace
// regions where the engine has none, points of contact loss, names, order. Another engine is a file of its own and a
// line of `engines` there.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string_view>

#include "core/certificate.hpp"
#include "core/locus_factor.hpp"
#include "core/locus_map.hpp"

namespace clearloci::loci {

namespace sheet {
class KnownSearches;
}

using core::Engine;

struct TraceOptions {
  Engine engine = Engine::adaptive_then_exact;
  std::function<void(double fraction, std::string_view stage)> progress = {};  ///< may be empty
  std::optional<std::chrono::steady_clock::time_point> deadline = {};  ///< then: what is known, complete = false
  /// For pictures and names, where something else proves what counts: the adaptive engine alone, with a small part of
  /// its budget. What that leaves open is drawn, not certified, and not spoken of in notes.
  bool sketch = false;
  /// Where the adaptive engine puts what it claims of its cells; not asked for where it is null.
  core::Certificate* certificate = nullptr;
  /// Of a problem that is traced again with another tolerance and nothing else changed: what the adaptive engine has
  /// found that does not depend on it; may be null.
  sheet::KnownSearches* searches = nullptr;
};

struct Found {
  core::LocusMap map;
  /// Arcs failed the last check (arc_check.hpp) and are not handed out; points beside them may only look isolated.
  bool withheld = false;
  /// The map has no workspace regions: its boundary curves bound them.
  bool leaves_workspace = false;
};

/// Throws core::LimitReached where the deadline comes before anything is known; else what is known, complete = false.
using FindLoci = Found (*)(const core::LocusProblem& problem, const TraceOptions& options);

}  // namespace clearloci::loci
