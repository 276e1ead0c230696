// Task files.
#include "mechanism/read_task.hpp"

#include <algorithm>
#include <utility>

#include "core/task.hpp"
#include "mechanism/joint_traits.hpp"
#include "mechanism/open_design.hpp"
#include "mechanism/reader.hpp"

namespace clearloci::mechanism {
namespace {

using core::InputError;

const std::vector<std::string> task_keys = {"format",     "name",       "box",        "circle",     "ball",
                                            "polygon",    "path",       "mesh",       "margin",     "angle_length",
                                            "min_force",  "min_couple", "loads_from", "tolerances", "loads_within",
                                            "pose_error", "preload",    "knows_load"};

/// [[0, -80], [20, -100]]: of two components in the plane and of three in space.
core::LoadRange read_loads_from(const Mechanism& mechanism, const Value& value) {
  const bool one_force = mechanism.loads.size() == 1 && !mechanism.loads.front().force.empty();
  if (!one_force)
    throw InputError(value.where,
                     value.what + " takes the place of a mechanism's one force, but " + mechanism.file + " has " +
                         std::to_string(mechanism.loads.size()) + " loads",
                     "give the mechanism a single load with a force");
  const std::vector<Value> ends = elements(value, 2);
  core::LoadRange range;
  for (std::size_t i = 0; i < 2; ++i)
    for (const Value& part : components(mechanism, ends[i]))
      (i == 0 ? range.first : range.second).push_back(read_number(mechanism, part, Sign::any).value);
  const auto& [f, g] = range;
  Rational along = 0;
  bool parallel = true;
  for (std::size_t i = 0; i < f.size(); ++i) {
    along += f[i] * g[i];
    for (std::size_t k = 0; k < i; ++k) parallel = parallel && f[i] * g[k] == f[k] * g[i];
  }
  if (parallel && along <= 0)
    throw InputError(value.where, value.what + " passes through no load at all: its ends are opposite or zero",
                     "write two vectors less than half a turn apart");
  return range;
}

/// {L1: 0.1e-3, d: [-0.2e-3, 0.1e-3]}
std::vector<core::Tolerance> read_tolerances(const Mechanism& mechanism, const Value& value) {
  std::vector<std::string> allowed;
  for (const Parameter& parameter : mechanism.parameters) allowed.push_back(parameter.name);
  std::vector<core::Tolerance> tolerances;
  for (Entry& entry : entries(value)) {
    if (std::find(allowed.begin(), allowed.end(), entry.key) == allowed.end())
      throw InputError(entry.where, "there is no parameter '" + entry.key + "' in " + mechanism.file,
                       allowed.empty() ? "the file has no parameters" : suggest(entry.key, allowed, "parameters"));
    const Parameter& parameter = *parameter_named(mechanism, entry.key);
    entry.value.what = "the tolerance of " + entry.key;
    core::Tolerance tolerance{entry.key, 0, 0};
    if (entry.value.is_sequence()) {
      const std::vector<Value> ends = elements(entry.value, 2);
      tolerance.below = read_parameter_value(mechanism, parameter, ends[0]);
      tolerance.above = read_parameter_value(mechanism, parameter, ends[1]);
    } else {
      tolerance.above = read_parameter_value(mechanism, parameter, entry.value);
      if (tolerance.above < 0)
        throw InputError(entry.value.where, entry.value.what + " is negative", "write 0 or a value above 0");
      tolerance.below = -tolerance.above;
    }
    if (tolerance.below > 0 || tolerance.above < 0)
      throw InputError(entry.value.where, entry.value.what + " does not contain the value of the parameter",
                       "write a number, or [below, above] with below <= 0 <= above");
    tolerances.push_back(std::move(tolerance));
  }
  return tolerances;
}

/// [{load: 1, radius: 20, couple: 2}], loads counted from 1.
std::vector<core::LoadWithin> read_loads_within(const Mechanism& mechanism, const Value& value) {
  std::vector<core::LoadWithin> all;
  for (Value element : elements(value)) {
    element.what = "entry " + std::to_string(all.size() + 1) + " of " + value.what;
    const Mapping keys(element, {"load", "radius", "couple"});
    const Value which = keys.at("load");
    const Rational number = read_number(mechanism, which, Sign::positive).value;
    if (number.get_den() != 1 || number > static_cast<long>(mechanism.loads.size()))
      throw InputError(which.where,
                       "there is no load " + core::to_string(number) + " in " + mechanism.file + ", which has " +
                           std::to_string(mechanism.loads.size()),
                       "count its loads from 1");
    core::LoadWithin within{static_cast<std::size_t>(number.get_num().get_ui()) - 1};
    if (std::any_of(all.begin(), all.end(), [&](const core::LoadWithin& one) { return one.load == within.load; }))
      throw InputError(which.where, "load " + core::to_string(number) + " is varied twice", "write one entry a load");
    if (auto radius = keys.find("radius")) {
      radius->field = "force";  // not the length that a circle's radius is
      within.force = read_number(mechanism, *radius, Sign::not_negative).value;
    }
    if (const auto couple = keys.find("couple"))
      within.couple = read_number(mechanism, *couple, Sign::not_negative).value;
    if (within.force > 0 && !mechanism.loads[within.load].at)
      throw InputError(element.where, element.what + " varies the force of a load that is a couple alone",
                       "give the load a point and a force, or leave out the radius");
    all.push_back(within);
  }
  return all;
}

/// constant, controlled, or {A4: 3.5}: what joints of free effort exert.
void read_preload(const Mechanism& mechanism, const Value& value, core::Task& task) {
  std::vector<std::string> allowed;
  for (const JointIndex j : preloaded_joints(mechanism))
    allowed.push_back(mechanism.joints[static_cast<std::size_t>(j)].name);
  if (allowed.empty())
    throw InputError(value.where, "no joint of " + mechanism.file + " has a free effort",
                     "write actuated: {effort: free} at a motor more than the mechanism needs");
  if (value.is_scalar()) {
    task.controlled_preload = text_of(value) == "controlled";
    if (task.controlled_preload || text_of(value) == "constant") return;
    throw InputError(
        value.where, "the preload is '" + text_of(value) + "'",
        "write constant, one choice for the whole task, controlled, a law over it, or an effort for each joint: {" +
            allowed.front() + ": 3.5}");
  }
  for (Entry& entry : entries(value)) {
    if (std::find(allowed.begin(), allowed.end(), entry.key) == allowed.end())
      throw InputError(entry.where, "no joint of free effort is called " + entry.key,
                       suggest(entry.key, allowed, "joints of free effort"));
    for (const Joint& joint : mechanism.joints)
      if (joint.name == entry.key) {
        entry.value.what = "the effort of " + entry.key;
        entry.value.field = traits(joint).actuator == core::Quantity::F ? "force" : "couple";
      }
    task.preload.emplace_back(entry.key, read_number(mechanism, entry.value, Sign::any).value);
  }
}

/// Whether a law may depend on the load.
void read_knows_load(const Value& value, core::Task& task) {
  task.knows_load = boolean_of(value);
  if (task.knows_load && !task.controlled_preload)
    throw InputError(value.where, "only a preload that varies with the pose may vary with the load",
                     "write preload: controlled, or leave knows_load out");
}

}  // namespace

core::Task task_of(const Value& document, const Mechanism& mechanism, const HandedFiles* handed) {
  if (!document.is_map())
    throw InputError(document.where, "the file is no mapping of keys to values", "start with the line format: 1");
  const Mapping root(document, task_keys);
  core::Task task;
  task.file = document.where.file;
  if (auto length = root.find("angle_length")) {
    const auto& all = mechanism.coordinates;
    if (std::none_of(all.begin(), all.end(), [](const Coordinate& c) { return c.angle; }))
      throw InputError(length->where, length->what + " is given, but no coordinate is an angle", "leave it out");
    length->field = "margin";
    task.angle_length = read_number(mechanism, *length, Sign::positive).value;
  }
  const bool weighted = task.angle_length.has_value();
  task.shape = read_task_shape(mechanism, document, root, task.angle_length, handed);
  if (const auto margin = root.find("margin"))
    task.margin = read_number(mechanism, in_metric(*margin, mechanism, weighted), Sign::not_negative).value;
  if (const auto force = root.find("min_force")) task.min_force = read_number(mechanism, *force, Sign::positive).value;
  if (const auto couple = root.find("min_couple"))
    task.min_couple = read_number(mechanism, *couple, Sign::positive).value;
  if (const auto loads = root.find("loads_from")) task.loads = read_loads_from(mechanism, *loads);
  if (const auto error = root.find("pose_error"))
    task.pose_error = read_number(mechanism, *error, Sign::positive).value;
  if (const auto preload = root.find("preload")) read_preload(mechanism, *preload, task);
  if (const auto knows = root.find("knows_load")) read_knows_load(*knows, task);
  if (const auto all = root.find("tolerances")) task.tolerances = read_tolerances(mechanism, *all);
  if (const auto all = root.find("loads_within")) task.loads_within = read_loads_within(mechanism, *all);
  return task;
}

core::Task parse_task(const std::string& text, const std::string& file, const Mechanism& mechanism,
                      const HandedFiles* handed) {
  const Value document = parse_document(text, file);
  if (document.is_map()) {
    const Mapping root(document, task_keys);
    check_format(root.at("format"));
  }
  return task_of(document, mechanism, handed);
}

core::Task read_task(const std::string& path, const Mechanism& mechanism) {
  return parse_task(read_text(path, "the task file"), path, mechanism);
}

}  // namespace clearloci::mechanism
