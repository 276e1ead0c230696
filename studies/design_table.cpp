#include "studies/design_table.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>

#include "core/errors.hpp"

namespace clearloci {
namespace {

std::uint64_t fnv(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  return hash;
}

template <class T>
void put(std::string& line, T value) {
  std::array<char, 40> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
  line.append(text.data(), end);
  line += ' ';
}

/// Reasons hold blanks; names of joints are letters, digits and _.
std::string encoded(const std::string& reason) {
  std::string text;
  for (const char c : reason) text += c == ' ' ? '+' : c;
  return text.empty() ? "-" : text;
}

std::string decoded(std::string_view text) {
  if (text == "-") return {};
  std::string reason(text);
  for (char& c : reason)
    if (c == '+') c = ' ';
  return reason;
}

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  while (!line.empty()) {
    const std::size_t end = line.find(' ');
    words.push_back(line.substr(0, end));
    if (end == std::string_view::npos) break;
    line.remove_prefix(end + 1);
  }
  return words;
}

template <class T>
bool number(std::string_view word, T& value) {
  if (word == "-") {
    if constexpr (std::is_floating_point_v<T>) value = std::numeric_limits<T>::quiet_NaN();
    return std::is_floating_point_v<T>;
  }
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size();
}

void put_number(std::string& line, double value) {
  if (std::isnan(value))
    line += "- ";
  else
    put(line, value);
}

bool write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

}  // namespace

std::string hash_of(std::string_view text) {
  std::array<char, 17> digits{};
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), fnv(text), 16);
  const std::string hash(digits.data(), end);
  return std::string(16 - hash.size(), '0') + hash;
}

std::string table_line(const StudyDesign& design) {
  std::string line;
  put(line, design.index);
  put(line, static_cast<int>(design.status));
  put(line, design.task);
  for (std::size_t c = 0; c < 2; ++c) put_number(line, design.at ? (*design.at)[c] : std::nan(""));
  for (const double figure : design.figures) put_number(line, figure);
  line += encoded(design.reason);
  return line + " " + hash_of(line) + "\n";
}

bool read_table_line(std::string_view line, std::size_t figures, StudyDesign& design) {
  const std::size_t last = line.rfind(' ');
  if (last == std::string_view::npos || hash_of(line.substr(0, last)) != line.substr(last + 1)) return false;
  const std::vector<std::string_view> words = words_of(line.substr(0, last));
  if (words.size() != figures + 6) return false;
  int status = 0;
  core::Point2 at{};
  if (!number(words[0], design.index) || !number(words[1], status) || !number(words[2], design.task) ||
      !number(words[3], at[0]) || !number(words[4], at[1]) || status < 0 || status > 3)
    return false;
  design.status = static_cast<StudyDesign::Status>(status);
  design.at = std::isnan(at[0]) ? std::nullopt : std::optional(at);
  design.figures.resize(figures);
  for (std::size_t f = 0; f < figures; ++f)
    if (!number(words[5 + f], design.figures[f])) return false;
  design.reason = decoded(words[5 + figures]);
  return true;
}

void DesignTable::refuse(const std::string& what) const {
  throw core::InputError({path_.string()}, "the table of designs cannot be " + what + ": " + std::strerror(errno),
                         "choose another folder with -o");
}

DesignTable::DesignTable(std::filesystem::path path, const std::string& hash, std::size_t figures, bool resume)
    : path_(std::move(path)) {
  std::error_code error;
  if (path_.has_parent_path()) std::filesystem::create_directories(path_.parent_path(), error);
  file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file_ < 0) refuse("opened");
  if (::flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    ::close(file_);
    throw core::InputError({path_.string()}, "another run is writing this table",
                           "wait for it, or write to another folder");
  }
  header_ = "clearloci designs 1 " + hash + "\n";
  try {
    check_own();
    if (resume) read(header_, figures);
    if (!resume || ::lseek(file_, 0, SEEK_END) == 0) {
      if (::ftruncate(file_, 0) != 0 || ::lseek(file_, 0, SEEK_SET) != 0) refuse("begun");
      append(header_);
    }
  } catch (...) {
    ::close(file_);
    throw;
  }
}

DesignTable::~DesignTable() { ::close(file_); }

/// A table is begun in the place of another one, and of nothing else.
void DesignTable::check_own() const {
  struct stat status = {};
  std::array<char, 16> first{};
  constexpr std::string_view mark = "clearloci design";
  const bool regular = ::fstat(file_, &status) == 0 && S_ISREG(status.st_mode);
  const ssize_t size = regular ? ::pread(file_, first.data(), first.size(), 0) : -1;
  if (size < 0 || !mark.starts_with(std::string_view(first.data(), static_cast<std::size_t>(size))))
    throw core::InputError({path_.string()}, "this is no table of designs", "choose another folder with -o");
}

void DesignTable::read(const std::string& header, std::size_t figures) {
  std::ifstream stream(path_, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  std::size_t good = 0;
  if (text.size() >= header.size()) {
    if (!text.starts_with(header))
      throw core::InputError({path_.string()}, "this is the table of another study, model or version",
                             "start without --resume, or choose another folder with -o");
    good = header.size();
    while (true) {
      const std::size_t end = text.find('\n', good);
      if (end == std::string::npos) break;
      StudyDesign design;
      if (!read_table_line(std::string_view(text).substr(good, end - good), figures, design)) break;
      known_.push_back(std::move(design));
      good = end + 1;
    }
  } else if (!header.starts_with(text)) {
    throw core::InputError({path_.string()}, "this is no table of designs", "choose another folder with -o");
  }
  if (::ftruncate(file_, static_cast<off_t>(good)) != 0 || ::lseek(file_, 0, SEEK_END) < 0) refuse("gone on with");
}

void DesignTable::settle(const std::vector<StudyDesign>& designs) {
  std::string text = header_;
  for (const StudyDesign& design : designs) text += table_line(design);
  std::filesystem::path temporary = path_;
  temporary += ".tmp";
  const int file = ::open(temporary.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) refuse("settled");
  const bool written = write_all(file, text) && ::fdatasync(file) == 0 && ::flock(file, LOCK_EX | LOCK_NB) == 0 &&
                       ::rename(temporary.c_str(), path_.c_str()) == 0;
  if (!written) {
    const int error = errno;
    ::close(file);
    ::unlink(temporary.c_str());
    errno = error;
    refuse("settled");
  }
  ::close(file_);
  file_ = file;
}

void DesignTable::append(const std::string& lines) {
  if (!write_all(file_, lines) || ::fdatasync(file_) != 0) refuse("written");
}

}  // namespace clearloci
