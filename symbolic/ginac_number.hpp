// Rational numbers from GMP to GiNaC and back. Private to symbolic/.
#pragma once

#include <ginac/ginac.h>

#include "core/rational.hpp"

namespace clearloci::symbolic {

GiNaC::numeric number(const core::Rational& value);
core::Rational rational(const GiNaC::numeric& value);

}  // namespace clearloci::symbolic
