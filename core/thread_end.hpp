// Memory that libraries keep for each thread, numbers and tables set aside for the next use, and free when they are
// told to.
#pragma once

namespace clearloci::inline core {

/// From the first call on a thread `free` is called where that thread ends: flint_cleanup, mpfr_free_cache.
template <auto free>
void call_at_thread_end() {
  struct End {
    ~End() { free(); }
  };
  thread_local const End end;
}

}  // namespace clearloci::inline core
