// --certificate of the commands that prove something.
#pragma once

#include <CLI/App.hpp>
#include <string>

#include "cli/arguments.hpp"
#include "core/certificate.hpp"
#include "report/certificate.hpp"
#include "report/files.hpp"

namespace clearloci::cli {

/// `of`: what has one.
void add_certificate_argument(CLI::App& command, std::string& file, const std::string& of);

/// Of loci and zones.
inline constexpr const char* certified_mechanisms = "mechanisms over one coordinate, and planar ones over two lengths";

/// Planar, over two lengths: loci and zones have certificates of curves.
bool has_certified_loci(const mechanism::Mechanism& mechanism);
/// Over one coordinate: of intervals, of any mechanism.
bool has_certified_range(const mechanism::Mechanism& mechanism);
/// Throws core::InputError where loci and zones have none.
void require_certifiable(const mechanism::Mechanism& mechanism);

/// Adds `file`, which appears with the files of the answer that it certifies. Of loci and zones that claim nothing, as
/// at a time limit, none is written, and that is told.
void stage_certificate(report::StagedFiles& staged, const std::string& file, const std::string& command,
                       const CommonArguments& arguments, const core::Certificate& certificate,
                       const core::Task* task = nullptr);
void stage_certificate(report::StagedFiles& staged, const std::string& file, const std::string& command,
                       const CommonArguments& arguments, const core::TaskCertificate& certificate,
                       const std::vector<core::PreloadLawCell>& law = {});
void stage_certificate(report::StagedFiles& staged, const std::string& file, const std::string& command,
                       const CommonArguments& arguments, const core::TaskCertificate& certificate,
                       const core::PreloadAnswer& refuted);
void stage_certificate(report::StagedFiles& staged, const std::string& file, const std::string& command,
                       const CommonArguments& arguments, const core::RangeCertificate& certificate);

}  // namespace clearloci::cli
