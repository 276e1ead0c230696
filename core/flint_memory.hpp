// Memory that FLINT keeps for each thread: numbers and tables set aside for the next use, which `flint_cleanup` frees.
// For the sources that call FLINT, none of whose headers may include it (FLINT 2.9 documentation, flint.h).
#pragma once

#include <flint/flint.h>

namespace clearloci::core {

/// From the first call on a thread FLINT's memory is freed where that thread ends. Numbers of it that live on in
/// another thread stay valid.
inline void free_flint_memory_at_thread_end() {
  struct Memory {
    ~Memory() { flint_cleanup(); }
  };
  thread_local const Memory memory;
}

}  // namespace clearloci::core
