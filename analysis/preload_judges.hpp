// Whether all efforts of a box verify a task, or all of them fail it: by the design judge over two lengths, by cells of
// the statics over one to six coordinates. Private to analysis/.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "analysis/design_task.hpp"
#include "analysis/wanted_efforts.hpp"

namespace clearloci {

struct BoxVerdict {
  /// `refuted`: all of its efforts fail.
  core::Verdict verdict = core::Verdict::undecided;
  std::string reason = {};  ///< why they fail: "contact lost in A1, B1"
  long cells = 0;           ///< of the statics, that were looked at
};

class PreloadJudge {
 public:
  PreloadJudge() = default;
  virtual ~PreloadJudge() = default;
  PreloadJudge(const PreloadJudge&) = delete;
  PreloadJudge& operator=(const PreloadJudge&) = delete;

  /// A range for every effort. `finest`: it is cut no further, and asked in earnest.
  virtual BoxVerdict judge(const std::vector<ExactRange>& efforts, bool finest) = 0;
};

/// The mechanism must outlive the judge. Throws
/// core::InputError as verify().
std::unique_ptr<PreloadJudge> preload_judge(const mechanism::Mechanism& mechanism,
                                            const std::vector<WantedEffort>& wanted, const core::Task& task,
                                            const LociRequest& request);

}  // namespace clearloci
