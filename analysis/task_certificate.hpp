// What is certified of a task that was verified, over any coordinates.
#pragma once

#include "analysis/loci.hpp"
#include "core/certificate.hpp"
#include "core/task.hpp"

namespace clearloci {

/// Throws core::InputError for a task that no certificate is of: meshes, pose errors.
void require_certifiable(const core::Task& task);

/// Of the first of the request's working modes. Required: the task is verified, and may be certified.
core::TaskCertificate certificate_of(const mechanism::Mechanism& mechanism, const core::Task& task,
                                     const LociRequest& request);

}  // namespace clearloci
