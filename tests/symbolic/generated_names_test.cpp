// Generated programs are data-safe: whatever a file calls its mechanism, parameters, coordinates, points and joints,
// the C compiles without a warning, the programs run, and their values are those of the numeric witness.
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
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

/// Names of several kinds at once: each model takes a third of a second to derive.
std::vector<Names> cases() {
  return {
      {},
      {.title = R"(x\nimport os; os.system('touch injected')\n#)", .L = "lambda", .d = "int", .r = "log"},
      {.title = R"(*/ int pwned(void){return 42;} /*)", .L = "y0", .d = "M_PI", .r = "M_E", .joint = "1"},
      {.title = R"(*/*/ #error injected /*/**/)", .L = "A", .d = "b", .r = "w", .x = "lambda", .y = "gamma"},
      {.title = R"(x\nsystem('touch injected');\n%)", .L = "DB1", .d = "kB1", .r = "sB1", .x = "b", .y = "A"},
      {.title = R"(trailing \\)", .L = "DB2", .d = "DB2_", .r = "sB2", .x = "signgam", .y = "isnan"},
      {.title = R"(-*- coding: rot13 -*-)", .L = "end", .d = "def", .r = "function", .x = "from", .y = "persistent"},
      {.title = R"(\u2028\u0085\e[31m\0 ??/ ''' \"\"\" %{ #{ \\input{/etc/passwd} ^^M\\end)", .joint = "A"},
      {.L = "i", .d = "j", .r = "e", .x = "sB1", .y = "DB2"},
      {.L = "I", .d = "E", .r = "NAN", .B1 = "end", .B2 = "_"},
      {.L = "linux", .d = "unix", .r = "INFINITY", .B1 = "B_1", .B2 = "B__2"},
      {.L = "_x", .d = "__y", .r = "_Z", .B1 = "eta", .B2 = "1_"},
      {.L = "_", .d = "__", .r = "v_", .joint = "__joint_"},
      {.L = "UNKNOWNS", .d = "newton_euler", .r = "determinant_A"},
      {.L = "lambda_", .d = "lambda", .r = "lambda__"},
      {.L = "printf", .d = "main", .r = "exit"},
      {.L = "True", .d = "None", .r = "determinants"},
      {.L = "pow", .d = "math", .r = "fabs"},
      {.L = "HUGE_VAL", .d = "FP_NAN", .r = "__LINE__"},
      {.L = long_name + "1", .d = long_name + "2", .r = long_name + "_"},
      {.L = "class", .d = "template", .r = "import"},
      {.L = "double", .d = "const", .r = "return"},
      {.L = "D1", .x = "q", .y = "k2", .B1 = "1", .B2 = "2"},
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

constexpr std::array<Language, 5> languages = {Language::text, Language::latex, Language::c, Language::python,
                                               Language::matlab};

/// A model of `cases()` in every language.
struct Written {
  std::string name;  ///< of its files
  std::vector<EquationSheet> sheets;
  std::vector<double> witness;

  const EquationSheet& sheet(Language language) const {
    return sheets.at(
        static_cast<std::size_t>(std::find(languages.begin(), languages.end(), language) - languages.begin()));
  }
};

/// With parameters as numbers and as symbols.
const std::vector<Written>& all_written() {
  static const std::vector<Written> written = [] {
    std::vector<Written> all;
    for (const Names& names : cases()) {
      const mechanism::Mechanism mechanism = mechanism::parse_mechanism(model_text(names), "model.yaml");
      const std::string number = std::to_string(all.size() / 2);
      for (const bool keep : {false, true})
        all.push_back({(keep ? "symbolic_" : "numeric_") + number,
                       equation_sheets(mechanism, {languages.begin(), languages.end()}, keep),
                       witness_values(mechanism, poses)});
    }
    return all;
  }();
  return written;
}

void expect_values(const std::vector<double>& found, const std::vector<double>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_NEAR(found[i], expected[i], 1e-10 * std::max(1.0, std::abs(expected[i]))) << "value " << i;
}

/// Every program lies in one folder, so that one command compiles or runs all of them.
class GeneratedNames : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("clearloci_names_" + std::to_string(::getpid()) + "_" +
                                                        testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override {
    EXPECT_FALSE(std::filesystem::exists(folder_ / "injected"));
    std::filesystem::remove_all(folder_);
  }

  std::string in_folder(const std::string& command) const { return "cd '" + folder_.string() + "' && " + command; }

  void write_programs(Language language, const std::string& ending) const {
    for (const Written& written : written_)
      std::ofstream(folder_ / (written.name + ending)) << format(written.sheet(language));
  }

  /// Runs a Python program that prints, for each name, a line with the name and the values.
  void expect_values_of_python(const std::string& driver) const {
    std::ofstream file(folder_ / "driver.py");
    file << "POSES = [";
    for (const auto& [x, y] : poses) file << "(" << x << ", " << y << "), ";
    file << "]\nNAMES = [";
    for (const Written& written : written_) file << "\"" << written.name << "\", ";
    file << "]\n" << driver;
    file.close();
    ASSERT_EQ(std::system(in_folder("python3 -W error driver.py > printed").c_str()), 0);
    std::ifstream printed(folder_ / "printed");
    std::size_t count = 0;
    for (std::string text; std::getline(printed, text); ++count) {
      std::istringstream line(text);
      std::string name;
      line >> name;
      ASSERT_LT(count, written_.size());
      ASSERT_EQ(name, written_[count].name);
      SCOPED_TRACE(name);
      expect_values({std::istream_iterator<double>(line), {}}, written_[count].witness);
    }
    EXPECT_EQ(count, written_.size());
  }

  const std::vector<Written>& written_ = all_written();
  std::filesystem::path folder_;
};

/// The functions of a compiled program.
class Compiled {
 public:
  explicit Compiled(const std::string& file) : library_(::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL)) {
    EXPECT_NE(library_, nullptr) << ::dlerror();
  }
  Compiled(const Compiled&) = delete;
  Compiled& operator=(const Compiled&) = delete;
  ~Compiled() {
    if (library_ != nullptr) ::dlclose(library_);
  }

  template <class Function>
  Function* function(const std::string& name) const {
    void* const found = library_ == nullptr ? nullptr : ::dlsym(library_, name.c_str());
    EXPECT_NE(found, nullptr) << name;
    return reinterpret_cast<Function*>(found);
  }

 private:
  void* library_;
};

/// As witness_values.
std::vector<double> compiled_values(const Compiled& compiled, const std::vector<std::string>& unknowns) {
  auto* const newton_euler = compiled.function<void(double, double, double*, double*)>("newton_euler");
  std::vector<double (*)(double, double)> determinants = {compiled.function<double(double, double)>("determinant_A")};
  for (const std::string& unknown : unknowns)
    determinants.push_back(compiled.function<double(double, double)>("determinant_" + unknown));
  std::vector<double> values;
  if (testing::Test::HasFailure()) return values;
  const std::size_t n = unknowns.size();
  for (const auto& [x, y] : poses) {
    std::vector<double> equations(n * n + n);
    newton_euler(x, y, equations.data(), equations.data() + n * n);
    values.insert(values.end(), equations.begin(), equations.end());
    for (const auto determinant : determinants) values.push_back(determinant(x, y));
  }
  return values;
}

TEST_F(GeneratedNames, C) {
  write_programs(Language::c, ".c");
  const std::string warnings =
      " -Wall -Wextra -Wpedantic -Wconversion -Wstrict-prototypes -Wmissing-prototypes -Werror ";
  ASSERT_EQ(std::system(in_folder("cc -std=gnu17" + warnings + "-fsyntax-only *.c").c_str()), 0);
  ASSERT_EQ(std::system(in_folder("cc -std=c99" + warnings + "-fPIC -c *.c").c_str()), 0);
  for (const Written& written : written_) {
    SCOPED_TRACE(written.name);
    ASSERT_EQ(std::system(in_folder("cc -shared " + written.name + ".o -o " + written.name + ".so -lm").c_str()), 0);
    const Compiled compiled(folder_ / (written.name + ".so"));
    expect_values(compiled_values(compiled, written.sheet(Language::c).unknowns), written.witness);
  }
}

TEST_F(GeneratedNames, Python) {
  write_programs(Language::python, ".py");
  expect_values_of_python(R"python(
import runpy

for name in NAMES:
    code = runpy.run_path(name + ".py")
    values = []
    for at in POSES:
        A, b = code["newton_euler"](*at)
        values += sum(A, []) + b + [code["determinant_A"](*at)]
        values += [code["determinant_" + unknown](*at) for unknown in code["UNKNOWNS"]]
    print(name, *(repr(float(value)) for value in values))
)python");
}

// Assignments, and matrices of parenthesised entries, are all the MATLAB there is: read here line by line, every name
// held against what MATLAB and Octave allow.
constexpr const char* matlab_reader = R"python(
import math, re, sys
WORDS = set("""break case catch classdef continue else elseif end for function global if otherwise parfor persistent
return spmd switch try while do until endif endfor endwhile endfunction unwind_protect ans""".split())


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


def values_of(lines, head, at):
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
    return values["A"] + values["b"] + values["determinants"]


for case in NAMES:
    with open(case + ".m", encoding="utf-8") as file:
        lines = file.read().split("\n")
    head = re.fullmatch(r"function \[A, b, determinants\] = newton_euler\((\w+), (\w+)\)", lines[0])
    assert head, lines[0]
    assert lines[-2:] == ["end", ""], lines[-2:]
    print(case, *(repr(value) for at in POSES for value in values_of(lines, head, at)))
)python";

TEST_F(GeneratedNames, Matlab) {
  write_programs(Language::matlab, ".m");
  expect_values_of_python(matlab_reader);
}

void expect_latex(const std::string& text) {
  const std::regex subscript_upon_a_subscript(R"(_\{[^{}]*\}_)");
  std::istringstream lines(text);
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
    EXPECT_FALSE(std::regex_search(line, subscript_upon_a_subscript)) << line;
  }
}

TEST_F(GeneratedNames, Latex) {
  for (const Written& written : written_) {
    SCOPED_TRACE(written.name);
    expect_latex(format(written.sheet(Language::latex)));
  }
}

TEST_F(GeneratedNames, TextHasOneMeaningForAName) {
  for (const Written& written : written_) {
    SCOPED_TRACE(written.name);
    const EquationSheet& equations = written.sheet(Language::text);
    std::vector<std::string> defined = equations.coordinates;
    for (const auto& [name, value] : equations.parameters) defined.push_back(name);
    for (const auto& [name, value] : equations.closure) defined.push_back(name);
    std::sort(defined.begin(), defined.end());
    EXPECT_EQ(std::adjacent_find(defined.begin(), defined.end()), defined.end());
    const std::string text = format(equations);
    EXPECT_TRUE(std::none_of(text.begin(), text.end(), [](char c) { return c >= 0 && c < 0x20 && c != '\n'; }));
  }
}

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
