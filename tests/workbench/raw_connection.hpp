// A connection that sends what no client library would.
#pragma once

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <string>
#include <string_view>

namespace clearloci::workbench {

class RawConnection {
  /// A signal, such as a fuzzer's alarm, ends no call for good.
  template <typename Call>
  static auto again(Call call) {
    auto result = call();
    while (result == -1 && errno == EINTR) result = call();
    return result;
  }

 public:
  explicit RawConnection(int port) : handle_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    ::inet_pton(AF_INET, "127.0.0.1", &address.sin_addr);
    open_ = ::connect(handle_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  }
  ~RawConnection() { ::close(handle_); }
  RawConnection(const RawConnection&) = delete;
  RawConnection& operator=(const RawConnection&) = delete;

  bool open() const { return open_; }

  /// False where the other side has closed.
  bool send(std::string_view bytes) const {
    while (!bytes.empty()) {
      const ssize_t sent = again([&] { return ::send(handle_, bytes.data(), bytes.size(), MSG_NOSIGNAL); });
      if (sent <= 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
    return true;
  }

  void end_of_sending() const { ::shutdown(handle_, SHUT_WR); }

  /// What comes until `wanted` is among it, the connection ends or nothing has come for so long.
  std::string receive(std::string_view wanted, int patience_ms = 20'000) const {
    std::string text;
    std::array<char, 65536> bytes{};
    pollfd one{handle_, POLLIN, 0};
    while (text.find(wanted) == std::string::npos && again([&] { return ::poll(&one, 1, patience_ms); }) == 1) {
      const ssize_t got = again([&] { return ::recv(handle_, bytes.data(), bytes.size(), 0); });
      if (got <= 0) break;
      text.append(bytes.data(), static_cast<std::size_t>(got));
    }
    return text;
  }

 private:
  int handle_;
  bool open_ = false;
};

}  // namespace clearloci::workbench
