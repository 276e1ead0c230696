#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <memory>

#include "analysis/model.hpp"
#include "analysis/proven_cells.hpp"
#include "clearloci/study.hpp"
#include "core/errors.hpp"
#include "core/rational.hpp"
#include "mechanism/open_design.hpp"
#include "mechanism/read_study.hpp"
#include "mechanism/write_values.hpp"
#include "mechanism/written_unit.hpp"
#include "studies/collection.hpp"
#include "studies/design_table.hpp"
#include "studies/designs.hpp"
#include "studies/pareto.hpp"
#include "studies/prove.hpp"
#include "studies/search.hpp"
#include "studies/study_judge.hpp"
#include "studies/study_limits.hpp"
#include "studies/work.hpp"

namespace clearloci {
namespace {

using core::StudyDesign;
using Kind = core::StudyMethod::Kind;
using Status = StudyDesign::Status;

bool is_rank_0(const StudyOptions& options) { return options.ranks == nullptr || options.ranks->rank == 0; }

/// Of rank 0 the work as `lead` does it; the others serve. Rank 0 lets them go, however its own work ends.
template <class Lead>
void with_ranks(const Work& work, const StudyOptions& options, const Lead& lead) {
  if (!is_rank_0(options)) return serve(work, options);
  try {
    lead();
  } catch (...) {
    dismiss(options);
    throw;
  }
  dismiss(options);
}

/// In their order, with their values, and what is best of them.
void complete(const StudyProblem& problem, const Designs& designs, StudyResult& result) {
  std::sort(result.designs.begin(), result.designs.end(),
            [](const StudyDesign& a, const StudyDesign& b) { return a.index < b.index; });
  for (StudyDesign& design : result.designs)
    if (design.values.empty())
      for (const core::Rational& value : designs.values(design.index)) design.values.push_back(core::to_double(value));
  choose(problem, result);
}

StudyResult begun(const Model& model, const core::Study& study) {
  check_study(model.content().mechanism, study);
  StudyResult result;
  result.mechanism = model.name();
  result.study = study;
  for (const core::StudyParameter& parameter : study.vary) result.parameters.push_back(parameter.name);
  return result;
}

void require_numbered(const core::Study& study) {
  if (study.method.kind == Kind::grid || study.method.kind == Kind::sample) return;
  throw core::InputError({study.file}, "only designs of a grid or a sample are known beforehand",
                         "choose one of these methods, or run the study as a whole");
}

/// Every design of a grid or a sample that is not known yet.
void judge_all(const StudyProblem& problem, const StudyOptions& options, StudyResult& result) {
  const Designs designs(problem.study());
  Work work;
  work.figures = problem.figures().size();
  work.worker = [&]() -> Worker {
    return [&designs, judge = std::make_shared<StudyJudge>(problem)](std::uint64_t index) {
      return judge->judge(index, designs.values(index));
    };
  };
  with_ranks(work, options, [&] {
    Collection found(problem, designs.count(), options);
    const std::vector<bool> done = found.known(designs.count());
    std::uint64_t next = 0;
    work.next = [&]() -> std::optional<std::uint64_t> {
      while (next < designs.count() && done[next]) ++next;
      return next < designs.count() ? std::optional(next++) : std::nullopt;
    };
    work.found = [&](std::vector<StudyDesign> some) { found.add(std::move(some)); };
    result.complete = do_work(work, options);
    result.designs = found.take();
    complete(problem, designs, result);
  });
}

core::StudyCell cell_of(const StudyDesign& design, const CellTree& tree) {
  core::StudyCell cell;
  cell.status = design.status;
  cell.reason = design.reason;
  for (const ExactRange& range : tree.ranges(design.index)) {
    cell.lower.push_back(core::to_double(range.first));
    cell.upper.push_back(core::to_double(range.second));
  }
  return cell;
}

void require_provable(const core::Study& study) {
  using core::Figure;
  for (const core::StudyRequirement& requirement : study.require)
    if (requirement.figure != Figure::margin && requirement.figure != Figure::min_force &&
        requirement.figure != Figure::pose_error)
      throw core::InputError({study.file}, core::to_string(requirement.figure) + " is not proven for boxes of designs",
                             "require margin, min_force or pose_error, or choose another method");
  if (study.goals.empty()) return;
  const bool of_parameters = study.goals.size() == 1 && !study.goals.front().figure;
  const bool end = study.vary.size() > 1 || study.goals.front().expression == study.vary.front().name;
  if (!of_parameters || !end)
    throw core::InputError(
        {study.file}, "a proof measures no goal",
        "leave the goal out; it may be one expression in parameters, over one parameter that itself");
}

/// The least or the greatest value that verifies, as the goal asks, rounded into its range to a thousandth of that: a
/// number to build by.
void choose_end(const core::Study& study, StudyResult& result) {
  if (study.goals.empty() || result.ranges.empty()) return;
  const bool most = study.goals.front().maximise;
  const core::ProvenRange& range = most ? result.ranges.back() : result.ranges.front();
  const core::Rational low(range.from[1]), high(range.to[0]);
  const int exponent = static_cast<int>(std::floor(std::log10(range.to[0] - range.from[1]))) - 3;
  const core::Rational unit = core::rational_from_decimal("1e" + std::to_string(exponent));
  const core::Rational steps = (most ? high : low) / unit;
  core::Integer whole;
  (most ? mpz_fdiv_q : mpz_cdiv_q)(whole.get_mpz_t(), steps.get_num_mpz_t(), steps.get_den_mpz_t());
  StudyDesign best;
  best.status = Status::feasible;
  best.values = {core::to_double(core::Rational(whole) * unit)};
  result.designs = {best};
  result.best = 0;
}

/// Cells without a design that is better than the best found are not cut.
void leave_what_is_no_better(BestProven& best, const CellTree& tree, std::vector<std::uint64_t>& finer,
                             std::vector<StudyDesign>& leaves) {
  std::erase_if(finer, [&](std::uint64_t path) {
    const std::vector<ExactRange> ranges = tree.ranges(path);
    if (best.may_be_better(ranges)) return false;
    best.add_left(ranges);
    StudyDesign design;
    design.index = path;
    design.status = Status::left_out;
    design.reason = "no better";
    leaves.push_back(std::move(design));
    return true;
  });
}

/// When the deadline came.
StudyDesign not_looked_at(std::uint64_t path) {
  StudyDesign design;
  design.index = path;
  design.status = Status::undecided;
  design.reason = "not looked at";
  return design;
}

/// Cells level by level: what is undecided is cut, down to the finest.
void prove_all(const StudyProblem& problem, const StudyOptions& options, StudyResult& result) {
  require_provable(problem.study());
  const CellTree tree(problem.study());
  Work work;
  work.worker = [&]() -> Worker {
    return [judge = std::make_shared<CellJudge>(problem)](std::uint64_t path) { return judge->judge(path); };
  };
  with_ranks(work, options, [&] {
    Collection found(problem, 0, options);
    std::map<std::uint64_t, StudyDesign> judged_designs;
    for (const StudyDesign& design : found.designs()) judged_designs.emplace(design.index, design);
    std::vector<std::uint64_t> level = {1};
    std::vector<StudyDesign> leaves;
    std::optional<BestProven> best;
    if (!problem.study().goals.empty() && problem.study().vary.size() > 1) best.emplace(problem);
    while (!level.empty()) {
      std::size_t next = 0;
      work.next = [&]() -> std::optional<std::uint64_t> {
        while (next < level.size() && judged_designs.contains(level[next])) ++next;
        return next < level.size() ? std::optional(level[next++]) : std::nullopt;
      };
      work.found = [&](std::vector<StudyDesign> some) {
        for (const StudyDesign& design : some) judged_designs.insert_or_assign(design.index, design);
        found.add(std::move(some));
      };
      if (result.complete) result.complete = do_work(work, options);
      std::vector<std::uint64_t> finer;
      for (const std::uint64_t path : level) {
        const auto judged = judged_designs.find(path);
        if (judged == judged_designs.end()) {
          leaves.push_back(not_looked_at(path));
          continue;
        }
        if (best && judged->second.status == Status::feasible) best->add_feasible(tree.ranges(path));
        if (judged->second.status == Status::undecided && !tree.is_finest(path)) {
          finer.push_back(2 * path);
          finer.push_back(2 * path + 1);
        } else {
          leaves.push_back(judged->second);
          if (best && judged->second.status == Status::undecided) best->add_left(tree.ranges(path));
        }
      }
      if (best) leave_what_is_no_better(*best, tree, finer, leaves);
      found.expect(finer.size());
      level = std::move(finer);
    }
    (void)found.take();
    for (const StudyDesign& design : leaves) result.cells.push_back(cell_of(design, tree));
    if (result.complete && problem.study().vary.size() == 1) {
      result.ranges = joined_ranges(result.cells);
      choose_end(problem.study(), result);
    }
    if (result.complete && best) {
      CellJudge judge(problem);
      best->judge_single_designs(judge);
      best->tell(result);
    }
    if (result.complete) result.tolerances = proven_tolerances(problem);
  });
}

}  // namespace

core::Study read_study(const std::string& path, const Model& model) {
  return mechanism::read_study(path, model.content().mechanism);
}

core::Study parse_study(const std::string& text, const Model& model, const std::string& file) {
  return mechanism::parse_study(text, file, model.content().mechanism);
}

namespace {

/// The shortest decimal where that is the number itself, else a fraction.
std::string written(const core::Rational& value) {
  std::array<char, 40> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), core::to_double(value));
  const std::string decimal(text.data(), end);
  return core::rational_from_decimal(decimal) == value ? decimal : core::to_string(value);
}

/// As the mechanism file says it, with the unit of the parameter.
std::string value_words(const Model& model, const std::string& parameter, const core::Rational& value) {
  const mechanism::Mechanism& current = model.content().mechanism;
  const auto unit = mechanism::unit_of(*mechanism::parameter_named(current, parameter), current.units);
  return written(value) + (unit ? " " + mechanism::words_of(*unit) : "");
}

std::vector<Model::Value> values_of(const Model& model, const StudyResult& result, const StudyDesign& design) {
  std::vector<Model::Value> values;
  const core::Study& study = result.study;
  check_study(model.content().mechanism, study);
  if (design.values.size() != study.vary.size() ||
      !std::all_of(design.values.begin(), design.values.end(), [](double value) { return std::isfinite(value); }))
    throw core::InputError({study.file}, "the design has not one value for each parameter that varies",
                           "pass a design of the study's result");
  const bool numbered = study.method.kind == Kind::grid || study.method.kind == Kind::sample;
  const std::vector<core::Rational> exact =
      numbered ? Designs(study).values(design.index) : std::vector<core::Rational>{};
  for (std::size_t i = 0; i < study.vary.size(); ++i) {
    std::array<char, 40> text{};
    const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), design.values[i]);
    // Of a search values are short decimals, of which the double knows all digits.
    const core::Rational value = numbered ? exact[i] : core::rational_from_decimal(std::string(text.data(), end));
    values.emplace_back(study.vary[i].name, value_words(model, study.vary[i].name, value));
  }
  for (const Model::Value& value : model.values())
    if (std::none_of(values.begin(), values.end(), [&](const Model::Value& v) { return v.first == value.first; }))
      values.push_back(value);
  return values;
}

}  // namespace

std::uint64_t design_count(const core::Study& study) {
  require_numbered(study);
  return Designs(study).count();
}

std::string judge_designs(const Model& model, const core::Study& study, std::uint64_t first, std::uint64_t count,
                          int threads) {
  require_numbered(study);
  check_study(model.content().mechanism, study);
  const Designs designs(study);
  const StudyProblem problem(model, study);
  const std::uint64_t end = first + std::min(count, designs.count() - std::min(first, designs.count()));
  std::uint64_t next = first;
  std::vector<StudyDesign> found;
  Work work;
  work.figures = problem.figures().size();
  work.worker = [&]() -> Worker {
    return [&designs, judge = std::make_shared<StudyJudge>(problem)](std::uint64_t index) {
      return judge->judge(index, designs.values(index));
    };
  };
  work.next = [&]() -> std::optional<std::uint64_t> { return next < end ? std::optional(next++) : std::nullopt; };
  work.found = [&](std::vector<StudyDesign> some) { found.insert(found.end(), some.begin(), some.end()); };
  (void)do_work(work, {.threads = std::max(1, threads)});
  std::sort(found.begin(), found.end(), [](const StudyDesign& a, const StudyDesign& b) { return a.index < b.index; });
  std::string lines;
  for (const StudyDesign& design : found) lines += table_line(design);
  return lines;
}

StudyResult study_result(const Model& model, const core::Study& study, const std::string& lines) {
  require_numbered(study);
  StudyResult result = begun(model, study);
  const Designs designs(study);
  const StudyProblem problem(model, study);
  result.figures = problem.figures();
  std::vector<bool> done(designs.count(), false);
  for (std::size_t at = 0; at < lines.size();) {
    const std::size_t end = std::min(lines.find('\n', at), lines.size());
    StudyDesign design;
    if (!read_table_line(std::string_view(lines).substr(at, end - at), result.figures.size(), design) ||
        design.index >= done.size())
      throw core::InputError({"lines"}, "a line of designs is damaged or of another study",
                             "pass all results of judge_designs");
    if (!done[design.index]) result.designs.push_back(design);
    done[design.index] = true;
    at = end + 1;
  }
  result.complete = result.designs.size() == designs.count();
  complete(problem, designs, result);
  return result;
}

std::string design_text(const Model& model, const StudyResult& result, const StudyDesign& design) {
  return mechanism::with_values(model.text(), model.file(), values_of(model, result, design));
}

Model design_model(const Model& model, const StudyResult& result, const StudyDesign& design) {
  return model.with(values_of(model, result, design));
}

StudyResult run_study(const Model& model, const core::Study& study, const StudyOptions& options) {
  if (options.threads < 0 || options.threads > most_threads)
    throw core::InputError({}, std::to_string(options.threads) + " threads are asked for",
                           "ask for 1 to " + std::to_string(most_threads) + ", or 0, which is one a core");
  StudyResult result = begun(model, study);
  const StudyProblem problem(model, study);
  if (study.method.kind == Kind::prove) {
    prove_all(problem, options, result);
    return result;
  }
  result.figures = problem.figures();
  if (study.method.kind == Kind::search)
    with_ranks({}, options, [&] { search(problem, options, result); });
  else
    judge_all(problem, options, result);
  return result;
}

}  // namespace clearloci
