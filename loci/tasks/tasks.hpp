// The door of tasks/: proofs that a mechanism, or all designs of a box, keeps clear of every locus over a task; how far
// around the task that holds; what ends it there; and where a task that fails fits.
#pragma once

#include "loci/tasks/cover_proof.hpp"
#include "loci/tasks/design_proof.hpp"
#include "loci/tasks/effort_proof.hpp"
#include "loci/tasks/pose_displacement.hpp"
#include "loci/tasks/pose_nearest.hpp"
#include "loci/tasks/pose_proof.hpp"
#include "loci/tasks/pose_region.hpp"
#include "loci/tasks/task_clearance.hpp"
#include "loci/tasks/task_proof.hpp"
#include "loci/tasks/task_region.hpp"
