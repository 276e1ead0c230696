// How the program takes memory. Where it ends: one line, and the status of a limit that was reached.
#pragma once

namespace clearloci::cli {

/// For a command that gives one answer: ends the process where memory is asked for that there is not, in whatever
/// thread or library. None of them could go on, and some would abort instead of saying so.
void end_where_memory_ends();

/// For one that answers again and again: GMP throws std::bad_alloc as the rest does, instead of ending the process.
void throw_where_memory_ends();

/// For a command that gives one answer: the allocator asks the system for memory in large pages, where it has them.
/// Long polynomials touch many pages for the first time, each of which costs a fault. Such memory is kept until the
/// end. Pages that the machine sets apart for others are left alone.
void take_large_pages();

/// Says so, removes temporary files and ends the process. Allocates nothing.
[[noreturn]] void end_without_memory();

}  // namespace clearloci::cli
