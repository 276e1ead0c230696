// Units: a file in mm, degrees and kN is the same mechanism as one in SI.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "five_bar_text.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/open_design.hpp"
#include "mechanism/read.hpp"
#include "mechanism/read_task.hpp"
#include "mechanism/trajectory.hpp"
#include "mechanism/written_unit.hpp"

namespace clearloci::mechanism {
namespace {

Rational value(const Mechanism& mechanism, const Expression& expression) { return value_of(expression, mechanism); }

std::string coordinates(const Mechanism& mechanism, std::size_t point) {
  std::string text;
  for (const Expression& e : std::get<ExplicitPoint>(mechanism.points.at(point).form).coordinates)
    text += (text.empty() ? "" : ", ") + to_string(e);
  return text;
}

const std::string in_mm = R"(format: 1
units: {length: mm, angle: deg, force: kN, mass: g}
parameters: {L: 500, d: 50 cm, alpha: 30, F: 100 N, k: 2}
workspace:
  x: [-500, 1 m]
  y: [-1000, 1000]
points:
  A1: [0, 0]
  A2: [d, 0]
  P: [x, y]
  B1: {dyad: [A1, P], lengths: [L, L], side: right}
  B2: {dyad: [A2, P], lengths: [L, 0.5 m], side: left}
links:
  A1B1: {points: [A1, B1], mass: 1000, inertia: 0.02}
  B1P: {points: [B1, P], mass: 1 kg, inertia: 2 kg*mm^2}
  PB2: {points: [P, B2], mass: 1000}
  B2A2: {points: [B2, A2], mass: 1000}
joints:
  A1: {revolute: [ground, A1B1], at: A1, actuated: true, clearance: {radial: 0.01, angular: 0.5}}
  B1: {revolute: [A1B1, B1P], at: B1, clearance: {radial: 10 um}}
  P: {revolute: [B1P, PB2], at: P}
  B2: {revolute: [B2A2, PB2], at: B2}
  A2: {revolute: [ground, B2A2], at: A2, actuated: true}
end_effector: {link: PB2, at: P}
loads:
  - {link: PB2, at: P, force: [F*cos(alpha), -0.1]}
  - {link: PB2, couple: 3}
  - {link: PB2, couple: 3 N mm}
  - {link: PB2, couple: F*L}
gravity: [0, -9.81]
)";

TEST(Units, EveryFieldConvertsByItsDimension) {
  const Mechanism m = parse_mechanism(in_mm, "m.yaml");
  EXPECT_EQ(m.coordinates[0].lower, Rational(-1, 2));
  EXPECT_EQ(m.coordinates[0].upper, 1);
  EXPECT_EQ(coordinates(m, 2), "x, y");
  EXPECT_EQ(value(m, std::get<ExplicitPoint>(m.points[1].form).coordinates[0]), Rational(1, 2));
  const auto& dyad = std::get<DyadPoint>(m.points[4].form);
  EXPECT_EQ(value(m, dyad.from_length), Rational(1, 2));
  EXPECT_EQ(value(m, dyad.to_length), Rational(1, 2));
  EXPECT_EQ(value(m, m.links[0].mass), 1);
  EXPECT_EQ(value(m, *m.links[0].inertia), Rational(1, 50));
  EXPECT_EQ(value(m, m.links[1].mass), 1);
  EXPECT_EQ(value(m, *m.links[1].inertia), Rational(1, 500000));
  EXPECT_EQ(value(m, m.joints[0].clearance->radial), Rational(1, 100000));
  EXPECT_EQ(value(m, m.joints[1].clearance->radial), Rational(1, 100000));
  EXPECT_EQ(to_string(m.joints[0].clearance->angular), "1/2*pi/180");
  EXPECT_NEAR(core::to_double(value(m, m.loads[0].force[0])), 100 * std::sqrt(3.0) / 2, 1e-12);
  EXPECT_EQ(value(m, m.loads[0].force[1]), -100);
  EXPECT_EQ(value(m, m.loads[1].couple), 3);
  EXPECT_EQ(value(m, m.loads[2].couple), Rational(3, 1000));
  EXPECT_EQ(value(m, m.loads[3].couple), 50) << "100 N at 500 mm";
  EXPECT_EQ(value(m, m.gravity[1]), Rational(-981, 100));
}

/// Numbers that are not in lowest terms are none: GMP compares and multiplies them wrongly.
TEST(Units, EveryLengthIsInLowestTerms) {
  for (const char* unit : {"m", "dm", "cm", "mm", "um", "km", "in"}) {
    std::string text = in_mm;
    text.replace(text.find("10 um"), 5, std::string("20 ") + unit);
    const Mechanism m = parse_mechanism(text, "m.yaml");
    const Rational at = value(m, m.joints[1].clearance->radial);
    Rational lowest = at;
    lowest.canonicalize();
    EXPECT_EQ(at.get_den(), lowest.get_den()) << unit;
  }
  std::string inches = in_mm;
  inches.replace(inches.find("length: mm"), 10, "length: in");
  const Mechanism m = parse_mechanism(inches, "m.yaml");
  EXPECT_EQ(m.coordinates[0].lower.get_num(), -127);
  EXPECT_EQ(m.coordinates[0].lower.get_den(), 10);
}

TEST(Units, AnAngleThatIsMissingOrLeftOverIsInRadians) {
  const auto read = [](const std::string& stiffness) {
    std::string text = in_mm + "springs: [{joint: A2, stiffness: " + stiffness + ", rest: 30}]\n";
    text.replace(text.find("k: 2}"), 5, "k: 2, kt: 3 N m, phi: pi/6 rad, R: 0.1 m}");
    text.replace(text.find("A2: [d, 0]"), 10, "A2: [R*phi, 0]");
    return parse_mechanism(text, "m.yaml");
  };
  for (const char* stiffness : {"3", "3 N m", "3 N m/rad", "kt", "3000 N mm"}) {
    const Mechanism m = read(stiffness);
    EXPECT_NEAR(core::to_double(value(m, m.springs.at(0).stiffness)), 3, 1e-12) << stiffness;
  }
  const Mechanism m = read("3 N m/deg");
  EXPECT_NEAR(core::to_double(value(m, m.springs.at(0).stiffness)), 540 / std::numbers::pi, 1e-9);
  const auto& place = std::get<ExplicitPoint>(m.points.at(1).form).coordinates;
  EXPECT_NEAR(core::to_double(value(m, place[0])), 0.1 * std::numbers::pi / 6, 1e-12);
}

TEST(Units, ExpressionsOfTheCoordinatesStayPolynomialsInMetres) {
  std::string text = with(in_mm, "P: [x, y]", "P: [2*x + 30 - 3 cm, x*y/100]");
  Mechanism m = parse_mechanism(text, "m.yaml");
  EXPECT_EQ(coordinates(m, 2), "2*x + 3/100 - 3/100, x*1000*y/100");
  text = with(in_mm, "x: [-500, 1 m]", "x: {angle: [0, 90]}");
  m = parse_mechanism(with(text, "P: [x, y]", "P: [40*cos(2*x + 30), y + 5*sin(x)]"), "m.yaml");
  EXPECT_EQ(to_string(m.coordinates[0].upper_expression), "90*pi/180");
  EXPECT_EQ(coordinates(m, 2), "1/25*cos(2*x + 30*pi/180), y + 1/200*sin(x)");
}

/// A range of plain numbers is refused where it is longer than two turns: nobody means that, and [0, 360] is degrees.
TEST(Units, ARangeOfManyTurnsSaysItsUnit) {
  const auto upper = [](const std::string& range) {
    std::string text = with(five_bar_text, "x: [-0.5, 1.0]", "x: {angle: " + range + "}");
    text = with(text, "P: [x, y]", "P: [cos(x), y]");
    return core::to_double(parse_mechanism(text, "m.yaml").coordinates[0].upper);
  };
  constexpr double pi = std::numbers::pi;
  EXPECT_NEAR(upper("[0, 12.5]"), 12.5, 1e-15);
  EXPECT_NEAR(upper("[0, 360 deg]"), 2 * pi, 1e-15);
  EXPECT_NEAR(upper("[0, 1080 deg]"), 6 * pi, 1e-14);
  EXPECT_NEAR(upper("[0, 6*pi]"), 6 * pi, 1e-14);
  EXPECT_NEAR(upper("[0, 20 rad]"), 20, 1e-15);
  EXPECT_THROW(upper("[0, 360]"), core::InputError);
  EXPECT_THROW(upper("[-10*L, 10]"), core::InputError);
}

TEST(Units, ANumberMayCarryItsOwnUnitInAnyFile) {
  std::string text = with(five_bar_text, "L: 0.5", "L: 500 mm");
  text = with(text, "radial: 10e-6", "radial: 10 um");
  text = with(text, "[0, -100]", "[0, -0.1 kN]");
  const Mechanism m = parse_mechanism(text, "m.yaml");
  EXPECT_EQ(m.parameters[0].value, Rational(1, 2));
  EXPECT_EQ(value(m, m.joints[0].clearance->radial), Rational(1, 100000));
  EXPECT_EQ(value(m, m.loads[0].force[1]), -100);
  EXPECT_FALSE(m.units.declared);
}

TEST(Units, ADegreeAsANumberHasPowersOfEverySize) {
  const double degree = std::numbers::pi / 180;
  const std::vector<std::pair<std::string, double>> powers = {
      {"2*deg^0.5", 2 * std::sqrt(degree)}, {"1/deg^2", 1 / (degree * degree)}, {"deg^7", std::pow(degree, 7)}};
  for (const auto& [text, expected] : powers) {
    const Mechanism m = parse_mechanism(with(five_bar_text, "[0, -100]", "[0, \"" + text + "\"]"), "m.yaml");
    EXPECT_NEAR(core::to_double(value(m, m.loads[0].force[1])), expected, 1e-12 * expected) << text;
  }
  EXPECT_THROW(parse_mechanism(with(five_bar_text, "L: 0.5", "L: 0.5 + 1/deg^3e17"), "m.yaml"), core::InputError);
}

// Products nested n deep are converted n times, not 2^n.
TEST(Units, ProductsMayNestDeep) {
  std::string text = "L";
  for (int i = 0; i < 90; ++i) text = "0.5*(" + text + " + 2 m)";
  const Mechanism m = parse_mechanism(with(five_bar_text, "A2: [d, 0]", "A2: [" + text + ", 0]"), "m.yaml");
  const auto& place = std::get<ExplicitPoint>(m.points[1].form);
  EXPECT_NEAR(core::to_double(value(m, place.coordinates[0])), 2, 1e-12);
}

TEST(Units, NamesOfTheFileAreNoUnits) {
  // A parameter mm, a coordinate s: after * and / they are themselves.
  const std::string text = with(with(five_bar_text, "L: 0.5", "mm: 1/2\n  L: 1*mm"), "x: [", "s: [");
  const Mechanism m = parse_mechanism(with(text, "[x, y]", "['1*s', y]"), "m.yaml");
  EXPECT_EQ(m.parameters[1].value, Rational(1, 2));
  EXPECT_EQ(coordinates(m, 2), "1*s, y");
}

TEST(Units, TasksAndTrajectoriesFollowTheMechanism) {
  const Mechanism m = parse_mechanism(in_mm, "m.yaml");
  const core::Task task = parse_task(
      "format: 1\ncircle: {centre: [100, -700], radius: 5 cm}\nmargin: 10\nmin_force: 0.005\nmin_couple: 2\n", "t.yaml",
      m);
  const auto& circle = std::get<core::TaskBall>(task.shape);
  EXPECT_EQ(circle.centre[1], Rational(-7, 10));
  EXPECT_EQ(circle.radius, Rational(1, 20));
  EXPECT_EQ(task.margin, Rational(1, 100));
  EXPECT_EQ(*task.min_force, 5);
  EXPECT_EQ(*task.min_couple, 2);
  const Trajectory path = parse_trajectory(
      "format: 1\npath: {waypoints: [[100, -700], {at: [200, -700], corner: 5}, [200, -600]]}\nmotion: cycloidal\n"
      "period: 500 ms\n",
      "p.yaml", m);
  EXPECT_EQ(path.waypoints[1].at[0], Rational(1, 5));
  EXPECT_EQ(path.waypoints[1].corner, Rational(1, 200));
  EXPECT_EQ(path.period, Rational(1, 2));
}

TEST(Units, ValuesOfTheCommandLineAreThoseOfTheFile) {
  const Mechanism m = parse_mechanism(in_mm, "m.yaml");
  EXPECT_EQ(value_in_si("250", "workspace", m, {}), Rational(1, 4));
  EXPECT_EQ(value_in_si("0.25 m", "workspace", m, {}), Rational(1, 4));
  EXPECT_EQ(value_in_si("L/2", "workspace", m, {}), Rational(1, 4));
  EXPECT_EQ(value_in_si("0.01", "length", m, {}), Rational(1, 100000));
  EXPECT_EQ(value_in_si("1/32", "", m, {}), Rational(1, 32));
}

TEST(Units, ReachSpringsEffortsLimitsAndLoadsThatVary) {
  std::string text =
      with(in_mm, "at: B1, clearance: {radial: 10 um}", "at: B1, actuated: {effort: 2}, clearance: {radial: 10 um}");
  text = with(text, "force: [F*cos(alpha), -0.1]", "force: [-40 N/m*(x - 250), -0.1*(y/1000)]");
  text = with(text, "  - {link: PB2, couple: 3}\n",
              "  - {link: PB2, at: P, force: '30 N/m*(A1 - P) + [0.001, 0]'}\n"
              "  - {link: PB2, at: P, force: '0.002*(A1 - P)'}\n");
  text += R"(springs:
  - {links: [A1B1, ground], at: [B1, A2], stiffness: 400, free_length: 100}
  - {links: [A1B1, ground], at: [B1, A2], stiffness: 0.4 N/mm, free_length: 10 cm}
  - {links: [B1P, ground], at: [P, A2], force: 0.025}
  - {joint: A1, stiffness: 2.5, rest: 30}
  - {joint: A1, stiffness: 500 N mm/deg}
limits:
  - {distance: [A1, P], within: [310, 92 cm]}
  - {angle: [A1, B1, P], within: [20, 160]}
)";
  const Mechanism m = parse_mechanism(text, "m.yaml");
  EXPECT_EQ(value(m, *m.joints[1].effort), 2);
  EXPECT_EQ(value(m, m.springs[0].stiffness), 400);
  EXPECT_EQ(value(m, m.springs[0].free_length), Rational(1, 10));
  EXPECT_EQ(value(m, m.springs[1].stiffness), 400);
  EXPECT_EQ(value(m, m.springs[1].free_length), Rational(1, 10));
  EXPECT_EQ(value(m, m.springs[2].force), 25);
  EXPECT_EQ(value(m, m.springs[3].stiffness), Rational(5, 2));
  EXPECT_EQ(to_string(m.springs[3].rest), "30*pi/180");
  EXPECT_NEAR(core::to_double(value(m, m.springs[4].stiffness)), 0.5 * 180 / std::acos(-1.0), 1e-12);
  EXPECT_EQ(m.limits[0].lower_value, Rational(31, 100));
  EXPECT_EQ(m.limits[0].upper_value, Rational(23, 25));
  EXPECT_EQ(to_string(m.limits[1].upper), "160*pi/180");
  // -40 (x - 1/4) N and -100 y N, of metres.
  std::vector<Parameter> at(2);
  at[0].name = "x";
  at[0].expression = Expression::number(Rational(1, 2));
  at[1].name = "y";
  at[1].expression = Expression::number(Rational(-1, 2));
  EXPECT_EQ(evaluate(m.loads[0].force[0], at).value, -10);
  EXPECT_EQ(evaluate(m.loads[0].force[1], at).value, 50);
  EXPECT_EQ(value(m, m.loads[1].force_vector->arguments[0].numbers[0]), 30);
  EXPECT_EQ(value(m, m.loads[1].force_vector->arguments[1].numbers[0]), 1);
  EXPECT_EQ(value(m, m.loads[2].force_vector->numbers[0]), 2000) << "0.002 kN/mm";
}

TEST(Units, WrongOnesAreRefused) {
  const std::vector<std::array<std::string, 3>> mistakes = {
      {"length: mm", "length: deg", "'deg' is no unit of length; write one of m, dm, cm, mm"},
      {"length: mm", "lenght: mm", "did you mean 'length'?"},
      {"radial: 10 um", "radial: 10 deg", "is a length, but '10 deg' is an angle; write it in a unit such as mm"},
      {"radial: 10 um", "radial: 10 N", "is a length, but '10 N' is a force; write it in a unit such as mm"},
      {"mass: 1 kg", "mass: 1 kN", "is a mass, but '1 kN' is a force"},
      {"couple: 3 N mm", "couple: 3 N/mm", "is a couple, but '3 N/mm' is a stiffness"},
      {"couple: 3 N mm", "couple: 5 + 3 N mm", "adds numbers with and without a unit"},
      {"d: 50 cm", "d: 50 cm + 3 N", "adds what does not measure the same"},
      {"radial: 10 um", "radial: 10 parsec", "unexpected 'parsec'"},
      {"radial: 10 um", "radial: 10 um^9", "a unit to this power"},
  };
  for (const auto& [from, to, says] : mistakes) {
    try {
      parse_mechanism(with(in_mm, from, to), "m.yaml");
      ADD_FAILURE() << "accepted: " << to;
    } catch (const core::InputError& error) {
      EXPECT_NE(std::string(error.what()).find(says), std::string::npos) << error.what();
    }
  }
}

TEST(Units, ParametersOfAnotherKindAreRefusedWhereTheyStandAlone) {
  const std::string file = with(in_mm, "radial: 10 um", "radial: F");  // a force
  try {
    parse_mechanism(file, "m.yaml");
    ADD_FAILURE() << "accepted";
  } catch (const core::InputError& error) {
    const std::string said = error.what();
    EXPECT_NE(said.find("is a length, but 'F' is a force; give parameter F a unit such as mm"), std::string::npos)
        << said;
  }
}

/// The mechanism's parameter with a value in the place of the file's.
const Parameter& parameter(const Mechanism& m, const std::string& name) { return *parameter_named(m, name); }

TEST(Units, PlainNumbersInThePlaceOfAParameterAreInItsUnit) {
  // d is written in cm, F in N, in a file in mm and kN; values are kept in the file's numbers.
  const Mechanism m = parse_mechanism(in_mm, "m.yaml", {{"d", "60"}, {"F", "3/2"}, {"L", "510"}});
  EXPECT_EQ(parameter(m, "d").value, 600);
  EXPECT_EQ(value_words(parameter(m, "d"), m), "600 mm");
  EXPECT_EQ(parameter(m, "F").value, Rational(3, 2000));
  EXPECT_EQ(parameter(m, "L").value, 510) << "a plain number stays one";
  // A number with a unit says itself what it is, and so does what is made of parameters that carry one.
  EXPECT_EQ(parameter(parse_mechanism(in_mm, "m.yaml", {{"d", "0.6 m"}}), "d").value, 600);
  EXPECT_EQ(
      parameter(parse_mechanism(with(in_mm, "F: 100 N", "F: 100 N, G: 2 N"), "m.yaml", {{"G", "3*F"}}), "G").value,
      Rational(3, 10));
}

TEST(Units, PlainNumbersInThePlaceOfAParameterKeepItsUnitWhereTheFileIsInSi) {
  const std::string text = with(five_bar_text, "  d: L", "  d: 500 mm\n  k: 2 N/mm\n  turn: 30 deg");
  const Mechanism m = parse_mechanism(text, "si.yaml", {{"k", "3"}, {"d", "450"}, {"turn", "45"}});
  EXPECT_EQ(parameter(m, "k").value, 3000);
  EXPECT_EQ(value_words(parameter(m, "k"), m), "3000 N/m");
  EXPECT_EQ(parameter(m, "d").value, Rational(9, 20));
  EXPECT_NEAR(core::to_double(parameter(m, "turn").value), std::numbers::pi / 4, 1e-15);
  EXPECT_EQ(value_words(parameter(m, "turn"), m), "45 deg");
  // Terms of different units have none in common: what is plain stays plain.
  const std::string mixed = with(five_bar_text, "  d: L", "  d: 1 mm + 1 cm");
  EXPECT_EQ(parameter(parse_mechanism(mixed, "si.yaml", {{"d", "0.5"}}), "d").value, Rational(1, 2));
}

TEST(Units, TolerancesOfAParameterWithAUnitCarryOne) {
  const Mechanism m = parse_mechanism(in_mm, "m.yaml");
  const std::string task = "format: 1\nbox: {x: [0, 10], y: [0, 10]}\ntolerances: {d: TOLERANCE}\n";
  EXPECT_EQ(parse_task(with(task, "TOLERANCE", "0.1 cm"), "t.yaml", m).tolerances.front().above, 1);
  try {
    parse_task(with(task, "TOLERANCE", "0.1"), "t.yaml", m);
    ADD_FAILURE() << "a plain number was taken";
  } catch (const core::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("write its unit, such as 0.1 mm"), std::string::npos) << error.what();
  }
}

TEST(Units, RefusalsSpeakInThem) {
  const Mechanism m = parse_mechanism(in_mm, "m.yaml");
  const auto says = [](const auto& call, const std::string& words) {
    try {
      call();
      ADD_FAILURE() << "accepted; wanted: " << words;
    } catch (const core::InputError& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  };
  says([&] { parse_task("format: 1\nbox: {x: [900, 1100], y: [0, 10]}\n", "t.yaml", m); },
       "x from 900 mm to 1100 mm, not within -500 mm to 1000 mm");
  says([&] { parse_task("format: 1\nbox: {x: [100, 50], y: [0, 10]}\n", "t.yaml", m); }, "from 100 mm to 50 mm");
  says([&] { parse_mechanism(with(in_mm, "lengths: [L, L]", "lengths: [L, -L]"), "m.yaml"); }, "-L = -500 mm");
  says([&] { parse_mechanism(with(in_mm, "[-1000, 1000]", "[1000, -1000]"), "m.yaml"); }, "1000 is above -1000");
}

}  // namespace
}  // namespace clearloci::mechanism
