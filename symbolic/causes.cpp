#include "symbolic/causes.hpp"

#include <algorithm>

#include "mechanism/actions.hpp"

namespace clearloci::symbolic {
namespace {

using mechanism::Mechanism;
using mechanism::PointIndex;
using Vector = std::array<Poly, 3>;

Vector difference(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
/// In the plane.
Poly cross(const Vector& a, const Vector& b) { return a[0] * b[1] - a[1] * b[0]; }
Poly dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

}  // namespace

/// Two points of one link.
struct Causes::Edge {
  std::size_t link;
  PointIndex from, to;
  std::string wording;
};

/// A direction that loads act in.
struct Causes::Direction {
  Vector along;
  std::string wording;
  std::optional<PointIndex> at;
};

Causes::Causes(const Geometry& geometry, const NewtonEulerEquations* equations)
    : geometry_(&geometry), equations_(equations) {
  const Mechanism& m = geometry.mechanism();
  for (std::size_t i = 0; i < m.points.size(); ++i) {
    const auto& p = geometry.natural(static_cast<PointIndex>(i));
    points_.push_back({geometry.poly(p[0]), geometry.poly(p[1]), geometry.poly(p[2])});
  }
  for (std::size_t i = 0; i < m.points.size(); ++i)
    if (const auto* dyad = std::get_if<mechanism::DyadPoint>(&m.points[i].form); dyad != nullptr && dyad->axis)
      add(stretched(static_cast<PointIndex>(i), *dyad), stretched_wording(static_cast<PointIndex>(i), *dyad));
  first_of_springs_ = conditions_.size();
  if (m.space == mechanism::Space::spatial) return;  // the conditions below are those of the plane
  // The point of a dependent root may be placed beside another one: where its leg is stretched is a fold, whatever else
  // it is on this side of it.
  for (const TowerRoot& root : geometry.roots())
    if (root.value) add_alignments_along_chains(root.point);
  std::vector<Edge> edges;
  for (std::size_t i = 0; i < m.links.size(); ++i) {
    const auto& points = m.links[i].points;
    for (std::size_t a = 0; a < points.size(); ++a) {
      for (std::size_t b = a + 1; b < points.size(); ++b) {
        const std::string& name = m.links[i].name;
        edges.push_back({i, points[a], points[b],
                         points.size() == 2
                             ? "link " + name
                             : "line " + m.points[static_cast<std::size_t>(points[a])].name + "-" +
                                   m.points[static_cast<std::size_t>(points[b])].name + " of link " + name});
      }
    }
  }
  std::vector<Direction> directions;
  const auto direction = [&](const std::vector<core::Expression>& force) {
    return Vector{geometry.poly(geometry.expression(force[0]).expand()),
                  geometry.poly(geometry.expression(force[1]).expand()), Poly(geometry.ring())};
  };
  const auto forces = std::count_if(m.loads.begin(), m.loads.end(), [](const auto& l) { return l.has_force(); });
  for (const mechanism::Load& load : m.loads) {
    if (!load.has_force()) continue;
    const std::string on = forces > 1 ? " on " + m.links[static_cast<std::size_t>(load.link)].name : "";
    directions.push_back({vector(mechanism::force_of(load)), "the load" + on, load.at});
  }
  std::vector<Direction> springs;
  for (const mechanism::Spring& spring : m.springs)
    if (spring.kind != mechanism::Spring::Kind::torsion)
      springs.push_back(
          {vector(mechanism::way(spring.from_point, spring.to_point)), "spring " + spring.name, spring.from_point});
  if (!m.gravity.empty()) directions.push_back({direction(m.gravity), "gravity", std::nullopt});
  first_of_loads_ = conditions_.size();
  add_load_conditions(edges, directions);
  last_of_loads_ = conditions_.size();
  add_alignments();
  add_link_pairs(edges);
  // Last, since a spring between two joints lies along what has a name of its own.
  first_of_springs_ = conditions_.size();
  add_load_conditions(edges, springs);
}

void Causes::add(const Poly& condition, std::string wording) {
  if (!condition.is_constant()) conditions_.emplace_back(condition.primitive(), std::move(wording));
}

Poly Causes::aligned(PointIndex a, PointIndex b, PointIndex c) const {
  const auto& p = points_;
  const auto at = [](PointIndex i) { return static_cast<std::size_t>(i); };
  return cross(difference(p[at(b)], p[at(a)]), difference(p[at(c)], p[at(a)])).primitive();
}

Poly Causes::stretched(PointIndex elbow, const mechanism::DyadPoint& dyad) const {
  if (!dyad.axis) return aligned(dyad.from, elbow, dyad.to);
  const auto at = [&](PointIndex i) { return points_[static_cast<std::size_t>(i)]; };
  const Vector n = vector(*dyad.axis), a = difference(at(elbow), at(dyad.from)),
               b = difference(at(dyad.to), at(dyad.from));
  Poly volume(geometry_->ring());
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    volume += n[i] * (a[j] * b[k] - a[k] * b[j]);
  }
  return volume.primitive();
}

std::string Causes::stretched_wording(PointIndex elbow, const mechanism::DyadPoint& dyad) const {
  if (!dyad.axis) return of_determinant(stretched(elbow, dyad));
  const auto name = [&](PointIndex i) { return geometry_->mechanism().points[static_cast<std::size_t>(i)].name; };
  return name(dyad.from) + ", " + name(elbow) + ", " + name(dyad.to) + " aligned as seen along the axis of " +
         name(elbow);
}

Vector Causes::vector(const mechanism::VectorExpression& written) const {
  const std::vector<GiNaC::ex> u = geometry_->vector(written);
  return {geometry_->poly(u[0]), geometry_->poly(u[1]), u.size() > 2 ? geometry_->poly(u[2]) : Poly(geometry_->ring())};
}

Poly Causes::perpendicular(PointIndex a, PointIndex b, const mechanism::VectorExpression& along) const {
  return dot(difference(points_[static_cast<std::size_t>(b)], points_[static_cast<std::size_t>(a)]), vector(along))
      .primitive();
}

void Causes::add_load_conditions(const std::vector<Edge>& edges, const std::vector<Direction>& directions) {
  const auto vector = [&](PointIndex a, PointIndex b) {
    return difference(points_[static_cast<std::size_t>(b)], points_[static_cast<std::size_t>(a)]);
  };
  for (const Direction& d : directions) {
    for (const Edge& e : edges) add(cross(vector(e.from, e.to), d.along), e.wording + " parallel to " + d.wording);
  }
  const auto& points = geometry_->mechanism().points;
  for (const Direction& d : directions) {
    for (const Edge& e : edges) add(dot(vector(e.from, e.to), d.along), e.wording + " perpendicular to " + d.wording);
    for (std::size_t i = 0; d.at && i < points.size(); ++i) {
      if (points[i].auxiliary) continue;
      add(cross(vector(*d.at, static_cast<PointIndex>(i)), d.along),
          points[i].name + " on the line of action of " + d.wording);
    }
  }
}

void Causes::add_alignments_along_chains(std::optional<PointIndex> at) {
  const Mechanism& m = geometry_->mechanism();
  const auto name = [&](PointIndex i) { return m.points[static_cast<std::size_t>(i)].name; };
  for (std::size_t i = 0; i < m.links.size(); ++i) {
    for (std::size_t k = i + 1; k < m.links.size(); ++k) {
      for (const PointIndex shared : m.links[i].points) {
        if (std::count(m.links[k].points.begin(), m.links[k].points.end(), shared) == 0) continue;
        if (at && *at != shared) continue;
        for (const PointIndex a : m.links[i].points) {
          for (const PointIndex b : m.links[k].points) {
            if (a == shared || b == shared || a == b) continue;
            add(aligned(a, shared, b), name(a) + ", " + name(shared) + ", " + name(b) + " aligned");
          }
        }
      }
    }
  }
}

void Causes::add_alignments() {
  const Mechanism& m = geometry_->mechanism();
  const auto name = [&](PointIndex i) { return m.points[static_cast<std::size_t>(i)].name; };
  add_alignments_along_chains(std::nullopt);
  std::vector<PointIndex> named;
  for (std::size_t i = 0; i < m.points.size(); ++i) {
    if (!m.points[i].auxiliary) named.push_back(static_cast<PointIndex>(i));
  }
  for (std::size_t a = 0; a < named.size(); ++a) {
    for (std::size_t b = a + 1; b < named.size(); ++b) {
      for (std::size_t c = b + 1; c < named.size(); ++c) {
        add(aligned(named[a], named[b], named[c]),
            name(named[a]) + ", " + name(named[b]) + ", " + name(named[c]) + " aligned");
      }
    }
  }
}

void Causes::add_link_pairs(const std::vector<Edge>& edges) {
  const auto vector = [&](const Edge& e) {
    return difference(points_[static_cast<std::size_t>(e.to)], points_[static_cast<std::size_t>(e.from)]);
  };
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t k = i + 1; k < edges.size(); ++k) {
      if (edges[i].link == edges[k].link) continue;
      const Vector a = vector(edges[i]), b = vector(edges[k]);
      add(cross(a, b), edges[i].wording + " parallel to " + edges[k].wording);
      add(dot(a, b), edges[i].wording + " perpendicular to " + edges[k].wording);
    }
  }
}

std::string Causes::of_lines(const Poly& factor, bool loads) const {
  if (equations_ == nullptr) return "";
  if (!lines_) lines_.emplace(*geometry_, *equations_);
  return lines_->of(factor, loads);
}

std::string Causes::of_determinant(const Poly& factor) const {
  const Poly primitive = factor.primitive();
  const auto of_loads = [&](std::size_t i) {
    return (i >= first_of_loads_ && i < last_of_loads_) || i >= first_of_springs_;
  };
  for (std::size_t i = 0; i < conditions_.size(); ++i)
    if (!of_loads(i) && conditions_[i].first == primitive) return conditions_[i].second;
  return of_lines(factor, false);
}

std::string Causes::of(const Poly& factor) const {
  const Poly primitive = factor.primitive();
  for (const auto& [condition, wording] : conditions_) {
    if (condition == primitive) return wording;
  }
  return of_lines(factor, true);
}

}  // namespace clearloci::symbolic
