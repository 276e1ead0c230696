// In place of the compiled viewer, in a build without the workbench.
#include "report/viewer.hpp"

namespace clearloci::report {

ViewerBundle viewer_bundle() { return {}; }

}  // namespace clearloci::report
