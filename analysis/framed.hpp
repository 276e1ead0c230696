// Mechanisms are analysed in a frame of their own (mechanism/frame.hpp): here on the way in, and what was found on the
// way out.
#pragma once

#include <optional>

#include "analysis/loci.hpp"
#include "clearloci/error.hpp"
#include "clearloci/pose.hpp"
#include "clearloci/trajectory.hpp"
#include "clearloci/verify.hpp"
#include "clearloci/zones.hpp"
#include "core/certificate.hpp"
#include "core/task.hpp"
#include "mechanism/frame.hpp"
#include "mechanism/trajectory.hpp"
#include "numeric/validate.hpp"

namespace clearloci {

struct Framed {
  mechanism::Frame frame;
  mechanism::Mechanism mechanism;
};

enum class Scaling {
  by_size,  ///< and where lengths in metres are far from 1, scaled
  none,     ///< moved alone, where lengths and angles are measured together
};

/// Nothing where that is its own frame, or where it is in it already.
std::optional<Framed> framed(const mechanism::Mechanism& mechanism, Scaling scaling = Scaling::by_size,
                             mechanism::Parameters parameters = mechanism::Parameters::valued);

/// The same, moved alone and only where doubles would lose digits: for answers that rest on no more than doubles.
std::optional<Framed> framed_where_far(const mechanism::Mechanism& mechanism);

/// What a certificate tells besides its cells: the map as it was traced, and the frame that it was traced in.
void certify(const core::LocusMap& map, const std::optional<Framed>& framed, core::Certificate& certificate);

LociRequest in_frame(LociRequest request, const mechanism::Frame& frame);
core::Task in_frame(core::Task task, const mechanism::Frame& frame);
/// In that of the certificate.
core::Task in_frame(core::Task task, const core::Certificate& certificate);
mechanism::Trajectory in_frame(mechanism::Trajectory trajectory, const mechanism::Frame& frame);

/// `mechanism`: the one of the file. Vertices are rounded to doubles once more: far from the origin they hold to the
/// spacing of doubles there.
core::LocusMap from_frame(core::LocusMap map, const mechanism::Mechanism& mechanism, const mechanism::Frame& frame);
core::Zones from_frame(core::Zones map, const mechanism::Mechanism& mechanism, const mechanism::Frame& frame);
Pose from_frame(Pose pose, const mechanism::Mechanism& mechanism, const mechanism::Frame& frame);
Errors from_frame(Errors errors, const mechanism::Mechanism& mechanism, const mechanism::Frame& frame);
TrajectoryResult from_frame(TrajectoryResult result, const mechanism::Mechanism& mechanism,
                            const mechanism::Frame& frame);
/// Where a task fails or stays open.
void move_from_frame(std::optional<core::TaskWitness>& witness, std::optional<core::OpenTask>& open,
                     const mechanism::Mechanism& mechanism, const mechanism::Frame& frame);
Verification from_frame(Verification result, const core::Task& task, const mechanism::Mechanism& mechanism,
                        const mechanism::Frame& frame);
numeric::ValidationReport from_frame(numeric::ValidationReport report, const mechanism::Mechanism& mechanism,
                                     const mechanism::Frame& frame);

}  // namespace clearloci
