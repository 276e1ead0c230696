#include "report/files.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>

#include "core/errors.hpp"

namespace clearloci::report {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& what, int error) {
  throw core::InputError({path.string(), 0, 0}, what + ": " + std::generic_category().message(error),
                         "choose a folder that can be written with -o DIR");
}

/// A name no other writer uses: the process and a running number. Hidden, so that a listing does not show it.
std::filesystem::path temporary_name(const std::filesystem::path& path) {
  static std::atomic<unsigned> running{0};
  return path.parent_path() /
         ("." + path.filename().string() + "." + std::to_string(::getpid()) + "-" + std::to_string(running++) + ".tmp");
}

/// A temporary name where a signal handler finds it: fixed places, for a handler may not allocate, lock or wait.
struct Place {
  enum State : int { free, filling, used };
  std::atomic<int> state = free;
  std::array<char, 4096> name = {};
};
std::array<Place, 64> places;  // writes under way at the same time
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler reads the states");

/// Notes a temporary name for as long as it lives. Without a free place, or with a name too long for one, the name goes
/// unnoted: the write is as good, and only a signal would leave its file.
class Noted {
 public:
  explicit Noted(const std::string& name) {
    if (name.size() >= Place{}.name.size()) return;
    for (Place& place : places) {
      int expected = Place::free;
      if (!place.state.compare_exchange_strong(expected, Place::filling)) continue;
      std::memcpy(place.name.data(), name.c_str(), name.size() + 1);
      place.state = Place::used;
      place_ = &place;
      return;
    }
  }
  ~Noted() {
    if (place_ != nullptr) place_->state = Place::free;
  }
  Noted(const Noted&) = delete;
  Noted& operator=(const Noted&) = delete;

 private:
  Place* place_ = nullptr;
};

/// 0, or the errno of the step that failed.
int write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

}  // namespace

void write_atomically(const std::filesystem::path& path, std::string_view bytes) {
  std::error_code failure;
  if (path.has_parent_path()) {
    std::filesystem::create_directories(path.parent_path(), failure);
    if (failure) refuse(path.parent_path(), "the folder cannot be made", failure.value());
  }

  const std::filesystem::path temporary = temporary_name(path);
  const Noted noted(temporary.string());
  const int descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor < 0) refuse(path, "the file cannot be written", errno);

  int error = write_all(descriptor, bytes);
  if (::close(descriptor) != 0 && error == 0) error = errno;
  if (error == 0) {
    std::filesystem::rename(temporary, path, failure);
    error = failure.value();
  }
  if (error != 0) {
    std::filesystem::remove(temporary, failure);
    refuse(path, "the file cannot be written", error);
  }
}

void remove_temporaries() {
  for (const Place& place : places)
    if (place.state == Place::used) ::unlink(place.name.data());
}

}  // namespace clearloci::report
