#include "mechanism/read_study.hpp"

#include <algorithm>
#include <filesystem>

#include "mechanism/open_design.hpp"
#include "mechanism/read.hpp"
#include "mechanism/read_task.hpp"
#include "mechanism/reader.hpp"
#include "mechanism/units.hpp"
#include "mechanism/written_unit.hpp"

namespace clearloci::mechanism {
namespace {

using core::InputError;
using core::Study;
using core::StudyGoal;
using core::StudyMethod;

std::vector<std::string> parameter_names(const Mechanism& mechanism) {
  std::vector<std::string> names;
  for (const Parameter& parameter : mechanism.parameters) names.push_back(parameter.name);
  return names;
}

void read_vary(Study& study, const Mechanism& mechanism, const Value& value) {
  const std::vector<std::string> allowed = parameter_names(mechanism);
  for (Entry& entry : entries(value)) {
    if (std::find(allowed.begin(), allowed.end(), entry.key) == allowed.end())
      throw InputError(entry.where, "there is no parameter '" + entry.key + "' in " + mechanism.file,
                       allowed.empty() ? "the file has no parameters" : suggest(entry.key, allowed, "parameters"));
    const Parameter& parameter = *parameter_named(mechanism, entry.key);
    Value& range = entry.value;
    range.what = "the range of " + entry.key;
    const std::vector<Value> ends = elements(range, 2);
    const Rational lower = read_parameter_value(mechanism, parameter, ends[0]);
    const Rational upper = read_parameter_value(mechanism, parameter, ends[1]);
    if (lower >= upper)
      throw InputError(range.where,
                       range.what + " is empty: from " + value_words(parameter, lower, mechanism.units) + " to " +
                           value_words(parameter, upper, mechanism.units),
                       "write [lower, upper]");
    study.vary.push_back({entry.key, lower, upper});
  }
  if (study.vary.empty()) throw InputError(value.where, "nothing is varied", "write such as vary: {L: [0.3, 0.7]}");
  if (study.vary.size() > most_varied)
    throw InputError(value.where, std::to_string(study.vary.size()) + " parameters are varied",
                     "vary " + std::to_string(most_varied) + " at most");
}

void read_keep(Study& study, const Mechanism& mechanism, const Value& value) {
  const std::vector<std::string> allowed = parameter_names(mechanism);
  for (const Value& element : elements(value)) {
    const Keep keep = parse_keep(text_of(element), element.where, mechanism);
    for (const Expression& side : {keep.left, keep.right})
      for (const std::string& name : core::symbols(side))
        if (std::find(allowed.begin(), allowed.end(), name) == allowed.end())
          throw InputError(element.where, "'" + name + "' is no parameter of " + mechanism.file,
                           suggest(name, allowed, "parameters"));
    study.keep.push_back(text_of(element));
  }
}

core::Task read_own_task(const Mechanism& mechanism, const Value& value) {
  if (value.is_map()) return task_of(value, mechanism);
  const std::filesystem::path named = text_of(value), folder = std::filesystem::path(value.where.file).parent_path();
  return read_task((named.is_absolute() ? named : folder / named).string(), mechanism);
}

void read_tasks(Study& study, const Mechanism& mechanism, const Value& document, const Mapping& root) {
  const auto one = root.find("task"), several = root.find("tasks");
  if (one && several) throw InputError(several->where, "the study has both task and tasks", "leave one of them out");
  if (one)
    study.tasks.push_back(read_own_task(mechanism, *one));
  else if (several)
    for (const Value& element : elements(*several)) study.tasks.push_back(read_own_task(mechanism, element));
  if (study.tasks.empty())
    throw InputError(document.where, "the study has no task", "write such as task: tasks/pick_and_place.yaml");
}

std::vector<std::string> figure_names() {
  std::vector<std::string> names;
  for (const core::Figure figure : {core::Figure::margin, core::Figure::min_force, core::Figure::effort,
                                    core::Figure::pose_error, core::Figure::zone_area, core::Figure::largest_circle})
    names.push_back(core::to_string(figure));
  return names;
}

/// What a figure is measured in: an effort in what its unit says, without one in N m or N.
std::string field_of(core::Figure figure, const Mechanism& mechanism, const Value& value) {
  if (figure != core::Figure::effort) return core::to_string(figure);
  const std::vector<std::string> names = parameter_names(mechanism);
  const Expression written = parse_with_units(text_of(value), value.where, {names.begin(), names.end()});
  return in_si(written, mechanism, std::nullopt).dimension == dimension_of("force") ? "force" : "couple";
}

void read_require(Study& study, const Mechanism& mechanism, const Value& value) {
  for (Entry& entry : entries(value)) {
    const auto figure = core::figure_named(entry.key);
    if (!figure)
      throw InputError(entry.where, "'" + entry.key + "' cannot be required",
                       suggest(entry.key, figure_names(), "figures"));
    entry.value.what = "the required " + entry.key;
    entry.value.field = field_of(*figure, mechanism, entry.value);
    study.require.push_back({*figure, read_number(mechanism, entry.value, Sign::not_negative).value});
  }
}

StudyGoal read_goal(const Mechanism& mechanism, const Value& value) {
  const Mapping goal(value, {"maximise", "minimise"});
  const auto most = goal.find("maximise"), least = goal.find("minimise");
  if (!most == !least)
    throw InputError(value.where, value.what + " is to be maximised or minimised", "write such as {maximise: margin}");
  const Value& what = most ? *most : *least;
  StudyGoal study_goal;
  study_goal.maximise = most.has_value();
  study_goal.figure = core::figure_named(text_of(what));
  if (study_goal.figure) return study_goal;
  try {
    study_goal.expression = core::to_string(read_expression(mechanism, what, Scope::parameters));
  } catch (const InputError&) {
    throw InputError(what.where, "'" + text_of(what) + "' is neither a figure nor an expression in parameters",
                     suggest(text_of(what), figure_names(), "figures"));
  }
  return study_goal;
}

void read_goals(Study& study, const Mechanism& mechanism, const std::optional<Value>& value) {
  if (!value) return;
  if (!value->is_sequence()) {
    study.goals.push_back(read_goal(mechanism, *value));
    return;
  }
  for (Value element : elements(*value)) {
    element.what = "goal " + std::to_string(study.goals.size() + 1);
    study.goals.push_back(read_goal(mechanism, element));
  }
}

/// "5000 evaluations", "1/64 of each range": the number may say what it is of.
Value without_words(Value value, const std::string& words) {
  const std::string text = text_of(value), tail = " " + words;
  if (text.size() > tail.size() && text.ends_with(tail)) value.node = Node(text.substr(0, text.size() - tail.size()));
  return value;
}

long read_count(const Mechanism& mechanism, const Value& value, long least) {
  const Rational number = read_number(mechanism, value, Sign::positive).value;
  if (number.get_den() != 1 || number < least || number > most_designs)
    throw InputError(value.where, value.what + " is " + core::to_string(number),
                     "write a whole number from " + std::to_string(least) + " to " + std::to_string(most_designs));
  return number.get_num().get_si();
}

StudyMethod read_method(const Mechanism& mechanism, const Value& value, std::size_t varied) {
  const Mapping keys(value, {"grid", "sample", "search", "prove"});
  std::vector<std::string> given;
  for (const char* key : {"grid", "sample", "search", "prove"})
    if (keys.find(key)) given.emplace_back(key);
  if (given.size() != 1)
    throw InputError(value.where, "the method is one of grid, sample, search, prove",
                     "write such as method: {grid: [64, 64]}");
  StudyMethod method;
  Value key = keys.at(given.front());
  using Kind = StudyMethod::Kind;
  if (given.front() == "grid") {
    method.kind = Kind::grid;
    Rational designs = 1;
    std::vector<Value> counts =
        key.is_sequence() ? elements(key, static_cast<int>(varied)) : std::vector<Value>(varied, key);
    for (Value& count : counts) {
      count.what = "a count of the grid";
      method.counts.push_back(static_cast<int>(read_count(mechanism, count, 1)));
      designs *= method.counts.back();
    }
    if (designs > most_designs)
      throw InputError(key.where, "the grid has " + core::to_string(designs) + " designs", "write a coarser one");
  } else if (given.front() == "prove") {
    method.kind = Kind::prove;
    method.finest = read_number(mechanism, without_words(key, "of each range"), Sign::positive).value;
    if (method.finest > 1 || method.finest < Rational(1, 1L << 52))
      throw InputError(key.where, key.what + " is " + core::to_string(method.finest) + " of each range",
                       "write a part between 2^-52 and 1");
  } else {
    method.kind = given.front() == "sample" ? Kind::sample : Kind::search;
    method.count = static_cast<std::uint64_t>(read_count(mechanism, without_words(key, "evaluations"), 1));
  }
  return method;
}

}  // namespace

Keep parse_keep(const std::string& text, const core::SourcePosition& where, const Mechanism& mechanism) {
  const std::size_t at = text.find_first_of("<>");
  if (at == std::string::npos)
    throw InputError(where, "'" + text + "' compares nothing", "write such as L1 + L2 <= 0.9");
  const bool equal = at + 1 < text.size() && text[at + 1] == '=';
  const std::vector<std::string> names = parameter_names(mechanism);
  const auto side = [&](const std::string& words) {
    return in_si(parse_with_units(words, where, {names.begin(), names.end()}), mechanism, std::nullopt);
  };
  const InSi left = side(text.substr(0, at)), right = side(text.substr(at + (equal ? 2 : 1)));
  const bool zero = left.expression.is_zero_literal() || right.expression.is_zero_literal();
  if (!zero && (left.mixes || right.mixes || left.dimension != right.dimension) &&
      (left.dimension != Dimension{} || right.dimension != Dimension{}))
    throw InputError(where, "'" + text + "' compares what does not measure the same", "write the unit of each number");
  const Expression &first = left.expression, &second = right.expression;
  return text[at] == '>' ? Keep{first, second, !equal} : Keep{second, first, !equal};
}

core::Study parse_study(const std::string& text, const std::string& file, const Mechanism& mechanism) {
  const Value document = parse_document(text, file);
  if (!document.is_map())
    throw InputError(document.where, "the file is no mapping of keys to values", "start with the line format: 1");
  const Mapping root(document, {"format", "name", "vary", "keep", "task", "tasks", "require", "goal", "method"});
  check_format(root.at("format"));
  Study study;
  study.file = file;
  read_vary(study, mechanism, root.at("vary"));
  if (const auto keep = root.find("keep")) read_keep(study, mechanism, *keep);
  read_tasks(study, mechanism, document, root);
  if (const auto require = root.find("require")) read_require(study, mechanism, *require);
  read_goals(study, mechanism, root.find("goal"));
  study.method = read_method(mechanism, root.at("method"), study.vary.size());
  if (study.method.kind == StudyMethod::Kind::search && study.goals.empty())
    throw InputError(document.where, "a search has no goal", "write such as goal: {maximise: margin}");
  return study;
}

core::Study read_study(const std::string& path, const Mechanism& mechanism) {
  return parse_study(read_text(path, "the study file"), path, mechanism);
}

}  // namespace clearloci::mechanism
