// Scalar fields over the plane of two free coordinates (clearloci/error.hpp): what numeric/ computes and report/ draws
// and writes.
#pragma once

#include "clearloci/error.hpp"
