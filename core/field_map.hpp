// Scalar fields over the free coordinates (clearloci/error.hpp): what numeric/ computes and report/ draws and writes.
#pragma once

#include "clearloci/error.hpp"
