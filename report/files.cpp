#include "report/files.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <mutex>
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
std::array<Place, 512> places;  // writes under way at the same time
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler reads the states");

/// Notes a temporary name, and says where. Without a free place, or with a name too long for one, the name goes unnoted
/// (-1): the write is as good, and only a signal would leave its file.
int note(const std::string& name) {
  if (name.size() >= Place{}.name.size()) return -1;
  for (std::size_t i = 0; i < places.size(); ++i) {
    int expected = Place::free;
    if (!places[i].state.compare_exchange_strong(expected, Place::filling)) continue;
    std::memcpy(places[i].name.data(), name.c_str(), name.size() + 1);
    places[i].state = Place::used;
    return static_cast<int>(i);
  }
  return -1;
}

void forget(int place) {
  if (place >= 0) places.at(static_cast<std::size_t>(place)).state = Place::free;
}

/// What keep_inputs named: of a file whose name may lead to it in several ways, the file itself.
struct FileIdentity {
  dev_t device;
  ino_t number;
};

struct Inputs {
  std::mutex mutex;
  std::vector<FileIdentity> files;
};

Inputs& inputs() {
  static Inputs all;
  return all;
}

/// Where a name leads that may be a symbolic link, to something or to nothing yet.
std::filesystem::path followed(std::filesystem::path path) {
  constexpr int most = 40;  // as many as the system follows
  std::error_code failure;
  for (int i = 0; i < most && std::filesystem::is_symlink(std::filesystem::symlink_status(path, failure)); ++i) {
    const std::filesystem::path target = std::filesystem::read_symlink(path, failure);
    if (failure) return path;
    path = target.is_absolute() ? target : path.parent_path() / target;
  }
  return path;
}

void refuse_to_replace(const std::filesystem::path& path, const std::string& why) {
  throw core::InputError({path.string(), 0, 0}, "the file is not written: " + why, "choose another name or folder");
}

/// Nothing but a regular file is replaced, and no input.
void check_target(const std::filesystem::path& asked, const std::filesystem::path& path) {
  struct stat status = {};
  if (::stat(path.c_str(), &status) != 0) return;
  if (!S_ISREG(status.st_mode))
    refuse_to_replace(asked, S_ISDIR(status.st_mode) ? "a folder has its name" : "it is no regular file");
  Inputs& all = inputs();
  const std::lock_guard lock(all.mutex);
  for (const FileIdentity& input : all.files)
    if (input.device == status.st_dev && input.number == status.st_ino)
      refuse_to_replace(asked, "it is what this call reads");
}

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

StagedFiles::~StagedFiles() {
  std::error_code ignored;
  for (const Staged& staged : staged_) {
    std::filesystem::remove(staged.temporary, ignored);
    forget(staged.place);
  }
}

void StagedFiles::add(const std::filesystem::path& asked, std::string_view bytes) {
  std::error_code failure;
  const std::filesystem::path path = followed(asked);
  if (path.has_parent_path()) {
    std::filesystem::create_directories(path.parent_path(), failure);
    if (failure) refuse(path.parent_path(), "the folder cannot be made", failure.value());
  }
  check_target(asked, path);
  for (const Staged& other : staged_)
    if (std::filesystem::weakly_canonical(other.path, failure) == std::filesystem::weakly_canonical(path, failure))
      refuse_to_replace(asked, "two files of the answer would have this name");

  Staged staged{path, temporary_name(path), -1};
  staged.place = note(staged.temporary.string());
  const int descriptor = ::open(staged.temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor < 0) {
    const int error = errno;
    forget(staged.place);
    refuse(asked, "the file cannot be written", error);
  }
  int error = write_all(descriptor, bytes);
  if (::close(descriptor) != 0 && error == 0) error = errno;
  staged_.push_back(staged);
  if (error != 0) refuse(asked, "the file cannot be written", error);
}

void StagedFiles::commit() {
  while (!staged_.empty()) {
    const Staged staged = staged_.front();
    std::error_code failure;
    std::filesystem::rename(staged.temporary, staged.path, failure);
    if (failure) refuse(staged.path, "the file cannot be written", failure.value());
    forget(staged.place);
    staged_.erase(staged_.begin());
  }
}

void write_atomically(const std::filesystem::path& path, std::string_view bytes) {
  StagedFiles file;
  file.add(path, bytes);
  file.commit();
}

void keep_inputs(const std::vector<std::filesystem::path>& named) {
  Inputs& all = inputs();
  const std::lock_guard lock(all.mutex);
  for (const std::filesystem::path& path : named) {
    struct stat status = {};
    if (::stat(path.c_str(), &status) == 0) all.files.push_back({status.st_dev, status.st_ino});
  }
}

void remove_temporaries() {
  for (const Place& place : places)
    if (place.state == Place::used) ::unlink(place.name.data());
}

}  // namespace clearloci::report
