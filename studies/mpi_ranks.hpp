// Studies on more than one machine: the processes that mpirun or srun started, by MPI (cluster.md). A target of
// its own, which the program links: the library asks for no MPI, and the program loads it when it is started by it.
#pragma once

#include "clearloci/study.hpp"

namespace clearloci {

/// Whether this process is one of several that MPI started.
bool started_by_mpi();

struct MpiCalls;

/// MPI for as long as it lives; once in a process. Throws core::InputError where MPI cannot be loaded.
class MpiRanks {
 public:
  MpiRanks();
  ~MpiRanks();
  MpiRanks(const MpiRanks&) = delete;
  MpiRanks& operator=(const MpiRanks&) = delete;

  const StudyRanks& ranks() const;

  /// Ends every rank.
  [[noreturn]] void abort(int status) const;

 private:
  MpiCalls& calls_;
};

}  // namespace clearloci
