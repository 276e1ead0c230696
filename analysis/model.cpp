#include "analysis/model.hpp"

#include <algorithm>
#include <utility>

#include "analysis/framed.hpp"
#include "loci/search/search.hpp"
#include "mechanism/read.hpp"

namespace clearloci {
namespace {

std::string point_name(const mechanism::Mechanism& mechanism, mechanism::PointIndex point) {
  return mechanism.points[static_cast<std::size_t>(point)].name;
}

std::string link_name(const mechanism::Mechanism& mechanism, mechanism::LinkIndex link) {
  return link == mechanism::ground ? "ground" : mechanism.links[static_cast<std::size_t>(link)].name;
}

/// With what the import of its file said.
mechanism::Mechanism with_notes(mechanism::Mechanism parsed, const std::vector<std::string>& notes) {
  parsed.notes.insert(parsed.notes.begin(), notes.begin(), notes.end());
  return parsed;
}

}  // namespace

SharedDesign::SharedDesign(std::string text, std::string file, std::vector<std::string> notes,
                           mechanism::Mechanism first)
    : text_(std::move(text)), file_(std::move(file)), notes_(std::move(notes)), first_(std::move(first)) {
  loci::keep_to_threads_to_be_had();
  // Each member has its own.
  for (mechanism::Joint& joint : first_.joints)
    if (joint.free_effort) joint.free_effort->given = true;
}

mechanism::Mechanism SharedDesign::read(const std::vector<Model::Value>& values) const {
  const auto reader = [&] {
    const std::lock_guard lock(mutex_);
    if (!reader_) reader_ = mechanism::mechanism_reader(text_, file_);
    return reader_;
  };
  return with_notes(reader()(values), notes_);
}

const symbolic::LocusFamily& SharedDesign::family() const {
  const std::lock_guard lock(mutex_);
  if (!family_) {
    const std::optional<Framed> inside = framed(first_, Scaling::by_size, mechanism::Parameters::kept);
    family_.emplace(inside ? inside->mechanism : first_);
  }
  return *family_;
}

namespace {

std::shared_ptr<const Model::Content> content_of(mechanism::ModelText text, const std::vector<Model::Value>& values) {
  mechanism::Mechanism read = with_notes(mechanism::parse_mechanism(text.text, text.file, values), text.notes);
  auto shared =
      std::make_shared<const SharedDesign>(std::move(text.text), std::move(text.file), std::move(text.notes), read);
  return std::make_shared<const Model::Content>(Model::Content{std::move(shared), values, std::move(read), false});
}

}  // namespace

Model Model::parse(std::string text, std::string file, const std::vector<Value>& values) {
  return Model(content_of(mechanism::model_text(std::move(text), std::move(file)), values));
}

Model Model::Content::of(mechanism::Mechanism mechanism) {
  auto shared =
      std::make_shared<const SharedDesign>(std::string(), mechanism.file, std::vector<std::string>(), mechanism);
  return Model(std::make_shared<const Content>(Content{std::move(shared), {}, std::move(mechanism), false}));
}

Model Model::read(const std::string& path, const std::vector<Value>& values) {
  return Model(content_of(mechanism::read_model_text(path), values));
}

Model Model::with(const std::vector<Value>& values) const {
  std::vector<Value> all = values;
  for (const Value& old : content_->values)
    if (std::none_of(values.begin(), values.end(), [&](const Value& v) { return v.first == old.first; }))
      all.push_back(old);
  mechanism::Mechanism parsed = content_->shared->read(all);
  return Model(std::make_shared<const Content>(Content{content_->shared, std::move(all), std::move(parsed), true}));
}

const std::string& Model::name() const { return content_->mechanism.name; }
const std::string& Model::file() const { return content_->shared->file(); }
const std::string& Model::text() const { return content_->shared->text(); }
const std::vector<Model::Value>& Model::values() const { return content_->values; }
const Units& Model::units() const { return content_->mechanism.units; }
bool Model::spatial() const { return content_->mechanism.space == mechanism::Space::spatial; }

std::vector<Model::Parameter> Model::parameters() const {
  std::vector<Parameter> list;
  for (const mechanism::Parameter& current : content_->mechanism.parameters)
    list.push_back({current.name, current.exact ? core::to_string(current.value) : core::to_string(current.expression),
                    core::to_double(current.value)});
  return list;
}

std::vector<Model::Coordinate> Model::coordinates() const {
  std::vector<Coordinate> list;
  for (const mechanism::Coordinate& current : content_->mechanism.coordinates)
    list.push_back({current.name, current.angle, core::to_double(current.lower), core::to_double(current.upper)});
  return list;
}

std::vector<Model::Joint> Model::joints() const {
  const mechanism::Mechanism& mechanism = content_->mechanism;
  std::vector<Joint> list;
  for (const mechanism::Joint& joint : mechanism.joints)
    list.push_back({.name = joint.name,
                    .type = mechanism::to_string(joint.type),
                    .actuated = joint.actuated,
                    .clearance = joint.clearance.has_value(),
                    .from = link_name(mechanism, joint.from),
                    .to = link_name(mechanism, joint.to),
                    .at = point_name(mechanism, joint.at)});
  return list;
}

std::vector<Model::Link> Model::links() const {
  const mechanism::Mechanism& mechanism = content_->mechanism;
  std::vector<Link> list;
  for (const mechanism::Link& entry : mechanism.links) {
    Link& link = list.emplace_back(Link{entry.name, {}});
    for (const mechanism::PointIndex point : entry.points) link.points.push_back(point_name(mechanism, point));
  }
  return list;
}

Model::EndEffector Model::end_effector() const {
  const mechanism::Mechanism& mechanism = content_->mechanism;
  return {link_name(mechanism, mechanism.end_effector_link), point_name(mechanism, mechanism.end_effector_point)};
}

std::vector<Model::Dyad> Model::dyads() const {
  const mechanism::Mechanism& current = content_->mechanism;
  const std::vector<mechanism::PointIndex> points = mechanism::dyad_points(current);
  const std::vector<int> sides = mechanism::working_mode(current);
  std::vector<Dyad> list;
  for (std::size_t j = 0; j < points.size(); ++j)
    list.push_back({current.points[static_cast<std::size_t>(points[j])].name,
                    mechanism::side_name(current, points[j], 1), mechanism::side_name(current, points[j], -1),
                    sides[j]});
  return list;
}

}  // namespace clearloci
