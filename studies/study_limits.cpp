#include "studies/study_limits.hpp"

#include <algorithm>
#include <set>
#include <string>

#include "analysis/request_limits.hpp"
#include "core/errors.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/read_study.hpp"

namespace clearloci {
namespace {

using core::InputError;
using core::Rational;

void check_varied(const mechanism::Mechanism& mechanism, const core::Study& study) {
  if (study.vary.empty()) throw InputError({study.file}, "nothing is varied", "give a parameter and its range");
  if (study.vary.size() > mechanism::most_varied)
    throw InputError({study.file}, std::to_string(study.vary.size()) + " parameters are varied",
                     "vary " + std::to_string(mechanism::most_varied) + " at most");
  std::set<std::string> names;
  for (const core::StudyParameter& parameter : study.vary) {
    const std::string& name = parameter.name;
    if (mechanism::parameter_named(mechanism, name) == nullptr)
      throw InputError({study.file}, "there is no parameter '" + name + "' in " + mechanism.file,
                       "vary parameters of the mechanism");
    if (!names.insert(name).second)
      throw InputError({study.file}, "parameter " + name + " is varied twice", "give one range");
    if (parameter.lower >= parameter.upper)
      throw InputError({study.file}, "the range of " + name + " is empty", "give its lower and its upper end");
    for (const Rational& end : {parameter.lower, parameter.upper})
      if (const auto reason = mechanism::unusable(end))
        throw InputError({study.file}, "an end of the range of " + name + " " + *reason, "give one as it occurs");
  }
}

void check_count(const core::Study& study, const Rational& count) {
  if (count < 1 || count > mechanism::most_designs)
    throw InputError({study.file}, "the study has " + core::to_string(count) + " designs",
                     "ask for 1 to " + std::to_string(mechanism::most_designs));
}

void check_method(const core::Study& study) {
  using Kind = core::StudyMethod::Kind;
  const core::StudyMethod& method = study.method;
  switch (method.kind) {
    case Kind::grid: {
      if (method.counts.size() != study.vary.size())
        throw InputError({study.file},
                         "the grid has " + std::to_string(method.counts.size()) + " counts, and " +
                             std::to_string(study.vary.size()) + " parameters vary",
                         "give one for each");
      Rational designs = 1;
      for (const int count : method.counts) {
        check_count(study, count);
        designs *= count;
      }
      return check_count(study, designs);
    }
    case Kind::sample:
    case Kind::search:
      check_count(study, Rational(core::Integer(std::to_string(method.count))));
      if (method.kind == Kind::search && study.goals.empty())
        throw InputError({study.file}, "a search has no goal", "give one, such as the largest margin");
      return;
    case Kind::prove:
      if (method.finest > 1 || method.finest < Rational(1, 1L << 52))
        throw InputError({study.file}, "cells are cut to " + core::to_string(method.finest) + " of each range",
                         "give a part between 2^-52 and 1");
  }
}

}  // namespace

void check_study(const mechanism::Mechanism& mechanism, const core::Study& study) {
  check_varied(mechanism, study);
  if (study.tasks.empty()) throw InputError({study.file}, "the study has no task", "give one at least");
  for (const core::Task& task : study.tasks) check_task(mechanism, task);
  for (const core::StudyRequirement& requirement : study.require)
    if (requirement.bound < 0)
      throw InputError({study.file}, "the required " + core::to_string(requirement.figure) + " is negative",
                       "give 0 or more");
  check_method(study);
}

}  // namespace clearloci
