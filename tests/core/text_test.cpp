#include "core/text.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace clearloci::inline core {
namespace {

TEST(Printable, KeepsWritingAndReplacesWhatSteers) {
  EXPECT_EQ(printable("déjà №机🙂"), "déjà №机🙂");
  EXPECT_EQ(printable("a\nb\x7F"), "a\uFFFDb\uFFFD");
  EXPECT_EQ(printable("\x1b[31m"), "\uFFFD[31m");
  EXPECT_EQ(printable("\u009b"), "\uFFFD") << "CSI of the C1 controls";
  EXPECT_EQ(printable("\u202eabc\u2066"), "\uFFFDabc\uFFFD") << "turns the direction of writing";
  EXPECT_EQ(printable("\u2028"), "\uFFFD");
  EXPECT_EQ(printable("\uFFFE"), "\uFFFD") << "no character, and no XML";
  EXPECT_EQ(printable("a\xC3"), "a\uFFFD");
  EXPECT_EQ(printable(std::string("\0", 1)), "\uFFFD");
}

TEST(Shortened, KeepsBothEndsAndWholeCharacters) {
  EXPECT_EQ(shortened("short", 10), "short");
  EXPECT_EQ(shortened("0123456789", 10), "0123456789");
  EXPECT_EQ(shortened("0123456789abcdef", 9), "0123...ef");
  std::string long_text;
  for (int i = 0; i < 1000; ++i) long_text += "é";
  EXPECT_EQ(printable(shortened(long_text, 50)), shortened(long_text, 50));
  EXPECT_LE(shortened(long_text, 50).size(), 100U);
}

TEST(MessageLine, FitsOnAScreenWhateverItIsMadeOf) {
  EXPECT_EQ(message_line("model.yaml:3:7: the mass is negative; write 0 or more"),
            "model.yaml:3:7: the mass is negative; write 0 or more");
  EXPECT_EQ(message_line("a\nb\tc"), "a b c");
  const std::string word = "unknown key '" + std::string(200000, 'k') + "' in the file";
  EXPECT_LT(message_line(word).size(), 300U);
  EXPECT_NE(message_line(word).find("in the file"), std::string::npos);
  std::string words;
  for (int i = 0; i < 100000; ++i) words += "word ";
  EXPECT_LE(message_line(words).size(), 900U);
  EXPECT_EQ(message_line(std::string(10, '\x1b')).find('\x1b'), std::string::npos);
}

}  // namespace
}  // namespace clearloci::inline core
