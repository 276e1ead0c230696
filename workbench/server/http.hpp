// HTTP for one page: connections over Boost.Beast, on one thread that never waits for any of them, and a few threads
// that answer. A body is read only after the head was let in. What a connection may take is bounded: the bytes of its
// head and body, the time for each, how many are open at once. A stranger, who has shown no token yet, gives way to
// whoever comes later.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace clearloci::workbench {

struct HttpHead {
  std::string method, target, host, content_type;
  std::optional<std::string> origin;
};

struct HttpAnswer {
  int status = 200;
  std::string type, body;
  /// Where it is set, the answer is a stream of events: asked again and again for the next ones ("": none yet) until
  /// it returns nothing or the caller is gone.
  std::function<std::optional<std::string>()> events;
};

/// Sends a part of the body ahead of the rest, which then comes in chunks, with status 200 and this type. Once: later
/// parts are dropped.
using SendAhead = std::function<void(const std::string& type, std::string part)>;

struct HttpService {
  /// Looks at the head alone. Nothing: the body is to be read and asked. Called on the one thread: may not wait.
  std::function<std::optional<HttpAnswer>(const HttpHead&)> greet;
  /// Answers what was let in. Called on any of several threads; throws nothing.
  std::function<HttpAnswer(const HttpHead&, const std::string& body, const SendAhead& ahead)> ask;
  /// In the page's words, of what is no request: 400, 411, 413, 431.
  std::function<HttpAnswer(int status)> refuse;
};

struct HttpLimits {
  std::size_t head = std::size_t{16} << 10, body = std::size_t{5} << 20;  ///< bytes
  std::size_t connections = 256, threads = 24;
  std::chrono::milliseconds stranger{10'000};  ///< for the head of a first request, from its connection on
  std::chrono::milliseconds idle{600'000};     ///< for that of the next one
  std::chrono::milliseconds transfer{30'000};  ///< for a body, or an answer
};

class HttpServer {
 public:
  /// Listens on 127.0.0.1; port 0 is any that is free. Throws std::system_error where it cannot.
  HttpServer(int port, HttpService service, HttpLimits limits = {});
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  int port() const;
  void run();   ///< until it is stopped; what is being answered then is waited for
  void stop();  ///< from any thread

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace clearloci::workbench
