// What the page begins with: the model of the call, the examples, the rules of drawing.
#pragma once

#include "workbench/server/fields.hpp"
#include "workbench/server/server.hpp"

namespace clearloci::workbench {

Json start_of(const ServerOptions& options);

}  // namespace clearloci::workbench
