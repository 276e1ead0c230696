#include "studies/designs.hpp"

#include <array>

#include "core/errors.hpp"
#include "core/reduced.hpp"

namespace clearloci {
namespace {

struct Direction {
  unsigned degree, polynomial;
  std::array<std::uint32_t, 6> first;
};
/// Of dimensions 2 to 16; dimension 1 is van der Corput's.
constexpr std::array<Direction, 15> directions = {{{1, 0, {1}},
                                                   {2, 1, {1, 3}},
                                                   {3, 1, {1, 3, 1}},
                                                   {3, 2, {1, 1, 1}},
                                                   {4, 1, {1, 1, 3, 3}},
                                                   {4, 4, {1, 3, 5, 13}},
                                                   {5, 2, {1, 1, 5, 5, 17}},
                                                   {5, 4, {1, 1, 5, 5, 5}},
                                                   {5, 7, {1, 1, 7, 11, 19}},
                                                   {5, 11, {1, 1, 5, 1, 1}},
                                                   {5, 13, {1, 1, 1, 3, 11}},
                                                   {5, 14, {1, 3, 5, 5, 31}},
                                                   {6, 1, {1, 3, 3, 9, 7, 49}},
                                                   {6, 13, {1, 1, 1, 15, 21, 21}},
                                                   {6, 16, {1, 3, 1, 13, 27, 49}}}};
constexpr unsigned bits = 32;
using Numbers = std::array<std::uint32_t, bits>;

Numbers direction_numbers(std::size_t dimension) {
  Numbers v{};
  if (dimension == 0) {
    for (unsigned i = 0; i < bits; ++i) v[i] = 1U << (bits - 1 - i);
    return v;
  }
  const Direction& direction = directions[dimension - 1];
  for (unsigned i = 0; i < bits; ++i) {
    if (i < direction.degree) {
      v[i] = direction.first[i] << (bits - 1 - i);
      continue;
    }
    v[i] = v[i - direction.degree] ^ (v[i - direction.degree] >> direction.degree);
    for (unsigned k = 1; k < direction.degree; ++k)
      if ((direction.polynomial >> (direction.degree - 1 - k)) & 1U) v[i] ^= v[i - k];
  }
  return v;
}

}  // namespace

std::vector<std::uint32_t> sobol_point(std::uint64_t index, std::size_t dimensions) {
  static const std::array<Numbers, directions.size() + 1> numbers = [] {
    std::array<Numbers, directions.size() + 1> all{};
    for (std::size_t d = 0; d < all.size(); ++d) all[d] = direction_numbers(d);
    return all;
  }();
  core::ensure(dimensions <= numbers.size() && index < (std::uint64_t{1} << bits), "a point of the sequence");
  const auto gray = static_cast<std::uint32_t>(index ^ (index >> 1U));
  std::vector<std::uint32_t> point(dimensions, 0);
  for (std::size_t d = 0; d < dimensions; ++d)
    for (unsigned i = 0; i < bits; ++i)
      if ((gray >> i) & 1U) point[d] ^= numbers[d][i];
  return point;
}

Designs::Designs(const core::Study& study) : study_(study) {
  using Kind = core::StudyMethod::Kind;
  core::ensure(study.method.kind == Kind::grid || study.method.kind == Kind::sample, "a grid or a sample");
  if (study.method.kind == Kind::sample) {
    count_ = study.method.count;
  } else {
    core::ensure(study.method.counts.size() == study.vary.size(), "a count for every parameter that varies");
    count_ = 1;
    for (const int count : study.method.counts) count_ *= static_cast<std::uint64_t>(count);
  }
}

std::vector<core::Rational> Designs::values(std::uint64_t index) const {
  std::vector<core::Rational> values;
  const auto at = [](const core::StudyParameter& parameter, const core::Rational& part) -> core::Rational {
    return parameter.lower + (parameter.upper - parameter.lower) * part;
  };
  if (study_.method.kind == core::StudyMethod::Kind::sample) {
    // The first point is the corner of the cube: the middle of its own cell serves as well and lies inside.
    const std::vector<std::uint32_t> point = sobol_point(index, study_.vary.size());
    for (std::size_t d = 0; d < point.size(); ++d) {
      values.push_back(
          at(study_.vary[d], core::reduced(2 * static_cast<unsigned long>(point[d]) + 1, core::Integer(1UL << 33U))));
    }
    return values;
  }
  for (std::size_t d = 0; d < study_.vary.size(); ++d) {
    const auto count = static_cast<std::uint64_t>(study_.method.counts[d]);
    // Of a single value the middle.
    values.push_back(at(study_.vary[d], count > 1 ? core::reduced(index % count, count - 1) : core::Rational(1, 2)));
    index /= count;
  }
  return values;
}

}  // namespace clearloci
