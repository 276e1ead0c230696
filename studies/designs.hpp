// Which designs a study looks at: a grid, ends included, or a Sobol sequence, which leaves no region of the box empty.
// Values are exact. Private to studies/.
#pragma once

#include <cstdint>
#include <vector>

#include "clearloci/study.hpp"

namespace clearloci {

class Designs {
 public:
  /// Of a grid or a sample.
  explicit Designs(const core::Study& study);

  std::uint64_t count() const { return count_; }
  /// One value a varied parameter. On a grid the first parameter runs fastest.
  std::vector<core::Rational> values(std::uint64_t index) const;

 private:
  const core::Study& study_;
  std::uint64_t count_ = 0;
};

/// The `index`-th point of the Sobol sequence in the unit cube, as multiples of 2^-32. `dimensions`: 16 at most. By the
/// primitive polynomials and direction numbers of Joe and Kuo (SIAM J. Sci. Comput. 30 (2008) 2635-2654).
std::vector<std::uint32_t> sobol_point(std::uint64_t index, std::size_t dimensions);

}  // namespace clearloci
