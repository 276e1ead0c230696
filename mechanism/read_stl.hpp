// Solids from STL files, binary and ASCII.
// Private to mechanism/.
#pragma once

#include <string>

#include "clearloci/verify.hpp"
#include "core/errors.hpp"

namespace clearloci::mechanism {

/// The solid of an STL file's bytes; `unit`: m of one of its numbers. Throws core::InputError in one line for what is
/// no STL file, and where the surface is not closed: an edge is not passed as often one way as the other.
core::TaskMesh parse_stl(const std::string& bytes, const std::string& file, double unit);

/// The same of a file of 256 MB at most.
core::TaskMesh read_stl(const std::string& path, double unit);

}  // namespace clearloci::mechanism
