// In the place of mpi_ranks.cpp where the build knows no MPI.
#include <cstdlib>

#include "core/errors.hpp"
#include "studies/mpi_ranks.hpp"

namespace clearloci {

bool started_by_mpi() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"})
    if (std::getenv(name) != nullptr) return true;
  return false;
}

MpiRanks::MpiRanks() {
  throw core::InputError({}, "this program was built without MPI",
                         "install libopenmpi-dev and build again with -D CLEARLOCI_MPI=ON, or start it without mpirun");
}

MpiRanks::~MpiRanks() = default;

void MpiRanks::abort(int status) const { std::_Exit(status); }

}  // namespace clearloci
