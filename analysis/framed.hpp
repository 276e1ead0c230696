// Mechanisms far from the origin or of a size far from a metre are analysed in a frame of their own
// (mechanism/frame.hpp): here on the way in, and what was found on the way out.
#pragma once

#include <optional>

#include "analysis/loci.hpp"
#include "analysis/verification.hpp"
#include "clearloci/zones.hpp"
#include "core/task.hpp"
#include "mechanism/frame.hpp"
#include "numeric/validate.hpp"

namespace clearloci {

struct Framed {
  mechanism::Frame frame;
  mechanism::Mechanism mechanism;
};

/// Nothing where the mechanism needs no other frame than its own.
std::optional<Framed> framed(const mechanism::Mechanism& mechanism);

LociRequest in_frame(LociRequest request, const mechanism::Frame& frame);
core::Task in_frame(core::Task task, const mechanism::Frame& frame);

/// `mechanism`: the one of the file. Vertices are rounded to doubles once more: far from the origin they hold to the
/// spacing of doubles there.
core::LocusMap from_frame(core::LocusMap map, const mechanism::Mechanism& mechanism, const mechanism::Frame& frame);
core::ZoneMap from_frame(core::ZoneMap map, const mechanism::Mechanism& mechanism, const mechanism::Frame& frame);
Verification from_frame(Verification result, const core::Task& task, const mechanism::Mechanism& mechanism,
                        const mechanism::Frame& frame);
numeric::ValidationReport from_frame(numeric::ValidationReport report, const mechanism::Mechanism& mechanism,
                                     const mechanism::Frame& frame);

}  // namespace clearloci
