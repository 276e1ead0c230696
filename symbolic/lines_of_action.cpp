#include "symbolic/lines_of_action.hpp"

#include <algorithm>
#include <iterator>

#include "mechanism/actions.hpp"

namespace clearloci::symbolic {
namespace {

using mechanism::Mechanism;
using mechanism::PointIndex;

/// Longer factors state none of the conditions, which are products of a few vectors.
constexpr std::size_t longest_factor = 2000;
/// Of so many links that bear loads, those of every set are summed.
constexpr std::size_t most_loaded = 6;

std::size_t place(PointIndex point) { return static_cast<std::size_t>(point); }

std::string joined(const std::vector<std::string>& names) {
  std::string list;
  for (std::size_t i = 0; i < names.size(); ++i)
    list += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return list;
}

}  // namespace

LinesOfAction::LinesOfAction(const Geometry& geometry, const NewtonEulerEquations& equations)
    : geometry_(geometry),
      planar_(geometry.mechanism().space == mechanism::Space::planar),
      at_{ResiduePose(geometry, 0), ResiduePose(geometry, 1)} {
  for (std::size_t i = 0; i < geometry.mechanism().points.size(); ++i) {
    const auto& p = geometry.natural(static_cast<PointIndex>(i));
    points_.push_back({{values(p[0]), values(p[1]), values(p[2])}});
  }
  add_links();
  add_axes();
  add_loads(equations);
  add_springs();
  add_directions();
  add_universals();
  add_pairs();
  add_triples();
  add_balances();
  // Of two that say the same, the one on whole links and axes.
  std::stable_partition(conditions_.begin(), conditions_.end(), [](const Condition& condition) {
    return std::none_of(condition.lines.begin(), condition.lines.end(), [](const Line* line) { return line->part; });
  });
}

LinesOfAction::Values LinesOfAction::values(const Poly& p) const {
  const core::Polynomial plain = p.plain();
  return {at_[0].value(plain), at_[1].value(plain)};
}

LinesOfAction::Values LinesOfAction::values(const GiNaC::ex& expression) const {
  return values(geometry_.poly(expression));
}

LinesOfAction::Values LinesOfAction::product(const Values& a, const Values& b) { return {a[0] * b[0], a[1] * b[1]}; }
LinesOfAction::Values LinesOfAction::sum(const Values& a, const Values& b) { return {a[0] + b[0], a[1] + b[1]}; }
LinesOfAction::Values LinesOfAction::difference(const Values& a, const Values& b) {
  return {a[0] + -b[0], a[1] + -b[1]};
}
LinesOfAction::Values LinesOfAction::dot(const Vector& a, const Vector& b) {
  return sum(sum(product(a.along[0], b.along[0]), product(a.along[1], b.along[1])), product(a.along[2], b.along[2]));
}
LinesOfAction::Vector LinesOfAction::cross(const Vector& a, const Vector& b) {
  Vector result;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    result.along[i] = difference(product(a.along[j], b.along[k]), product(a.along[k], b.along[j]));
  }
  return result;
}

LinesOfAction::Vector LinesOfAction::vector(const mechanism::VectorExpression& written) const {
  const std::vector<GiNaC::ex> u = geometry_.vector(written);
  return {{values(u[0]), values(u[1]), u.size() > 2 ? values(u[2]) : Values{}}};
}

LinesOfAction::Vector LinesOfAction::way(PointIndex from, PointIndex to) const {
  Vector result;
  for (std::size_t i = 0; i < 3; ++i)
    result.along[i] = difference(points_[place(to)].along[i], points_[place(from)].along[i]);
  return result;
}

LinesOfAction::Values LinesOfAction::moment(PointIndex at, const Vector& along) const {
  return cross(way(geometry_.mechanism().end_effector_point, at), along).along[2];
}

/// The lines through any two points of a link.
void LinesOfAction::add_links() {
  const Mechanism& m = geometry_.mechanism();
  for (std::size_t i = 0; i < m.links.size(); ++i) {
    std::vector<PointIndex> at;
    for (const PointIndex p : m.links[i].points)
      if (!m.points[place(p)].auxiliary) at.push_back(p);
    for (std::size_t a = 0; a < at.size(); ++a)
      for (std::size_t b = a + 1; b < at.size(); ++b) {
        const Vector along = way(at[a], at[b]);
        const bool whole = at.size() == 2;
        lines_.push_back(
            {Kind::link,
             whole ? m.links[i].name
                   : m.points[place(at[a])].name + "-" + m.points[place(at[b])].name + " of " + m.links[i].name,
             along, moment(at[a], along), !whole});
      }
  }
}

void LinesOfAction::add_axes() {
  const Mechanism& m = geometry_.mechanism();
  for (const mechanism::Joint& joint : m.joints) {
    if (joint.type == mechanism::JointType::universal) continue;  // has two
    for (const mechanism::VectorExpression& axis : joint.axes) {
      const Vector along = vector(axis);
      lines_.push_back({Kind::axis, joint.name, along, moment(joint.at, along)});
    }
  }
}

void LinesOfAction::add_loads(const NewtonEulerEquations& equations) {
  const Mechanism& m = geometry_.mechanism();
  const unsigned rows = planar_ ? 3 : 6;
  for (std::size_t link = 0; link < m.links.size(); ++link) {
    const auto first = static_cast<unsigned>(link) * rows;
    const auto row = [&](unsigned i) { return equations.loads(first + i, 0); };
    bool any = false;
    for (unsigned i = 0; i < rows; ++i) any = any || !row(i).is_zero();
    if (!any) continue;
    Resultant resultant{link, {{values(row(0)), values(row(1)), planar_ ? Values{} : values(row(2))}}, {}};
    if (planar_) resultant.moment = values(row(2));
    resultants_.push_back(resultant);
  }
  for (const std::vector<std::size_t>& set : loaded_sets()) {
    if (set.size() > 1 && set.size() < resultants_.size()) continue;
    Line line{Kind::load, loads_on(set), {}, Values{}};
    for (const std::size_t i : set) {
      for (std::size_t k = 0; k < 3; ++k) line.way.along[k] = sum(line.way.along[k], resultants_[i].force.along[k]);
      line.moment = sum(line.moment, resultants_[i].moment);
    }
    lines_.push_back(std::move(line));
  }
}

/// By their places in resultants_: every set where there are few, else each link alone and all of them.
std::vector<std::vector<std::size_t>> LinesOfAction::loaded_sets() const {
  std::vector<std::vector<std::size_t>> sets;
  const std::size_t count = resultants_.size();
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < count; ++i) all.push_back(i);
  if (count > most_loaded) {
    for (const std::size_t i : all) sets.push_back({i});
    sets.push_back(all);
    return sets;
  }
  for (std::size_t bits = 1; bits < std::size_t{1} << count; ++bits) {
    std::vector<std::size_t>& set = sets.emplace_back();
    std::copy_if(all.begin(), all.end(), std::back_inserter(set), [&](std::size_t i) { return (bits >> i & 1U) != 0; });
  }
  return sets;
}

std::string LinesOfAction::loads_on(const std::vector<std::size_t>& set) const {
  const Mechanism& m = geometry_.mechanism();
  if (set.size() == resultants_.size())
    return m.loads.size() == 1 && m.gravity.empty() && m.springs.empty() && set.size() == 1 ? "the load" : "the loads";
  std::vector<std::string> names;
  for (const std::size_t i : set) names.push_back(m.links[resultants_[i].link].name);
  return "the loads on " + joined(names);
}

std::string LinesOfAction::listed(const std::vector<const Line*>& lines) {
  std::vector<std::string> parts;
  for (const Kind kind : {Kind::load, Kind::axis, Kind::link}) {
    std::vector<std::string> names;
    bool whole = true;
    for (const Line* line : lines) {
      if (line->kind != kind) continue;
      names.push_back(line->name);
      whole = whole && !line->part;
    }
    if (kind == Kind::load) parts = names;
    if (kind == Kind::load || names.empty()) continue;
    const bool several = names.size() > 1;
    std::string what = several ? "the axes of " : "the axis of ";
    if (kind == Kind::link) what = whole ? (several ? "links " : "link ") : (several ? "lines " : "line ");
    parts.push_back(what + joined(names));
  }
  return joined(parts);
}

void LinesOfAction::add(const Values& condition, std::vector<const Line*> lines, const char* words, bool of_loads) {
  if (condition[0].is_zero() || condition[1].is_zero()) return;
  for (const Line* line : lines) of_loads = of_loads || line->kind == Kind::load;
  conditions_.push_back({condition, std::move(lines), words, of_loads});
}

/// stiffness (|v| - l) v / |v| = stiffness (1 - l / |v|) v.
void LinesOfAction::add_springs() {
  const Mechanism& m = geometry_.mechanism();
  for (const mechanism::Spring& spring : m.springs) {
    if (spring.kind != mechanism::Spring::Kind::linear || !geometry_.has_inverse_length(spring.name)) continue;
    const GiNaC::ex left = 1 - geometry_.expression(spring.free_length) * geometry_.inverse_length(spring.name).natural;
    add(values(left.expand()), {}, ("spring " + spring.name + " at its free length").c_str(), true);
  }
}

void LinesOfAction::add_directions() {
  const std::vector<const char*> words =
      planar_
          ? std::vector{"parallel to the y axis", "parallel to the x axis"}
          : std::vector{"perpendicular to the x axis", "perpendicular to the y axis", "perpendicular to the z axis"};
  for (const Line& line : lines_)
    for (std::size_t i = 0; i < words.size(); ++i) add(line.way.along[i], {&line}, words[i]);
}

/// |u1 x u2|^2, by which the couple across both axes is divided.
void LinesOfAction::add_universals() {
  for (const mechanism::Joint& joint : geometry_.mechanism().joints) {
    if (joint.type != mechanism::JointType::universal || joint.axes.size() != 2) continue;
    const Vector across = cross(vector(joint.axes[0]), vector(joint.axes[1]));
    add(dot(across, across), {}, ("the axes of " + joint.name + " parallel").c_str());
  }
}

void LinesOfAction::add_pairs() {
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const Line& a = lines_[i];
    if (a.kind == Kind::axis) add(dot(a.way, a.way), {&a}, "without a direction");
    for (std::size_t k = i + 1; k < lines_.size(); ++k) {
      const Line& b = lines_[k];
      if (planar_) add(cross(a.way, b.way).along[2], {&a, &b}, "parallel");
      add(dot(a.way, b.way), {&a, &b}, "perpendicular");
    }
  }
}

void LinesOfAction::add_triples() {
  for (std::size_t i = 0; i < lines_.size(); ++i)
    for (std::size_t j = i + 1; j < lines_.size(); ++j) {
      const Line &a = lines_[i], &b = lines_[j];
      const Vector across = cross(a.way, b.way);
      for (std::size_t k = j + 1; k < lines_.size(); ++k) {
        const Line& c = lines_[k];
        if (!planar_) {
          add(dot(across, c.way), {&a, &b, &c}, "parallel to one plane");
          continue;
        }
        const Values bc = cross(b.way, c.way).along[2], ac = cross(a.way, c.way).along[2];
        add(sum(difference(product(bc, a.moment), product(ac, b.moment)), product(across.along[2], c.moment)),
            {&a, &b, &c}, "meet in one point or are parallel");
      }
    }
}

void LinesOfAction::add_balances() {
  if (!planar_) return;
  const Mechanism& m = geometry_.mechanism();
  for (const std::vector<std::size_t>& set : loaded_sets()) {
    Vector force;
    Values about_end_effector{};
    for (const std::size_t i : set) {
      for (std::size_t k = 0; k < 3; ++k) force.along[k] = sum(force.along[k], resultants_[i].force.along[k]);
      about_end_effector = sum(about_end_effector, resultants_[i].moment);
    }
    const std::string loads = loads_on(set),
                      words = loads + (loads == "the load" ? " balances about " : " balance about ");
    const auto add_about = [&](PointIndex p) {
      if (!m.points[place(p)].auxiliary)
        add(difference(about_end_effector, moment(p, force)), {}, (words + m.points[place(p)].name).c_str(), true);
    };
    // Where they balance about several points, those of the links themselves come first.
    for (const std::size_t i : set)
      for (const PointIndex p : m.links[resultants_[i].link].points) add_about(p);
    for (std::size_t p = 0; p < m.points.size(); ++p) add_about(static_cast<PointIndex>(p));
  }
}

std::string LinesOfAction::of(const Poly& factor, bool loads) const {
  if (factor.length() > longest_factor) return "";
  const Values factor_values = values(factor);
  for (const Condition& condition : conditions_)
    if ((loads || !condition.of_loads) &&
        factor_values[0] * condition.values[1] == factor_values[1] * condition.values[0])
      return condition.lines.empty() ? condition.words : listed(condition.lines) + " " + condition.words;
  return "";
}

}  // namespace clearloci::symbolic
