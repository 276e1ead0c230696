// What is found as it comes: kept in the table, counted for the progress. Private to studies/.
#pragma once

#include <optional>
#include <vector>

#include "clearloci/study.hpp"
#include "studies/design_table.hpp"
#include "studies/study_judge.hpp"

namespace clearloci {

class Collection {
 public:
  /// Opens the table, if there is one. `total`: how many results there will be, as far as is known.
  Collection(const StudyProblem& problem, std::uint64_t total, const StudyOptions& options);

  const std::vector<core::StudyDesign>& designs() const { return designs_; }
  /// Which of so many are known already.
  std::vector<bool> known(std::uint64_t count) const;
  void expect(std::uint64_t more) { progress_.total += more; }
  void add(std::vector<core::StudyDesign> some);
  /// All, those of the table among them; what is not written yet is.
  std::vector<core::StudyDesign> take();

 private:
  using Clock = std::chrono::steady_clock;
  void write();
  void count(const core::StudyDesign& design);

  const StudyProblem& problem_;
  const StudyOptions& options_;
  Clock::time_point started_, last_write_;
  std::optional<DesignTable> table_;
  std::vector<core::StudyDesign> designs_;
  std::string lines_;
  StudyProgress progress_;
  std::uint64_t before_ = 0;
};

}  // namespace clearloci
