// Damaged certificates are answered: rejected or unreadable, never a crash, never accepted.
#include <gtest/gtest.h>

#include <random>

#include "core/errors.hpp"
#include "tests/check/certified.hpp"

namespace clearloci::test {
namespace {

/// True: accepted.
bool is_accepted(const std::string& model, const std::string& certificate) {
  try {
    return examination_of(model, certificate).accepted;
  } catch (const core::InputError&) {
    return false;
  }
}

TEST(Damaged, TextsAreUnreadable) {
  const std::string model = example("five_bar.yaml");
  const std::string deep(200'000, '[');
  for (const std::string& text : {std::string(), std::string("{}"), std::string("[]"), std::string("null"), deep,
                                  std::string("{\"format\": \"clearloci-certificate\"}"),
                                  std::string("{\"format\": \"clearloci-certificate\", \"version\": 2}")})
    EXPECT_THROW((void)examination_of(model, text), core::InputError) << text.substr(0, 60);
}

TEST(Damaged, KeysThatAreTwiceAreUnreadable) {
  const std::string model = example("five_bar.yaml");
  std::string certificate = certificate_of(model);
  certificate.insert(certificate.find('{') + 1, R"("version": 1, )");
  EXPECT_THROW((void)examination_of(model, certificate), core::InputError);
}

TEST(Damaged, BytesAreNotAccepted) {
  const std::string model = example("five_bar.yaml");
  const std::string certificate = certificate_of(model);
  std::mt19937 random(7);
  const auto below = [&](std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random); };
  for (int i = 0; i < 40; ++i) {
    std::string damaged = certificate;
    if (i % 2 == 0)
      damaged.resize(below(damaged.size()));
    else
      damaged.erase(below(damaged.size() - 100), 1 + below(90));
    EXPECT_FALSE(is_accepted(model, damaged) && damaged != certificate) << i;
  }
}

}  // namespace
}  // namespace clearloci::test
