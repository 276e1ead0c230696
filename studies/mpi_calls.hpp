// What the module clearloci_mpi.so gives to the program, which opens it under mpirun alone (mpi_ranks.cpp): no other
// process waits for the libraries of MPI.
// Private to studies/.
#pragma once

#include "clearloci/study.hpp"

namespace clearloci {

struct MpiCalls {
  StudyRanks ranks;
  void (*finish)() = nullptr;
  void (*abort)(int status) = nullptr;
};

/// The module's one function: begins MPI, once in a process.
extern "C" MpiCalls* clearloci_start_mpi();

}  // namespace clearloci
