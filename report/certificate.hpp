// The file behind --certificate (docs/certificates.md).
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/certificate.hpp"
#include "core/locus_map.hpp"
#include "core/zone_map.hpp"

namespace clearloci::report {

/// What the certificate is about, as the user called the program.
struct CertificateSource {
  std::string command;     ///< "loci"
  std::string model_text;  ///< of the mechanism file
  std::vector<std::pair<std::string, std::string>> overrides;
};

/// `zones`: null where none were asked for.
std::string certificate_text(const CertificateSource& source, const core::Certificate& certificate,
                             const core::LocusMap& map, const std::vector<core::Zone>* zones = nullptr);

}  // namespace clearloci::report
