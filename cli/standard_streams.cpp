#include "cli/standard_streams.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <iostream>

#include "core/text.hpp"
#include "report/files.hpp"

namespace clearloci::cli {
namespace {

/// Ends as the signal would have ended the process, without what it was writing.
void end_by_signal(int signal) {
  report::remove_temporaries();
  std::signal(signal, SIG_DFL);
  std::raise(signal);  // delivered on return from here, where the signal is no longer held back
}

}  // namespace

void prepare_process() {
  // A descriptor that is closed is the next one that open() hands out. Opened the wrong way round it stays closed in
  // effect: writing to it fails, as it should.
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(descriptor, F_GETFD) != -1 || errno != EBADF) continue;
    [[maybe_unused]] const int opened = ::open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  }
  for (const int signal : {SIGHUP, SIGINT, SIGTERM, SIGPIPE, SIGXCPU, SIGXFSZ}) {
    struct sigaction now = {};
    // What the caller has the process ignore (nohup, a shell's background jobs) stays so.
    if (::sigaction(signal, nullptr, &now) != 0 || now.sa_handler != SIG_DFL) continue;
    struct sigaction wanted = {};
    wanted.sa_handler = end_by_signal;
    ::sigemptyset(&wanted.sa_mask);
    ::sigaction(signal, &wanted, nullptr);
  }
}

void complain(const std::string& message) {
  const std::string line = "clearloci: " + core::message_line(message) + "\n";
  std::fflush(stderr);
  std::size_t at = 0;
  while (at < line.size()) {
    const ssize_t written = ::write(STDERR_FILENO, line.data() + at, line.size() - at);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return;
    at += static_cast<std::size_t>(written);
  }
}

bool flush_standard_output() {
  std::cout.flush();
  return std::cout.good() && std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
}

}  // namespace clearloci::cli
