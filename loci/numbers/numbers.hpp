// The door of numbers/: what everything else here computes with. Intervals and jets, alone and side by side; numbers of
// twice the digits of doubles and of many more; affine and mean-value forms; real roots of polynomials and the algebra
// of root towers, exactly; and SheetProgram, functions on a tower compiled once to run on all of these. Nothing here
// knows cells or curves.
#pragma once

#include "loci/numbers/affine.hpp"
#include "loci/numbers/batch.hpp"
#include "loci/numbers/centred.hpp"
#include "loci/numbers/double_double.hpp"
#include "loci/numbers/interval_batch.hpp"
#include "loci/numbers/inverse.hpp"
#include "loci/numbers/jet.hpp"
#include "loci/numbers/jet_batch.hpp"
#include "loci/numbers/multi_interval.hpp"
#include "loci/numbers/number_field.hpp"
#include "loci/numbers/sheet_program.hpp"
#include "loci/numbers/square_free.hpp"
#include "loci/numbers/surd.hpp"
#include "loci/numbers/tower_algebra.hpp"
#include "loci/numbers/univariate.hpp"
