// The Python and C that `equations` prints must run and agree with themselves: its determinants are those of its own
// matrix, column replaced or not.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "mechanism/read.hpp"
#include "symbolic/equation_sheet.hpp"
#include "tests/source_dir.hpp"

namespace clearloci::symbolic {
namespace {

std::filesystem::path scratch(const std::string& name) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / ("clearloci_generated_" + name);
  std::filesystem::create_directories(folder);
  return folder;
}

std::string program(const std::string& example, Language language, bool keep) {
  const auto mechanism = mechanism::read_mechanism(source_dir() + "/examples/" + example + ".yaml");
  return format(equation_sheet(mechanism, {language, keep}));
}

constexpr const char* python_check = R"(
from fractions import Fraction


def det(m):
    m = [row[:] for row in m]
    n, result = len(m), 1.0
    for k in range(n):
        p = max(range(k, n), key=lambda i: abs(m[i][k]))
        if m[p][k] == 0:
            return 0.0
        if p != k:
            m[p], m[k] = m[k], m[p]
            result = -result
        result *= m[k][k]
        for i in range(k + 1, n):
            q = m[i][k] / m[k][k]
            for j in range(k, n):
                m[i][j] -= q * m[k][j]
    return result


checked = 0
for at in POSES:
    A, b = newton_euler(*at)
    assert abs(det(A) - determinant_A(*at)) < 1e-9, (det(A), determinant_A(*at))
    for k, name in enumerate(UNKNOWNS):
        replaced = [row[:k] + [b[i]] + row[k + 1:] for i, row in enumerate(A)]
        expected = globals()["determinant_" + name](*at)
        assert abs(det(replaced) - expected) < 1e-9 * max(1, abs(expected)), (name, at, det(replaced), expected)
        checked += 1
assert checked > 0
)";

constexpr const char* c_check = R"(
#include <stdio.h>

#define N (int)(sizeof b / sizeof b[0])

static double det(int n, double m[n][n]) {
  double result = 1;
  for (int k = 0; k < n; ++k) {
    int p = k;
    for (int i = k; i < n; ++i)
      if (fabs(m[i][k]) > fabs(m[p][k])) p = i;
    if (m[p][k] == 0) return 0;
    for (int j = 0; j < n && p != k; ++j) {
      const double kept = m[k][j];
      m[k][j] = m[p][j];
      m[p][j] = kept;
    }
    result *= p == k ? m[k][k] : -m[k][k];
    for (int i = k + 1; i < n; ++i) {
      const double q = m[i][k] / m[k][k];
      for (int j = k; j < n; ++j) m[i][j] -= q * m[k][j];
    }
  }
  return result;
}

int main(void) {
  const double poses[3][2] = {{0.25, -0.7}, {0.3, 0.6}, {0.1, -0.55}};
  double A[UNKNOWNS][UNKNOWNS], b[UNKNOWNS];
  int seen = 0;
  for (int i = 0; i < 3; ++i) {
    newton_euler(poses[i][0], poses[i][1], A, b);
    const double expected = determinant_A(poses[i][0], poses[i][1]);
    const double found = det(N, A);
    if (fabs(found - expected) > 1e-9 || !(fabs(expected) > 1e-9)) {
      printf("%g %g: %g is not %g\n", poses[i][0], poses[i][1], found, expected);
      return 1;
    }
    ++seen;
  }
  return seen != 3;
}
)";

class GeneratedCode : public testing::TestWithParam<std::tuple<std::string, bool>> {};

TEST_P(GeneratedCode, PythonDeterminantsAreThoseOfItsMatrix) {
  const auto& [example, keep] = GetParam();
  const std::filesystem::path file = scratch(example + (keep ? "_kept" : "")) / "equations.py";
  std::ofstream(file) << program(example, Language::python, keep)
                      << "\nPOSES = [(0.25, -0.7), (0.3, 0.6), (0.1, -0.55)]\n"
                      << python_check;
  EXPECT_EQ(std::system(("python3 " + file.string()).c_str()), 0);
}

TEST_P(GeneratedCode, CCompilesWithoutAWarningAndItsDeterminantIsThatOfItsMatrix) {
  const auto& [example, keep] = GetParam();
  const std::filesystem::path file = scratch(example + (keep ? "_kept" : "")) / "equations.c";
  const std::string source = program(example, Language::c, keep);
  const std::size_t unknowns = source.find("double b[") + 9;
  std::ofstream(file) << source << "\n#define UNKNOWNS "
                      << source.substr(unknowns, source.find(']', unknowns) - unknowns) << c_check;
  const std::string program = file.string() + ".out";
  EXPECT_EQ(std::system(("cc -std=c99 -Wall -Werror -Wno-unused-variable -Wno-unused-const-variable " + file.string() +
                         " -o " + program + " -lm")
                            .c_str()),
            0);
  EXPECT_EQ(std::system(program.c_str()), 0);
}

/// Factors have integer coefficients of hundreds of digits there, and constants as small.
TEST(GeneratedNumbers, AreDoublesWhereCoefficientsAreNone) {
  const std::filesystem::path file = scratch("hexapod") / "equations.py";
  std::ofstream(file)
      << program("hexapod", Language::python, false) << "\nPOSES = [(0.02, 0.03), (-0.03, 0.01)]\n"
      << python_check
      << "\nassert all(abs(det(newton_euler(*at)[0]) / determinant_A(*at) - 1) < 1e-6 for at in POSES)\n";
  EXPECT_EQ(std::system(("python3 " + file.string()).c_str()), 0);
}

INSTANTIATE_TEST_SUITE_P(Examples, GeneratedCode,
                         testing::Combine(testing::Values("five_bar", "five_bar_generic", "five_bar_weights"),
                                          testing::Bool()),
                         [](const auto& test) {
                           return std::get<0>(test.param) + (std::get<1>(test.param) ? "_symbolic" : "_numeric");
                         });

}  // namespace
}  // namespace clearloci::symbolic
