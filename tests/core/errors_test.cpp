#include "core/errors.hpp"

#include <gtest/gtest.h>

namespace clearloci::inline core {
namespace {

TEST(InputError, IsOneLineWithPlaceProblemAndMend) {
  const InputError error({"model.yaml", 3, 7}, "the mass is negative", "write 0 or more");
  EXPECT_STREQ(error.what(), "model.yaml:3:7: the mass is negative; write 0 or more");
  EXPECT_EQ(error.position().line, 3);
  EXPECT_EQ(error.problem(), "the mass is negative");
  EXPECT_EQ(error.mend(), "write 0 or more");
}

TEST(InputError, LeavesOutWhatIsUnknown) {
  EXPECT_STREQ(InputError({"model.yaml", 0, 0}, "there is no such file", "").what(),
               "model.yaml: there is no such file");
  EXPECT_STREQ(InputError({"model.yaml", 3, 0}, "p", "m").what(), "model.yaml:3: p; m");
  EXPECT_STREQ(InputError({}, "p", "m").what(), "p; m");
}

TEST(Ensure, ThrowsForABrokenPromiseOnly) {
  EXPECT_NO_THROW(ensure(true, "kept"));
  try {
    ensure(false, "the sky is up");
    FAIL() << "nothing thrown";
  } catch (const std::logic_error& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("the sky is up"), std::string::npos);
    EXPECT_NE(text.find("errors_test.cpp"), std::string::npos);
  }
}

}  // namespace
}  // namespace clearloci::inline core
