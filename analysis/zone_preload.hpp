// Which free efforts keep contact, or which tensions are within their bounds, in the zones between the loci of section
// 15 of docs/background/method.md: decided at their samples, by the independent witness. Private to analysis/.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "clearloci/loci.hpp"
#include "clearloci/zones.hpp"
#include "mechanism/mechanism.hpp"

namespace clearloci {

/// Of a mechanism with free efforts without a value; of others nothing.
void add_preload(const mechanism::Mechanism& mechanism, const LociRequest& request, core::Zones& map);

/// What is the same all over a zone, of a sample in the frame.
using PreloadLabel = std::function<std::string(const core::TowerNames& tower, const core::WorkingMode& mode,
                                               const std::vector<double>& sample)>;

/// Of cables: whether a pose has tensions within their bounds. Else empty. `mechanism`: that of the file; it has to
/// outlive the label.
PreloadLabel label_of_preload(const mechanism::Mechanism& mechanism, const mechanism::Frame& frame);

}  // namespace clearloci
