// Holds the functions of a certificate against the statics of the model: at many random poses, with a thousand bits,
//     log |w_k| = c + sum_i p_i log |f_i|
// over the certificate's functions f_i and the model's own squares and divisors. The exponents p are found, not
// believed: the order in which each reaction vanishes on f_i = 0, and |A| likewise. Both sides are analytic on the
// sheet; that they agree to a thousand bits at dozens of random poses without being equal has a probability that is
// nothing. Private to check/.
#pragma once

#include <optional>
#include <vector>

#include "check/certificate.hpp"
#include "check/sheet.hpp"
#include "check/statics.hpp"

namespace clearloci::check {

/// A mode's signs, of the dyads and sliders alone.
Sides sides_of(const CertificateFile& certificate, int mode);
SheetParts parts_of(const CertificateFile& certificate, int mode, std::vector<int> at_zero = {});

struct Orders {
  bool known = false;  ///< false: too few poses of the mode were found in the box
  /// Of every function: itself, or the earlier one that it is a power of, times model divisors; -1: it is neither that
  /// nor independent of the earlier ones.
  std::vector<int> same_zeros;
  /// By unknown and function, twice the exponent of the reaction; none for one that is 0 in every pose, or not wanted.
  std::vector<std::optional<std::vector<int>>> reactions;
  std::vector<int> determinant;
};

/// Throws FalseClaim where no exponents fit.
Orders orders_of(const mechanism::Mechanism& m, const CertificateFile& certificate, int mode);

}  // namespace clearloci::check
