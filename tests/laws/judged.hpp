// Tasks of mechanisms that tests make, verified as anybody's are: through clearloci/verify.hpp.
#pragma once

#include "analysis/loci.hpp"
#include "analysis/model.hpp"
#include "clearloci/verify.hpp"

namespace clearloci::test {

inline Verification judged(const mechanism::Mechanism& mechanism, const core::Task& task,
                           const LociRequest& request = {}) {
  return verify(model_of(mechanism), task, {.loci = request});
}

/// The verdict and the margin alone.
inline Verification decided(const mechanism::Mechanism& mechanism, const core::Task& task,
                            const LociRequest& request = {}) {
  return verify(model_of(mechanism), task, {.loci = request, .depth = VerifyDepth::margin});
}

/// A pose over two lengths.
inline Point2 point_of(const std::vector<double>& at) { return {at[0], at[1]}; }

}  // namespace clearloci::test
