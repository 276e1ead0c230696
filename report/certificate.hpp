// The file behind --certificate (docs/certificates.md).
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "clearloci/zones.hpp"
#include "core/certificate.hpp"
#include "core/locus_map.hpp"
#include "core/task.hpp"

namespace clearloci::report {

/// What the certificate is about, as the user called the program.
struct CertificateSource {
  std::string command;     ///< "loci"
  std::string model_text;  ///< of the mechanism file
  std::vector<std::pair<std::string, std::string>> overrides;
};

/// What was proven besides the loci; null where it was not asked for.
struct CertifiedMore {
  const std::vector<core::Zone>* zones = nullptr;
  const core::Task* task = nullptr;  ///< that was verified, in the problem's first mode
};

std::string certificate_text(const CertificateSource& source, const core::Certificate& certificate,
                             const core::LocusMap& map, const CertifiedMore& more = {});

}  // namespace clearloci::report
