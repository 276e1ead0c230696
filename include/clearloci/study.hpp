// Which of many designs are good, and which is best? A study varies parameters of a mechanism file and judges every
// design by a task (docs/guide/studies.md).
//
//     const clearloci::Model model = clearloci::Model::read("five_bar.yaml");
//     const clearloci::Study study = clearloci::read_study("studies/lengths.yaml", model);
//     const clearloci::StudyResult result = clearloci::run_study(model, study);
//     if (result.best) std::cout << "L = " << result.designs[*result.best].values[0] << "\n";
//
// Lengths in m, forces in N, couples in N m.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "clearloci/mechanism.hpp"
#include "clearloci/verify.hpp"

namespace clearloci::inline core {

/// What a design is measured by. `margin`: m, proven; `min_force`: the least force that any joint with a clearance
/// bears over the task, N, a proven lower bound; `effort`: the most that any actuator exerts over the task, N m or N, a
/// proven upper bound; `pose_error`: the largest displacement of the end effector over the task, m, a proven upper
/// bound; `zone_area`: of the largest discontinuity-free zone, m^2; `largest_circle`: the radius of the largest circle
/// in any zone, m.
enum class Figure { margin, min_force, effort, pose_error, zone_area, largest_circle };

/// "margin", "min_force", ... as in a study file.
std::string to_string(Figure figure);
std::optional<Figure> figure_named(std::string_view name);

struct StudyParameter {
  std::string name;
  Rational lower, upper;
};

struct StudyGoal {
  bool maximise = true;
  std::optional<Figure> figure;
  std::string expression = {};  ///< in parameters, where there is no figure
};

struct StudyMethod {
  enum class Kind { grid, sample, search, prove };
  Kind kind = Kind::grid;
  std::vector<int> counts = {};  ///< of a grid: values of each parameter, both ends among them
  std::uint64_t count = 0;       ///< designs of a sample, evaluations of a search
  Rational finest = 0;           ///< of a proof: cells are cut down to this part of each range
};

struct StudyRequirement {
  Figure figure = Figure::margin;
  Rational bound = 0;  ///< at least, or of effort and pose_error at most
};

struct Study {
  std::string file;
  std::vector<StudyParameter> vary;
  std::vector<std::string> keep = {};  ///< "L1 + L2 <= 0.9"
  std::vector<Task> tasks;
  std::vector<StudyRequirement> require = {};
  std::vector<StudyGoal> goals = {};
  StudyMethod method = {};
};

/// The study's tasks with what it requires besides of them: margin, min_force, pose_error.
std::vector<Task> required_tasks(const Study& study);

/// What became of one design.
struct StudyDesign {
  enum class Status {
    feasible,    ///< verified for every task, and whatever is required holds
    infeasible,  ///< refuted
    undecided,
    left_out,  ///< `keep` does not hold
  };
  std::uint64_t index = 0;     ///< in the study's order
  std::vector<double> values;  ///< of the varied parameters, rounded
  Status status = Status::undecided;
  std::string reason = {};           ///< why not feasible: "workspace", "singularity", "contact lost in A1", "margin"
  std::size_t task = 0;              ///< the one that it fails
  std::optional<Point2> at = {};     ///< where, where there is such a place
  std::vector<double> figures = {};  ///< of StudyResult::figures; NaN where not known
};

/// "feasible", "infeasible", "undecided", "left out".
std::string to_string(StudyDesign::Status status);

/// A box of designs of which the same is proven.
struct StudyCell {
  std::vector<double> lower, upper;
  StudyDesign::Status status = StudyDesign::Status::undecided;
  std::string reason = {};
};

struct StudyResult {
  std::string mechanism;
  Study study;
  std::vector<std::string> parameters;  ///< that vary
  std::vector<Figure> figures;
  std::vector<StudyDesign> designs;      ///< by index; of a search its history
  std::optional<std::size_t> best;       ///< in `designs`, by the first goal; of a proof the only one there
  std::vector<std::size_t> front;        ///< in `designs`, with several goals: none is better in all
  std::vector<StudyCell> cells = {};     ///< of a proof
  std::vector<ProvenRange> ranges = {};  ///< of a proof over one parameter, in its order
  /// Of a proof with a goal over several parameters: what no design is better than, and what the best has.
  std::optional<std::array<double, 2>> best_goal = {};
  std::optional<StudyCell> tolerances = {};  ///< of a proof: the largest box around the file's design that is proven
  bool complete = true;
};

}  // namespace clearloci::inline core

namespace clearloci {

/// Throws InputError, with file, line, column, problem and mend. Tasks that it names are found beside it.
Study read_study(const std::string& path, const Model& model);
Study parse_study(const std::string& text, const Model& model, const std::string& file = "study");

struct StudyProgress {
  std::uint64_t done = 0, total = 0, feasible = 0;
  std::optional<double> best = {};  ///< of the first goal
  double seconds_left = 0;
};

/// Other processes with the same model and study, of which rank 0 hands out the work. Messages arrive whole.
struct StudyRanks {
  int rank = 0, size = 1;
  std::function<void(int to, const std::string& message)> send;
  std::function<std::string()> receive;                              ///< waits for a message of rank 0
  std::function<std::optional<std::pair<int, std::string>>()> poll;  ///< of rank 0: a message with its sender, if any
};

inline constexpr int most_threads = 1024;

struct StudyOptions {
  /// Where finished designs are kept as they come, so that a run that was stopped goes on; empty: nowhere.
  std::filesystem::path table = {};
  bool resume = false;  ///< go on from the table; else it is begun anew
  int threads = 0;      ///< 0: as many as there are cores; fewer where the system has no more
  std::optional<std::chrono::steady_clock::time_point> deadline = {};
  std::function<void(const StudyProgress&)> progress = {};
  const StudyRanks* ranks = nullptr;  ///< of a rank other than 0 the answer is empty
};

/// The same answer whatever the number of threads and ranks. Throws InputError where the study asks for what the
/// mechanism has not, or `table` is of another study. Where the deadline comes first `complete` is false.
StudyResult run_study(const Model& model, const Study& study, const StudyOptions& options = {});

/// How many designs a grid or a sample has.
std::uint64_t design_count(const Study& study);

/// Some designs of a grid or a sample, as lines of text: for a scheduler of one's own, which brings together by
/// study_result what any number of processes found.
std::string judge_designs(const Model& model, const Study& study, std::uint64_t first, std::uint64_t count,
                          int threads = 1);
StudyResult study_result(const Model& model, const Study& study, const std::string& lines);

/// The mechanism file with a design's values in the place of its own, and all else as it was written.
std::string design_text(const Model& model, const StudyResult& result, const StudyDesign& design);

/// The model of a design.
Model design_model(const Model& model, const StudyResult& result, const StudyDesign& design);

}  // namespace clearloci
