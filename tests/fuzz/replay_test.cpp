// Every seed and every input that a fuzzer ever broke a target with, without a fuzzer; and a share of mutations of
// them.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/fuzz/mutate_text.hpp"
#include "tests/fuzz/property.hpp"
#include "tests/fuzz/targets.hpp"
#include "tests/source_dir.hpp"

namespace clearloci::fuzz {
namespace {

const std::filesystem::path root = source_dir();

struct Target {
  const char* name;
  void (*run)(std::string_view bytes);
  std::vector<const char*> seeds;  ///< folders beside tests/fuzz/seeds/NAME and tests/corpus/fuzz/NAME
};

void PrintTo(const Target& target, std::ostream* out) { *out << target.name; }

std::vector<std::filesystem::path> files_of(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  if (!std::filesystem::exists(folder)) return files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::filesystem::path> inputs_of(const Target& target) {
  std::vector<std::filesystem::path> all;
  std::vector<std::filesystem::path> folders = {root / "tests/fuzz/seeds" / target.name,
                                                root / "tests/corpus/fuzz" / target.name};
  for (const char* folder : target.seeds) folders.push_back(root / folder);
  for (const std::filesystem::path& folder : folders)
    for (const std::filesystem::path& file : files_of(folder)) all.push_back(file);
  return all;
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

class Fuzz : public testing::TestWithParam<Target> {};

TEST_P(Fuzz, SeedsAndFormerCrashesKeepTheProperty) {
  const std::vector<std::filesystem::path> inputs = inputs_of(GetParam());
  EXPECT_FALSE(inputs.empty());
  for (const std::filesystem::path& input : inputs) EXPECT_NO_THROW(GetParam().run(bytes_of(input))) << input;
}

TEST_P(Fuzz, MutationsKeepTheProperty) {
  const std::vector<std::filesystem::path> inputs = inputs_of(GetParam());
  ASSERT_FALSE(inputs.empty());
  const Vocabulary& vocabulary = vocabulary_of(GetParam().name);
  std::string text;
  for (std::uint32_t seed = 0; seed < 1000; ++seed) {
    // Each one starts from a file anew or goes on from the mutation before it.
    if (seed % 4 == 0) text = bytes_of(inputs[seed / 4 % inputs.size()]);
    text = mutated(text, vocabulary, seed);
    EXPECT_NO_THROW(GetParam().run(text)) << "seed " << seed << ":\n" << text;
  }
}

std::vector<Target> targets() {
  std::vector<Target> all = {{"mechanism", mechanism_target, {"examples"}},
                             {"import",
                              import_target,
                              {"tests/mechanism/import/files/pmks", "tests/mechanism/import/files/linkage",
                               "tests/mechanism/import/files/mjcf", "tests/mechanism/import/files/urdf",
                               "tests/mechanism/import/files/sdf", "tests/mechanism/import/files/dxf",
                               "tests/mechanism/import/files/pyslvs", "tests/mechanism/import/files/cuik"}},
                             {"task", task_target, {"examples/tasks"}},
                             {"trajectory", trajectory_target, {"examples/pick_and_place"}},
                             {"expression", expression_target, {}},
                             {"certificate", certificate_target, {}},
                             {"arguments", arguments_target, {}}};
#ifdef CLEARLOCI_HAS_WORKBENCH
  all.push_back({"server", server_target, {}});
#endif
  return all;
}

INSTANTIATE_TEST_SUITE_P(Targets, Fuzz, testing::ValuesIn(targets()),
                         [](const auto& target) { return std::string(target.param.name); });

TEST(FlawOfMessage, FindsWhatATerminalShouldNotGet) {
  EXPECT_FALSE(flaw_of_message("m.yaml:1:1: Stößel ∅ fehlt; write one"));
  EXPECT_TRUE(flaw_of_message(""));
  EXPECT_TRUE(flaw_of_message("a\nb"));
  EXPECT_TRUE(flaw_of_message("a\x1b[31m"));
  EXPECT_TRUE(flaw_of_message("a\x7f"));
  EXPECT_TRUE(flaw_of_message("a\xc2\x9b"));      // a control sequence introducer of one character
  EXPECT_TRUE(flaw_of_message("a\xff"));          // no UTF-8
  EXPECT_TRUE(flaw_of_message("a\xe2\x82"));      // cut off
  EXPECT_TRUE(flaw_of_message("a\xc0\xaf"));      // longer than need be
  EXPECT_TRUE(flaw_of_message("a\xed\xa0\x80"));  // half of a pair
  EXPECT_FALSE(flaw_of_message(std::string(1920, 'a')));
  EXPECT_TRUE(flaw_of_message(std::string(1921, 'a')));
}

TEST(ValueOrComplaint, LetsNothingElsePass) {
  EXPECT_EQ(value_or_complaint([] { return 3; }), 3);
  EXPECT_FALSE(value_or_complaint([]() -> int { throw core::InputError({"f", 1, 1}, "wrong", "mend it"); }));
  EXPECT_THROW(value_or_complaint([]() -> int { throw core::InputError({"f", 1, 1}, "wrong", ""); }), PropertyBroken);
  EXPECT_THROW(value_or_complaint([]() -> int { throw std::out_of_range("at"); }), std::out_of_range);
}

TEST(MutatedText, IsTheSameForTheSameSeedAndMostlyAnother) {
  const std::string text = bytes_of(root / "examples/five_bar.yaml");
  int changed = 0;
  for (std::uint32_t seed = 0; seed < 100; ++seed) {
    const std::string once = mutated(text, vocabulary_of("mechanism"), seed);
    EXPECT_EQ(once, mutated(text, vocabulary_of("mechanism"), seed));
    if (once != text) ++changed;
  }
  EXPECT_GT(changed, 80);
}

}  // namespace
}  // namespace clearloci::fuzz
