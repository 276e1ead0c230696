// What texts of each kind are made of: mechanism-file.md, task-files.md, and numbers at which
// arithmetic changes its mind.
#include <stdexcept>

#include "tests/fuzz/mutate_text.hpp"

namespace clearloci::fuzz {
namespace {

const std::vector<std::string> numbers = {"0",
                                          "1",
                                          "-1",
                                          "1/2",
                                          "1/3",
                                          "0.25",
                                          "1e-6",
                                          "1e6",
                                          "1e-30",
                                          "1e30",
                                          "1e-300",
                                          "1e300",
                                          "1e-400",
                                          "1e400",
                                          "1e4096",
                                          "1e-4096",
                                          "1.7976931348623157e308",
                                          "4.9e-324",
                                          "9007199254740993",
                                          "18446744073709551616",
                                          "pi",
                                          "2*pi",
                                          "30 deg",
                                          "1e9 deg",
                                          "sqrt(2)",
                                          "sqrt(3)/2",
                                          "sqrt(1/1000003)",
                                          "sqrt(2)^100",
                                          "2^0.5",
                                          "2^(1/3)",
                                          "2^-1000",
                                          "2^1000",
                                          "(1/3)^40",
                                          "0^0",
                                          "1/0",
                                          "0/0",
                                          "sqrt(-1)",
                                          "(-1)^(1/2)",
                                          "cos(1)",
                                          "sin(30 deg)",
                                          "cos(1e30)",
                                          "sin(1e-30)",
                                          "cos(90 deg)",
                                          "1 - 1e-17",
                                          "sqrt(2) - 1.41421356237309504880168872420969807857",
                                          "sqrt(8) - 2*sqrt(2)",
                                          "pi/pi",
                                          "pi^2",
                                          "x",
                                          "L",
                                          "x*y",
                                          "x^2",
                                          "x^3",
                                          "x^-1",
                                          "cos(x)",
                                          "sqrt(x)",
                                          "x/y"};

Vocabulary mechanism_vocabulary() {
  Vocabulary all;
  all.numbers = numbers;
  all.words = {"format",      "name",
               "space",       "planar",
               "spatial",     "parameters",
               "workspace",   "angle",
               "points",      "dyad",
               "lengths",     "side",
               "left",        "right",
               "axis",        "slider",
               "from",        "length",
               "ahead",       "behind",
               "on",          "offset",
               "mean",        "links",
               "mass",        "com",
               "inertia",     "joints",
               "revolute",    "prismatic",
               "universal",   "spherical",
               "cylindrical", "ground",
               "at",          "axes",
               "actuated",    "true",
               "false",       "clearance",
               "radial",      "angular",
               "gap",         "half_length",
               "axial",       "end_effector",
               "link",        "loads",
               "force",       "couple",
               "gravity",     "cross",
               "sqrt",        "cos",
               "sin",         "pi",
               "deg",         "x",
               "y",           "z",
               "drawn",       "of",
               "within",      "stroke",
               "turn",        "by",
               "crossing",    "foot",
               "P",           "A",
               "B",           "L",
               "theta"};
  all.groups = {"[0, 0]",
                "[1, 0]",
                "[0, 1]",
                "[0, 0, 1]",
                "[x, y]",
                "[x, y, 0]",
                "[A, B]",
                "[ground, A]",
                "[]",
                "{}",
                "{angle: [0, 360 deg]}",
                "{angle: [-pi, pi]}",
                "{angle: [0, 1e-3]}",
                "[-1e-9, 1e-9]",
                "[0, 1e9]",
                "{dyad: [A1, P], lengths: [L, L], side: left}",
                "{slider: [A1, [1, 0]], from: P, length: L, side: ahead}",
                "{on: [A1, P], offset: [1, 0]}",
                "{mean: [A1, P]}",
                "{from: A1, by: [1, 0]}",
                "{from: A1, by: 2*(P - A1)}",
                "{crossing: [[A1, [1, 0]], [P, [0, 1]]]}",
                "{foot: [A1, P], length: L, side: left}",
                "{angle: [0, 360 deg], of: AB}",
                "{place: x, of: P, within: [-1, 1]}",
                "{stroke: [0, 1], of: S1}",
                "{turn: zyx.1, of: plate, within: [-1, 1]}",
                "{radial: 1e-5, angular: 1e-3}",
                "{gap: 1e-5, half_length: 0.1, axial: 1e-5}",
                "{points: [A1, P], mass: 1, com: P, inertia: 1}",
                "{dyad: [A1, P], lengths: [L, L], axis: [0, 0, 1], side: left}",
                "(cross([1, 0, 0], P - A1))"};
  all.lines = {"  x: [-1, 1]",
               "  z: {angle: [0, 360 deg]}",
               "space: spatial",
               "space: planar",
               "gravity: [0, -9.81]",
               "gravity: [0, 0, -9.81]",
               "  Z: {mean: [A1, P]}",
               "  Z: {on: [A1, P], offset: [0.1, 0.2]}",
               "  L: 0.5",
               "  Z: [x, y]",
               "  Z: {prismatic: [ground, A1], at: A1, axis: [1, 0], actuated: true}",
               "parameters:",
               "  - {link: P, at: P, force: [0, -1]}",
               "  - {link: P, couple: 1}",
               "  &a Z: *a",
               "  <<: {L: 1}",
               "  Z: !!binary aGVsbG8=",
               "? [a, b]",
               "  Z: |",
               "---",
               "..."};
  return all;
}

Vocabulary task_vocabulary() {
  Vocabulary all;
  all.numbers = numbers;
  all.words = {"format", "name",      "box",        "circle",     "centre", "radius", "polygon", "path",
               "margin", "min_force", "min_couple", "loads_from", "x",      "y",      "L",       "d"};
  all.groups = {"[0, 0]",
                "[0, -0.8]",
                "[[0, 0], [1, 0], [0, 1]]",
                "{x: [0, 0.1], y: [-0.8, -0.7]}",
                "[]",
                "{}",
                "{centre: [0.2, -0.7], radius: 0.1}",
                "[[0, -0.8], [0.1, -0.8], [0.1, -0.7], [0, -0.7]]",
                "[[0, -1], [1, 0]]",
                "[[0, -1], [0, 1]]"};
  all.lines = {"box: {x: [0.1, 0.2], y: [-0.8, -0.7]}",
               "circle: {centre: [0.2, -0.7], radius: 0.05}",
               "polygon: [[0, -0.8], [0.2, -0.8], [0.1, -0.7]]",
               "path: [[0, -0.8], [0.2, -0.8]]",
               "margin: 0.01",
               "min_force: 5",
               "min_couple: 1/2",
               "loads_from: [[-20, -100], [20, -100]]",
               "---"};
  return all;
}

Vocabulary trajectory_vocabulary() {
  Vocabulary all;
  all.numbers = numbers;
  all.words = {"format", "name",        "path",    "closed",       "true",     "false",  "waypoints", "points",
               "at",     "corner",      "stop",    "dwell",        "duration", "motion", "law",       "cycloidal",
               "3-4-5",  "trapezoidal", "s-curve", "accelerating", "jerking",  "period", "payload",   "link",
               "mass",   "inertia",     "picked",  "placed",       "pick",     "place"};
  all.groups = {"[0, -0.8]",
                "{at: [0.1, -0.8], corner: 0.01}",
                "{name: pick, at: [0, -0.82], stop: true}",
                "[]",
                "{}",
                "{at: [0.1, -0.8], stop: true, dwell: 1/4, duration: 1/4}",
                "[[0, -0.8], [0.5, -0.8]]",
                "{law: s-curve, accelerating: 2/5, jerking: 1/4}",
                "{law: trapezoidal, accelerating: 1/3}"};
  all.lines = {"    - {at: [0.2, -0.8], corner: 0.01}",
               "    - {name: place, at: [0.3, -0.8], stop: true}",
               "    - [0.2, -0.7]",
               "  closed: true",
               "  points: [[0, -0.8], [0.5, -0.8], [0.2, -0.7]]",
               "period: 1",
               "motion: 3-4-5",
               "motion: {law: s-curve, jerking: 1/2}",
               "  - {link: PB2, at: P, mass: 1, inertia: 0.1, picked: pick, placed: place}"};
  return all;
}

Vocabulary expression_vocabulary() {
  Vocabulary all;
  all.numbers = numbers;
  all.words = {"sqrt", "cos", "sin", "pi", "deg", "L", "a", "q", "x", "e1", "e-9"};
  all.groups = {"(L)", "(a + 1)", "(1/3)", "(-2)", "(sqrt(3))", "(cos(a))", "(2^L)", "(q - sqrt(2))"};
  all.lines = {" + 1", " - L", "*(2 - q)", "/(a - 30 deg)", "^(1/2)", "^-2", " deg"};
  return all;
}

Vocabulary arguments_vocabulary() {
  Vocabulary all;
  all.numbers = numbers;
  all.words = {"L", "d", "A1", "B1", "P",  "left", "right",     "ahead", "behind",   "all", "f",
               "N", "T", "M",  "F",  "fx", "mz",   "automatic", "exact", "adaptive", "inf", "nan"};
  all.groups = {"[0, 0]", "(1/2)", "{}"};
  all.lines = {
      "--set",       "--at",        "--grid",      "--steps",        "--joint",      "--quantity", "--working-mode",
      "--tolerance", "--mesh-size", "--min-force", "--min-couple",   "--time-limit", "--engine",   "-o",
      "--quiet",     "--json",      "--set=L=1/2", "--at=0.25,-0.7", "L=0.4",        "0.25,-0.7",  "400x400",
      "720",         "f,M",         "left,right",  "1e-5",           "--help",       "--",         "-",
      "--=",         "-o=",         "--at="};
  return all;
}

Vocabulary server_vocabulary() {
  Vocabulary all;
  all.numbers = {"0", "1", "-1", "2", "5242881", "4294967296", "18446744073709551616", "1e300"};
  all.words = {"GET",   "POST",     "HEAD", "api",   "loci",      "model",
               "start", "progress", "text", "files", "min_force", "quiet"};
  all.groups = {"{}", "[]", "\"\"", "[[[[]]]]"};
  all.lines = {"Host: 127.0.0.1:@PORT@\r",
               "Origin: http://127.0.0.1:@PORT@\r",
               "Content-Type: application/json\r",
               "Content-Length: 5\r",
               "Transfer-Encoding: chunked\r",
               "Content-Encoding: gzip\r",
               "Range: bytes=0-20000\r",
               "Expect: 100-continue\r",
               "Connection: close\r",
               " folded\r",
               "\r",
               "GET /@TOKEN@/ HTTP/1.1\r",
               "POST /@TOKEN@/api/model HTTP/1.1\r"};
  return all;
}

Vocabulary certificate_vocabulary() {
  Vocabulary all;
  all.numbers = {"0",
                 "1",
                 "-1",
                 "2",
                 "17",
                 "1e5",
                 "1e308",
                 "1e400",
                 "-0.0",
                 "4294967296",
                 "9223372036854775808",
                 "1/0",
                 "1/3",
                 "0x1p-1",
                 "0x1p+2000",
                 "-0x1.8p+0",
                 "0.5",
                 "null",
                 "true",
                 "\"\"",
                 "[]",
                 "{}"};
  all.words = {"format",      "version",
               "command",     "model",
               "text",        "set",
               "coordinates", "box",
               "tolerance",   "joints",
               "quantities",  "roots",
               "point",       "role",
               "length",      "square",
               "functions",   "name",
               "program",     "modes",
               "sheets",      "mode",
               "function",    "at_zero",
               "domain",      "cells",
               "open",        "curves",
               "kind",        "vanishing",
               "certified",   "arcs",
               "closed",      "ends",
               "points",      "zones",
               "id",          "assembly_mode",
               "signs",       "area",
               "outer",       "holes",
               "sample",      "reaction",
               "margin",      "construction",
               "true",        "false",
               "null",        "f",
               "M",           "fx",
               "v0",          "v1",
               "c1",          "i0",
               "g0",          "x"};
  all.groups = {"[]", "{}", "[0, 0]", "[[0, 0], [1, 1]]", "[\"0\", \"1\"]", "[1, -1]", "[[\"A1\", \"f\"]]"};
  all.lines = {"\"open\": [{\"mode\": 0, \"function\": 0}],",
               "\"zones\": [],",
               "\"modes\": [[1]],",
               "\"cells\": \"x:0x1p-1 . g0:2\",",
               "\"program\": \"v0 v1 +0,1 c1/2 *2,3 i4\",",
               "\"box\": [],"};
  return all;
}

/// Of docs/guide/import.md.
Vocabulary import_vocabulary() {
  Vocabulary all;
  all.numbers = numbers;
  all.words = {"connector",   "Link",       "slider",      "slidelimit", "anchor",    "input",   "actuator", "throw",
               "cpm",         "fastenlink", "true",        "false",      "body",      "joint",   "hinge",    "slide",
               "ball",        "pos",        "axis",        "equality",   "connect",   "weld",    "site1",    "anchor",
               "keyframe",    "qpos",       "inertial",    "robot",      "link",      "parent",  "child",    "revolute",
               "continuous",  "prismatic",  "fixed",       "origin",     "xyz",       "rpy",     "limit",    "pose",
               "relative_to", "frame",      "attached_to", "world",      "universal", "SECTION", "ENTITIES", "LINE",
               "CIRCLE",      "ground",     "M[",          "J[",         "P[",        "L[",      "A[",       "RP",
               "[LINKS]",     "[JOINTS]",   "[CONSTANTS]", "SPHERICAL",  "SPH_SPH",   "range",   "length"};
  all.groups = {"()", "[]", "<>", "</>", "(0,0,0)", "(0,0,0)+(0,1,0)", "P[0, 0]", "L[ground, L1]", "\"\"", ".."};
  all.lines = {"<connector id=\"1\" x=\"0\" y=\"0\"/>",
               "<Link id=\"1\"><connector id=\"0\"/></Link>",
               "<joint axis=\"1 0 0\"/>",
               "<link name=\"base\"/>",
               "J[R, P[0, 0], L[ground, L1]],",
               "REVOLUTE: a (0,0,0)+(0,1,0) b (0,0,0)+(0,1,0)",
               "0",
               "ENDSEC"};
  return all;
}

}  // namespace

const Vocabulary& vocabulary_of(const std::string& target) {
  static const Vocabulary mechanism = mechanism_vocabulary(), task = task_vocabulary(),
                          trajectory = trajectory_vocabulary(), expression = expression_vocabulary(),
                          arguments = arguments_vocabulary(), certificate = certificate_vocabulary(),
                          server = server_vocabulary(), imported = import_vocabulary();
  if (target == "mechanism") return mechanism;
  if (target == "import") return imported;
  if (target == "task") return task;
  if (target == "trajectory") return trajectory;
  if (target == "expression") return expression;
  if (target == "arguments") return arguments;
  if (target == "certificate") return certificate;
  if (target == "server") return server;
  throw std::logic_error("no vocabulary for " + target);
}

}  // namespace clearloci::fuzz
