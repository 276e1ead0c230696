// One mistake at a time in a correct file: the line, the column and the words of the complaint.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <ostream>

#include "five_bar_text.hpp"
#include "mechanism/read.hpp"

namespace clearloci::mechanism {
namespace {

struct Mistake {
  const char* name;
  const char* from;
  const char* to;
  int line, column;
  const char* says;
};

void PrintTo(const Mistake& mistake, std::ostream* out) { *out << mistake.to; }

class InputErrors : public testing::TestWithParam<Mistake> {};

TEST_P(InputErrors, SayWhereWhatAndHowToMend) {
  const Mistake& mistake = GetParam();
  try {
    parse_mechanism(with(five_bar_text, mistake.from, mistake.to), "m.yaml");
    FAIL() << "accepted";
  } catch (const core::InputError& error) {
    const std::string text = error.what();
    EXPECT_EQ(error.position().file, "m.yaml");
    EXPECT_EQ(error.position().line, mistake.line) << text;
    EXPECT_EQ(error.position().column, mistake.column) << text;
    EXPECT_NE(text.find(mistake.says), std::string::npos) << text;
    EXPECT_FALSE(error.mend().empty()) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  }
}

std::string mistake_name(const testing::TestParamInfo<Mistake>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(
    Structure, InputErrors,
    testing::Values(
        Mistake{"NoJoints", "joints:", "frames:", 1, 1, "the key 'joints' is missing in the file; add joints: {O: {"},
        Mistake{"NoWorkspaceNoPoints", "workspace:\n  x: [-0.5, 1.0]\n  y: [-1.0, 1.0]\npoints:", "frames:", 1, 1,
                "the keys workspace, points are missing in the file; add workspace: {x: "},
        Mistake{"UnitsAsAWord", "space: planar", "units: mm", 3, 8, "write it such as units: {length: mm}"},
        Mistake{"LinkAsAList", "A1B1: {points: [A1, B1], mass: 1}", "A1B1: [A1, B1]", 17, 9,
                "write it as {points: ...}; its keys are points, mass"},
        Mistake{"ClearanceAsANumber", "clearance: {radial: 10e-6}", "clearance: 10e-6", 23, 50,
                "write it as {radial: ...}"},
        Mistake{"UnknownTopKey", "loads:", "laods:", 28, 1, "did you mean 'loads'?"},
        Mistake{"UnknownKeyOfALink", "mass: 1}", "mas: 1}", 17, 28,
                "unknown key 'mas' in link A1B1; did you mean 'mass'?"},
        Mistake{"UnknownKeyOfAJoint", "clearance: {", "clerance: {", 22, 58, "did you mean 'clearance'?"},
        Mistake{"UnknownKeyLikeOneThatIsThere", "{radial: 10e-6}", "{radial: 10e-6, axial: 1e-6}", 23, 66,
                "unknown key 'axial' in the clearance of joint B1; the keys are radial"},
        Mistake{"UnknownKeyOfALoad", "force: [", "forces: [", 29, 24, "did you mean 'force'?"},
        Mistake{"UnlikeAnyKey", "mass: 1}", "colour: red}", 17, 28, "the keys are points, mass, com, inertia"},
        Mistake{"MissingEndEffector", "end_effector: {link: PB2, at: P}\n", "", 1, 1, "'end_effector' is missing"},
        Mistake{"MissingFormat", "format: 1\n", "", 1, 1, "'format' is missing"},
        Mistake{"MissingWorkspace", "workspace:\n  x: [-0.5, 1.0]\n  y: [-1.0, 1.0]\n", "", 1, 1,
                "'workspace' is missing"},
        Mistake{"MissingSide", ", side: right", "", 14, 7, "'side' is missing in point B1"},
        Mistake{"MissingJointPoint", "at: B1, ", "", 23, 7, "'at' is missing in joint B1"},
        Mistake{"OtherFormat", "format: 1", "format: 2", 1, 9, "format 1"},
        Mistake{"Spatial", "space: planar", "space: spatial", 11, 7, "a list of 3, not of 2"},
        Mistake{"OtherSpace", "space: planar", "space: flat", 3, 8, "'flat'"},
        Mistake{"DuplicatePoint", "  A2: [d, 0]", "  A1: [d, 0]", 12, 3, "'A1' is there twice"},
        Mistake{"DuplicateLink", "  B1P: {points", "  A1B1: {points", 18, 3,
                "'A1B1' is there twice in 'links': first in line 17"},
        Mistake{"DuplicateJoint", "  B1: {revolute", "  A1: {revolute", 23, 3, "'A1' is there twice"},
        Mistake{"DuplicateParameter", "  d: L", "  L: 1", 6, 3, "'L' is there twice"},
        Mistake{"DuplicateKey", "mass: 1}", "mass: 1, mass: 2}", 17, 37, "'mass' is there twice in link A1B1"},
        Mistake{"DuplicateSection", "end_effector:", "links: {}\nend_effector:", 27, 1, "'links' is there twice"},
        Mistake{"ListForMapping", "points:\n  A1: [0, 0]", "points: [1]\nq:\n  A1: [0, 0]", 11, 1, "unknown key 'q'"},
        Mistake{"OpenBracket", "points: [A1, B1]", "points: [A1, B1", 17, 34, "not YAML"},
        Mistake{"WrongIndentation", "  d: L", " d: L", 6, 2, "not YAML"},
        Mistake{"SecondDocument", "points:\n", "---\npoints:\n", 11, 1, "second document"},
        Mistake{"CommaFirst", "format: 1", ",format: 1", 1, 1, "no mechanism can be read"},
        Mistake{"EmptyValue", "mass: 1}", "mass: }", 17, 28, "is empty"}),
    mistake_name);

INSTANTIATE_TEST_SUITE_P(
    Numbers, InputErrors,
    testing::Values(
        Mistake{"NotANumber", "mass: 1}", "mass: heavy}", 17, 34, "'heavy' is neither a number nor a parameter"},
        Mistake{"UnknownParameterInside", "d: L", "d: 2 * M", 6, 10, "'M' is neither"},
        Mistake{"DivisionByZero", "L: 0.5", "L: 1/0", 5, 6, "division by zero"},
        Mistake{"HiddenDivisionByZero", "d: L", "d: 1/(L - 1/2)", 6, 6, "division by zero"},
        Mistake{"DivisionByZeroInAPoint", "P: [x, y]", "P: [x/(L - 0.5), y]", 13, 7, "division by zero"},
        Mistake{"RootOfNegative", "L: 0.5", "L: sqrt(-2)", 5, 6, "negative number -2"},
        Mistake{"TooLargePower", "L: 0.5", "L: 2^(10^9)", 5, 6, "100000 bits"},
        Mistake{"TooLargeProduct", "L: 0.5", "L: (3/7)^4096*(3/7)^4096*(3/7)^4096*(3/7)^4096*(3/7)^4096*(3/7)^4096", 5,
                6, "100000 bits"},
        Mistake{"TooLargeSum", "L: 0.5", "L: (1/7)^20000 + (1/11)^20000", 5, 6, "100000 bits"},
        Mistake{
            "TooManyRoots", "L: 0.5",
            "L: (sqrt(2) + sqrt(3) + 1)*(sqrt(5) + sqrt(7) + 1)*(sqrt(11) + sqrt(13) + 1)*(sqrt(17) + sqrt(19) + 1)*"
            "(sqrt(23) + sqrt(29) + 1)*(sqrt(31) + sqrt(37) + 1)",
            5, 6, "256 different roots"},
        Mistake{"Huge", "L: 0.5", "L: 10^400", 5, 6, "larger than 1e15"},
        Mistake{"HugeAndIrrational", "L: 0.5", "L: sqrt(10^400 + 1)", 5, 6, "larger than 1e15"},
        Mistake{"Tiny", "L: 0.5", "L: 1e-40", 5, 6, "nearer to 0 than 1e-30"},
        Mistake{"Endless", "L: 0.5", "L: 1 + 7^-1500/7^-1500*1/3^2500 - 1/7^1000 + 0", 5, 6, "4096 bits"},
        Mistake{"HugeInAPoint", "P: [x, y]", "P: [x + 1e20, y]", 13, 7, "larger than 1e15"},
        Mistake{"HighDegree", "P: [x, y]", "P: [((x + y)^8)^8, y]", 13, 7, "degree above 32"},
        Mistake{"HighDegreeOfAProduct", "P: [x, y]", "P: [(x + y)^20*(x - y)^20, y]", 13, 7, "degree above 32"},
        Mistake{"HugeBox", "x: [-0.5,", "x: [-1.8e308,", 8, 7, "larger than 1e15"},
        Mistake{"DecimalComma", "d: L", "d: '0,5'", 6, 8, "0.5"},
        Mistake{"UnsaidProduct", "d: L", "d: 2L", 6, 7, "2*L"},
        Mistake{"UsesItself", "d: L", "d: d", 6, 6, "uses itself"},
        Mistake{"UsesALaterParameter", "L: 0.5", "L: d", 5, 6, "write d above L"},
        Mistake{"ReservedName", "  d: L", "  pi: L", 6, 3, "'pi' has a meaning"},
        Mistake{"NameWithDigitFirst", "  d: L", "  2d: L", 6, 3, "begins with a digit"},
        Mistake{"NameWithSpace", "  d: L", "  d x: L", 6, 3, "letters, digits and _"},
        Mistake{"ListAsNumber", "d: L", "d: [1]", 6, 6, "single value"},
        Mistake{"EmptyParameter", "d: L", "d:", 6, 3, "is empty"},
        Mistake{"NegativeLength", "[L, L], side: right", "[L, -L], side: right", 14, 36,
                "a length of point B1 is negative: -L = -0.5 m"},
        Mistake{"ZeroLength", "[L, L], side: right", "[L, L - 1/2], side: right", 14, 36, "is zero"},
        Mistake{"NegativeMass", "mass: 1}", "mass: -1}", 17, 34, "the mass of link A1B1 is negative: -1"},
        Mistake{"NegativeInertia", "mass: 1}", "mass: 1, inertia: -0.1}", 17, 46, "inertia of link A1B1 is negative"},
        Mistake{"NegativeClearance", "radial: 10e-6", "radial: -10e-6", 22, 78,
                "radial clearance of joint A1 is negative"},
        Mistake{"NegativeAngularClearance", "angular: 0.5e-3", "angular: -1", 22, 94, "angular clearance"},
        Mistake{"NeitherTrueNorFalse", "actuated: true", "actuated: yes", 22, 52, "neither true nor false"},
        Mistake{"ALoadOverACoordinate", "force: [0,", "force: [1/x,", 29, 32, "divides by 'x'"},
        Mistake{"CoordinateInAMass", "mass: 1}", "mass: x}", 17, 34, "free coordinate 'x'"}),
    mistake_name);

INSTANTIATE_TEST_SUITE_P(
    Workspace, InputErrors,
    testing::Values(
        Mistake{"EmptyRange", "x: [-0.5, 1.0]", "x: [1, 1.0]", 8, 6, "is empty"},
        Mistake{"ReversedRange", "x: [-0.5, 1.0]", "x: [1, -0.5]", 8, 6, "is reversed"},
        Mistake{"RangeOfThree", "x: [-0.5, 1.0]", "x: [0, 1, 2]", 8, 6, "list of 2, not of 3"},
        Mistake{"NoRange", "x: [-0.5, 1.0]", "x: 3", 8, 6, "should be a list of 2, not '3'"},
        Mistake{"NoCoordinates", "workspace:\n  x: [-0.5, 1.0]\n  y: [-1.0, 1.0]\n", "workspace: {}\n", 7, 12,
                "no coordinate"},
        Mistake{"SevenCoordinates", "  x: [", "  q: [0, 1]\n  r: [0, 1]\n  s: [0, 1]\n  u: [0, 1]\n  v: [0, 1]\n  x: [",
                14, 3, "more than six"},
        Mistake{"CoordinateNamedAsAParameter", "  y: [-1.0", "  L: [-1.0", 9, 3, "a parameter and a coordinate"},
        Mistake{"UnusedCoordinate", "P: [x, y]", "P: [x, 1/3]", 8, 3, "no point depends on the free coordinate 'y'"},
        Mistake{"EmptyAngle", "y: [-1.0, 1.0]", "y: {angle: [pi, 180 deg]}", 9, 14, "is empty"},
        Mistake{"DegreesWithoutTheirUnit", "y: [-1.0, 1.0]", "y: {angle: [-30, 30]}", 9, 14,
                "is 60 rad, 9.549 turns: plain numbers of an angle are rad; write [-30 deg, 30 deg]"},
        Mistake{"AngleOutsideCos", "y: [-1.0, 1.0]", "y: {angle: [0, pi]}", 13, 10, "outside cos and sin"},
        Mistake{"UnknownRangeKey", "y: [-1.0, 1.0]", "y: {angel: [0, pi]}", 9, 7, "did you mean 'angle'?"}),
    mistake_name);

INSTANTIATE_TEST_SUITE_P(
    Points, InputErrors,
    testing::Values(
        Mistake{"UnknownPoint", "dyad: [A1, P], lengths: [L, L], side: right",
                "dyad: [A9, P], lengths: [L, L], side: right", 14, 15, "there is no point 'A9'"},
        Mistake{"LaterPoint", "  P: [x, y]\n  B1: {dyad: [A1, P], lengths: [L, L], side: right}\n",
                "  B1: {dyad: [A1, P], lengths: [L, L], side: right}\n  P: [x, y]\n", 13, 19, "write P above B1"},
        Mistake{"Cycle", "dyad: [A1, P], lengths: [L, L], side: right}\n  B2: {dyad: [A2, P]",
                "dyad: [B2, P], lengths: [L, L], side: right}\n  B2: {dyad: [A2, B1]", 14, 3, "B1 -> B2 -> B1"},
        Mistake{"OnItself", "dyad: [A1, P]", "dyad: [B1, P]", 14, 3, "B1 -> B1"},
        Mistake{"SamePointTwice", "dyad: [A1, P]", "dyad: [P, P]", 14, 18, "names the point P twice"},
        Mistake{"DyadOfThree", "dyad: [A1, P]", "dyad: [A1, P, A2]", 14, 14, "list of 2, not of 3"},
        Mistake{"OneLength", "lengths: [L, L]", "lengths: [L]", 14, 32, "list of 2, not of 1"},
        Mistake{"ThreeCoordinates", "A1: [0, 0]", "A1: [0, 0, 0]", 11, 7,
                "three components, but the mechanism is planar"},
        Mistake{"NeitherSide", "side: right", "side: up", 14, 46, "write left or right"},
        Mistake{"NoForm", "A1: [0, 0]", "A1: {at: [0, 0]}", 11, 8, "none of the forms"},
        Mistake{"MisspeltForm", "{dyad: [A1, P]", "{dyda: [A1, P]", 14, 8, "did you mean 'dyad'?"},
        Mistake{"TwoForms", "{dyad: [A1, P]", "{on: [A1, P], dyad: [A1, P]", 14, 8, "unknown key 'on'"},
        Mistake{"SliderSide", "{dyad: [A1, P], lengths: [L, L], side: right}",
                "{slider: [A1, [1, 0]], from: P, length: L, side: left}", 14, 56, "write ahead or behind"},
        Mistake{"SliderNoVector", "{dyad: [A1, P], lengths: [L, L], side: right}",
                "{slider: [A1, 2*L], from: P, length: L, side: ahead}", 14, 21, "'2*L' is no vector"},
        Mistake{"SliderTwoVectors", "{dyad: [A1, P], lengths: [L, L], side: right}",
                "{slider: [A1, A2*P], from: P, length: L, side: ahead}", 14, 21, "multiplies two vectors"},
        Mistake{"SliderNoPoint", "{dyad: [A1, P], lengths: [L, L], side: right}",
                "{slider: [A1, A2 - C], from: P, length: L, side: ahead}", 14, 21, "'C' is no vector"},
        Mistake{"SliderOpenParenthesis", "{dyad: [A1, P], lengths: [L, L], side: right}",
                "{slider: [A1, 2*(A2 - P], from: P, length: L, side: ahead}", 14, 21, "do not match"},
        Mistake{"SliderTooFar", "{dyad: [A1, P], lengths: [L, L], side: right}",
                "{slider: [A1, [1, 0]], from: A3, length: L, side: ahead}", 14, 36, "there is no point 'A3'"},
        Mistake{"SliderCycle", "{dyad: [A1, P], lengths: [L, L], side: right}",
                "{slider: [A1, [1, 0]], from: B2, length: L, side: ahead}", 14, 36, "B2, which is written below it"},
        Mistake{"ScalarPoint", "A1: [0, 0]", "A1: 0", 11, 7, "neither coordinates nor a construction"},
        Mistake{"NotAPolynomial", "P: [x, y]", "P: [x, 1/y]", 13, 10, "divides by 'y'"},
        Mistake{"RootOfACoordinate", "P: [x, y]", "P: [x, sqrt(y)]", 13, 10, "'sqrt(y)' is no polynomial"},
        Mistake{"NegativePower", "P: [x, y]", "P: [x, y^-1]", 13, 10, "no exponent"},
        Mistake{"CosOfALength", "P: [x, y]", "P: [x, cos(y)]", 13, 10, "'y' inside cos or sin is a length"},
        Mistake{"UnknownName", "P: [x, y]", "P: [x, y + h]", 13, 14,
                "'h' is neither a number nor a parameter nor a coordinate"},
        Mistake{"NameOfASymbol", "  d: L", "  d: L\n  xB1: 1", 15, 3, "'xB1' names a coordinate of point B1"},
        Mistake{"CoincidingBases", "A2: [d, 0]\n  P: [x, y]\n  B1: {dyad: [A1, P]",
                "A2: [0, 0]\n  P: [x, y]\n  B1: {dyad: [A1, A2]", 14, 3, "coincide in every pose"},
        Mistake{"Unreachable", "A1: [0, 0]", "A1: [10, 0]", 14, 3,
                "point B1 is unreachable in the whole box: |A1 P| runs from about 9"},
        Mistake{"UnreachableInside", "[L, L], side: right", "[5, 1], side: right", 14, 3, "reach from 4 m to 6 m"},
        Mistake{"UnreachableFixed", "links:", "  C: {dyad: [A1, A2], lengths: [0.1, 0.1], side: left}\nlinks:", 16, 3,
                "point C is unreachable"},
        Mistake{"UnreachableNested", "links:", "  C: {dyad: [A1, B1], lengths: [0.1, 0.2], side: left}\nlinks:", 16, 3,
                "point C is unreachable"}),
    mistake_name);

INSTANTIATE_TEST_SUITE_P(
    LinksAndJoints, InputErrors,
    testing::Values(
        Mistake{"UnknownLink", "revolute: [A1B1, B1P]", "revolute: [A1B, B1P]", 23, 19,
                "no link 'A1B'; did you mean 'A1B1'?"},
        Mistake{"UnknownPointOfALink", "points: [A1, B1]", "points: [A1, B9]", 17, 23, "there is no point 'B9'"},
        Mistake{"PointTwiceOnALink", "points: [A1, B1]", "points: [A1, A1]", 17, 23, "list A1 twice"},
        Mistake{"NoPointsOnALink", "points: [A1, B1]", "points: []", 17, 18, "are none"},
        Mistake{"LinkNamedGround", "  A1B1: {points", "  ground: {points", 17, 3, "'ground' is always there"},
        Mistake{"OnePointWithMass", "points: [A1, B1], mass", "points: [B1], mass", 17, 3, "its com has no default"},
        Mistake{"DyadAsCentreOfMass", "mass: 1}", "mass: 1, com: {dyad: [A1, P], lengths: [L, L], side: left}}", 17, 42,
                "is a dyad"},
        Mistake{"NotRigid", "points: [P, B2]", "points: [P, B2, A1]", 19, 3, "the distance between P and A1 changes"},
        Mistake{"CentreOfMassNotRigid", "mass: 1}", "mass: 1, com: [L, 0]}", 17, 3, "its centre of mass changes"},
        Mistake{"JoinsItself", "revolute: [A1B1, B1P]", "revolute: [B1P, B1P]", 23, 24, "joins link B1P to itself"},
        Mistake{"JoinsTheGroundToItself", "revolute: [ground, A1B1]", "revolute: [ground, ground]", 22, 27,
                "joins the ground to itself"},
        Mistake{"NotOnTheLink", "B1P], at: B1,", "B1P], at: A1,", 23, 35, "A1, which is no point of link B1P"},
        Mistake{"GroundJointMoves", "A1B1], at: A1,", "A1B1], at: B1,", 22, 38, "moves with the free coordinate x"},
        Mistake{"SlidesOnNeitherLink", "revolute: [A1B1, B1P], at: B1, clearance: {radial: 10e-6}",
                "prismatic: [A1B1, B1P], at: B2, axis: [1, 0]", 23, 36, "B2, which is no point of links A1B1 and B1P"},
        Mistake{"SlidesOnTheGroundAlone", "revolute: [A1B1, B1P], at: B1, clearance: {radial: 10e-6}",
                "prismatic: [ground, B1P], at: B2, axis: [1, 0]", 23, 38, "B2, which is no point of link B1P"},
        Mistake{"PrismaticNoAxis", "revolute: [A1B1, B1P]", "prismatic: [A1B1, B1P]", 23, 7, "'axis' is missing"},
        Mistake{"PrismaticZeroAxis", "revolute: [A1B1, B1P], at: B1, clearance: {radial: 10e-6}",
                "prismatic: [A1B1, B1P], at: B1, axis: [0, 0]", 23, 3, "the axis of joint B1 is zero"},
        Mistake{"PrismaticRadial", "revolute: [A1B1, B1P], at: B1", "prismatic: [A1B1, B1P], axis: [B1, P], at: B1", 23,
                67, "unknown key 'radial'"},
        Mistake{"PrismaticGapAlone", "revolute: [A1B1, B1P], at: B1, clearance: {radial: 10e-6}",
                "prismatic: [A1B1, B1P], axis: [B1, P], at: B1, clearance: {gap: 10e-6}", 23, 66, "no half_length"},
        Mistake{"PrismaticGroundTurns",
                "revolute: [ground, A1B1], at: A1, actuated: true, clearance: {radial: 10e-6, angular: 0.5e-3}",
                "prismatic: [ground, A1B1], axis: [A1, P], at: A1, actuated: true", 22, 3, "turns over the workspace"},
        Mistake{"Spherical", "revolute: [A1B1, B1P]", "spherical: [A1B1, B1P]", 23, 8,
                "spherical, a joint of spatial mechanisms"},
        Mistake{"TwoTypes", "revolute: [A1B1, B1P]", "revolute: [A1B1, B1P], prismatic: [A1B1, B1P]", 23, 31,
                "is revolute and prismatic"},
        Mistake{"JointOfThree", "revolute: [A1B1, B1P]", "revolute: [A1B1, B1P, PB2]", 23, 18, "list of 2, not of 3"},
        Mistake{"OverConstrained", "at: B1, ", "at: B1, actuated: true, ", 22, 3,
                "13 unknowns (2 for each of 5 joints, 3 actuators) but 12 equations (3 for each of 4 links), "
                "over-constrained by 1"},
        Mistake{"UnderActuated", "at: A2, actuated: true", "at: A2", 22, 3,
                "11 unknowns (2 for each of 5 joints, 1 actuators) but 12 equations (3 for each of 4 links), "
                "under-actuated by 1"},
        Mistake{"EndEffectorOnGround", "{link: PB2, at: P}", "{link: ground, at: P}", 27, 22, "name a link that moves"},
        Mistake{"EndEffectorOffItsLink", "{link: PB2, at: P}", "{link: PB2, at: A1}", 27, 31, "no point of link PB2"},
        Mistake{"LoadOnGround", "{link: PB2, at: P, force", "{link: ground, at: P, force", 29, 12, "is the ground"},
        Mistake{"PlayInDegreesWithoutTheirUnit", "angular: 0.5e-3", "angular: 40", 22, 94,
                "the angular clearance of joint A1 is 40 rad, 6.366 turns: plain numbers of an angle are rad; write 40 "
                "deg"},
        Mistake{"ForceWithoutPoint", "at: P, force", "force", 29, 5, "no point where it acts"},
        Mistake{"EmptyLoad", ", force: [0, -100]", "", 29, 5, "neither a force nor a couple"},
        Mistake{"ForceOfThree", "force: [0, -100]", "force: [0, 0, 1]", 29, 31,
                "three components, but the mechanism is planar"},
        Mistake{"ScalarGravity", "loads:", "gravity: 9.81\nloads:", 28, 10, "list of 2, not '9.81'"}),
    mistake_name);

void expect_override_error(const std::string& name, const std::string& text, const std::string& says) {
  try {
    parse_mechanism(five_bar_text, "m.yaml", {{name, text}});
    FAIL() << "accepted";
  } catch (const core::InputError& error) {
    EXPECT_EQ(std::string(error.what()).find("--set " + name + "=" + text + ": "), 0U) << error.what();
    EXPECT_NE(std::string(error.what()).find(says), std::string::npos) << error.what();
  }
}

TEST(Overrides, AreCheckedLikeTheFile) {
  expect_override_error("K", "1", "the parameters are L, d");
  expect_override_error("L", "1/0", "division by zero");
  expect_override_error("L", "d", "written below it");
  expect_override_error("d", "", "empty");
  expect_override_error("d", "2L", "2*L");
  expect_override_error("d", "K", "'K' is neither a number nor a parameter");
}

TEST(EmptyText, IsAnInputError) {
  for (const char* text : {"", "\n\n", "# only a comment\n", "just text", "[1, 2]", "~", "format: 1"})
    EXPECT_THROW(parse_mechanism(text, "m.yaml"), core::InputError) << text;
}

/// However a file is spoilt, the complaint is an InputError of one line.
RC_GTEST_PROP(SpoiltText, IsReadOrAnInputError, ()) {
  std::string text = five_bar_text;
  const std::string alphabet = "\n :,[]{}-#'\"*&!|>%@`~?\t.0189eAxyL/^()";
  for (int k = *rc::gen::inRange(1, 4); k > 0; --k) {
    const auto at = static_cast<std::size_t>(*rc::gen::inRange(0, static_cast<int>(text.size())));
    const char c = *rc::gen::elementOf(alphabet);
    switch (*rc::gen::inRange(0, 3)) {
      case 0:
        text.erase(at, static_cast<std::size_t>(*rc::gen::inRange(1, 12)));
        break;
      case 1:
        text.insert(at, 1, c);
        break;
      default:
        text[at] = c;
    }
  }
  try {
    parse_mechanism(text, "m.yaml");
  } catch (const core::InputError& error) {
    RC_ASSERT(std::string(error.what()).find('\n') == std::string::npos);
  }
}

}  // namespace
}  // namespace clearloci::mechanism
