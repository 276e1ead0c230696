// From factors to arcs, with a guarantee (method.md section 8).
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
  sheet::KnownSearches* known = nullptr;
};

/// Every curve, isolated point and workspace region of the problem's modes; over one free coordinate its points and
/// reachable intervals. One or two free coordinates required.
/// The map's mechanism name, parameters, notes and other timings are left to the caller.
core::LocusMap trace(const core::LocusProblem& problem, const TraceOptions& options = {});

}  // namespace clearloci::loci
