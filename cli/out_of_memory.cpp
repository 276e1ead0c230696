#include "cli/out_of_memory.hpp"

#include <gmp.h>
#include <unistd.h>

#include <cstdlib>
#include <new>
#include <string_view>

#include "cli/program.hpp"
#include "report/files.hpp"

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

}  // namespace

void end_where_memory_ends() {
  std::set_new_handler(end_without_memory);
  ::mp_set_memory_functions(gmp_allocate<end_without_memory>, gmp_reallocate<end_without_memory>, gmp_free);
}

void throw_where_memory_ends() {
  ::mp_set_memory_functions(gmp_allocate<throw_without_memory>, gmp_reallocate<throw_without_memory>, gmp_free);
}

void end_without_memory() {
  constexpr std::string_view line =
      "clearloci: out of memory; choose a coarser grid, mesh or tolerance, or fewer working modes\n";
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, line.data(), line.size());
  report::remove_temporaries();
  std::_Exit(exit_limit_reached);
}

}  // namespace clearloci::cli
