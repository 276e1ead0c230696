// The door of search/: boxes cut until something is proven in each, on all cores. Common zeros of functions on a sheet,
// touches, stars at irrational points; trees of cells in which a curve hides nothing. What a search leaves undecided,
// it says.
#pragma once

#include "loci/search/box_search.hpp"
#include "loci/search/cell_tree.hpp"
#include "loci/search/critical_point.hpp"
#include "loci/search/enclosed_stars.hpp"
#include "loci/search/exact_zero.hpp"
#include "loci/search/halves.hpp"
#include "loci/search/isolated_zeros.hpp"
#include "loci/search/known_searches.hpp"
#include "loci/search/open_places.hpp"
#include "loci/search/touch_search.hpp"
#include "loci/search/work_queue.hpp"
#include "loci/search/zero_search.hpp"
