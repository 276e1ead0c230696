// The door of curves/: loci over two coordinates. The engines that trace them and the last check of what they hand out;
// what vanishes on a locus and to which order, and how it is labelled (for points and surfaces, too); curves of several
// charts and sheets joined into one map.
#pragma once

#include "loci/curves/adaptive_engine.hpp"
#include "loci/curves/carried_loci.hpp"
#include "loci/curves/chart_maps.hpp"
#include "loci/curves/curve_arrangement.hpp"
#include "loci/curves/curve_projection.hpp"
#include "loci/curves/edge_labels.hpp"
#include "loci/curves/engine.hpp"
#include "loci/curves/exact_engine.hpp"
#include "loci/curves/force_zeros.hpp"
#include "loci/curves/isolated_points.hpp"
#include "loci/curves/margin_nodes.hpp"
#include "loci/curves/open_regions.hpp"
#include "loci/curves/place_words.hpp"
#include "loci/curves/pose_zeros.hpp"
#include "loci/curves/sheet_maps.hpp"
#include "loci/curves/simple_zeros.hpp"
