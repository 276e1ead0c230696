#include "mechanism/import/joint_constraints.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace clearloci::mechanism::imports {

template <typename Do>
void Constraints::each_freedom(const SourceJoint& j, const Do& one) const {
  for (const bool from : {true, false}) {
    const int link = from ? j.from : j.to;
    if (link == ground_link) continue;
    for (std::size_t f = 0; f < freedoms; ++f) one(freedoms * index(link) + f, f, from);
  }
}

Constraints::Constraints(const Source& source) : source_(source), scale_(1 / std::max(size_of(source), 1e-300)) {
  centres_.resize(source.links.size());
  std::vector<std::size_t> counts(source.links.size());
  for (const SourceJoint& joint : source.joints) {
    if (joint.dropped) continue;
    for (const auto& [link, side] : {std::pair{joint.from, &joint.on_from}, std::pair{joint.to, &joint.on_to}}) {
      if (link == ground_link) continue;
      centres_[index(link)] = centres_[index(link)] + side->at;
      ++counts[index(link)];
    }
  }
  for (std::size_t i = 0; i < centres_.size(); ++i)
    if (counts[i] > 0) centres_[i] = (1 / static_cast<double>(counts[i])) * centres_[i];
}

void Constraints::add(const SourceJoint& j, std::vector<double>& values, Rows* rows) const {
  using Kind = SourceKind;
  const bool meets =
      j.kind == Kind::revolute || j.kind == Kind::spherical || j.kind == Kind::universal || j.kind == Kind::fixed;
  if (meets) add_meeting(j, values, rows);
  if (j.slides()) add_line(j, values, rows);
  if (j.kind == Kind::slot) {
    // It is in the plane, and one of x and y across that.
    const bool x = std::abs(j.on_from.frame.x[2]) > std::abs(j.on_from.frame.y[2]);
    const auto normal = [&](const JointSide& side) { return x ? &side.frame.x : &side.frame.y; };
    add_parallel(j, {normal(j.on_from)}, {normal(j.on_to)}, values, rows);
  }
  if (j.kind == Kind::revolute || j.kind == Kind::cylindrical)
    add_parallel(j, {&j.on_from.frame.z}, {&j.on_to.frame.z}, values, rows);
  if (j.kind == Kind::prismatic || j.kind == Kind::fixed)
    add_parallel(j, {&j.on_from.frame.x, &j.on_from.frame.y, &j.on_from.frame.z},
                 {&j.on_to.frame.x, &j.on_to.frame.y, &j.on_to.frame.z}, values, rows);
  if (j.kind == Kind::universal) add_square(j, values, rows);
}

Vec Constraints::moved(int link, const Vec& at, std::size_t freedom) const {
  Vec e{};
  e[freedom % 3] = 1;
  // Lengths in sizes: a velocity of 1 is a size, so that columns of turning are alike.
  return freedom < 3 ? e : scale_ * cross(e, at - centre(link));
}

Vec Constraints::turned(const Vec& direction, std::size_t freedom) {
  if (freedom < 3) return {};
  Vec e{};
  e[freedom - 3] = 1;
  return cross(e, direction);
}

Rows* Constraints::start(Rows* rows, std::size_t count) const {
  if (rows != nullptr) rows->resize(rows->size() + count, std::vector<double>(columns()));
  return rows;
}

void Constraints::add_meeting(const SourceJoint& j, std::vector<double>& values, Rows* rows) const {
  const Vec gap = scale_ * (j.on_from.at - j.on_to.at);
  for (std::size_t i = 0; i < 3; ++i) values.push_back(gap[i]);
  if (start(rows, 3) == nullptr) return;
  each_freedom(j, [&](std::size_t column, std::size_t freedom, bool from) {
    const Vec d = from ? moved(j.from, j.on_from.at, freedom) : -moved(j.to, j.on_to.at, freedom);
    for (std::size_t i = 0; i < 3; ++i) (*rows)[rows->size() - 3 + i][column] += d[i];
  });
}

/// The point of `to` is on the line of `from`: z × gap = 0.
void Constraints::add_line(const SourceJoint& j, std::vector<double>& values, Rows* rows) const {
  const Vec& z = j.on_from.frame.z;
  const Vec gap = scale_ * (j.on_to.at - j.on_from.at), off = cross(z, gap);
  for (std::size_t i = 0; i < 3; ++i) values.push_back(off[i]);
  if (start(rows, 3) == nullptr) return;
  each_freedom(j, [&](std::size_t column, std::size_t freedom, bool from) {
    const Vec d = from ? cross(turned(z, freedom), gap) - cross(z, moved(j.from, j.on_from.at, freedom))
                       : cross(z, moved(j.to, j.on_to.at, freedom));
    for (std::size_t i = 0; i < 3; ++i) (*rows)[rows->size() - 3 + i][column] += d[i];
  });
}

void Constraints::add_parallel(const SourceJoint& j, const std::vector<const Vec*>& of_from,
                               const std::vector<const Vec*>& of_to, std::vector<double>& values, Rows* rows) const {
  // Cross products are 0 for opposite directions too: what is turned apart by more than a right angle (of three axes:
  // 1 + 2 cos < 1) is pushed together by the difference of the axis that is farthest off.
  double together = 0;
  std::size_t farthest = 0;
  Vec off{};
  for (std::size_t a = 0; a < of_from.size(); ++a) {
    together += dot(*of_from[a], *of_to[a]);
    off = off + cross(*of_from[a], *of_to[a]);
    if (dot(*of_from[a], *of_to[a]) < dot(*of_from[farthest], *of_to[farthest])) farthest = a;
  }
  const bool flipped = together < (of_from.size() == 1 ? 0 : 1);
  if (flipped) off = *of_from[farthest] - *of_to[farthest];
  for (std::size_t i = 0; i < 3; ++i) values.push_back(off[i]);
  if (start(rows, 3) == nullptr) return;
  each_freedom(j, [&](std::size_t column, std::size_t freedom, bool from) {
    Vec d{};
    for (std::size_t a = 0; a < of_from.size(); ++a) {
      if (flipped && a == farthest) d = d + (from ? turned(*of_from[a], freedom) : -turned(*of_to[a], freedom));
      if (!flipped)
        d = d +
            (from ? cross(turned(*of_from[a], freedom), *of_to[a]) : cross(*of_from[a], turned(*of_to[a], freedom)));
    }
    for (std::size_t i = 0; i < 3; ++i) (*rows)[rows->size() - 3 + i][column] += d[i];
  });
}

/// The two axes of a universal joint are at a right angle.
void Constraints::add_square(const SourceJoint& j, std::vector<double>& values, Rows* rows) const {
  values.push_back(dot(j.on_from.frame.z, j.on_to.frame.z));
  if (start(rows, 1) == nullptr) return;
  each_freedom(j, [&](std::size_t column, std::size_t freedom, bool from) {
    rows->back()[column] += from ? dot(turned(j.on_from.frame.z, freedom), j.on_to.frame.z)
                                 : dot(j.on_from.frame.z, turned(j.on_to.frame.z, freedom));
  });
}

double amount_of(const SourceJoint& joint) {
  const Vec &z = joint.axis(), &from = joint.on_from.frame.x, &to = joint.on_to.frame.x;
  if (joint.kind == SourceKind::revolute) return std::atan2(dot(z, cross(from, to)), dot(from, to));
  const bool slides = joint.kind == SourceKind::prismatic || joint.kind == SourceKind::cylindrical;
  return slides ? dot(z, joint.on_to.at - joint.on_from.at) : 0;
}

double way_between(const SourceJoint& before, const SourceJoint& after) {
  const double way = amount_of(after) - amount_of(before);
  return after.slides() ? way : std::remainder(way, 2 * std::numbers::pi);
}

double largest(const std::vector<double>& values) {
  double most = 0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return std::isfinite(most) ? most : std::numeric_limits<double>::infinity();
}

Rows constraint_rows(const Source& source) {
  const Constraints constraints(source);
  std::vector<double> values;
  Rows rows;
  for (const SourceJoint& joint : source.joints)
    if (!joint.dropped) constraints.add(joint, values, &rows);
  for (const SourceMesh& mesh : source.meshes) {
    const auto carrier = carrier_of(source, mesh);
    if (!carrier) continue;
    const double first = static_cast<double>(mesh.teeth[0]),
                 second = (mesh.belt ? -1 : 1) * static_cast<double>(mesh.teeth[1]);
    std::vector<double> row(constraints.columns());
    const auto add = [&](int link, double weight) {
      if (link != ground_link) row[freedoms * static_cast<std::size_t>(link) + freedoms - 1] += weight;
    };
    add(mesh.links[0], first);
    add(mesh.links[1], second);
    add(*carrier, -first - second);
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<double> motor_row(const Source& source, const SourceJoint& joint) {
  const Constraints constraints(source);
  std::vector<double> row(constraints.columns());
  const Vec& z = joint.axis();
  for (const bool from : {true, false}) {
    const int link = from ? joint.from : joint.to;
    if (link == ground_link) continue;
    for (std::size_t f = 0; f < freedoms; ++f) {
      const double along = joint.slides() ? dot(z, constraints.moved(link, joint.at(), f)) : f < 3 ? 0 : z[f - 3];
      row[freedoms * static_cast<std::size_t>(link) + f] += from ? -along : along;
    }
  }
  return row;
}

bool RowSpace::add(std::vector<double> row) {
  constexpr double nothing = 1e-8;  // of the row: what is left of one that depends on the others
  const double size = largest(row);
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const double factor = row[pivots_[r]];
    if (factor != 0)
      for (std::size_t c = 0; c < row.size(); ++c) row[c] -= factor * rows_[r][c];
  }
  std::size_t pivot = 0;
  for (std::size_t c = 1; c < row.size(); ++c)
    if (std::abs(row[c]) > std::abs(row[pivot])) pivot = c;
  if (row.empty() || !(std::abs(row[pivot]) > nothing * size)) return false;
  const double factor = row[pivot];
  for (double& entry : row) entry /= factor;
  rows_.push_back(std::move(row));
  pivots_.push_back(pivot);
  return true;
}

}  // namespace clearloci::mechanism::imports
