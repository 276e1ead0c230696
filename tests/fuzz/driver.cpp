// One target as a libFuzzer program. CLEARLOCI_FUZZ_TARGET: its function; CLEARLOCI_FUZZ_VOCABULARY: with it, most
// mutations keep the shape of the text, without it all of them are libFuzzer's own, of bytes.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <string>
#include <string_view>

#include "tests/fuzz/mutate_text.hpp"
#include "tests/fuzz/targets.hpp"

namespace {

/// Processor time, which a loaded machine does not stretch. libFuzzer's own -timeout ends what never returns.
double seconds_used() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double seconds_of(std::string_view bytes) {
  const double before = seconds_used();
  try {
    clearloci::fuzz::CLEARLOCI_FUZZ_TARGET(bytes);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "property broken: %s\n", error.what());
    std::abort();
  }
  return seconds_used() - before;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // A second of the program that is shipped: what allocates much is 25 times as slow with the sanitizers.
  constexpr double most_seconds = 25;
  const double taken = seconds_of({reinterpret_cast<const char*>(data), size});
  if (taken > most_seconds) {
    std::fprintf(stderr, "property broken: an answer within %.0f s; this one took %.2f s\n", most_seconds, taken);
    std::abort();
  }
  return 0;
}

#ifdef CLEARLOCI_FUZZ_VOCABULARY

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace {

std::size_t hand_over(const std::string& text, std::uint8_t* data, std::size_t most) {
  const std::size_t size = text.size() < most ? text.size() : most;
  std::copy_n(text.begin(), size, data);
  return size;
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
  constexpr unsigned bytewise = 8;  // one mutation in so many is of bytes
  if (size == 0 || seed % bytewise == 0) return LLVMFuzzerMutate(data, size, most);
  const std::string text(reinterpret_cast<const char*>(data), size);
  const auto& vocabulary = clearloci::fuzz::vocabulary_of(CLEARLOCI_FUZZ_VOCABULARY);
  return hand_over(clearloci::fuzz::mutated(text, vocabulary, seed), data, most);
}

extern "C" std::size_t LLVMFuzzerCustomCrossOver(const std::uint8_t* first, std::size_t first_size,
                                                 const std::uint8_t* second, std::size_t second_size, std::uint8_t* out,
                                                 std::size_t most, unsigned seed) {
  const std::string a(reinterpret_cast<const char*>(first), first_size);
  const std::string b(reinterpret_cast<const char*>(second), second_size);
  return hand_over(clearloci::fuzz::crossed(a, b, seed), out, most);
}

#endif
