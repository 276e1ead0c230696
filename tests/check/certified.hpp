// Certificates of mechanism files, and what the checker says of them.
#pragma once

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "analysis/loci.hpp"
#include "analysis/zones.hpp"
#include "check/check.hpp"
#include "mechanism/read.hpp"
#include "report/certificate.hpp"
#include "tests/source_dir.hpp"

namespace clearloci::test {

inline std::string example(const std::string& name) {
  std::ifstream stream(source_dir() + "/examples/" + name, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

inline std::string certificate_of(const std::string& model, const LociRequest& request = {}, bool zones = false) {
  const mechanism::Mechanism mechanism = mechanism::parse_mechanism(model, "model.yaml");
  core::Certificate certificate;
  if (zones) {
    find_zones(mechanism, {request}, &certificate);
    return report::certificate_text({"zones", model, {}}, certificate);
  }
  trace_loci(mechanism, request, &certificate);
  return report::certificate_text({"loci", model, {}}, certificate);
}

inline check::Examination examination_of(const std::string& model, const std::string& certificate) {
  return check::check_certificate_text(model, "model.yaml", certificate, "certificate");
}

inline std::string summary(const check::Examination& examination) {
  std::string text = examination.accepted ? "accepted: " : "rejected: " + examination.why + "; ";
  text += std::to_string(examination.cells) + " cells, " + std::to_string(examination.arcs) + " arcs, open " +
          std::to_string(examination.open_share);
  for (const std::string& what : examination.unchecked) text += "\n  unchecked: " + what;
  return text;
}

}  // namespace clearloci::test
