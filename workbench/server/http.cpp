#include "workbench/server/http.hpp"

#include <array>
#include <boost/asio/dispatch.hpp>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http.hpp>
#include <list>
#include <sstream>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace clearloci::workbench {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
using asio::ip::tcp;
using Error = beast::error_code;

class Connection;

/// Connections of which no request was let in yet, the oldest first. All of it belongs to the one thread.
struct Doorway {
  HttpService service;
  HttpLimits limits;
  std::size_t open = 0;
  std::list<std::weak_ptr<Connection>> strangers;
};

template <typename Message>
void add_common_fields(Message& message) {
  message.set(http::field::cache_control, "no-store");
  message.set("X-Content-Type-Options", "nosniff");
  message.set("Referrer-Policy", "no-referrer");
  message.set("Cross-Origin-Resource-Policy", "same-origin");
  message.set("Content-Security-Policy",
              "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; "
              "connect-src 'self'; frame-ancestors 'none'; base-uri 'none'");
}

std::string field(const http::fields& fields, http::field name) {
  const auto value = fields[name];
  return {value.data(), value.size()};
}

HttpHead head_of(const http::request<http::string_body>& request) {
  const auto method = request.method_string(), target = request.target();
  HttpHead head{.method = {method.data(), method.size()},
                .target = {target.data(), target.size()},
                .host = field(request, http::field::host),
                .content_type = field(request, http::field::content_type),
                .origin = {}};
  if (request.find(http::field::origin) != request.end()) head.origin = field(request, http::field::origin);
  return head;
}

class Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(tcp::socket socket, Doorway& doorway, asio::io_context& answers)
      : stream_(std::move(socket)),
        doorway_(doorway),
        answers_(answers),
        buffer_(2 * doorway.limits.head),
        timer_(stream_.get_executor()) {
    ++doorway_.open;
  }
  ~Connection() { --doorway_.open; }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  void start() {
    place_ = doorway_.strangers.insert(doorway_.strangers.end(), weak_from_this());
    Error ignored;
    stream_.socket().set_option(tcp::no_delay(true), ignored);
    read_head();
  }

  void close() {
    forget_stranger();
    timer_.cancel();
    stream_.close();
  }

 private:
  void read_head();
  void on_head(Error error);
  void greet();
  void read_body();
  void ask();
  void send_ahead(const std::string& type, const std::string& part);
  void answer(HttpAnswer given, bool keep);
  void send_rest();
  void begin_events();
  void send_events();
  void next_events();
  void drain();
  void discard();

  /// The member as a handler that keeps this alive.
  template <typename Then>
  auto then(Then call) {
    return [self = shared_from_this(), call](Error error, std::size_t) { call(*self, error); };
  }

  void forget_stranger() {
    if (place_) doorway_.strangers.erase(*std::exchange(place_, std::nullopt));
  }

  beast::tcp_stream stream_;
  Doorway& doorway_;
  asio::io_context& answers_;
  beast::flat_buffer buffer_;
  asio::steady_timer timer_;
  std::optional<http::request_parser<http::string_body>> parser_;
  std::optional<std::list<std::weak_ptr<Connection>>::iterator> place_;
  HttpHead head_;
  enum class Ahead { nothing, being_sent, sent } ahead_ = Ahead::nothing;
  std::optional<HttpAnswer> rest_;  ///< what follows the part that was sent ahead
  std::function<std::optional<std::string>()> events_;
  std::chrono::steady_clock::time_point told_;
  std::string sending_;
  std::array<char, 16384> discarded_{};
};

void Connection::read_head() {
  parser_.emplace();
  parser_->header_limit(static_cast<std::uint32_t>(doorway_.limits.head));
  parser_->body_limit(doorway_.limits.body);
  stream_.expires_after(place_ ? doorway_.limits.stranger : doorway_.limits.idle);
  http::async_read_header(stream_, buffer_, *parser_, then([](Connection& self, Error error) { self.on_head(error); }));
}

void Connection::on_head(Error error) {
  if (!error) return greet();
  if (error == http::error::header_limit || error == http::error::buffer_overflow)
    return answer(doorway_.service.refuse(431), false);
  if (error == http::error::body_limit) return answer(doorway_.service.refuse(413), false);
  const bool malformed = error.category() == http::make_error_code(http::error::end_of_stream).category() &&
                         error != http::error::end_of_stream && error != http::error::partial_message;
  if (malformed) return answer(doorway_.service.refuse(400), false);
  close();  // gone, or too slow
}

void Connection::greet() {
  const auto& request = parser_->get();
  head_ = head_of(request);
  std::optional<HttpAnswer> answered = doorway_.service.greet(head_);
  if (answered && answered->status >= 400) return answer(std::move(*answered), false);
  // Encodings are of no use between two programs of one machine, and each would need bounds of its own.
  const bool encoded = parser_->chunked() || request.find(http::field::content_encoding) != request.end();
  const auto length = parser_->content_length();
  if (encoded || (!answered && !length)) return answer(doorway_.service.refuse(411), false);
  if (length && *length > doorway_.limits.body) return answer(doorway_.service.refuse(413), false);
  if (answered && length && *length > 0) return answer(doorway_.service.refuse(400), false);
  forget_stranger();
  if (answered) return answer(std::move(*answered), request.keep_alive());
  if (field(request, http::field::expect) != "100-continue") return read_body();
  sending_ = "HTTP/1.1 100 Continue\r\n\r\n";
  stream_.expires_after(doorway_.limits.transfer);
  asio::async_write(stream_, asio::buffer(sending_), then([](Connection& self, Error error) {
                      if (error)
                        self.close();
                      else
                        self.read_body();
                    }));
}

void Connection::read_body() {
  stream_.expires_after(doorway_.limits.transfer);
  http::async_read(stream_, buffer_, *parser_, then([](Connection& self, Error error) {
                     if (!error) return self.ask();
                     if (error == http::error::body_limit) return self.answer(self.doorway_.service.refuse(413), false);
                     self.close();
                   }));
}

void Connection::ask() {
  stream_.expires_never();
  asio::post(answers_, [self = shared_from_this()]() mutable {
    const auto thread = self->stream_.get_executor();  // to which this connection, and its end, belong
    const SendAhead ahead = [&self, &thread](const std::string& type, std::string part) {
      asio::post(thread, [self, type, part = std::move(part)] { self->send_ahead(type, part); });
    };
    auto given =
        std::make_shared<HttpAnswer>(self->doorway_.service.ask(self->head_, self->parser_->get().body(), ahead));
    asio::post(thread,
               [self = std::move(self), given] { self->answer(std::move(*given), self->parser_->get().keep_alive()); });
  });
}

std::string chunk(const std::string& part) {
  if (part.empty()) return {};
  std::ostringstream size;
  size << std::hex << part.size();
  return size.str() + "\r\n" + part + "\r\n";
}

void Connection::send_ahead(const std::string& type, const std::string& part) {
  if (ahead_ != Ahead::nothing) return;
  http::response<http::empty_body> response(http::status::ok, 11);
  add_common_fields(response);
  response.set(http::field::content_type, type);
  response.keep_alive(parser_->get().keep_alive());
  response.chunked(true);
  std::ostringstream head;
  head << response.base();
  sending_ = head.str() + chunk(part);
  ahead_ = Ahead::being_sent;
  stream_.expires_after(doorway_.limits.transfer);
  asio::async_write(stream_, asio::buffer(sending_), then([](Connection& self, Error error) {
                      if (error) return self.close();
                      self.stream_.expires_never();
                      self.ahead_ = Ahead::sent;
                      if (self.rest_) self.send_rest();
                    }));
}

void Connection::send_rest() {
  sending_ = chunk(rest_->body) + "0\r\n\r\n";
  rest_.reset();
  ahead_ = Ahead::nothing;
  stream_.expires_after(doorway_.limits.transfer);
  asio::async_write(stream_, asio::buffer(sending_), then([](Connection& self, Error error) {
                      if (error) return self.close();
                      if (self.parser_->get().keep_alive()) return self.read_head();
                      self.drain();
                    }));
}

void Connection::answer(HttpAnswer given, bool keep) {
  if (ahead_ != Ahead::nothing) {
    rest_ = std::move(given);
    if (ahead_ == Ahead::sent) send_rest();
    return;
  }
  const bool stream = given.events && head_.method != "HEAD";
  auto response =
      std::make_shared<http::response<http::string_body>>(http::int_to_status(static_cast<unsigned>(given.status)), 11);
  add_common_fields(*response);
  response->set(http::field::content_type, given.type);
  response->keep_alive(keep && !stream);
  if (stream) {  // of no known length: the connection's end is its end
    events_ = std::move(given.events);
  } else {
    response->content_length(given.body.size());
    if (head_.method != "HEAD") response->body() = std::move(given.body);
  }
  stream_.expires_after(doorway_.limits.transfer);
  const auto done = [self = shared_from_this(), response, keep, stream](Error error, std::size_t) {
    if (error) return self->close();
    if (stream) return self->begin_events();
    if (keep) return self->read_head();
    self->drain();
  };
  if (!stream && head_.method != "HEAD") return http::async_write(stream_, *response, done);
  auto serializer = std::make_shared<http::response_serializer<http::string_body>>(*response);
  http::async_write_header(stream_, *serializer,
                           [serializer, done](Error error, std::size_t sent) { done(error, sent); });
}

/// Whatever a listener sends, or that it is gone, ends the stream.
void Connection::begin_events() {
  stream_.expires_never();
  stream_.async_read_some(asio::buffer(discarded_), then([](Connection& self, Error) { self.close(); }));
  send_events();
}

void Connection::send_events() {
  constexpr std::chrono::milliseconds pause{50};
  timer_.expires_after(pause);
  timer_.async_wait([self = shared_from_this()](Error error) {
    if (!error) self->next_events();
  });
}

void Connection::next_events() {
  constexpr std::chrono::seconds silence{10};
  std::optional<std::string> news = events_();
  if (!news) return close();
  const auto now = std::chrono::steady_clock::now();
  if (news->empty() && now - told_ < silence) return send_events();
  told_ = now;
  sending_ = news->empty() ? ": still here\n\n" : std::move(*news);
  stream_.expires_after(doorway_.limits.transfer);
  asio::async_write(stream_, asio::buffer(sending_), then([](Connection& self, Error error) {
                      if (error)
                        self.close();
                      else
                        self.send_events();
                    }));
}

/// A caller that is still sending reads the refusal only if what it sends is taken off the line meanwhile.
void Connection::drain() {
  Error ignored;
  stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
  constexpr std::chrono::seconds patience{5};
  stream_.expires_after(patience);
  discard();
}

void Connection::discard() {
  stream_.async_read_some(asio::buffer(discarded_), then([](Connection& self, Error error) {
                            if (error)
                              self.close();
                            else
                              self.discard();
                          }));
}

}  // namespace

// The order is that of the ends: threads first, then the handlers that the context still holds, then what they refer
// to.
struct HttpServer::Parts {
  Doorway doorway;
  asio::io_context context{1};
  tcp::acceptor acceptor{context};
  asio::steady_timer pause{context};
  asio::io_context answers;
  asio::executor_work_guard<asio::io_context::executor_type> more_to_come{answers.get_executor()};
  std::vector<std::thread> threads;

  Parts(HttpService service, const HttpLimits& limits);
  ~Parts() { end_answers(); }
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;

  /// Those that are asked for are given first.
  void end_answers() {
    more_to_come.reset();
    for (std::thread& thread : threads) thread.join();
    threads.clear();
  }
  void accept();
  void make_room();
};

HttpServer::Parts::Parts(HttpService service, const HttpLimits& limits) : doorway{std::move(service), limits, 0, {}} {
  try {
    while (threads.size() < limits.threads) threads.emplace_back([this] { answers.run(); });
  } catch (const std::system_error&) {  // the system has no more
    if (threads.empty()) throw;
  }
}

/// As many as may be open are: the stranger who has waited longest goes.
void HttpServer::Parts::make_room() {
  if (doorway.open < doorway.limits.connections || doorway.strangers.empty()) return;
  if (const std::shared_ptr<Connection> oldest = doorway.strangers.front().lock()) oldest->close();
}

void HttpServer::Parts::accept() {
  acceptor.async_accept([this](Error error, tcp::socket socket) {
    if (error == asio::error::operation_aborted) return;
    make_room();
    if (!error) {
      if (doorway.open <= doorway.limits.connections)
        std::make_shared<Connection>(std::move(socket), doorway, answers)->start();
      return accept();
    }
    constexpr std::chrono::milliseconds later{20};  // no file is left to open
    pause.expires_after(later);
    pause.async_wait([this](Error stopped) {
      if (!stopped) accept();
    });
  });
}

HttpServer::HttpServer(int port, HttpService service, HttpLimits limits)
    : parts_(std::make_unique<Parts>(std::move(service), limits)) {
  const tcp::endpoint here(asio::ip::address_v4::loopback(), static_cast<unsigned short>(port));
  tcp::acceptor& acceptor = parts_->acceptor;
  acceptor.open(here.protocol());
  acceptor.set_option(tcp::acceptor::reuse_address(true));  // of a port that is listened on there is none other
  Error error;
  acceptor.bind(here, error);
  if (!error) acceptor.listen(tcp::acceptor::max_listen_connections, error);
  // Boost's own exception is no std::system_error in every version of it.
  if (error) throw std::system_error(error.value(), std::system_category(), error.message());
  parts_->accept();
}

HttpServer::~HttpServer() = default;

int HttpServer::port() const { return parts_->acceptor.local_endpoint().port(); }

void HttpServer::run() {
  parts_->context.run();
  parts_->end_answers();
}

void HttpServer::stop() { parts_->context.stop(); }

}  // namespace clearloci::workbench
