// What a function of exact data gave for its last arguments. The curves of a mechanism lie on parts of one tower, and
// each asks the same of them. Private to sheet/.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

#include "core/polynomial.hpp"

namespace clearloci::loci::sheet {

/// A number that tells most arguments apart.
inline std::size_t fingerprint(int value) { return static_cast<std::size_t>(value); }
inline std::size_t fingerprint(const core::Rational& value) {
  return mpz_getlimbn(value.get_num_mpz_t(), 0) + 31 * mpz_getlimbn(value.get_den_mpz_t(), 0) +
         static_cast<std::size_t>(sgn(value));
}
template <class Part>
std::size_t fingerprint(const std::vector<Part>& list);
inline std::size_t fingerprint(const core::Polynomial& p) {
  std::size_t sum = static_cast<std::size_t>(p.variables);
  for (const core::Term& term : p.terms) sum = 0x9E3779B97F4A7C15U * sum + fingerprint(term.coefficient);
  return sum;
}
template <class Part>
std::size_t fingerprint(const std::vector<Part>& list) {
  std::size_t sum = list.size();
  for (const Part& part : list) sum = 0x9E3779B97F4A7C15U * sum + fingerprint(part);
  return sum;
}

/// For one thread.
template <class Value, class... Arguments>
class Remembered {
 public:
  /// Valid until the next call.
  template <class Compute>
  const Value& operator()(const Compute& compute, const Arguments&... arguments) {
    std::size_t sum = 0;
    ((sum = 0x9E3779B97F4A7C15U * sum + fingerprint(arguments)), ...);
    for (std::size_t i = 0; i < most; ++i)
      if (sums_[i] == sum && known_[i] && known_[i]->first == std::tie(arguments...)) return known_[i]->second;
    auto entry = std::make_unique<Entry>(std::tuple<Arguments...>(arguments...), compute());
    next_ = (next_ + 1) % most;
    sums_[next_] = sum;
    known_[next_] = std::move(entry);
    return known_[next_]->second;
  }

 private:
  static constexpr std::size_t most = 64;
  using Entry = std::pair<std::tuple<Arguments...>, Value>;
  std::array<std::size_t, most> sums_{};  ///< of the entries' arguments
  std::array<std::unique_ptr<Entry>, most> known_;
  std::size_t next_ = 0;  ///< the last one that was made
};

/// Terms of a polynomial that is worth the memory.
inline constexpr std::size_t most_terms_remembered = 300;

}  // namespace clearloci::loci::sheet
