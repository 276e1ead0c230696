// Answers do not depend on where the origin of the file is: loci, zones, verdicts, poses, errors and certificates of a
// mechanism that is moved are those of its twin, moved along.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "analysis/error.hpp"
#include "analysis/framed.hpp"
#include "analysis/loci.hpp"
#include "analysis/pose.hpp"
#include "analysis/zones.hpp"
#include "check/check.hpp"
#include "mechanism/read.hpp"
#include "report/certificate.hpp"
#include "tests/laws/design_texts.hpp"
#include "tests/laws/judged.hpp"
#include "tests/laws/lattice_designs.hpp"
#include "tests/laws/same_topology.hpp"
#include "tests/source_dir.hpp"

namespace clearloci {
namespace {

using core::Rational;
using mechanism::Frame;
using mechanism::Mechanism;
using test::Family;

/// The frame in which a mechanism is seen moved by a vector: that of its twin, back there.
Frame moved_by(const Mechanism& m, const std::array<Rational, 3>& by) {
  Frame frame;
  frame.from.resize(m.coordinates.size());
  for (std::size_t i = 0; i < mechanism::dimension(m); ++i) frame.origin[i] = -by[i];
  for (std::size_t q = 0; q < m.coordinates.size(); ++q)
    for (std::size_t i = 0; i < 3; ++i)
      if (m.coordinates[q].name == std::string(1, "xyz"[i])) frame.from[q] = -by[i];
  return frame;
}

Mechanism moved(const Mechanism& m, const Frame& frame) {
  Mechanism result = mechanism::in_frame(m, frame).value();
  result.frame.reset();
  return result;
}

double extent_of(const Mechanism& m) { return mechanism::frame_of(m).scale_value(); }

void expect_near(const core::Polyline& a, const core::Polyline& b, double within) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    ASSERT_LE(std::hypot(a[i][0] - b[i][0], a[i][1] - b[i][1]), within) << "vertex " << i;
}

/// Factors are written in the coordinates of the file, over roots in units of its numbers.
core::LocusMap without_factors(core::LocusMap map) {
  for (core::LocusCurve& curve : map.curves) curve.factor.clear();
  return map;
}

void expect_same(const core::LocusMap& a, const core::LocusMap& b, double within) {
  EXPECT_EQ(test::differences(without_factors(a), without_factors(b)), std::vector<std::string>());
  EXPECT_EQ(a.complete, b.complete);
  ASSERT_EQ(a.curves.size(), b.curves.size());
  for (std::size_t c = 0; c < a.curves.size(); ++c) {
    EXPECT_EQ(a.curves[c].id, b.curves[c].id);
    EXPECT_EQ(a.curves[c].certified, b.curves[c].certified) << a.curves[c].id;
    EXPECT_EQ(a.curves[c].excited, b.curves[c].excited) << a.curves[c].id;
    ASSERT_EQ(a.curves[c].arcs.size(), b.curves[c].arcs.size()) << a.curves[c].id;
    for (std::size_t k = 0; k < a.curves[c].arcs.size(); ++k)
      expect_near(a.curves[c].arcs[k].points, b.curves[c].arcs[k].points, within);
  }
  ASSERT_EQ(a.workspace.size(), b.workspace.size());
  for (std::size_t w = 0; w < a.workspace.size(); ++w) {
    ASSERT_EQ(a.workspace[w].rings.size(), b.workspace[w].rings.size());
    for (std::size_t r = 0; r < a.workspace[w].rings.size(); ++r)
      expect_near(a.workspace[w].rings[r], b.workspace[w].rings[r], within);
  }
}

/// 1e-9 of the size, or what doubles so far away can tell.
double within(const Mechanism& m, const Frame& frame) {
  double far = 0;
  for (const Rational& way : frame.origin) far = std::max(far, std::abs(core::to_double(way)));
  return 1e-9 * extent_of(m) + 4 * far * 0x1p-52;
}

LociRequest as_closely(const Mechanism& m) { return {.tolerance = 1e-5 * extent_of(m)}; }

/// Of the mechanism where it stands.
void expect_same_loci(const core::LocusMap& loci, const Mechanism& m, const Frame& frame) {
  const core::LocusMap there = trace_loci(moved(m, frame), as_closely(m));
  expect_same(loci, from_frame(there, m, frame), within(m, frame));
}

// ---- Random designs

/// Between two distances, any way, in decimals.
std::array<Rational, 3> somewhere(std::mt19937& random, double least, double most) {
  const double way = std::uniform_real_distribution(0.0, 6.2831853)(random),
               size = std::uniform_real_distribution(least, most)(random);
  const auto decimal = [](double value) {
    Rational result(static_cast<long>(std::lround(1000 * value)), 1000L);
    result.canonicalize();
    return result;
  };
  return {decimal(size * std::cos(way)), decimal(size * std::sin(way)), Rational(0)};
}

class Anywhere : public testing::TestWithParam<Family> {};

TEST_P(Anywhere, WeightedDesignsHaveTheLociOfTheirTwins) {
  constexpr int seed = 20261123, designs = 2;
  for (int i = 0; i < designs; ++i) {
    SCOPED_TRACE(i);
    std::seed_seq sequence{seed, static_cast<int>(GetParam()), i};
    std::mt19937 random(sequence);
    const std::string text =
        i % 2 == 0 ? test::generic_design(random, GetParam(), true) : test::lattice_design(random, GetParam(), true);
    const Mechanism m = mechanism::parse_mechanism(text, "design.yaml");
    expect_same_loci(trace_loci(m, as_closely(m)), m, moved_by(m, somewhere(random, 5, 17)));
  }
}

INSTANTIATE_TEST_SUITE_P(Families, Anywhere,
                         testing::Values(Family::five_bar, Family::coupler, Family::prrrp, Family::three_rpr,
                                         Family::four_bar),
                         [](const auto& test) {
                           std::string name = test::to_string(test.param);
                           std::erase_if(name, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; });
                           return name;
                         });

// ---- Examples, by every command

struct Place {
  const char* name;
  std::array<Rational, 3> by;
};

const Place places[] = {{"Near", {Rational(1, 3), Rational(-1, 7), Rational(1, 9)}},
                        {"Far", {Rational(123457, 10), Rational(-98765, 7), Rational(33333)}},
                        {"VeryFar", {Rational(1000000), Rational(999999), Rational(-1000000)}}};

Mechanism example(const std::string& name) {
  return mechanism::read_mechanism(source_dir() + "/examples/" + name + ".yaml");
}

class AtPlaces : public testing::TestWithParam<Place> {};

/// The answer about an example where it stands, computed once for all places.
template <class Answer, class Ask>
const Answer& at_home(const std::string& name, const Ask& ask) {
  static std::map<std::string, Answer> answers;
  const auto found = answers.find(name);
  return found != answers.end() ? found->second : answers.emplace(name, ask(example(name))).first->second;
}

TEST_P(AtPlaces, Loci) {
  for (const char* const name : {"five_bar_weights", "prrrp", "slider_crank", "three_rpr_orientation"}) {
    SCOPED_TRACE(name);
    const Mechanism m = example(name);
    const auto& loci = at_home<core::LocusMap>(
        name, [](const Mechanism& mechanism) { return trace_loci(mechanism, as_closely(mechanism)); });
    expect_same_loci(loci, m, moved_by(m, GetParam().by));
  }
}

TEST_P(AtPlaces, Zones) {
  const Mechanism m = example("five_bar_generic");
  const Frame frame = moved_by(m, GetParam().by);
  const auto& a =
      at_home<core::Zones>("five_bar_generic", [](const Mechanism& mechanism) { return find_zones(mechanism); });
  const core::Zones b = from_frame(find_zones(moved(m, frame)), m, frame);
  expect_same(a.loci, b.loci, within(m, frame));
  ASSERT_EQ(a.zones.size(), b.zones.size());
  for (std::size_t z = 0; z < a.zones.size(); ++z) {
    EXPECT_EQ(a.zones[z].id, b.zones[z].id);
    EXPECT_EQ(a.zones[z].signs, b.zones[z].signs);
    EXPECT_EQ(a.zones[z].certified, b.zones[z].certified);
    EXPECT_NEAR(a.zones[z].size, b.zones[z].size, within(m, frame));
    EXPECT_NEAR(a.zones[z].ball.radius, b.zones[z].ball.radius, within(m, frame));
    expect_near(a.zones[z].outer, b.zones[z].outer, within(m, frame));
  }
}

core::Task circle(const Rational& x, const Rational& y, const Rational& radius) {
  core::Task task;
  task.shape = core::TaskBall{{x, y}, radius};
  task.margin = Rational(1, 1000);
  return task;
}

TEST_P(AtPlaces, Verdicts) {
  const Mechanism m = example("five_bar");
  const Frame frame = moved_by(m, GetParam().by);
  for (const bool tolerant : {false, true})
    for (const Rational& radius : {Rational(1, 50), Rational(1, 4)}) {
      core::Task task = circle(Rational(1, 4), Rational(-3, 5), radius);
      if (tolerant) task.pose_error = Rational(1, 100);
      const Verification a = test::judged(m, task, {}), b = test::judged(moved(m, frame), in_frame(task, frame), {});
      EXPECT_EQ(a.verdict, b.verdict);
      EXPECT_NEAR(a.margin.value_or(0), b.margin.value_or(0), within(m, frame));
      EXPECT_EQ(a.zone, b.zone);
      EXPECT_EQ(a.nearest.has_value(), b.nearest.has_value());
      if (a.pose_error && b.pose_error) {
        EXPECT_NEAR(*a.pose_error, *b.pose_error, 1e-9 * *a.pose_error);
      }
      if (!a.witness || !b.witness) {
        EXPECT_EQ(a.witness.has_value(), b.witness.has_value());
        continue;
      }
      EXPECT_EQ(a.witness->kind, b.witness->kind);
      for (std::size_t i = 0; i < 2; ++i)
        EXPECT_NEAR(a.witness->at[i], b.witness->at[i] + core::to_double(frame.from[i]), within(m, frame));
    }
}

TEST_P(AtPlaces, PosesAndErrors) {
  const Mechanism m = example("five_bar");
  const Frame frame = moved_by(m, GetParam().by);
  const Mechanism there = moved(m, frame);
  const std::vector<Rational> at = {Rational(1, 4), Rational(-7, 10)};
  const Pose a = solve_pose(m, at), b = solve_pose(there, {at[0] - frame.from[0], at[1] - frame.from[1]});
  ASSERT_TRUE(a.error && b.error);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_NEAR(a.error->displacement[i], b.error->displacement[i], 1e-9 * std::abs(a.error->displacement[i]));
  EXPECT_NEAR(a.determinant, b.determinant, 1e-9 * std::abs(a.determinant));
  ASSERT_EQ(a.reactions.size(), b.reactions.size());
  for (std::size_t j = 0; j < a.reactions.size(); ++j)
    for (std::size_t k = 0; k < a.reactions[j].components.size(); ++k)
      EXPECT_NEAR(a.reactions[j].components[k].value, b.reactions[j].components[k].value, 1e-7) << "of 100 N";
  for (std::size_t p = 0; p < a.points.size(); ++p)
    for (std::size_t i = 0; i < 2; ++i)
      EXPECT_NEAR(a.points[p].at[i], b.points[p].at[i] + core::to_double(frame.origin[i]), within(m, frame));

  const ErrorRequest request = {.grid = {20, 20}, .with_loci = false};
  const Errors c = find_errors(m, request), d = find_errors(there, request);
  ASSERT_EQ(c.modes.size(), d.modes.size());
  EXPECT_EQ(c.modes[0].reachable, d.modes[0].reachable);
  for (std::size_t f = 0; f < c.modes[0].map.fields.size(); ++f)
    for (std::size_t k = 0; k < 400; ++k) {
      const double one = c.modes[0].map.fields[f].values[k], other = d.modes[0].map.fields[f].values[k];
      EXPECT_EQ(std::isnan(one), std::isnan(other));
      if (!std::isnan(one)) {
        EXPECT_NEAR(one, other, 1e-6 * (1e-4 + std::abs(one)));
      }
    }
}

TEST_P(AtPlaces, TasksAndZonesOverPoses) {
  const Mechanism m = example("gough_stewart");
  const Frame frame = moved_by(m, GetParam().by);
  core::Task task;
  core::TaskBox box;
  for (const mechanism::Coordinate& c : m.coordinates) {
    const Rational middle = (c.lower + c.upper) / 2, half = (c.upper - c.lower) / 64;
    box.lower.push_back(middle - half);
    box.upper.push_back(middle + half);
  }
  task.shape = box;
  const auto& a =
      at_home<Verification>("gough_stewart", [&](const Mechanism& mechanism) { return test::judged(mechanism, task); });
  const Verification b = test::judged(moved(m, frame), in_frame(task, frame));
  EXPECT_EQ(a.verdict, b.verdict);
  EXPECT_EQ(a.cells, b.cells);
  EXPECT_EQ(a.margin.has_value(), b.margin.has_value());
  if (a.margin && b.margin) {
    EXPECT_NEAR(*a.margin, *b.margin, 1e-9);
  }
  const Mechanism crank = example("slider_crank");
  const auto& c =
      at_home<core::Zones>("slider_crank", [](const Mechanism& mechanism) { return find_zones(mechanism); });
  const core::Zones d = find_zones(moved(crank, moved_by(crank, GetParam().by)));
  ASSERT_EQ(c.zones.size(), d.zones.size());
  for (std::size_t z = 0; z < c.zones.size(); ++z) {
    EXPECT_EQ(c.zones[z].lower, d.zones[z].lower);
    EXPECT_EQ(c.zones[z].signs, d.zones[z].signs);
  }
}

TEST_P(AtPlaces, Certificates) {
  test::FiveBarDesign design;
  const auto shifted = [&](const std::string& text, std::size_t i) {
    return core::to_string(Rational(Rational(text) + GetParam().by[i]));
  };
  for (std::size_t i = 0; i < 2; ++i) {
    design.a1[i] = shifted(design.a1[i], i);
    design.a2[i] = shifted(design.a2[i], i);
    design.box[2 * i] = shifted(design.box[2 * i], i);
    design.box[2 * i + 1] = shifted(design.box[2 * i + 1], i);
  }
  const std::string text = design.text();
  core::Certificate certificate;
  find_zones(mechanism::parse_mechanism(text, "model.yaml"), {}, &certificate);
  const std::string written = report::certificate_text({"zones", text, {}}, certificate);
  const check::Examination examination = check::check_certificate_text(text, "model.yaml", written, "certificate");
  EXPECT_TRUE(examination.accepted) << examination.why;
  // The frame is a part of the claims.
  const std::string scale = "\"scale\":\"" + core::to_string(certificate.scale) + "\"";
  ASSERT_NE(written.find(scale), std::string::npos);
  std::string wrong = written;
  wrong.replace(wrong.find(scale), scale.size(), "\"scale\":\"1001/1000\"");
  EXPECT_FALSE(check::check_certificate_text(text, "model.yaml", wrong, "certificate").accepted);
}

INSTANTIATE_TEST_SUITE_P(Examples, AtPlaces, testing::ValuesIn(places),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace clearloci
