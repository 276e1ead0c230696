// --certificate of the commands that prove something.
#pragma once

#include <CLI/App.hpp>
#include <string>

#include "cli/arguments.hpp"
#include "core/certificate.hpp"
#include "report/certificate.hpp"
#include "report/files.hpp"

namespace clearloci::cli {

void add_certificate_argument(CLI::App& command, std::string& file);

/// Throws core::InputError where the mechanism has no certificate: it is in space, or not over two lengths.
void require_certifiable(const mechanism::Mechanism& mechanism);

/// Adds `file`, which appears with the files of the answer that it certifies.
void stage_certificate(report::StagedFiles& staged, const std::string& file, const std::string& command,
                       const CommonArguments& arguments, const core::Certificate& certificate,
                       const core::Task* task = nullptr);

}  // namespace clearloci::cli
