#include <algorithm>
#include <array>
#include <cctype>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "tests/fuzz/property.hpp"
#include "tests/fuzz/targets.hpp"
#include "tests/workbench/raw_connection.hpp"
#include "workbench/server/server.hpp"

namespace clearloci::fuzz {
namespace {

/// One server for all inputs: what one of them breaks, the next one meets.
class Served {
 public:
  Served() : server_({.file = "m.yaml", .text = "format: 1\n", .values = {}, .port = 0, .time_limit = 1}) {
    thread_ = std::thread([this] { server_.run(); });
  }
  ~Served() {
    server_.stop();
    thread_.join();
  }
  Served(const Served&) = delete;
  Served& operator=(const Served&) = delete;

  int port() const { return server_.port(); }
  const std::string& token() const { return server_.token(); }

 private:
  workbench::Server server_;
  std::thread thread_;
};

void replace_all(std::string& text, const std::string& word, const std::string& by) {
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + by.size()))
    text.replace(at, word.size(), by);
}

std::string field_of(std::string head, const std::string& name) {
  std::transform(head.begin(), head.end(), head.begin(), [](unsigned char c) { return std::tolower(c); });
  const std::size_t at = head.find("\r\n" + name + ": ");
  if (at == std::string::npos) return {};
  const std::size_t from = at + name.size() + 4;
  return head.substr(from, head.find("\r\n", from) - from);
}

constexpr std::array allowed = {"100", "200", "400", "403", "404", "405", "409", "411", "413", "415", "422", "431"};

/// Takes one answer off the front.
void check_answer(std::string& text) {
  const std::size_t end = text.find("\r\n\r\n");
  require(text.starts_with("HTTP/1.1 ") && end != std::string::npos, "an answer is one of HTTP");
  const std::string head = text.substr(0, end + 2), status = text.substr(9, 3);
  require(std::find(allowed.begin(), allowed.end(), status) != allowed.end(), "a status is one of few, not " + status);
  text.erase(0, end + 4);
  if (status == "100") return;
  if (field_of(head, "content-type") == "text/event-stream") return text.clear();
  const std::size_t length = std::stoul("0" + field_of(head, "content-length"));
  if (text.empty() || text.starts_with("HTTP/1.1 ")) return;  // the answer to HEAD has none
  require(text.size() >= length, "an answer is as long as it says");
  const std::string body = text.substr(0, length);
  text.erase(0, length);
  if (status == "200") return;
  const nlohmann::json said = nlohmann::json::parse(body, nullptr, false);
  require(said.is_object() && said["error"].is_string(), "a refusal is an object with a sentence");
  const auto flaw = flaw_of_message(said["error"].get<std::string>());
  require(!flaw, "a sentence is fit to be shown: " + flaw.value_or(""));
}

std::string answers_to(const Served& served, const std::string& bytes) {
  const workbench::RawConnection connection(served.port());
  require(connection.open(), "the server takes connections");
  connection.send(bytes);
  connection.end_of_sending();
  return connection.receive("text/event-stream");
}

}  // namespace

void server_target(std::string_view bytes) {
  static const auto served = std::make_unique<Served>();
  std::string sent(bytes);
  replace_all(sent, "@TOKEN@", served->token());
  replace_all(sent, "@PORT@", std::to_string(served->port()));
  std::string answers = answers_to(*served, sent);
  if (answers.find("text/event-stream") == std::string::npos)
    while (!answers.empty()) check_answer(answers);
  const std::string page = answers_to(*served, "GET /" + served->token() + "/ HTTP/1.1\r\nHost: 127.0.0.1:" +
                                                   std::to_string(served->port()) + "\r\nConnection: close\r\n\r\n");
  require(page.starts_with("HTTP/1.1 200"), "the page is still there");
}

}  // namespace clearloci::fuzz
