#include "workbench/server/server.hpp"

#include <fmt/format.h>
#include <httplib.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <random>

#include "clearloci/errors.hpp"
#include "report/viewer.hpp"
#include "workbench/server/assets.hpp"
#include "workbench/server/lanes.hpp"
#include "workbench/server/progress.hpp"
#include "workbench/server/questions.hpp"
#include "workbench/server/refusal.hpp"

namespace clearloci::workbench {
namespace {

using httplib::Request;
using httplib::Response;

/// 128 bits nobody can guess, as hexadecimal digits.
std::string fresh_token() {
  std::random_device device;
  std::string token;
  for (int word = 0; word < 4; ++word) token += fmt::format("{:08x}", device());
  return token;
}

std::string_view type_of(std::string_view path) {
  if (path.ends_with(".html")) return "text/html; charset=utf-8";
  if (path.ends_with(".css")) return "text/css; charset=utf-8";
  if (path.ends_with(".js")) return "text/javascript; charset=utf-8";
  return "image/svg+xml";
}

/// Uncompressed: what is handed over whole, cpp-httplib compresses by brotli at its slowest, which took longer than all
/// else, and nothing leaves this machine.
void put_content(Response& response, std::string_view bytes, std::string_view type, std::shared_ptr<void> owner) {
  response.set_content_provider(
      bytes.size(), std::string(type),
      [bytes, owner = std::move(owner)](std::size_t from, std::size_t count, httplib::DataSink& sink) {
        return sink.write(bytes.data() + from, count);
      });
}

void put_json(Response& response, int status, const Json& body) {
  response.status = status;
  auto text = std::make_shared<std::string>(body.dump(-1, ' ', false, Json::error_handler_t::replace));
  constexpr std::string_view type = "application/json";
  if (status == 200)
    put_content(response, *text, type, text);
  else  // without a body at hand cpp-httplib would put its own words there
    response.set_content(*text, std::string(type));
}

void put_refusal(Response& response, int status, const std::string& sentence) {
  put_json(response, status, {{"error", sentence}});
}

/// The words of the command line, and their parts for the page, which shows them beside the field.
Json input_error_json(const InputError& error) {
  return {{"error", error.what()},
          {"problem", error.problem()},
          {"mend", error.mend()},
          {"line", error.position().line},
          {"column", error.position().column}};
}

/// "127.0.0.1:8080" or "localhost:8080".
bool is_own_host(const std::string& host, int port) {
  return host == fmt::format("127.0.0.1:{}", port) || host == fmt::format("localhost:{}", port);
}

/// A page's own name for itself: letters and digits; it only keeps the lanes of two pages apart.
std::string client_of(const std::string& name) {
  constexpr std::size_t longest = 32;
  std::string kept;
  for (const char c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 && kept.size() < longest) kept += c;
  return kept;
}

}  // namespace

struct Server::Parts {
  ServerOptions options;
  std::string token = fresh_token();
  int port = 0;
  httplib::Server http;
  Lanes lanes;
  ProgressBoard progress;

  void check_caller(const Request& request) const;
  std::string path_below_token(const Request& request) const;
  void answer(const Request& request, Response& response);
  void answer_get(const std::string& path, const Request& request, Response& response);
  void answer_question(const std::string& name, const Request& request, Response& response);
  void follow_progress(const Request& request, Response& response);
  Json start() const;
};

/// Another origin's page can make the browser send requests here, and a name of its own can lead to 127.0.0.1.
void Server::Parts::check_caller(const Request& request) const {
  if (!is_own_host(request.get_header_value("Host"), port))
    throw Refusal(403, "this address is not the one that the program printed");
  if (!request.has_header("Origin")) return;
  const std::string origin = request.get_header_value("Origin");
  constexpr std::string_view scheme = "http://";
  if (!origin.starts_with(scheme) || !is_own_host(origin.substr(scheme.size()), port))
    throw Refusal(403, "a page of another origin is not answered");
}

std::string Server::Parts::path_below_token(const Request& request) const {
  const std::string prefix = "/" + token + "/";
  if (!request.path.starts_with(prefix)) throw Refusal(403, "the address lacks the token that the program printed");
  return request.path.substr(prefix.size());
}

Json Server::Parts::start() const {
  Json examples = Json::array(), companions = Json::array();
  for (const Asset& asset : example_assets()) {
    Json one = {{"name", asset.path}, {"text", asset.bytes}};
    (asset.path.find("tasks/") == 0 || asset.path.ends_with("/path.yaml") ? companions : examples)
        .push_back(std::move(one));
  }
  Json values = Json::object();
  for (const auto& [name, value] : options.values) values[name] = value;
  return {{"file", options.file},
          {"text", options.text},
          {"values", std::move(values)},
          {"examples", std::move(examples)},
          {"companions", std::move(companions)},
          {"rules", report::drawing_rules()},
          {"time_limit", options.time_limit}};
}

void Server::Parts::answer_get(const std::string& path, const Request& request, Response& response) {
  if (path == "api/start") return put_json(response, 200, start());
  if (path == "api/progress") return follow_progress(request, response);
  const std::string wanted = path.empty() ? "index.html" : path;
  for (const Asset& asset : page_assets())
    if (asset.path == wanted) return put_content(response, asset.bytes, type_of(wanted), nullptr);
  throw Refusal(404, "there is nothing at this address");
}

void Server::Parts::follow_progress(const Request& request, Response& response) {
  const std::string client = client_of(request.get_param_value("client"));
  response.set_chunked_content_provider("text/event-stream", [this, client](std::size_t, httplib::DataSink& sink) {
    const std::optional<std::string> events = progress.next(client);
    if (!events) {
      sink.done();
      return true;
    }
    return sink.write(events->data(), events->size());
  });
}

void Server::Parts::answer_question(const std::string& name, const Request& request, Response& response) {
  const Question question = question_named(name);
  if (question == nullptr) throw Refusal(404, "there is no such question");
  if (!request.get_header_value("Content-Type").starts_with("application/json"))
    throw Refusal(415, "a question is asked in application/json");
  const auto begun = std::chrono::steady_clock::now();
  const Json body = parse_body(request.body);
  const Fields fields(body);
  const std::string client = client_of(fields.text("client", ""));
  const std::string lane = fields.text("lane", name);
  const std::unique_ptr<Lanes::Turn> turn = lanes.enter(client + "/" + name + "/" + client_of(lane));
  // Quick answers come without: a page that is told of everything has nothing else to do.
  constexpr std::chrono::milliseconds quick{200};
  const Watch watch{.deadline = begun + std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                                            std::chrono::duration<double>(options.time_limit)),
                    .abandoned = [&turn] { return turn->abandoned(); },
                    .progress =
                        [&, begun](double fraction, std::string_view stage) {
                          if (std::chrono::steady_clock::now() - begun > quick)
                            progress.tell(client, lane, fraction, stage);
                        }};
  try {
    Json answer = question(body, watch);
    if (turn->abandoned()) throw Refusal(409, "a newer request has taken the place of this one");
    answer["seconds"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    put_json(response, 200, answer);
  } catch (const LimitReached& limit) {
    throw Refusal(turn->abandoned() ? 409 : 422, limit.what());
  }
}

void Server::Parts::answer(const Request& request, Response& response) {
  try {
    check_caller(request);
    const std::string path = path_below_token(request);
    constexpr std::string_view questions = "api/";
    if (request.method == "GET" || request.method == "HEAD")
      answer_get(path, request, response);
    else if (request.method == "POST" && path.starts_with(questions))
      answer_question(path.substr(questions.size()), request, response);
    else
      throw Refusal(405, "this address is not asked in this way");
  } catch (const Refusal& refusal) {
    put_refusal(response, refusal.status(), refusal.what());
  } catch (const InputError& error) {
    put_json(response, 422, input_error_json(error));
  } catch (const std::bad_alloc&) {
    put_refusal(response, 422, "this is more than there is memory for; ask for less");
  } catch (const std::exception& error) {
    put_refusal(response, 500,
                fmt::format("internal error: {}; please report it with the mechanism file", error.what()));
  }
}

Server::Server(ServerOptions options) : parts_(std::make_unique<Parts>()) {
  parts_->options = std::move(options);
  httplib::Server& http = parts_->http;
  // A page holds up to six connections and one for its progress; each has a thread while it is open.
  constexpr std::size_t threads = 48, longest_body = std::size_t{5} << 20;
  http.new_task_queue = [] { return new httplib::ThreadPool(threads); };
  http.set_payload_max_length(longest_body);
  http.set_tcp_nodelay(true);
  http.set_keep_alive_max_count(1'000'000);
  http.set_socket_options([](socket_t) {});  // httplib's would let another process listen on the same port
  http.set_default_headers({{"Cache-Control", "no-store"},
                            {"X-Content-Type-Options", "nosniff"},
                            {"Referrer-Policy", "no-referrer"},
                            {"Cross-Origin-Resource-Policy", "same-origin"},
                            {"Content-Security-Policy",
                             "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' "
                             "data: blob:; connect-src 'self'; frame-ancestors 'none'; base-uri 'none'"}});
  const auto answer = [this](const Request& request, Response& response) { parts_->answer(request, response); };
  http.Get(".*", answer);
  http.Post(".*", answer);
  http.Put(".*", answer);
  http.Patch(".*", answer);
  http.Delete(".*", answer);
  http.Options(".*", answer);
  http.set_error_handler([](const Request&, Response& response) {
    if (!response.body.empty() || response.status < 400) return;
    put_refusal(
        response, response.status < 500 ? response.status : 400,
        response.status == 413 ? "the request is longer than any question" : "this is no request that HTTP knows");
  });
  parts_->port = parts_->options.port;
  if (parts_->port == 0)
    parts_->port = http.bind_to_any_port("127.0.0.1");
  else if (!http.bind_to_port("127.0.0.1", parts_->port))
    parts_->port = -1;
  if (parts_->port <= 0)
    throw InputError({.file = "--port"}, "the port cannot be listened on", "leave --port out, and a free one is taken");
}

Server::~Server() { stop(); }

int Server::port() const { return parts_->port; }
const std::string& Server::token() const { return parts_->token; }
std::string Server::address() const { return fmt::format("http://127.0.0.1:{}/{}/", parts_->port, parts_->token); }
void Server::run() { parts_->http.listen_after_bind(); }
void Server::stop() {
  parts_->progress.stop();
  parts_->http.stop();
}

}  // namespace clearloci::workbench
