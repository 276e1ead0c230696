// The door of sheet/: the sheet of one working mode, the part of the tower's square roots that it chooses, over n
// coordinates. What is known of it at a point and over a cell (over two coordinates, over three, and of the statics of
// poses over any number), the charts in which it is smooth, its blow-ups around stars, and Krawczyk's operator. Nothing
// here searches.
#pragma once

#include "loci/sheet/all_solutions.hpp"
#include "loci/sheet/apex.hpp"
#include "loci/sheet/block_sheet.hpp"
#include "loci/sheet/boundary_curves.hpp"
#include "loci/sheet/chain_rule.hpp"
#include "loci/sheet/fine_zero.hpp"
#include "loci/sheet/form_cells.hpp"
#include "loci/sheet/krawczyk.hpp"
#include "loci/sheet/lifted_cell.hpp"
#include "loci/sheet/patch.hpp"
#include "loci/sheet/plane_cell.hpp"
#include "loci/sheet/pose_cell.hpp"
#include "loci/sheet/pose_chart.hpp"
#include "loci/sheet/rim_cell.hpp"
#include "loci/sheet/sheet_cell.hpp"
#include "loci/sheet/sheet_follower.hpp"
#include "loci/sheet/sheet_newton.hpp"
#include "loci/sheet/smooth_cell.hpp"
#include "loci/sheet/star.hpp"
#include "loci/sheet/subtower.hpp"
#include "loci/sheet/way_zeros.hpp"
