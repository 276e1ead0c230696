// A point described where its name would stand: `at: [0, 0.1]`, `dyad: [[0, 0], P]`. Before anything is read it becomes
// a point of the file with a name of its own. Private to mechanism/.
#pragma once

#include "mechanism/yaml_input.hpp"

namespace clearloci::mechanism {

/// The document with every inline point among `points`, before the point that is built on it, else after all others;
/// its name stands in its place. Descriptions that read alike are one point: the place of a joint may be written in
/// the joint and among the points of its links.
Value name_inline_points(const Value& document);

}  // namespace clearloci::mechanism
