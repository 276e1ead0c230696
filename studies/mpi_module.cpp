// The module clearloci_mpi.so: whatever calls MPI.
#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "studies/mpi_calls.hpp"

namespace clearloci {
namespace {

constexpr int tag = 1;

std::optional<std::pair<int, std::string>> poll(int from) {
  int here = 0;
  MPI_Status status;
  MPI_Iprobe(from, tag, MPI_COMM_WORLD, &here, &status);
  if (here == 0) return std::nullopt;
  int size = 0;
  MPI_Get_count(&status, MPI_CHAR, &size);
  std::string message(static_cast<std::size_t>(size), '\0');
  MPI_Recv(message.data(), size, MPI_CHAR, status.MPI_SOURCE, tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  return std::pair(status.MPI_SOURCE, std::move(message));
}

/// MPI's own receive spins; a rank that waits leaves its core to others.
std::string receive() {
  constexpr std::chrono::microseconds least(50), most(2000);
  for (auto pause = least;; pause = std::min(2 * pause, most)) {
    if (auto message = poll(0)) return std::move(message->second);
    std::this_thread::sleep_for(pause);
  }
}

}  // namespace

extern "C" MpiCalls* clearloci_start_mpi() {
  static MpiCalls calls;
  int provided = 0;
  // Threads work; the one that came here speaks.
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  MPI_Comm_rank(MPI_COMM_WORLD, &calls.ranks.rank);
  MPI_Comm_size(MPI_COMM_WORLD, &calls.ranks.size);
  calls.ranks.send = [](int to, const std::string& message) {
    MPI_Send(message.data(), static_cast<int>(message.size()), MPI_CHAR, to, tag, MPI_COMM_WORLD);
  };
  calls.ranks.receive = receive;
  calls.ranks.poll = [] { return poll(MPI_ANY_SOURCE); };
  calls.finish = [] { MPI_Finalize(); };
  calls.abort = [](int status) { MPI_Abort(MPI_COMM_WORLD, status); };
  return &calls;
}

}  // namespace clearloci
