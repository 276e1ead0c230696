#include "studies/mpi_ranks.hpp"

#include <dlfcn.h>

#include <cstdlib>

#include "core/errors.hpp"
#include "studies/mpi_calls.hpp"

namespace clearloci {
namespace {

/// The module is beside the program, where the program's run path leads. MPI's own plugins look for its functions among
/// those of all.
MpiCalls& start_mpi() {
  void* const module = dlopen("clearloci_mpi.so", RTLD_NOW | RTLD_GLOBAL);
  const char* const failure = module == nullptr ? dlerror() : nullptr;
  void* const start = module == nullptr ? nullptr : dlsym(module, "clearloci_start_mpi");
  if (start == nullptr)
    throw core::InputError(
        {}, std::string("MPI cannot be loaded: ") + (failure != nullptr ? failure : "not its module"),
        "install libopenmpi-dev and build again with -D CLEARLOCI_MPI=ON, or start it without mpirun");
  return *reinterpret_cast<decltype(&clearloci_start_mpi)>(start)();
}

}  // namespace

bool started_by_mpi() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"})
    if (std::getenv(name) != nullptr) return true;
  return false;
}

MpiRanks::MpiRanks() : calls_(start_mpi()) {}

MpiRanks::~MpiRanks() { calls_.finish(); }

const StudyRanks& MpiRanks::ranks() const { return calls_.ranks; }

void MpiRanks::abort(int status) const {
  calls_.abort(status);
  std::_Exit(status);
}

}  // namespace clearloci
