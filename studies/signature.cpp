#include "studies/signature.hpp"

#include "core/task.hpp"

namespace clearloci {
namespace {

using core::Rational;

class Text {
 public:
  Text& operator<<(const std::string& word) {
    text_ += std::to_string(word.size()) + ":" + word + ";";
    return *this;
  }
  Text& operator<<(const Rational& value) { return *this << core::to_string(value); }
  Text& operator<<(const core::RationalPose& pose) {
    for (const Rational& value : pose) *this << value;
    return *this;
  }
  Text& operator<<(const std::optional<Rational>& value) {
    return value ? *this << std::string("is") << *value : *this << std::string("none");
  }
  Text& operator<<(std::uint64_t number) { return *this << std::to_string(number); }
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

void add(Text& text, const core::Task& task) {
  text << core::kind_of(task.shape);
  if (const auto* box = std::get_if<core::TaskBox>(&task.shape)) text << box->lower << box->upper;
  if (const auto* circle = std::get_if<core::TaskBall>(&task.shape)) text << circle->centre << circle->radius;
  if (const auto* polygon = std::get_if<core::TaskPolygon>(&task.shape))
    for (const core::RationalPose& pose : polygon->corners) text << pose;
  if (const auto* path = std::get_if<core::TaskPath>(&task.shape))
    for (const core::RationalPose& pose : path->points) text << pose;
  text << task.margin << task.min_force << task.min_couple;
  if (task.loads) text << std::string("loads") << task.loads->first << task.loads->second;
  for (const core::Tolerance& tolerance : task.tolerances)
    text << std::string("tolerance") << tolerance.parameter << tolerance.below << tolerance.above;
  for (const core::LoadWithin& load_range : task.loads_within)
    text << std::string("within") << std::uint64_t{load_range.load} << load_range.force << load_range.couple;
}

}  // namespace

std::string signature(const Model& model, const core::Study& study) {
  Text text;
  text << model.text();
  for (const auto& [name, value] : model.values()) text << name << value;
  for (const core::StudyParameter& parameter : study.vary) text << parameter.name << parameter.lower << parameter.upper;
  for (const std::string& name : study.keep) text << std::string("keep") << name;
  for (const core::Task& task : study.tasks) add(text, task);
  for (const core::StudyRequirement& requirement : study.require)
    text << std::string("require") << core::to_string(requirement.figure) << requirement.bound;
  for (const core::StudyGoal& goal : study.goals)
    text << std::string(goal.maximise ? "maximise" : "minimise")
         << (goal.figure ? core::to_string(*goal.figure) : "(" + goal.expression + ")");
  text << std::uint64_t{static_cast<std::uint64_t>(study.method.kind)} << study.method.count << study.method.finest;
  for (const int count : study.method.counts) text << static_cast<std::uint64_t>(count);
  return text.take();
}

}  // namespace clearloci
