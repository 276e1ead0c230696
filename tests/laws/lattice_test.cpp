// Laws over designs of the lattice (lattice_designs.hpp): arcs lie in the box, on their curves and in their modes; both
// engines tell the same; zones partition the workspace; the independent witness disputes nothing.
// In the environment: CLEARLOCI_DESIGNS=n tries n designs a family, CLEARLOCI_FIRST=i begins with the i-th.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <map>

#include "cli/zone_search.hpp"
#include "core/errors.hpp"
#include "numeric/reactions.hpp"
#include "tests/laws/lattice_designs.hpp"
#include "tests/laws/same_topology.hpp"

namespace clearloci {
namespace {

using Clock = std::chrono::steady_clock;

int from_environment(const char* name, int usual) {
  const char* wanted = std::getenv(name);
  return wanted != nullptr ? std::atoi(wanted) : usual;
}

double size_of(const core::LocusMap& map) {
  return std::max(core::to_double(map.upper[0] - map.lower[0]), core::to_double(map.upper[1] - map.lower[1]));
}

std::string describe(const core::LocusMap& map, const core::LocusCurve& curve) {
  return curve.id + " " + to_string(curve.kind) + " " + core::to_string(curve.implicit, map.tower.coordinates);
}

/// Distance of a point from an implicit curve, to first order, in exact arithmetic; where the curve is singular the
/// size of the polynomial beside its second derivatives.
double distance_from(const core::Polynomial& implicit, const core::Point2& at) {
  const std::vector<core::Rational> exact = {core::Rational(at[0]), core::Rational(at[1])};
  const auto value = [&](const core::Polynomial& p) { return core::to_double(core::evaluate(p, exact)); };
  const core::Polynomial dx = core::derivative(implicit, 0), dy = core::derivative(implicit, 1);
  const double slope = std::hypot(value(dx), value(dy)), f = std::abs(value(implicit));
  const double bend =
      std::hypot(value(core::derivative(dx, 0)), value(core::derivative(dy, 1)), value(core::derivative(dx, 1)));
  // Near a double point the distance is about sqrt(f / bend); Newton's step is the bound elsewhere.
  const double newton = slope > 0 ? f / slope : f;
  return bend > 0 ? std::min(newton, std::sqrt(f / bend)) : newton;
}

class Laws {
 public:
  Laws(std::string text, int index) : text_(std::move(text)), index_(index) {}

  void hold() {
    const mechanism::Mechanism mechanism = mechanism::parse_mechanism(text_, "lattice.yaml");
    LociRequest request;
    request.deadline = Clock::now() + std::chrono::seconds(20);
    TracedProblem traced;
    try {
      traced = trace_problem(mechanism, request);
    } catch (const core::InputError& refused) {
      ++refused_;
      return;
    }
    if (!traced.map.complete) {
      ++slow_;
      return;
    }
    arcs_are_where_they_should_be(traced.map, "adaptive");
    if (degree_of(traced.problem) <= 8) engines_agree(mechanism, traced.map);
    zones_partition(mechanism, traced.map);
  }

  static int refused_, slow_, uncertified_, tried_;

 private:
  std::string where() const { return "\ndesign " + std::to_string(index_) + "\n" + text_; }

  static int degree_of(const core::LocusProblem& problem) {
    int degree = 0;
    for (const core::LocusFactor& factor : problem.factors) {
      if (factor.implicit_too_heavy) return 1000;
      for (const core::Polynomial& p : factor.implicit) degree = std::max(degree, core::total_degree(p));
    }
    return degree;
  }

  void arcs_are_where_they_should_be(const core::LocusMap& map, const std::string& engine) {
    const double slack = 1e-12 * size_of(map);
    bool all = true;
    for (const core::LocusCurve& curve : map.curves) {
      all = all && curve.certified;
      for (const core::Arc& arc : curve.arcs) {
        const auto fault = [&](const std::string& what, const core::Point2& at) {
          ADD_FAILURE() << engine << ": " << what << " (" << at[0] << ", " << at[1] << ") on " << describe(map, curve)
                        << where();
        };
        if (arc.points.size() < 2) {
          fault("an arc without points", {});
          continue;
        }
        // A loop may begin and end in one crossing; at the box it cannot.
        const bool same = arc.points.front() == arc.points.back();
        if (arc.closed != same && !(same && arc.ends[0] == arc.ends[1] && arc.ends[0] != core::ArcEnd::box))
          fault("closed or not", arc.points.front());
        if (arc.closed != (arc.ends[0] == core::ArcEnd::none)) fault("ends", arc.points.front());
        double length = 0;
        for (std::size_t i = 0; i < arc.points.size(); ++i) {
          const core::Point2& p = arc.points[i];
          if (i > 0) length += std::hypot(p[0] - arc.points[i - 1][0], p[1] - arc.points[i - 1][1]);
          for (std::size_t c = 0; c < 2; ++c)
            if (p[c] < core::to_double(map.lower[c]) - slack || p[c] > core::to_double(map.upper[c]) + slack) {
              fault("outside the box", p);
              return;
            }
          if (!curve.implicit.is_zero() && i % (1 + arc.points.size() / 6) == 0 &&
              distance_from(curve.implicit, p) > 2 * slack)
            fault("off its curve by " + std::to_string(distance_from(curve.implicit, p) / slack) + "e-12", p);
        }
        if (!(std::abs(arc.length - length) <= 1e-3 * length + 10 * map.tolerance))
          fault("length " + std::to_string(arc.length) + " for " + std::to_string(length), arc.points.front());
        for (const std::size_t end : {0u, 1u}) {
          if (arc.ends[end] != core::ArcEnd::box) continue;
          const core::Point2& p = end == 0 ? arc.points.front() : arc.points.back();
          bool on = false;
          for (std::size_t c = 0; c < 2; ++c)
            on = on || std::abs(p[c] - core::to_double(map.lower[c])) <= slack ||
                 std::abs(p[c] - core::to_double(map.upper[c])) <= slack;
          if (!on) fault("an end at the box that is not", p);
        }
      }
    }
    if (!all) {
      ++uncertified_;
      if (from_environment("CLEARLOCI_SHOW", 0) != 0)
        for (const std::string& note : map.notes) std::cout << "design " << index_ << ": " << note << "\n";
    }
  }

  void engines_agree(const mechanism::Mechanism& mechanism, const core::LocusMap& adaptive) {
    LociRequest request;
    request.engine = loci::Engine::exact;
    request.deadline = Clock::now() + std::chrono::seconds(20);
    const core::LocusMap exact = trace_loci(mechanism, request);
    if (!exact.complete) return;
    arcs_are_where_they_should_be(exact, "exact");
    for (const std::string& difference : test::differences(exact, adaptive)) ADD_FAILURE() << difference << where();
  }

  /// The workspace's area by sampling, and how far it may be off.
  static std::pair<double, double> sampled_area(const mechanism::Mechanism& mechanism, const core::LocusMap& map) {
    const numeric::NumericModel model = numeric::compile(mechanism);
    const std::vector<int> sides = numeric::dyad_signs(model, map.tower, map.workspace.front().mode);
    constexpr int n = 400;
    const core::Point2 low = {core::to_double(map.lower[0]), core::to_double(map.lower[1])};
    const core::Point2 step = {(core::to_double(map.upper[0]) - low[0]) / n,
                               (core::to_double(map.upper[1]) - low[1]) / n};
    std::vector<char> inside(n * n);
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < n; ++k) {
        const std::array<double, 2> pose = {low[0] + (i + 0.5) * step[0], low[1] + (k + 0.5) * step[1]};
        inside[static_cast<std::size_t>(i * n + k)] = numeric::reachable(model, pose, sides) ? 1 : 0;
      }
    int count = 0, rim = 0;
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < n; ++k) {
        const char own = inside[static_cast<std::size_t>(i * n + k)];
        count += own;
        if ((i > 0 && inside[static_cast<std::size_t>((i - 1) * n + k)] != own) ||
            (k > 0 && inside[static_cast<std::size_t>(i * n + k - 1)] != own))
          ++rim;
      }
    return {count * step[0] * step[1], (0.5 * rim + 2) * step[0] * step[1]};
  }

  static double area_of(const core::Polyline& ring) {
    double twice = 0;
    for (std::size_t i = 1; i < ring.size(); ++i) twice += ring[i - 1][0] * ring[i][1] - ring[i][0] * ring[i - 1][1];
    return twice / 2;
  }

  void zones_partition(const mechanism::Mechanism& mechanism, const core::LocusMap& map) {
    LociRequest request;
    request.deadline = Clock::now() + std::chrono::seconds(30);
    core::ZoneMap zones;
    try {
      zones = find_zones(mechanism, request);
    } catch (const core::LimitReached&) {
      ++slow_;
      return;
    }
    double total = 0;
    bool certified = true;
    for (const core::Zone& zone : zones.zones) total += zone.area, certified = certified && zone.certified;
    const auto [sampled, doubt] = sampled_area(mechanism, map);
    if (!certified) ++uncertified_;
    if (std::abs(total - sampled) > doubt)
      ADD_FAILURE() << zones.zones.size() << " zones of " << total << " m^2, " << (certified ? "" : "not ")
                    << "certified; sampled " << sampled << " +- " << doubt << where();
    double rings = 0;
    for (const core::Polyline& ring : map.workspace.front().rings) rings += std::abs(area_of(ring));
    if (map.workspace.front().rings.empty() && sampled > doubt)
      ADD_FAILURE() << "no rings, sampled " << sampled << where();
  }

  std::string text_;
  int index_;
};

int Laws::refused_ = 0;
int Laws::slow_ = 0;
int Laws::uncertified_ = 0;
int Laws::tried_ = 0;

class Lattice : public testing::TestWithParam<test::Family> {};

TEST_P(Lattice, LawsHold) {
  const int designs = from_environment("CLEARLOCI_DESIGNS", 6), first = from_environment("CLEARLOCI_FIRST", 0);
  for (int i = first; i < first + designs; ++i) {
    std::seed_seq seed{20260, static_cast<int>(GetParam()), i};
    std::mt19937 random(seed);
    const std::string text = test::lattice_design(random, GetParam(), i % 4 == 3);
    ++Laws::tried_;
    try {
      Laws(text, i).hold();
    } catch (const std::exception& error) {
      ADD_FAILURE() << error.what() << "\ndesign " << i << "\n" << text;
    }
  }
  std::cout << test::to_string(GetParam()) << ": so far " << Laws::tried_ << " designs, " << Laws::refused_
            << " refused, " << Laws::slow_ << " not done in time, " << Laws::uncertified_ << " not certified\n";
}

INSTANTIATE_TEST_SUITE_P(Families, Lattice,
                         testing::Values(test::Family::five_bar, test::Family::coupler, test::Family::prrrp,
                                         test::Family::prrr_r, test::Family::rprpr, test::Family::three_rpr),
                         [](const auto& test) {
                           std::string name = test::to_string(test.param);
                           std::replace_if(
                               name.begin(), name.end(), [](char c) { return !std::isalnum(c); }, '_');
                           return name;
                         });

}  // namespace
}  // namespace clearloci
