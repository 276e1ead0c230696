#include "workbench/server/server.hpp"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <random>
#include <system_error>

#include "clearloci/errors.hpp"
#include "clearloci/work_limit.hpp"
#include "workbench/server/answered_loci.hpp"
#include "workbench/server/assets.hpp"
#include "workbench/server/http.hpp"
#include "workbench/server/lanes.hpp"
#include "workbench/server/progress.hpp"
#include "workbench/server/questions.hpp"
#include "workbench/server/refusal.hpp"
#include "workbench/server/start.hpp"

/// mimalloc's, where the program is linked with it: what the calling thread keeps goes back to the system.
extern "C" [[gnu::weak]] void mi_collect(bool force);

namespace clearloci::workbench {
namespace {

constexpr std::string_view questions = "api/";

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

std::string written(const Json& body) { return body.dump(-1, ' ', false, Json::error_handler_t::replace); }

HttpAnswer json_answer(int status, const Json& body) {
  return {.status = status, .type = "application/json", .body = written(body), .events = {}};
}

HttpAnswer refusal(int status, const std::string& sentence) { return json_answer(status, {{"error", sentence}}); }

/// What is no request of any page.
HttpAnswer refused_request(int status) {
  switch (status) {
    case 411:
      return refusal(status, "a request needs a Content-Length; encodings and chunks are refused");
    case 413:
      return refusal(status, "the request is too long");
    case 431:
      return refusal(status, "the head of the request is too long");
    default:
      return refusal(status, "this is no request that HTTP knows");
  }
}

/// The words of the command line, and their parts for the page, which shows them beside the field.
Json input_error_json(const InputError& error) {
  return {{"error", error.what()},
          {"problem", error.problem()},
          {"mend", error.mend()},
          {"line", error.position().line},
          {"column", error.position().column}};
}

constexpr std::chrono::milliseconds quick{200};

/// What one question took is of no use to the next: the allocator would keep it, in each thread that ever answered.
class MemoryGivenBack {
 public:
  MemoryGivenBack() = default;
  ~MemoryGivenBack() {
    if (std::chrono::steady_clock::now() - begun_ <= quick) return;
    if (::mi_collect != nullptr)
      ::mi_collect(true);
    else
      ::malloc_trim(0);
  }
  MemoryGivenBack(const MemoryGivenBack&) = delete;
  MemoryGivenBack& operator=(const MemoryGivenBack&) = delete;

 private:
  std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
};

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
  std::atomic<bool> stopping = false;
  Lanes lanes;
  ProgressBoard progress;
  AnsweredLoci answered;
  std::unique_ptr<HttpServer> http;  // its threads end before what they use

  int port() const { return http->port(); }
  void check_caller(const HttpHead& head) const;
  std::string path_below_token(const HttpHead& head) const;
  std::optional<HttpAnswer> greet(const HttpHead& head);
  HttpAnswer page(const std::string& path, const std::string& query);
  HttpAnswer follow_progress(const std::string& client);
  HttpAnswer ask(const HttpHead& head, const std::string& body, const SendAhead& ahead);
  HttpAnswer answer_question(const std::string& name, const Json& body, const std::function<void(const Json&)>& ahead);
};

/// Another origin's page can make the browser send requests here, and a name of its own can lead to 127.0.0.1.
void Server::Parts::check_caller(const HttpHead& head) const {
  if (!is_own_host(head.host, port())) throw Refusal(403, "this address is not the one that the program printed");
  if (!head.origin) return;
  constexpr std::string_view scheme = "http://";
  if (!head.origin->starts_with(scheme) || !is_own_host(head.origin->substr(scheme.size()), port()))
    throw Refusal(403, "a page of another origin is not answered");
}

std::string Server::Parts::path_below_token(const HttpHead& head) const {
  const std::string prefix = "/" + token + "/";
  if (!head.target.starts_with(prefix)) throw Refusal(403, "the address lacks the token that the program printed");
  return head.target.substr(prefix.size());
}

HttpAnswer Server::Parts::page(const std::string& path, const std::string& query) {
  if (path == "api/start") return json_answer(200, start_of(options));
  constexpr std::string_view client = "client=";
  if (path == "api/progress")
    return follow_progress(client_of(query.starts_with(client) ? query.substr(client.size()) : ""));
  const std::string wanted = path.empty() ? "index.html" : path;
  for (const Asset& asset : page_assets())
    if (asset.path == wanted)
      return {.status = 200, .type = std::string(type_of(wanted)), .body = std::string(asset.bytes), .events = {}};
  throw Refusal(404, "there is nothing at this address");
}

HttpAnswer Server::Parts::follow_progress(const std::string& client) {
  return {.status = 200,
          .type = "text/event-stream",
          .body = {},
          .events = [this, client, listening = progress.listen(client)]() -> std::optional<std::string> {
            return progress.take(client);
          }};
}

/// What a head alone decides: who may ask, and the page. Of a question only whether its body is to be read.
std::optional<HttpAnswer> Server::Parts::greet(const HttpHead& head) {
  try {
    check_caller(head);
    const std::string below = path_below_token(head);
    const std::size_t mark = std::min(below.find('?'), below.size());
    const std::string path = below.substr(0, mark);
    if (head.method == "GET" || head.method == "HEAD")
      return page(path, mark < below.size() ? below.substr(mark + 1) : "");
    if (head.method != "POST" || !path.starts_with(questions))
      throw Refusal(405, "this address does not accept this method");
    if (question_named(path.substr(questions.size())) == nullptr) throw Refusal(404, "there is no such question");
    if (!head.content_type.starts_with("application/json"))
      throw Refusal(415, "a request needs the type application/json");
    return std::nullopt;
  } catch (const Refusal& refused) {
    return refusal(refused.status(), refused.what());
  }
}

HttpAnswer Server::Parts::answer_question(const std::string& name, const Json& body,
                                          const std::function<void(const Json&)>& ahead) {
  const Question question = question_named(name);
  const auto begun = std::chrono::steady_clock::now();
  const Fields fields(body);
  const std::string client = client_of(fields.text("client", ""));
  const std::string lane = fields.text("lane", name);
  const std::unique_ptr<Lanes::Turn> turn = lanes.enter(client + "/" + name + "/" + client_of(lane));
  // Quick answers come without: a page that is told of everything has nothing else to do.
  const Watch watch{.deadline = deadline_after(begun, options.time_limit),
                    .abandoned = [this, &turn] { return turn->abandoned() || stopping; },
                    .progress =
                        [&, begun](double fraction, std::string_view stage) {
                          if (std::chrono::steady_clock::now() - begun > quick)
                            progress.tell(client, lane, fraction, stage);
                        },
                    .ahead = ahead,
                    .answered = ahead ? &answered : nullptr,
                    .begun = begun};
  try {
    const WorkLimit limit(watch.deadline, watch.abandoned);
    Json answer = question(body, watch);
    if (turn->abandoned()) throw Refusal(409, "a newer request has taken the place of this one");
    answer["seconds"] = watch.seconds();
    return json_answer(200, answer);
  } catch (const LimitReached& limit) {
    throw Refusal(turn->abandoned() ? 409 : 422, limit.what());
  }
}

/// `parts`: the page takes an answer in lines, of which the first may come ahead of the last.
HttpAnswer Server::Parts::ask(const HttpHead& head, const std::string& body, const SendAhead& ahead) {
  const MemoryGivenBack afterwards;
  bool quiet = false, begun = false;
  const auto refused = [&quiet](int status, Json why) {
    if (!quiet) return json_answer(status, why);
    why["refused"] = status;
    return json_answer(200, why);
  };
  try {
    const std::string path = path_below_token(head);
    const std::size_t mark = std::min(path.find('?'), path.size());
    const Json question = parse_body(body);
    quiet = Fields(question).flag("quiet");
    std::function<void(const Json&)> send;
    if (Fields(question).flag("parts"))
      send = [&](const Json& part) {
        quiet = begun = true;  // the status is 200 from now on
        ahead("application/x-ndjson", written(part) + "\n");
      };
    return answer_question(path.substr(questions.size(), mark - questions.size()), question, send);
  } catch (const Refusal& refusal) {
    return refused(refusal.status(), {{"error", refusal.what()}});
  } catch (const InputError& error) {
    return refused(422, input_error_json(error));
  } catch (const std::bad_alloc&) {
    return refused(422, {{"error", "there is not enough memory for this; ask for less"}});
  } catch (const std::exception& error) {
    const std::string words = fmt::format("internal error: {}; please report it with the mechanism file", error.what());
    return begun ? refused(500, {{"error", words}}) : refusal(500, words);
  }
}

Server::Server(ServerOptions options) : parts_(std::make_unique<Parts>()) {
  parts_->options = std::move(options);
  Parts& parts = *parts_;
  try {
    parts.http = std::make_unique<HttpServer>(
        parts.options.port,
        HttpService{.greet = [&parts](const HttpHead& head) { return parts.greet(head); },
                    .ask = [&parts](const HttpHead& head, const std::string& body,
                                    const SendAhead& ahead) { return parts.ask(head, body, ahead); },
                    .refuse = refused_request});
  } catch (const std::system_error& error) {
    if (error.code() == std::errc::resource_unavailable_try_again) throw;  // no thread is to be had
    throw InputError({.file = "--port"}, "the port cannot be listened on", "leave --port out, and a free one is taken");
  }
}

Server::~Server() { stop(); }

int Server::port() const { return parts_->port(); }
const std::string& Server::token() const { return parts_->token; }
std::string Server::address() const { return fmt::format("http://127.0.0.1:{}/{}/", port(), parts_->token); }
void Server::run() { parts_->http->run(); }
void Server::stop() {
  parts_->stopping = true;
  parts_->http->stop();
}

}  // namespace clearloci::workbench
