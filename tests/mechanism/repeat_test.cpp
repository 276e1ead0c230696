// `repeat`: what is written once is read as if it were written out.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "mechanism/read.hpp"

namespace clearloci::mechanism {
namespace {

const std::string head = R"(format: 1
parameters: {r: 0.2, b: 0.5}
workspace:
  x: [-0.1, 0.1]
  y: [-0.1, 0.1]
points:
  P: [x, y]
links:
  plate: {points: [P, B1, B2, B3]}
end_effector: {link: plate, at: P}
loads:
  - {link: plate, at: P, force: [0, -100]}
)";

const std::string once = R"(joints:
repeat:
  i: [1, 2, 3]
  table: {a: [0 deg, 120 deg, 240 deg]}
  points:
    A{i}: ['b*cos(a{i})', 'b*sin(a{i})']
    B{i}: ['x + r*cos(a{i} + 20 deg)', 'y + r*sin(a{i} + 20 deg)']
  links: {'cyl{i}': {points: ['A{i}']}, 'rod{i}': {points: ['B{i}']}}
  joints:
    A{i}: {revolute: [ground, 'cyl{i}'], at: 'A{i}'}
    S{i}: {prismatic: ['cyl{i}', 'rod{i}'], at: 'B{i}', axis: ['A{i}', 'B{i}'], actuated: true}
    B{i}: {revolute: ['rod{i}', plate], at: 'B{i}', clearance: {radial: '{i}e-5'}}
)";

/// The same by hand, in the order in which copies come.
std::string written_out() {
  std::string points, links, joints, parameters;
  const char* angles[] = {"0 deg", "120 deg", "240 deg"};
  for (int k = 1; k <= 3; ++k) {
    const std::string i = std::to_string(k);
    parameters += ", a" + i + ": " + angles[k - 1];
    points += "  A" + i + ": [b*cos(a" + i + "), b*sin(a" + i + ")]\n  B" + i + ": [x + r*cos(a" + i +
              " + 20 deg), y + r*sin(a" + i + " + 20 deg)]\n";
    links += "  cyl" + i + ": {points: [A" + i + "]}\n  rod" + i + ": {points: [B" + i + "]}\n";
    joints += "  A" + i + ": {revolute: [ground, cyl" + i + "], at: A" + i + "}\n  S" + i + ": {prismatic: [cyl" + i +
              ", rod" + i + "], at: B" + i + ", axis: [A" + i + ", B" + i + "], actuated: true}\n  B" + i +
              ": {revolute: [rod" + i + ", plate], at: B" + i + ", clearance: {radial: " + i + "e-5}}\n";
  }
  std::string text = head;
  const auto insert_after = [&text](const std::string& what, const std::string& more) {
    text.insert(text.find(what) + what.size(), more);
  };
  insert_after("b: 0.5", parameters);
  insert_after("  P: [x, y]\n", points);
  insert_after("B3]}\n", links);
  return text + "joints:\n" + joints;
}

std::string names(const Mechanism& mechanism) {
  std::ostringstream text;
  for (const Parameter& one : mechanism.parameters) text << one.name << '=' << to_string(one.expression) << ' ';
  for (const Point& one : mechanism.points) {
    text << one.name;
    if (const auto* form = std::get_if<ExplicitPoint>(&one.form))
      for (const Expression& coordinate : form->coordinates) text << ' ' << to_string(coordinate);
    text << '\n';
  }
  for (const Link& one : mechanism.links) text << one.name << ' ' << one.points.size() << '\n';
  for (const Joint& one : mechanism.joints) {
    text << one.name << ' ' << to_string(one.type) << ' ' << one.from << ' ' << one.to << ' ' << one.at;
    if (one.clearance) text << ' ' << to_string(one.clearance->radial);
    text << '\n';
  }
  return text.str();
}

TEST(Repeat, IsReadAsIfItWereWrittenOut) {
  const Mechanism short_one = parse_mechanism(head + once, "m.yaml");
  EXPECT_EQ(names(short_one), names(parse_mechanism(written_out(), "m.yaml")));
  EXPECT_EQ(short_one.joints.size(), 9U);
}

TEST(Repeat, ValuesOfTheTableAreParameters) {
  const Mechanism mechanism = parse_mechanism(head + once, "m.yaml", {{"a2", "100 deg"}});
  EXPECT_EQ(to_string(mechanism.parameters[3].expression), "100*pi/180");
}

TEST(Repeat, MayBeAListOfBlocks) {
  std::string text = head + once;
  const std::string from = "repeat:\n  i: [1, 2, 3]\n";
  text.replace(text.find(from), from.size(), "repeat:\n- i: [1, 2, 3]\n");
  EXPECT_EQ(names(parse_mechanism(text, "m.yaml")), names(parse_mechanism(head + once, "m.yaml")));
}

struct Mistake {
  const char* from;
  const char* to;
  int line;
  const char* says;
};

TEST(Repeat, ErrorsNameTheLineAndTheValue) {
  const std::vector<Mistake> mistakes = {
      {"at: 'A{i}'}", "at: 'C{i}'}", 22, "there is no point 'C1' (i = 1)"},
      {"cos(a{i})", "cos(c{i})", 18, "'c1' is neither a number nor a parameter nor a coordinate (i = 1)"},
      {"240 deg]", "240 dag]", 16, "unexpected 'dag' in the expression '240 dag' (i = 3)"},
      {"[0 deg, 120 deg, 240 deg]", "[0, 1]", 16, "row a of the table has 2 values, but i has 3"},
      {"i: [1, 2, 3]", "i: [1, 2, 2]", 15, "i of repeat is 2 twice"},
      {"i: [1, 2, 3]", "i: []", 15, "i of repeat has no value"},
      {"i: [1, 2, 3]", "i: [1, 2, '-3']", 15, "'-3' cannot be the end of a name"},
      {"    A{i}: ['b*cos", "    A: ['b*cos", 18, "'A' of repeat would exist once for every i"},
      {"points: ['A{i}']", "points: ['A{j}']", 20, "'A{j}' has a brace that is not that of {i} (i = 1)"},
      {"  joints:\n    A", "  jonts:\n    A", 21, "did you mean 'joints'?"},
      {"['b*cos(a{i})', ", "[b*cos(a{i}), ", 18, "in brackets put quotes round what holds {i}"},
      {"  links: {'cyl{i}': {points: ['A{i}']}, 'rod{i}': {points: ['B{i}']}}", "  links: 3", 20,
       "neither a mapping nor a list"},
      {"  links: {'cyl{i}': {points: ['A{i}']}, 'rod{i}': {points: ['B{i}']}}", "  links: [3]", 20,
       "links of repeat are a list, and links of the file are not"},
  };
  for (const Mistake& mistake : mistakes) {
    std::string text = head + once;
    const std::size_t at = text.find(mistake.from);
    ASSERT_NE(at, std::string::npos) << mistake.from;
    text.replace(at, std::string(mistake.from).size(), mistake.to);
    try {
      parse_mechanism(text, "m.yaml");
      ADD_FAILURE() << "accepted: " << mistake.to;
    } catch (const core::InputError& error) {
      EXPECT_EQ(error.position().file, "m.yaml");
      EXPECT_EQ(error.position().line, mistake.line) << error.what();
      EXPECT_NE(std::string(error.what()).find(mistake.says), std::string::npos) << error.what();
    }
  }
}

TEST(Repeat, DoesNotFillTheMemory) {
  std::string wide = head + "repeat:\n  i: [";
  for (int k = 0; k < 100; ++k) wide += std::to_string(k) + ", ";
  wide += "x]\n  loads: []\n";
  EXPECT_THROW(parse_mechanism(wide, "m.yaml"), core::InputError);
  // Aliases double the text with every line.
  std::string deep = head + "repeat:\n  i: [1, 2]\n  loads:\n    - &a0 [x, x]\n";
  for (int k = 1; k < 60; ++k)
    deep += "    - &a" + std::to_string(k) + " [*a" + std::to_string(k - 1) + ", *a" + std::to_string(k - 1) + "]\n";
  EXPECT_THROW(parse_mechanism(deep, "m.yaml"), core::InputError);
  EXPECT_THROW(parse_mechanism("&a [*a]", "m.yaml"), core::InputError);
}

}  // namespace
}  // namespace clearloci::mechanism
