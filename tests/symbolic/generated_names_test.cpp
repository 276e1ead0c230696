// Generated programs are data-safe: whatever a file calls its mechanism, parameters, coordinates, points and joints,
// the C compiles without a warning, the programs run, and their values are those of the numeric witness.
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include "mechanism/mechanism.hpp"
#include "mechanism/read.hpp"
#include "numeric/reactions.hpp"
#include "symbolic/equation_sheet.hpp"
#include "tests/source_dir.hpp"

namespace clearloci::symbolic {
namespace {

/// What stands in for the placeholders of the model.
struct Names {
  std::string title = "Planar 5R";
  std::string L = "L", d = "d", r = "r", x = "x", y = "y";
  std::string B1 = "B1", B2 = "B2", joint = "A1";
};

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += with.size())
    text.replace(at, what.size(), with);
  return text;
}

/// A 5R whose base has a root, pi, a quotient and a power in it, so that symbolic programs hold all of them.
std::string model_text(const Names& names) {
  std::string text = R"yaml(format: 1
name: "@title@"
parameters: {@L@: 0.5, @d@: @L@ + 1/100, @r@: "sqrt(3)/(@L@ + 3)"}
workspace: {@x@: [-0.5, 1.0], @y@: [-1.0, 1.0]}
points:
  A1: [0, 0]
  A2: ["@d@ + 1/(@L@ + 20)", "@r@^(2 + @L@) + @r@*cos(1 + @d@)/20 + pi/50 + sqrt(1/300)"]
  P: [@x@, @y@]
  @B1@: {dyad: [A1, P], lengths: [@L@, @L@], side: right}
  @B2@: {dyad: [A2, P], lengths: [@L@, @d@], side: left}
links:
  l1: {points: [A1, @B1@], mass: 1}
  l2: {points: [@B1@, P], mass: 1}
  l3: {points: [P, @B2@], mass: 1}
  l4: {points: [@B2@, A2], mass: 1}
joints:
  @joint@: {revolute: [ground, l1], at: A1, actuated: true}
  j2: {revolute: [l1, l2], at: @B1@}
  j3: {revolute: [l2, l3], at: P}
  j4: {revolute: [l4, l3], at: @B2@}
  j5: {revolute: [ground, l4], at: A2, actuated: true}
end_effector: {link: l3, at: P}
loads: [{link: l3, at: P, force: [30, -100]}]
)yaml";
  text = replaced(text, "@title@", names.title);
  text = replaced(text, "@L@", names.L);
  text = replaced(text, "@d@", names.d);
  text = replaced(text, "@r@", names.r);
  text = replaced(text, "@x@", names.x);
  text = replaced(text, "@y@", names.y);
  text = replaced(text, "@B1@", names.B1);
  text = replaced(text, "@B2@", names.B2);
  return replaced(text, "@joint@", names.joint);
}

const std::string long_name(63, 'q');

std::vector<Names> cases() {
  return {
      {},
      {.title = R"(x\nimport os; os.system('touch injected')\n#)"},
      {.title = R"(*/ int pwned(void){return 42;} /*)"},
      {.title = R"(*/*/ #error injected /*/**/)"},
      {.title = R"(x\nsystem('touch injected');\n%)"},
      {.title = R"(trailing \\)"},
      {.title = R"(-*- coding: rot13 -*-)"},
      {.title = R"(\u2028\u0085\e[31m\0 ??/ ''' \"\"\" %{ #{ \\input{/etc/passwd} ^^M\\end)"},
      {.L = "lambda", .d = "int", .r = "log"},
      {.L = "y0", .d = "M_PI", .r = "M_E"},
      {.L = "A", .d = "b", .r = "w"},
      {.L = "DB1", .d = "kB1", .r = "sB1"},
      {.L = "DB2", .d = "DB2_", .r = "sB2"},
      {.L = "end", .d = "def", .r = "function"},
      {.L = "i", .d = "j", .r = "e"},
      {.L = "I", .d = "E", .r = "NAN"},
      {.L = "linux", .d = "unix", .r = "INFINITY"},
      {.L = "_x", .d = "__y", .r = "_Z"},
      {.L = "_", .d = "__", .r = "v_"},
      {.L = "UNKNOWNS", .d = "newton_euler", .r = "determinant_A"},
      {.L = "lambda_", .d = "lambda", .r = "lambda__"},
      {.L = "printf", .d = "main", .r = "exit"},
      {.L = "True", .d = "None", .r = "determinants"},
      {.L = "pow", .d = "math", .r = "fabs"},
      {.L = "HUGE_VAL", .d = "FP_NAN", .r = "__LINE__"},
      {.L = long_name + "1", .d = long_name + "2", .r = long_name + "_"},
      {.L = "class", .d = "template", .r = "import"},
      {.L = "double", .d = "const", .r = "return"},
      {.x = "lambda", .y = "gamma"},
      {.x = "b", .y = "A"},
      {.x = "sB1", .y = "DB2"},
      {.x = "signgam", .y = "isnan"},
      {.x = "from", .y = "persistent"},
      {.L = "D1", .x = "q", .y = "k2", .B1 = "1", .B2 = "2"},
      {.B1 = "end", .B2 = "_"},
      {.B1 = "B_1", .B2 = "B__2"},
      {.B1 = "eta", .B2 = "1_"},
      {.joint = "1"},
      {.joint = "A"},
      {.joint = "__joint_"},
  };
}

/// A, b, |A| and the numerators at a few poses, row by row: by the witness.
std::vector<double> witness_values(const mechanism::Mechanism& mechanism,
                                   const std::vector<std::array<double, 2>>& poses) {
  const numeric::NumericModel model = numeric::compile(mechanism);
  std::vector<double> values;
  for (const auto& pose : poses) {
    const numeric::Posture posture =
        numeric::posture(model, std::vector<double>(pose.begin(), pose.end()), mechanism::working_mode(mechanism));
    EXPECT_FALSE(posture.unreachable.has_value());
    const Eigen::MatrixXd A = numeric::newton_euler_matrix(model, posture);
    const Eigen::VectorXd b = numeric::load_column(model, posture);
    for (Eigen::Index i = 0; i < A.rows(); ++i)
      for (Eigen::Index j = 0; j < A.cols(); ++j) values.push_back(A(i, j));
    for (Eigen::Index i = 0; i < b.size(); ++i) values.push_back(b(i));
    values.push_back(A.determinant());
    for (Eigen::Index j = 0; j < A.cols(); ++j) {
      Eigen::MatrixXd replaced_column = A;
      replaced_column.col(j) = b;
      values.push_back(replaced_column.determinant());
    }
  }
  return values;
}

const std::vector<std::array<double, 2>> poses = {{0.3, -0.6}, {0.3, 0.6}, {0.1, -0.55}};

/// The numbers that a command prints; empty where it fails.
std::vector<double> numbers_of(const std::string& command) {
  std::FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return {};
  std::vector<double> values;
  for (double value = 0; std::fscanf(pipe, "%lf", &value) == 1;) values.push_back(value);
  return ::pclose(pipe) == 0 ? values : std::vector<double>{};
}

void expect_values(const std::vector<double>& found, const std::vector<double>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_NEAR(found[i], expected[i], 1e-10 * std::max(1.0, std::abs(expected[i]))) << "value " << i;
}

class GeneratedNames : public testing::TestWithParam<std::tuple<std::size_t, bool>> {
 protected:
  void SetUp() override {
    const auto [index, keep] = GetParam();
    keep_ = keep;
    mechanism_ = mechanism::parse_mechanism(model_text(cases()[index]), "model.yaml");
    folder_ = std::filesystem::temp_directory_path() /
              ("clearloci_names_" + std::to_string(::getpid()) + "_" + std::to_string(index) + (keep ? "_kept" : "") +
               "_" + testing::UnitTest::GetInstance()->current_test_info()->name()[0]);
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override {
    EXPECT_FALSE(std::filesystem::exists(folder_ / "injected"));
    std::filesystem::remove_all(folder_);
  }

  EquationSheet sheet(Language language) const { return equation_sheet(mechanism_, {language, keep_}); }
  std::string in_folder(const std::string& command) const { return "cd '" + folder_.string() + "' && " + command; }

  bool keep_ = false;
  mechanism::Mechanism mechanism_;
  std::filesystem::path folder_;
};

TEST_P(GeneratedNames, C) {
  const EquationSheet equations = sheet(Language::c);
  std::ofstream(folder_ / "equations.c") << format(equations);
  const std::string n = std::to_string(equations.unknowns.size());
  std::ofstream driver(folder_ / "driver.c");
  driver << "#include <stdio.h>\nvoid newton_euler(double, double, double[" << n << "][" << n << "], double[" << n
         << "]);\ndouble determinant_A(double, double);\n";
  for (const std::string& unknown : equations.unknowns)
    driver << "double determinant_" << unknown << "(double, double);\n";
  driver << "int main(void) {\n  double A[" << n << "][" << n << "], b[" << n << "];\n";
  for (const auto& [x, y] : poses) {
    const std::string at = std::to_string(x) + ", " + std::to_string(y);
    driver << "  newton_euler(" << at << ", A, b);\n  for (int i = 0; i < " << n << "; ++i)\n    for (int j = 0; j < "
           << n << "; ++j) printf(\"%.17g\\n\", A[i][j]);\n  for (int i = 0; i < " << n
           << "; ++i) printf(\"%.17g\\n\", b[i]);\n  printf(\"%.17g\\n\", determinant_A(" << at << "));\n";
    for (const std::string& unknown : equations.unknowns)
      driver << "  printf(\"%.17g\\n\", determinant_" << unknown << "(" << at << "));\n";
  }
  driver << "  return 0;\n}\n";
  driver.close();
  const std::string warnings =
      " -Wall -Wextra -Wpedantic -Wconversion -Wstrict-prototypes -Wmissing-prototypes -Werror ";
  for (const char* standard : {"c99", "gnu17"})
    ASSERT_EQ(std::system(in_folder("cc -std=" + std::string(standard) + warnings + "-c equations.c").c_str()), 0)
        << standard;
  ASSERT_EQ(std::system(in_folder("cc -std=c99 driver.c equations.o -o run -lm").c_str()), 0);
  expect_values(numbers_of(in_folder("./run")), witness_values(mechanism_, poses));
}

std::string python_poses() {
  std::ostringstream text;
  for (const auto& [x, y] : poses) text << "(" << x << ", " << y << "), ";
  return "[" + text.str() + "]";
}

TEST_P(GeneratedNames, Python) {
  std::ofstream(folder_ / "equations.py") << format(sheet(Language::python));
  std::ofstream(folder_ / "driver.py") << "import runpy\ncode = runpy.run_path('equations.py')\nfor at in "
                                       << python_poses() << R"python(:
    A, b = code["newton_euler"](*at)
    for value in sum(A, []) + b + [code["determinant_A"](*at)]:
        print(repr(float(value)))
    for unknown in code["UNKNOWNS"]:
        print(repr(float(code["determinant_" + unknown](*at))))
)python";
  expect_values(numbers_of(in_folder("python3 -W error driver.py")), witness_values(mechanism_, poses));
}

// Assignments, and matrices of parenthesised entries, are all the MATLAB there is: read here line by line, every name
// held against what MATLAB and Octave allow.
constexpr const char* matlab_reader = R"python(
import math, re, sys
WORDS = set("""break case catch classdef continue else elseif end for function global if otherwise parfor persistent
return spmd switch try while do until endif endfor endwhile endfunction unwind_protect ans""".split())
lines = open("newton_euler.m", encoding="utf-8").read().split("\n")
head = re.fullmatch(r"function \[A, b, determinants\] = newton_euler\((\w+), (\w+)\)", lines[0])
assert head, lines[0]
assert lines[-2:] == ["end", ""], lines[-2:]


def evaluate(text, known):
    for name in re.findall(r"(?<![\w.])[A-Za-z_]\w*", text):
        assert re.fullmatch(r"[A-Za-z]\w{0,62}", name) and name not in WORDS, name
        assert name in known, (name, text)
    # Python's own words are none of MATLAB's: every name gets a letter before it.
    text = re.sub(r"(?<![\w.])([A-Za-z_]\w*)", r"v\1", text).replace("^", "**")
    return eval(text, {"__builtins__": {}}, {"v" + name: value for name, value in known.items()})


def entries(row, known):
    result, depth, start = [], 0, 0
    for i, c in enumerate(row):
        depth += (c == "(") - (c == ")")
        if c == "(" and depth == 1:
            start = i
        if c == ")" and depth == 0:
            result.append(float(evaluate(row[start:i + 1], known)))
        assert depth > 0 or c in "(), ;", row
    assert depth == 0, row
    return result


for at in POSES:
    known = {"sqrt": math.sqrt, "cos": math.cos, "sin": math.sin, "pi": math.pi}
    known.update(zip(head.groups(), at))
    matrix, values = None, {}
    for line in lines[1:-2]:
        if line.startswith("%"):
            continue
        if matrix is not None:
            if line == "];":
                matrix = None
            else:
                values[matrix] += entries(line, known)
            continue
        name, _, right = line.partition(" = ")
        assert re.fullmatch(r"[A-Za-z]\w{0,62}", name) and name not in WORDS, line
        if right == "[":
            matrix, values[name] = name, []
        elif right.startswith("["):
            assert right.endswith("];"), line
            values[name] = entries(right[1:-2], known)
        else:
            assert name not in known and right.endswith(";"), line
            known[name] = evaluate(right[:-1], known)
    for name in ("A", "b", "determinants"):
        for value in values[name]:
            print(repr(value))
)python";

TEST_P(GeneratedNames, Matlab) {
  std::ofstream(folder_ / "newton_euler.m") << format(sheet(Language::matlab));
  std::ofstream(folder_ / "driver.py") << "POSES = " << python_poses() << matlab_reader;
  expect_values(numbers_of(in_folder("python3 driver.py")), witness_values(mechanism_, poses));
}

TEST_P(GeneratedNames, Latex) {
  std::istringstream lines(format(sheet(Language::latex)));
  for (std::string line; std::getline(lines, line);) {
    const bool has_control = std::any_of(line.begin(), line.end(), [](char c) { return c >= 0 && c < 0x20; });
    EXPECT_FALSE(has_control) << line;
    if (line.starts_with("%")) continue;
    line = line.substr(0, line.find(" % "));
    EXPECT_EQ(line.find('%'), std::string::npos) << line;
    EXPECT_EQ(line.find("input"), std::string::npos) << line;
    int depth = 0;
    for (std::size_t i = 0; i < line.size(); ++i) {
      depth += line[i] == '{' ? 1 : line[i] == '}' ? -1 : 0;
      EXPECT_GE(depth, 0) << line;
      if (line[i] == '_' && (i == 0 || line[i - 1] != '\\')) {
        EXPECT_EQ(line.substr(i + 1, 1), "{") << line;
      }
    }
    EXPECT_EQ(depth, 0) << line;
    // No subscript upon a subscript.
    EXPECT_FALSE(std::regex_search(line, std::regex(R"(_\{[^{}]*\}_)"))) << line;
  }
}

TEST_P(GeneratedNames, TextHasOneMeaningForAName) {
  const EquationSheet equations = sheet(Language::text);
  std::vector<std::string> defined = equations.coordinates;
  for (const auto& [name, value] : equations.parameters) defined.push_back(name);
  for (const auto& [name, value] : equations.closure) defined.push_back(name);
  std::sort(defined.begin(), defined.end());
  EXPECT_EQ(std::adjacent_find(defined.begin(), defined.end()), defined.end());
  const std::string text = format(equations);
  EXPECT_TRUE(std::none_of(text.begin(), text.end(), [](char c) { return c >= 0 && c < 0x20 && c != '\n'; }));
}

INSTANTIATE_TEST_SUITE_P(Cases, GeneratedNames,
                         testing::Combine(testing::Range(std::size_t{0}, cases().size()), testing::Bool()),
                         [](const auto& test) {
                           return std::to_string(std::get<0>(test.param)) +
                                  (std::get<1>(test.param) ? "_symbolic" : "_numeric");
                         });

TEST(GeneratedNamesOfExamples, CompileAndHaveTheirComments) {
  const std::string source = source_dir() + "/tests/corpus/input/";
  const auto written = [&](const std::string& name, Language language) {
    return format(equation_sheet(mechanism::read_mechanism(source + name), {language, true}));
  };
  EXPECT_NE(written("05-derived-name-collision.yaml", Language::c).find("/* derived DB1 is written DB1_ */"),
            std::string::npos);
  EXPECT_NE(written("46-parameter-named-lambda.yaml", Language::python).find("# lambda is written lambda_\n"),
            std::string::npos);
  EXPECT_EQ(written("46-parameter-named-lambda.yaml", Language::matlab).find("lambda_"), std::string::npos);
}

TEST(GeneratedNamesOfExamples, SymbolicThreeRprDeclaresPi) {
  const auto mechanism = mechanism::read_mechanism(source_dir() + "/examples/three_rpr.yaml");
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("clearloci_pi_" + std::to_string(::getpid()) + ".c");
  std::ofstream(file) << format(equation_sheet(mechanism, {Language::c, true}));
  const std::string flags = "cc -std=c99 -Wall -Wextra -Wpedantic -Wconversion -Werror -fsyntax-only ";
  EXPECT_EQ(std::system((flags + file.string()).c_str()), 0);
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace clearloci::symbolic
