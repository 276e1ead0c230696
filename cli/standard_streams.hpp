// The standard streams and signals of the process. Nothing here depends on what the program computes.
#pragma once

#include <string>

namespace clearloci::cli {

/// Gives the standard descriptors that the caller closed a place of their own, so that no file that is opened later
/// becomes "standard output"; has the signals that end a process remove its temporary files first.
/// A process ended so has the usual status of its signal, 128 + n for a shell.
void prepare_process();

/// "clearloci: message", one line on standard error. A standard error that cannot be written is passed over: there is
/// nowhere left to say so.
void complain(const std::string& message);

/// Whether everything printed has reached standard output.
bool flush_standard_output();

}  // namespace clearloci::cli
