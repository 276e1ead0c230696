#include "symbolic/ginac_number.hpp"

#include <cln/integer.h>

#include <limits>
#include <sstream>

namespace clearloci::symbolic {

GiNaC::numeric number(const core::Rational& value) {
  if (value.get_num().fits_slong_p() && value.get_den().fits_slong_p())
    return GiNaC::numeric(value.get_num().get_si(), value.get_den().get_si());
  return GiNaC::numeric(core::to_string(value).c_str());
}

namespace {

bool fits_long(const GiNaC::numeric& whole) {
  return cln::integer_length(cln::the<cln::cl_I>(whole.to_cl_N())) < std::numeric_limits<long>::digits;
}

}  // namespace

core::Rational rational(const GiNaC::numeric& value) {
  const GiNaC::numeric above = value.numer(), below = value.denom();
  if (fits_long(above) && fits_long(below)) return {above.to_long(), below.to_long()};
  // GiNaC prints and parses cl_RA exactly; a text is the simplest bridge to GMP.
  std::ostringstream text;
  text << above << "/" << below;
  core::Rational result(text.str());
  result.canonicalize();
  return result;
}

}  // namespace clearloci::symbolic
