// Ten thousand requests that make no sense: each is answered 4xx with one sentence, and the server stays up.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <random>

#include "tests/workbench/running_server.hpp"

namespace clearloci::workbench {
namespace {

using Json = nlohmann::json;
using Random = std::mt19937;

int below(Random& random, int count) { return std::uniform_int_distribution<int>(0, count - 1)(random); }

const std::vector<std::string> questions = {"model", "loci",  "zones",      "verify", "pose", "sweep",
                                            "cycle", "modes", "trajectory", "export", "none", "../loci"};
const std::vector<std::string> fields = {"text",  "file",       "mode",    "joints", "quantities", "tolerance",
                                         "at",    "poses",      "task",    "fit",    "what",       "format",
                                         "steps", "trajectory", "samples", "lane",   "client",     "min_force"};

std::string random_text(Random& random, int longest) {
  std::string text;
  for (int i = below(random, longest); i > 0; --i) text += static_cast<char>(below(random, 256));
  return text;
}

Json random_value(Random& random, int depth = 0) {
  switch (below(random, depth > 3 ? 6 : 8)) {
    case 0:
      return nullptr;
    case 1:
      return below(random, 2) == 0;
    case 2:
      return std::ldexp(below(random, 2001) - 1000, below(random, 600) - 300);
    case 3:
      return below(random, 7) - 3;
    case 4:
      return std::vector<std::string>{"f", "A1", "best", "svg", "1e9999", "9/0", "loci"}[below(random, 7)];
    case 5: {
      std::string text;
      for (int i = below(random, 30); i > 0; --i) text += static_cast<char>(32 + below(random, 95));
      return text;
    }
    case 6: {
      Json list = Json::array();
      for (int i = below(random, 5); i > 0; --i) list.push_back(random_value(random, depth + 1));
      return list;
    }
    default: {
      Json object = Json::object();
      for (int i = below(random, 4); i > 0; --i) object[fields[below(random, 18)]] = random_value(random, depth + 1);
      return object;
    }
  }
}

/// A mechanism from which a line is missing or in which bytes are others.
std::string damaged_model(Random& random) {
  std::string text = example("five_bar.yaml");
  for (int k = 0; k < 3; ++k) {
    const std::size_t from = static_cast<std::size_t>(below(random, static_cast<int>(text.size())));
    text.replace(from, static_cast<std::size_t>(below(random, 60)), random_text(random, 6));
  }
  return text;
}

std::string random_body(Random& random) {
  switch (below(random, 6)) {
    case 0:
      return random_text(random, 200);
    case 1:
      return std::string(static_cast<std::size_t>(below(random, 4000)), "[{\""[below(random, 3)]);
    default:
      break;
  }
  Json body = Json::object();
  for (int i = below(random, 6); i > 0; --i) body[fields[below(random, 18)]] = random_value(random);
  return body.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void expect_one_sentence(const httplib::Result& answer, const std::string& what) {
  ASSERT_TRUE(answer) << what;
  ASSERT_TRUE(answer->status >= 400 && answer->status < 500) << answer->status << " " << what << "\n" << answer->body;
  const Json said = Json::parse(answer->body, nullptr, false);
  ASSERT_TRUE(said.is_object() && said["error"].is_string()) << answer->body;
  const std::string sentence = said["error"];
  EXPECT_FALSE(sentence.empty());
  EXPECT_EQ(sentence.find('\n'), std::string::npos) << sentence;
}

TEST(Nonsense, IsRefusedInOneSentence) {
  constexpr int count = 10'000;
  const RunningServer server;
  httplib::Client client = server.client();
  Random random(20110501);
  for (int i = 0; i < count; ++i) {
    const std::string question = questions[static_cast<std::size_t>(below(random, 12))];
    const std::string body = random_body(random);
    const bool known_type = below(random, 8) != 0;
    const std::string path =
        below(random, 10) == 0 ? "/" + std::to_string(random()) + "/api/" + question : server.path("api/" + question);
    expect_one_sentence(client.Post(path, body, known_type ? "application/json" : "text/html"), question + " " + body);
    if (HasFatalFailure()) return;
  }
  EXPECT_EQ(client.Get(server.path(""))->status, 200);
}

/// Sound mechanisms of every kind, asked what does not go with them: answered, or refused in a sentence.
TEST(Nonsense, AskedOfSoundMechanismsIsRefusedInASentence) {
  const RunningServer server(2);
  Random random(13);
  httplib::Client client = server.client();
  const std::vector<std::string> models = {"five_bar.yaml",      "four_bar.yaml", "gripper.yaml",  "three_rpr.yaml",
                                           "gough_stewart.yaml", "hexapod.yaml",  "squeezer.yaml", "three_upu.yaml"};
  const std::vector<Json> odd = {Json::array(),
                                 {0.1},
                                 {1, -1},
                                 {1, 1, 1, 1, 1, 1, 1},
                                 {1e300, -1e300},
                                 {"A1", "none"},
                                 {"f", "M"},
                                 "box: {x: [0, 1]}",
                                 "format: 1\ncircle: {centre: [0, 0], radius: 0}",
                                 "best",
                                 "zones",
                                 "verification",
                                 "dxf",
                                 "html",
                                 7,
                                 true};
  for (int i = 0; i < 120; ++i) {
    Json body = {{"text", example(models[static_cast<std::size_t>(below(random, 8))])}};
    for (int k = below(random, 4); k > 0; --k)
      body[fields[static_cast<std::size_t>(1 + below(random, 17))]] =
          odd[static_cast<std::size_t>(below(random, static_cast<int>(odd.size())))];
    const std::string question = questions[static_cast<std::size_t>(below(random, 10))];
    const auto answer = client.Post(server.path("api/" + question), body.dump(), "application/json");
    ASSERT_TRUE(answer) << question << " " << body;
    if (answer->status != 200) expect_one_sentence(answer, question + " " + body.dump());
    if (HasFatalFailure()) return;
  }
}

/// A damaged file is refused, or, where the damage does no harm, answered.
TEST(Nonsense, InTheMechanismIsRefusedToo) {
  const RunningServer server(5);
  Random random(7);
  int refused = 0;
  for (int i = 0; i < 300; ++i) {
    const std::string text = damaged_model(random);
    const auto answer = server.ask(
        "pose",
        {{"text", Json::parse(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace))}, {"at", {0.25, -0.7}}});
    ASSERT_TRUE(answer);
    if (answer->status == 200) continue;
    expect_one_sentence(answer, text);
    ++refused;
  }
  EXPECT_GT(refused, 100);
}

/// Bytes that are no HTTP at all.
TEST(Nonsense, BelowHttpEndsTheConnectionAlone) {
  const RunningServer server;
  Random random(11);
  for (int i = 0; i < 60; ++i) {
    const int handle = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(server.port()));
    ::inet_pton(AF_INET, "127.0.0.1", &address.sin_addr);
    ASSERT_EQ(::connect(handle, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    const std::string bytes = random_text(random, 300) + "\r\n\r\n";
    [[maybe_unused]] const auto sent = ::send(handle, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    ::close(handle);
  }
  EXPECT_EQ(server.client().Get(server.path(""))->status, 200);
}

}  // namespace
}  // namespace clearloci::workbench
