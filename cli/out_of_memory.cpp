#include "cli/out_of_memory.hpp"

#include <gmp.h>
#include <sys/mman.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <new>
#include <string>
#include <string_view>

#include "cli/program.hpp"
#include "report/files.hpp"

/// mimalloc's, where the program is linked with it: its `new` aborts without asking the new-handler.
extern "C" [[gnu::weak]] void mi_register_error(void (*handler)(int error, void* argument), void* argument);
/// What it would say on standard error besides.
extern "C" [[gnu::weak]] void mi_register_output(void (*write)(const char* text, void* argument), void* argument);
/// Switches an option on or off, one of mimalloc.h, unless the environment says which; for memory that is asked of the
/// system from then on.
extern "C" [[gnu::weak]] void mi_option_set_enabled_default(int option, bool enable);

namespace clearloci::cli {
namespace {

void throw_without_memory() { throw std::bad_alloc(); }

/// GMP's own print and abort. Its frames on the way of an exception hold nothing but numbers, which are lost.
template <void (*end)()>
void* gmp_allocate(std::size_t size) {
  void* const place = std::malloc(size);
  if (place == nullptr) end();
  return place;
}

template <void (*end)()>
void* gmp_reallocate(void* old, std::size_t, std::size_t size) {
  void* const place = std::realloc(old, size);
  if (place == nullptr) end();
  return place;
}

void gmp_free(void* old, std::size_t) { std::free(old); }

template <void (*end)()>
void on_error_of_allocator(int error, void*) {
  if (error == ENOMEM) end();
}

template <void (*end)()>
void call_where_memory_ends() {
  if (mi_register_error != nullptr) ::mi_register_error(on_error_of_allocator<end>, nullptr);
  if (mi_register_output != nullptr) ::mi_register_output([](const char*, void*) {}, nullptr);
  ::mp_set_memory_functions(gmp_allocate<end>, gmp_reallocate<end>, gmp_free);
}

/// Pages that are set apart belong to others; where a process may take none of them, touching one is a bus error.
bool has_pages_set_apart() {
  for (const char* const name : {"nr_hugepages", "nr_overcommit_hugepages"}) {
    std::ifstream file(std::string("/sys/kernel/mm/hugepages/hugepages-2048kB/") + name);
    if (long count = 0; file >> count && count > 0) return true;
  }
  return false;
}

}  // namespace

void end_where_memory_ends() {
  std::set_new_handler(end_without_memory);
  call_where_memory_ends<end_without_memory>();
}

void take_large_pages() {
  constexpr int large_pages = 6;  // mi_option_large_os_pages, mi_option_allow_large_os_pages of later versions
  if (mi_option_set_enabled_default == nullptr || has_pages_set_apart()) return;
  ::mi_option_set_enabled_default(large_pages, true);
  // What it has of the system already, and has not touched yet: the segment of a new block, which begins at a multiple
  // of its size. A hint, which changes nothing where it is wrong.
  constexpr std::size_t segment = std::size_t{32} << 20;
  const auto block = std::make_unique<char>();
  auto* const start = block.get() - reinterpret_cast<std::uintptr_t>(block.get()) % segment;
  static_cast<void>(::madvise(start, segment, MADV_HUGEPAGE));
}

void throw_where_memory_ends() { call_where_memory_ends<throw_without_memory>(); }

void end_without_memory() {
  static std::atomic_flag ending;
  if (ending.test_and_set())  // another thread says so and ends the process, this one with it
    for (;;) ::pause();
  constexpr std::string_view line =
      "clearloci: out of memory; choose a coarser grid, mesh or tolerance, or fewer working modes\n";
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, line.data(), line.size());
  report::remove_temporaries();
  std::_Exit(exit_limit_reached);
}

}  // namespace clearloci::cli
