// Holds the functions of a certificate against the statics of the model: at many random poses, with a thousand bits,
//     log |w_k| = c + sum_i p_i log |f_i|
// over the certificate's functions f_i and what the model's closure divides by. The exponents p are found, not
// believed: the order in which each reaction vanishes on f_i = 0, and |A| and every square Q_j likewise. Both sides are
// analytic on the sheet; that they agree to a thousand bits at dozens of random poses without being equal has a
// probability that is nothing. Private to check/.
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
/// Whether some pose of a box may be out of reach, or have a root that is zero.
bool may_be_on_boundary(const mechanism::Mechanism& m, const CertificateFile& certificate, int mode, const Interval& x,
                        const Interval& y);

/// Of every function, twice its exponent.
using Exponents = std::vector<int>;

struct Orders {
  bool known = false;  ///< false: too few poses of the mode were found in the box
  /// Of every function: those whose zeros together are its own. Itself, or others that it is a product of.
  std::vector<std::vector<int>> makers;
  /// In the order of reactions_of; none for one that is 0 in every pose, or not wanted.
  std::vector<std::optional<Exponents>> reactions;
  Exponents determinant;
  std::vector<std::optional<Exponents>>
      squares;  ///< of every dyad, slider and limit's end; none: no functions make it up
  std::vector<std::optional<Exponents>> roots;  ///< of the squares of the certificate's roots; likewise
};

/// Throws FalseClaim where no exponents fit, and where a function is part of nothing.
Orders orders_of(const mechanism::Mechanism& m, const CertificateFile& certificate, int mode);

}  // namespace clearloci::check
