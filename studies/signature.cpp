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
    for (const core::RationalPose& own : polygon->corners) text << own;
  if (const auto* path = std::get_if<core::TaskPath>(&task.shape))
    for (const core::RationalPose& own : path->points) text << own;
  text << task.margin << task.min_force << task.min_couple;
  if (task.loads) text << std::string("loads") << task.loads->first << task.loads->second;
  for (const core::Tolerance& own : task.tolerances)
    text << std::string("tolerance") << own.parameter << own.below << own.above;
  for (const core::LoadWithin& own : task.loads_within)
    text << std::string("within") << std::uint64_t{own.load} << own.force << own.couple;
}

}  // namespace

std::string signature(const Model& model, const core::Study& study) {
  Text text;
  text << model.text();
  for (const auto& [name, value] : model.values()) text << name << value;
  for (const core::StudyParameter& own : study.vary) text << own.name << own.lower << own.upper;
  for (const std::string& own : study.keep) text << std::string("keep") << own;
  for (const core::Task& own : study.tasks) add(text, own);
  for (const core::StudyRequirement& own : study.require)
    text << std::string("require") << core::to_string(own.figure) << own.bound;
  for (const core::StudyGoal& own : study.goals)
    text << std::string(own.maximise ? "maximise" : "minimise")
         << (own.figure ? core::to_string(*own.figure) : "(" + own.expression + ")");
  text << std::uint64_t{static_cast<std::uint64_t>(study.method.kind)} << study.method.count << study.method.finest;
  for (const int own : study.method.counts) text << static_cast<std::uint64_t>(own);
  return text.take();
}

}  // namespace clearloci
