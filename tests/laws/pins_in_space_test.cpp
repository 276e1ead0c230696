// Contact losses in space at single poses of a slice: of pins, where the part of the force across the axis vanishes and
// the force does not; of balls whose force keeps to a plane. Held against the turns of two parts of the force round the
// cells of a grid, from reactions that are solved plainly.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "analysis/loci.hpp"
#include "clearloci/mechanism.hpp"
#include "clearloci/verify.hpp"
#include "mechanism/known_lines.hpp"
#include "mechanism/read.hpp"
#include "mechanism/read_task.hpp"
#include "tests/laws/distance_to.hpp"
#include "tests/laws/judged.hpp"
#include "tests/numeric/solved.hpp"
#include "tests/numeric/spatial_designs.hpp"
#include "tests/source_dir.hpp"

namespace clearloci {
namespace {

using test::distance_to;

using mechanism::Mechanism;

constexpr unsigned seed = 20260715;

std::string three_legs(unsigned number) {
  std::mt19937 random(seed + number);
  return test::random_three_leg(random);
}

std::size_t index_of(const Mechanism& m, const std::string& name) {
  for (std::size_t j = 0; j < m.joints.size(); ++j)
    if (m.joints[j].name == name) return j;
  throw std::invalid_argument(name);
}

/// The force across the axis of a joint along two unit vectors across it, times |A|, so that nothing is unbounded.
class PinForce {
 public:
  PinForce(const Mechanism& m, const std::string& joint)
      : model_(numeric::compile(m)), mode_(mechanism::working_mode(m)), joint_(index_of(m, joint)) {}

  struct Force {
    Eigen::Vector2d across;  ///< of a constant axis in directions that are constant too
    double along = 0;
    double determinant = 0;
  };

  Force at(std::span<const double> pose) const {
    const numeric::Posture posture = numeric::posture(model_, pose, mode_);
    const Eigen::PartialPivLU<Eigen::MatrixXd> lu(numeric::newton_euler_matrix(model_, posture));
    const Eigen::VectorXd values = lu.solve(numeric::load_column(model_, posture));
    const Eigen::Vector3d force =
        numeric::joint_reactions(model_.mechanism.joints.size(), numeric::reaction_columns(model_, posture), values)
            .at(joint_)
            .force;
    const Eigen::Vector3d u = posture.axes[joint_], v = u.unitOrthogonal();
    return {{force.dot(v), force.dot(u.cross(v))}, force.dot(u), lu.determinant()};
  }

  Eigen::Vector2d numerator(std::span<const double> pose) const {
    const Force force = at(pose);
    return force.determinant * force.across;
  }

 private:
  numeric::NumericModel model_;
  std::vector<int> mode_;
  std::size_t joint_;
};

/// The force of the ball at the end of a leg that turns about an axis through its base: along that axis and along the
/// leg, times |A|. There is no third part.
class BallForce {
 public:
  BallForce(const Mechanism& m, const std::string& leg)
      : model_(numeric::compile(m)),
        mode_(mechanism::working_mode(m)),
        ball_(index_of(m, "B" + leg)),
        pin_(index_of(m, "A" + leg)) {}

  Eigen::Vector2d numerator(std::span<const double> pose) const {
    const numeric::Posture posture = numeric::posture(model_, pose, mode_);
    const Eigen::PartialPivLU<Eigen::MatrixXd> lu(numeric::newton_euler_matrix(model_, posture));
    const Eigen::VectorXd values = lu.solve(numeric::load_column(model_, posture));
    const auto& joints = model_.mechanism.joints;
    const Eigen::Vector3d force =
        numeric::joint_reactions(joints.size(), numeric::reaction_columns(model_, posture), values).at(ball_).force;
    const auto place = [&](std::size_t joint) { return posture.points[static_cast<std::size_t>(joints[joint].at)]; };
    const Eigen::Vector3d way = (place(ball_) - place(pin_)).normalized(), axis = posture.axes[pin_];
    EXPECT_LT(std::abs(force.dot(axis.cross(way))), 1e-9 * (1 + force.norm()));
    return lu.determinant() * Eigen::Vector2d(force.dot(axis), force.dot(way));
  }

 private:
  numeric::NumericModel model_;
  std::vector<int> mode_;
  std::size_t ball_, pin_;
};

/// A platform that does not turn, on two legs that turn in one upright plane and on two that turn as they like.
/// `turned`: the plane is at an angle of atan(4/3) to the first axis, so that no component of a force is zero in it.
std::string two_legs_in_a_plane(unsigned number, bool turned) {
  std::mt19937 random(seed + number);
  const auto near = [&random](double middle, double spread) {
    const int thousandths = std::uniform_int_distribution<int>(-1000, 1000)(random);
    return std::to_string(middle + spread * thousandths / 1000);
  };
  const std::string c = turned ? "3/5" : "1", s = turned ? "4/5" : "0";
  const auto in_plane = [&](const std::string& along, const std::string& up) {
    return "[" + c + "*(" + along + "), " + s + "*(" + along + "), " + up + "]";
  };
  const auto triple = [](const std::string& x, const std::string& y, const std::string& z) {
    return "[" + x + ", " + y + ", " + z + "]";
  };
  std::string text =
      "format: 1\nspace: spatial\nworkspace: {x: [-2/5, 2/5], z: [3/5, 7/5]}\npoints:\n  P: " + in_plane("x", "z") +
      "\n";
  for (const int leg : {1, 2}) {
    const std::string k = std::to_string(leg);
    const double side = leg == 1 ? 1 : -1;
    text += "  A" + k + ": " + in_plane(near(0.75 * side, 0.2), near(0, 0.1)) + "\n";
    text += "  B" + k + ": " + in_plane("x + " + near(0.4 * side, 0.1), "z + " + near(0, 0.1)) + "\n";
  }
  for (const int leg : {3, 4}) {
    const std::string k = std::to_string(leg);
    const double side = leg == 3 ? 1 : -1;
    text += "  A" + k + ": " + triple(near(0, 0.3), near(0.7 * side, 0.2), near(0, 0.2)) + "\n";
    text += "  B" + k + ": " +
            triple(c + "*x + " + near(0, 0.2), s + "*x + " + near(0.35 * side, 0.1), "z + " + near(0, 0.2)) + "\n";
  }
  text += "links:\n  platform: {points: [P, B1, B2, B3, B4]}\n";
  std::string joints = "joints:\n";
  for (const int leg : {1, 2, 3, 4}) {
    const std::string k = std::to_string(leg), way = "B" + k + " - A" + k;
    text += "  cylinder" + k + ": {points: [A" + k + "]}\n  rod" + k + ": {points: [B" + k + "]}\n";
    joints += "  A" + k +
              (leg < 3 ? ": {revolute: [ground, cylinder" + k + "], at: A" + k + ", axis: [-" + s + ", " + c + ", 0]}\n"
                       : ": {universal: [ground, cylinder" + k + "], at: A" + k +
                             ", axes: [[1, 0, 0], 'cross([1, 0, 0], " + way + ")']}\n");
    joints += "  S" + k + ": {prismatic: [cylinder" + k + ", rod" + k + "], at: B" + k + ", axis: '" + way +
              "', actuated: true}\n  B" + k + ": {spherical: [rod" + k + ", platform], at: B" + k +
              ", clearance: {radial: 10e-6}}\n";
  }
  return text + joints + "end_effector: {link: platform, at: P}\nloads:\n  - {link: platform, at: P, force: " +
         triple(near(0, 40), near(0, 40), near(-100, 30)) +
         ", couple: " + triple(near(0, 20), near(0, 20), near(0, 20)) + "}\n";
}

/// How far a vector turns from a to b, halving the way until it turns by little.
template <class Force>
double turn(const Force& force, const core::Point2& a, const core::Point2& b, const Eigen::Vector2d& at_a,
            const Eigen::Vector2d& at_b, int depth = 0) {
  const double angle = std::atan2(at_a.x() * at_b.y() - at_a.y() * at_b.x(), at_a.dot(at_b));
  if (std::abs(angle) < 0.6 || depth > 12) return angle;
  const core::Point2 middle = {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2};
  const Eigen::Vector2d between = force.numerator(middle);
  return turn(force, a, middle, at_a, between, depth + 1) + turn(force, middle, b, between, at_b, depth + 1);
}

struct TurnedCell {
  core::Point2 lower, upper;
};

/// The cells round which the force turns by a full turn: each has a zero of odd number.
template <class Force>
std::vector<TurnedCell> turned_cells(const Force& force, int n, const core::Point2& low = {-0.4, -0.4}) {
  constexpr double width = 0.8;
  const auto place = [&](int i, int j) {
    // Off every symmetry.
    return core::Point2{low[0] + width * (i + 0.1234) / n, low[1] + width * (j + 0.3141) / n};
  };
  std::vector<Eigen::Vector2d> nodes;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) nodes.push_back(force.numerator(place(i, j)));
  const auto node = [&](int i, int j) { return nodes[static_cast<std::size_t>(j * n + i)]; };
  std::vector<TurnedCell> turned;
  for (int j = 0; j + 1 < n; ++j)
    for (int i = 0; i + 1 < n; ++i) {
      const std::array<std::array<int, 2>, 5> round = {{{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}, {i, j}}};
      double angle = 0;
      for (std::size_t k = 0; k < 4; ++k) {
        const auto &a = round[k], &b = round[k + 1];
        angle += turn(force, place(a[0], a[1]), place(b[0], b[1]), node(a[0], a[1]), node(b[0], b[1]));
      }
      if (std::lround(angle / (2 * std::numbers::pi)) != 0) turned.push_back({place(i, j), place(i + 1, j + 1)});
    }
  return turned;
}

/// On a direct singularity all numerators may vanish together: there no force has a limit.
bool is_near_singularity(const core::LocusMap& map, const TurnedCell& cell) {
  const core::Point2 middle = {(cell.lower[0] + cell.upper[0]) / 2, (cell.lower[1] + cell.upper[1]) / 2};
  const double reach = std::hypot(cell.upper[0] - cell.lower[0], cell.upper[1] - cell.lower[1]);
  return std::any_of(map.curves.begin(), map.curves.end(), [&](const core::LocusCurve& curve) {
    return curve.kind == core::LocusKind::direct_singularity &&
           std::any_of(curve.arcs.begin(), curve.arcs.end(),
                       [&](const core::Arc& arc) { return distance_to(arc.points, middle) < reach; });
  });
}

bool loses_contact(const std::vector<core::Vanishing>& vanishing, const std::string& joint) {
  return std::any_of(vanishing.begin(), vanishing.end(),
                     [&](const core::Vanishing& v) { return v.joint == joint && v.quantity == core::Quantity::f; });
}

TEST(PinsInSpace, ContactIsLostAtPointsOfASlice) {
  int points = 0, cells = 0;
  for (unsigned number = 0; number < 16; ++number) {
    const std::string text = three_legs(number);
    SCOPED_TRACE(text);
    const Mechanism m = mechanism::parse_mechanism(text, "legs.yaml");
    const core::LocusMap map = trace_loci(m, {});
    for (const std::string joint : {"R1", "R2", "R3"}) {
      const PinForce force(m, joint);
      std::vector<core::Point2> found;
      for (const core::IsolatedPoint& point : map.isolated_points) {
        if (point.kind != core::LocusKind::contact_loss || !loses_contact(point.vanishing, joint)) continue;
        EXPECT_TRUE(point.certified);
        const PinForce::Force there = force.at(point.at);
        EXPECT_LT(there.across.norm(), 1e-7 * std::abs(there.along)) << joint << ": the force itself does not vanish";
        found.push_back({point.at[0], point.at[1]});
        ++points;
      }
      const bool lost_along_a_curve = std::any_of(map.curves.begin(), map.curves.end(), [&](const auto& curve) {
        return loses_contact(curve.vanishing, joint);
      });
      if (lost_along_a_curve) continue;
      for (const TurnedCell& cell : turned_cells(force, 40)) {
        if (is_near_singularity(map, cell)) continue;
        ++cells;
        EXPECT_TRUE(std::any_of(found.begin(), found.end(),
                                [&](const core::Point2& at) {
                                  return cell.lower[0] <= at[0] && at[0] <= cell.upper[0] && cell.lower[1] <= at[1] &&
                                         at[1] <= cell.upper[1];
                                }))
            << joint << " loses contact near (" << cell.lower[0] << ", " << cell.lower[1] << ")";
      }
    }
  }
  EXPECT_GT(points, 4);
  EXPECT_GT(cells, 3);
}

TEST(BallsInSpace, ContactIsLostAtPointsOfASlice) {
  int points = 0, cells = 0;
  for (unsigned number = 0; number < 12; ++number) {
    const std::string text = two_legs_in_a_plane(number, number % 2 == 1);
    SCOPED_TRACE(text);
    const Mechanism m = mechanism::parse_mechanism(text, "legs.yaml");
    const core::LocusMap map = trace_loci(m, {});
    for (const std::string leg : {"1", "2"}) {
      const BallForce force(m, leg);
      const auto is_point_of = [&](const core::IsolatedPoint& point) {
        return point.kind == core::LocusKind::contact_loss && loses_contact(point.vanishing, "B" + leg);
      };
      for (const core::IsolatedPoint& point : map.isolated_points) {
        if (!is_point_of(point)) continue;
        EXPECT_TRUE(point.certified) << point.at[0] << ", " << point.at[1];
        EXPECT_LT(force.numerator(point.at).norm(), 1e-8);
        ++points;
      }
      for (const TurnedCell& cell : turned_cells(force, 40, {-0.4, 0.6})) {
        if (is_near_singularity(map, cell)) continue;
        ++cells;
        const bool listed =
            std::any_of(map.isolated_points.begin(), map.isolated_points.end(), [&](const core::IsolatedPoint& point) {
              return is_point_of(point) && cell.lower[0] <= point.at[0] && point.at[0] <= cell.upper[0] &&
                     cell.lower[1] <= point.at[1] && point.at[1] <= cell.upper[1];
            });
        EXPECT_TRUE(listed) << "B" << leg << " near (" << cell.lower[0] << ", " << cell.lower[1] << ")";
      }
    }
  }
  EXPECT_GT(points, 3);
  EXPECT_GT(cells, 2);
}

TEST(BallsInSpace, APlaneIsKnownWhereTheLegIsFreeAndBearsNothingElse) {
  const std::string text = two_legs_in_a_plane(0, true);
  const auto has_normal = [](const std::string& file, const std::string& joint) {
    const Mechanism m = mechanism::parse_mechanism(file, "legs.yaml");
    return mechanism::normal_of_force(m, m.joints[index_of(m, joint)]).has_value();
  };
  EXPECT_TRUE(has_normal(text, "B1"));
  EXPECT_FALSE(has_normal(text, "A1")) << "a pin bears a couple";
  EXPECT_FALSE(has_normal(text + "  - {link: rod1, at: B1, force: [1, 0, 0]}\n", "B1"));
  EXPECT_FALSE(has_normal(text + "  - {link: cylinder1, at: A1, force: [1, 0, 0]}\n", "B1"));
  EXPECT_TRUE(has_normal(text + "  - {link: cylinder1, at: A1, force: [1, 0, 0]}\n", "B2"));
  std::string driven = text;
  driven.insert(driven.find(", axis: [-4/5"), ", actuated: {effort: 2}");
  EXPECT_FALSE(has_normal(driven, "B1")) << "the motor's couple is about the axis";
}

/// Of a file: by joint, the places where it alone loses its contact.
std::multimap<std::string, core::Point2> lost_in(const std::string& file) {
  std::multimap<std::string, core::Point2> lost;
  for (const core::IsolatedPoint& point :
       trace_loci(mechanism::read_mechanism(source_dir() + "/" + file), {}).isolated_points) {
    EXPECT_TRUE(point.certified) << file;
    for (const core::Vanishing& v : point.vanishing)
      if (v.quantity == core::Quantity::f) lost.emplace(v.joint, core::Point2{point.at[0], point.at[1]});
  }
  return lost;
}

TEST(BallsInSpace, ATiltedPlaneIsAPlane) {
  const auto plane = lost_in("examples/five_bar_isolated.yaml");
  const auto tilted = lost_in("tests/corpus/loci/five_bar_in_tilted_plane.yaml");
  ASSERT_EQ(plane.size(), tilted.size());
  for (const auto& [joint, at] : plane) {
    const auto [first, last] = tilted.equal_range(joint);
    EXPECT_TRUE(std::any_of(first, last, [&at = at](const auto& other) {
      return std::hypot(other.second[0] - at[0], other.second[1] - at[1]) < 1e-9;
    })) << joint;
  }
}

/// The first point of a slice at which a pin alone loses its contact, and the file that has it.
struct Lost {
  std::string text, joint;
  std::vector<double> at;
};

Lost first_lost() {
  for (unsigned number = 0; number < 8; ++number) {
    const std::string text = three_legs(number);
    for (const core::IsolatedPoint& point :
         trace_loci(mechanism::parse_mechanism(text, "legs.yaml"), {}).isolated_points)
      if (point.kind == core::LocusKind::contact_loss && point.vanishing.front().joint.starts_with("R"))
        return {text, point.vanishing.front().joint, point.at};
  }
  throw std::invalid_argument("no pin loses its contact");
}

std::string box_round(const std::vector<double>& at, double half, const std::string& more) {
  std::string text = "format: 1\nbox: {x: [" + std::to_string(at[0] - half) + ", " + std::to_string(at[0] + half) +
                     "], y: [" + std::to_string(at[1] - half) + ", " + std::to_string(at[1] + half) + "]}\n";
  return text + more;
}

TEST(PinsInSpace, NoTaskRoundSuchAPointIsVerified) {
  const Lost lost = first_lost();
  const Mechanism m = mechanism::parse_mechanism(lost.text, "legs.yaml");
  LociRequest request;
  request.joints = {lost.joint};
  request.quantities = {core::Quantity::f};
  const auto verdict = [&](double half, const std::string& more) {
    return test::judged(m, mechanism::parse_task(box_round(lost.at, half, more), "task.yaml", m), request).verdict;
  };
  EXPECT_NE(verdict(0.004, ""), core::Verdict::verified);
  const PinForce force(m, lost.joint);
  // The whole force is far above what is asked of it; the part that presses is not.
  const PinForce::Force there = force.at(lost.at);
  const std::string asked = "min_force: " + std::to_string(std::abs(there.along) / 2) + "\n";
  EXPECT_EQ(verdict(1e-6, asked), core::Verdict::refuted);
}

TEST(PinsInSpace, TheLeastForceIsThatAcrossTheAxis) {
  int places = 0;
  for (unsigned number = 0; number < 6; ++number) {
    const std::string text = three_legs(number);
    SCOPED_TRACE(text);
    const Mechanism m = mechanism::parse_mechanism(text, "legs.yaml");
    const bool sleeves = text.find("cylindrical") != std::string::npos;
    for (const std::string joint : {"R1", "C1"}) {
      if (joint == "C1" && !sleeves) continue;
      LociRequest request;
      request.joints = {joint};
      request.quantities = {core::Quantity::M};
      request.min_force = 40;
      const PinForce force(m, joint);
      for (const core::LocusCurve& curve : trace_loci(m, request).curves) {
        if (curve.kind != core::LocusKind::margin) continue;
        for (const core::Arc& arc : curve.arcs)
          for (const std::size_t part : {1U, 2U, 3U}) {
            const core::Point2& at = arc.points[part * (arc.points.size() - 1) / 4];
            const PinForce::Force there = force.at(at);
            EXPECT_NEAR(there.across.norm(), 40, 0.4) << joint << " at (" << at[0] << ", " << at[1] << ")";
            ++places;
          }
      }
    }
  }
  EXPECT_GT(places, 10);
}

/// With the turn of the platform besides.
std::string over_three(std::string text) {
  const std::string turn = ", th: 0}", y = "  y: [-2/5, 2/5]\n";
  text.replace(text.find(turn), turn.size(), "}");
  return text.replace(text.find(y), y.size(), y + "  th: {angle: [-1/5, 1/5]}\n");
}

TEST(PinsInSpace, OverThreeCoordinatesContactIsLostAlongCurves) {
  const Mechanism m = mechanism::parse_mechanism(over_three(first_lost().text), "legs.yaml");
  LociRequest request;
  request.joints = {first_lost().joint};
  request.quantities = {core::Quantity::f};
  const core::LocusMap map = trace_loci(m, request);
  const PinForce force(m, request.joints.front());
  int vertices = 0;
  for (const core::SpaceCurve& curve : map.space_curves) {
    EXPECT_TRUE(loses_contact(curve.vanishing, request.joints.front()));
    for (const core::SpaceArc& arc : curve.arcs)
      for (const core::Point3& at : arc.points) {
        const PinForce::Force there = force.at(at);
        if (!(std::abs(there.determinant) > 1e-6)) continue;
        EXPECT_LT(there.across.norm(), 1e-3 * std::abs(there.along));
        ++vertices;
      }
  }
  EXPECT_GT(vertices, 10);
}

TEST(PinsInSpace, TasksOverPosesAskForThePartAcrossTheAxis) {
  const Lost lost = first_lost();
  const Mechanism slice = mechanism::parse_mechanism(lost.text, "legs.yaml");
  const PinForce force(slice, lost.joint);
  const PinForce::Force there = force.at(lost.at);
  const Model model = Model::parse(over_three(lost.text));
  LociRequest request;
  request.joints = {lost.joint};
  request.quantities = {core::Quantity::f};
  const auto verdict = [&](double half, const std::string& more) {
    std::string text = "format: 1\nbox:\n";
    const std::array<std::pair<const char*, double>, 3> middle = {{{"x", lost.at[0]}, {"y", lost.at[1]}, {"th", 0}}};
    for (const auto& [name, at] : middle)
      text += std::string("  ") + name + ": [" + std::to_string(at - half) + ", " + std::to_string(at + half) + "]\n";
    return verify(model, parse_task(text + more, model), {.loci = request}).verdict;
  };
  EXPECT_NE(verdict(0.002, ""), core::Verdict::verified);
  EXPECT_EQ(verdict(1e-6, "min_force: " + std::to_string(std::abs(there.along) / 2) + "\n"), core::Verdict::refuted);
}

}  // namespace
}  // namespace clearloci
