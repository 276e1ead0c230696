// The program: words in, exit status out.
#pragma once

namespace clearloci::cli {

/// Exit statuses. A failed call or a wrong input is one line on standard error.
inline constexpr int exit_done = 0;
inline constexpr int exit_check_said_no = 1;
inline constexpr int exit_wrong_input = 2;
inline constexpr int exit_limit_reached = 3;
inline constexpr int exit_internal_error = 70;  ///< EX_SOFTWARE of sysexits.h: a promise of our own code was broken

int run_program(int argc, const char* const* argv);

}  // namespace clearloci::cli
