// The file behind --certificate (docs/background/certificates.md).
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "clearloci/verify.hpp"
#include "core/certificate.hpp"
#include "core/task.hpp"

namespace clearloci::report {

/// What the certificate is about, as the user called the program.
struct CertificateSource {
  std::string command;     ///< "loci"
  std::string model_text;  ///< of the mechanism file
  std::vector<std::pair<std::string, std::string>> overrides;
};

/// `task`: that was verified, in the problem's first mode and in the coordinates of the certificate; null: none was.
std::string certificate_text(const CertificateSource& source, const core::Certificate& certificate,
                             const core::Task* task = nullptr);

/// Of a task over any coordinates. `law`: cells with the free efforts in them; none where all efforts are given.
std::string certificate_text(const CertificateSource& source, const core::TaskCertificate& certificate,
                             const std::vector<core::PreloadLawCell>& law = {});

/// Of a task that no efforts of free actuators keep clear of every locus: rows of each pattern, with multipliers.
std::string certificate_text(const CertificateSource& source, const core::TaskCertificate& certificate,
                             const core::PreloadAnswer& refuted);

/// Of loci or zones over one coordinate.
std::string certificate_text(const CertificateSource& source, const core::RangeCertificate& certificate);

}  // namespace clearloci::report
