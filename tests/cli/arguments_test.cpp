#include "cli/arguments.hpp"

#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "mechanism/read.hpp"

namespace clearloci::cli {
namespace {

using core::Quantity;

constexpr const char* two_dyads = R"(
format: 1
name: five-bar
space: planar
parameters: {L: 0.5}
workspace: {x: [-1, 1], y: [-1, 1]}
points:
  A: [0, 0]
  D: [L, 0]
  P: [x, y]
  B: {dyad: [A, P], lengths: [L, L], side: right}
  C: {dyad: [D, P], lengths: [L, L], side: left}
links:
  AB: {points: [A, B]}
  BP: {points: [B, P]}
  PC: {points: [P, C]}
  CD: {points: [C, D]}
joints:
  A: {revolute: [ground, AB], at: A, actuated: true}
  B: {revolute: [AB, BP], at: B}
  P: {revolute: [BP, PC], at: P}
  C: {revolute: [CD, PC], at: C}
  D: {revolute: [ground, CD], at: D, actuated: true}
end_effector: {link: PC, at: P}
loads:
  - {link: PC, at: P, force: [0, -1]}
)";

const mechanism::Mechanism& five_bar() {
  static const mechanism::Mechanism mechanism = mechanism::parse_mechanism(two_dyads, "five.yaml");
  return mechanism;
}

/// what() of the InputError that `call` throws.
template <typename Call>
std::string complaint(const Call& call) {
  try {
    call();
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Split, KeepsEmptyWordsAndDropsBlanks) {
  EXPECT_EQ(split("f, M ,fx"), (std::vector<std::string>{"f", "M", "fx"}));
  EXPECT_EQ(split(""), (std::vector<std::string>{""}));
  EXPECT_EQ(split("a,,b,"), (std::vector<std::string>{"a", "", "b", ""}));
}

TEST(ParseQuantities, ListsEachOnce) {
  EXPECT_EQ(parse_quantities("f,M,f"), (std::vector<Quantity>{Quantity::f, Quantity::M}));
  EXPECT_EQ(complaint([] { parse_quantities("f,m"); }),
            "--quantity: unknown quantity 'm'; choose from f, N, T, M, F, fx, fy, fz, mx, my, mz");
  EXPECT_EQ(complaint([] { parse_quantities(""); }),
            "--quantity: unknown quantity ''; choose from f, N, T, M, F, fx, fy, fz, mx, my, mz");
}

TEST(ParseWorkingMode, GivesASideToEveryDyadInTheFilesOrder) {
  EXPECT_EQ(parse_working_mode("left,right", five_bar()), (DyadSides{1, -1}));
  EXPECT_EQ(parse_working_mode(" right , right ", five_bar()), (DyadSides{-1, -1}));
}

TEST(ParseWorkingMode, NamesTheDyadsWhereTheCountIsWrong) {
  EXPECT_EQ(complaint([] { parse_working_mode("left", five_bar()); }),
            "--working-mode: 'left' has 1 side; give left or right for each of B,C (2 dyads), or all");
  EXPECT_NE(complaint([] { parse_working_mode("left,right,left", five_bar()); }).find("has 3 sides"),
            std::string::npos);
  EXPECT_NE(complaint([] { parse_working_mode("left,up", five_bar()); }).find("'up' is not a side"), std::string::npos);
}

TEST(ParseNumber, IsExactAndKnowsTheParameters) {
  EXPECT_EQ(parse_number("0.1", "--at", five_bar()), core::Rational(1, 10));
  EXPECT_EQ(parse_number("-1/3", "--at", five_bar()), core::Rational(-1, 3));
  EXPECT_EQ(parse_number("2*L", "--at", five_bar()), core::Rational(1));
  for (const char* wrong : {"", "1/0", "K", "x", "1,5", "nan", "0x10", "1e"})
    EXPECT_NE(complaint([&] { parse_number(wrong, "--at", five_bar()); }), "accepted") << wrong;
}

TEST(ParsePositive, RefusesZeroAndLess) {
  EXPECT_EQ(parse_positive("1e-5", "--tolerance", five_bar()), core::Rational(1, 100000));
  for (const char* wrong : {"0", "-1", "L-L"})
    EXPECT_NE(complaint([&] { parse_positive(wrong, "--tolerance", five_bar()); }).find("not above zero"),
              std::string::npos)
        << wrong;
}

TEST(ParsePose, NeedsOneValueACoordinate) {
  EXPECT_EQ(parse_pose("0.25,-0.7", five_bar()), (std::vector<core::Rational>{{1, 4}, {-7, 10}}));
  EXPECT_EQ(complaint([] { parse_pose("0.25", five_bar()); }),
            "--at: '0.25' has 1 value; give one for each of the 2 free coordinates: x,y");
  EXPECT_NE(complaint([] { parse_pose("1,2,3", five_bar()); }), "accepted");
}

TEST(ParseGrid, TakesACountForEachCoordinate) {
  EXPECT_EQ(parse_grid("400x300", 2), (std::vector<int>{400, 300}));
  EXPECT_EQ(parse_grid("720", 1), (std::vector<int>{720}));
  EXPECT_EQ(parse_grid("4x5x6", 3), (std::vector<int>{4, 5, 6}));
  for (const char* wrong : {"", "400", "400x", "x400", "0x5", "-4x5", "4.5x5", "4x5x6", "99999999999x2", "1x1"})
    EXPECT_NE(complaint([&] { parse_grid(wrong, 2); }), "accepted") << wrong;
  for (const char* wrong : {"", "1", "-4", "20x20", "2000000", "4.5"})
    EXPECT_NE(complaint([&] { parse_grid(wrong, 1); }).find("steps"), std::string::npos) << wrong;
  for (const char* wrong : {"40x40", "40", "40x40x1", "3000x3x3", "axbxc"})
    EXPECT_NE(complaint([&] { parse_grid(wrong, 3); }), "accepted") << wrong;
}

TEST(ParseJoints, AreThoseOfTheMechanism) {
  EXPECT_EQ(parse_joints({"A,P", "A", "C"}, five_bar()), (std::vector<std::string>{"A", "P", "C"}));
  EXPECT_EQ(complaint([] { parse_joints({"A9"}, five_bar()); }),
            "--joint: the mechanism has no joint 'A9'; choose from A, B, P, C, D");
}

TEST(OutputFolder, IsNamedAfterTheFile) {
  EXPECT_EQ(output_folder({.model = "somewhere/arm.v2.yaml"}), "out/arm.v2");
  EXPECT_EQ(output_folder({.model = "arm.yaml", .output = "there"}), "there");
}

}  // namespace
}  // namespace clearloci::cli
