// Nothing that comes over a connection brings the server down, holds it, has it read files, or makes it keep memory.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <filesystem>
#include <thread>
#include <vector>

#include "clearloci/errors.hpp"
#include "report/base64.hpp"
#include "tests/workbench/raw_connection.hpp"
#include "tests/workbench/running_server.hpp"

namespace clearloci::workbench {
namespace {

using Json = nlohmann::json;

std::string head(const RunningServer& server, const std::string& path, const std::string& more) {
  return "POST " + path + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(server.port()) +
         "\r\nContent-Type: application/json\r\n" + more + "\r\n";
}

/// The status of an answer to bytes that are sent as they are.
std::string status_of(const RunningServer& server, const std::string& bytes) {
  const RawConnection connection(server.port());
  EXPECT_TRUE(connection.open());
  connection.send(bytes);  // may be refused half-way
  const std::string answer = connection.receive("\r\n\r\n");
  constexpr std::size_t from = 9, digits = 3;
  return answer.starts_with("HTTP/1.1 ") ? answer.substr(from, digits) : answer;
}

TEST(TheHead, DecidesBeforeABodyIsRead) {
  const RunningServer server;
  const std::string promised = "Content-Length: 5000000\r\n";
  EXPECT_EQ(status_of(server, head(server, "/0123456789abcdef0123456789abcdef/api/loci", promised)), "403");
  EXPECT_EQ(status_of(server, head(server, server.path("api/none"), promised)), "404");
  EXPECT_EQ(status_of(server, head(server, server.path("api/loci"), promised + "Origin: http://example.org\r\n")),
            "403");
  EXPECT_EQ(
      status_of(server, "POST " + server.path("api/loci") + " HTTP/1.1\r\nHost: example.org\r\n" + promised + "\r\n"),
      "403");
}

TEST(ABody, HasALengthThatIsTakenOrNot) {
  const RunningServer server;
  const std::string path = server.path("api/model");
  EXPECT_EQ(status_of(server, head(server, path, "Content-Length: 6000000\r\n")), "413");
  EXPECT_EQ(status_of(server, head(server, path, "Content-Length: 99999999999999999999999\r\n")), "400");
  EXPECT_EQ(status_of(server, head(server, path, "")), "411");
  EXPECT_EQ(status_of(server, head(server, path, "Transfer-Encoding: chunked\r\n") + "2\r\n{}\r\n0\r\n\r\n"), "411");
  EXPECT_EQ(status_of(server, head(server, path, "Content-Encoding: gzip\r\nContent-Length: 20\r\n")), "411");
  EXPECT_EQ(status_of(server, head(server, path, "Content-Length: 2\r\nTransfer-Encoding: chunked\r\n") + "{}"), "400");
  EXPECT_EQ(status_of(server, head(server, path, "Content-Length: 2\r\n") + "{}"), "400") << "no mechanism";
}

TEST(AHead, HasAnEnd) {
  const RunningServer server;
  const std::string endless(100'000, 'a');
  EXPECT_EQ(status_of(server, "GET / HTTP/1.1\r\nX: " + endless), "431");
  EXPECT_EQ(status_of(server, "GET /" + endless), "431");
  std::string lines = "GET / HTTP/1.1\r\n";
  for (int i = 0; i < 20'000; ++i) lines += "X-" + std::to_string(i) + ": 1\r\n";
  EXPECT_EQ(status_of(server, lines), "431");
}

TEST(ARange, IsAnsweredByThePageAndNothingBeyond) {
  const RunningServer server;
  httplib::Client client = server.client();
  const std::string page = client.Get(server.path(""))->body;
  for (const char* range : {"bytes=0-20000", "bytes=-1", "bytes=5-2", "bytes=0-0,2-3", "bytes=99999999999999999999-"}) {
    const auto answer = client.Get(server.path(""), {{"Range", range}});
    ASSERT_TRUE(answer) << range;
    EXPECT_EQ(answer->body, page) << range;
  }
}

/// Each sends a byte now and then and never ends its head.
TEST(ConnectionsThatTrickle, HoldNobodyElse) {
  const RunningServer server;
  std::vector<std::unique_ptr<RawConnection>> slow;
  constexpr int more_than_may_be_open = 400;
  for (int i = 0; i < more_than_may_be_open; ++i) {
    slow.push_back(std::make_unique<RawConnection>(server.port()));
    ASSERT_TRUE(slow.back()->open());
    slow.back()->send(i % 2 == 0 ? "GET / HT" : head(server, "/x", "Content-Length: 100\r\n").substr(0, 40));
  }
  for (int i = 0; i < 5; ++i) {
    for (const auto& one : slow) one->send("a");
    httplib::Client client = server.client();
    client.set_read_timeout(5);
    const auto answer = client.Get(server.path(""));
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->status, 200);
  }
}

TEST(ATask, NamesNoFileThatWasNotHandedOver) {
  const RunningServer server;
  const std::filesystem::path pipe = std::filesystem::temp_directory_path() / ("pipe" + std::to_string(::getpid()));
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  Json body = {{"text", example("gough_stewart.yaml")}, {"client", "test"}};
  std::string sentence;
  for (const std::string& file : {std::string("/etc/passwd"), std::string("/none.stl"), pipe.string()}) {
    body["task"] = "format: 1\nmesh: {file: " + file + "}\n";
    const auto answer = server.ask("verify", body);
    ASSERT_TRUE(answer) << file;
    EXPECT_EQ(answer->status, 422);
    std::string said = Json::parse(answer->body)["error"];
    said.replace(said.find(file), file.size(), "FILE");
    if (!sentence.empty()) {
      EXPECT_EQ(said, sentence) << "it tells whether a file exists";
    }
    sentence = said;
  }
  Json path = {{"text", example("five_bar.yaml")}, {"client", "test"}};
  path["trajectory"] = "format: 1\nmotion: {law: table, file: " + pipe.string() + "}\n";
  EXPECT_EQ(server.ask("trajectory", path)->status, 422);
  path["trajectory"] = "format: 1\nmotion: {law: table, file: way.csv}\n";
  path["files"] = {{"way.csv", report::base64("0,0.25,-0.7\n1,0.26,-0.7\n2,0.25,-0.7\n")}};
  EXPECT_EQ(server.ask("trajectory", path)->status, 200);
  path["files"] = {{"way.csv", "no base64"}};
  EXPECT_EQ(server.ask("trajectory", path)->status, 400);
  std::filesystem::remove(pipe);
}

TEST(AVerification, IsDrawnWithoutLoci) {
  const RunningServer server;
  Json body = {
      {"text", example("five_bar.yaml")}, {"task", example("tasks/pick_and_place.yaml")}, {"what", "verification"}};
  for (const char* format : {"pdf", "svg", "png", "json"}) {
    body["format"] = format;
    EXPECT_EQ(server.ask("export", body)->status, 200) << format;
  }
  body["text"] = example("excavator.yaml");  // its tower has roots of its cylinders
  body["task"] = "format: 1\nbox: {x: [4.27, 4.4], y: [1.7, 1.9]}\n";
  EXPECT_EQ(server.ask("export", body)->status, 200);
}

TEST(ALimit, IsTheSameAsThatOfTheCommandLine) {
  const RunningServer server;
  Json body = {{"text", example("five_bar.yaml")}};
  for (const char* value : {"1e300", "1e-200", "1e16"}) {
    body["min_force"] = value;
    EXPECT_EQ(server.ask("loci", body)->status, 422) << value;
  }
  for (const char* value : {"5e-2147483648", "5.0e-2147483648", "5e2147483647", "5e 3", "1/0", "5/", ""}) {
    body["min_force"] = value;
    EXPECT_EQ(server.ask("loci", body)->status, 400) << value;
  }
  const auto polynomials = [&](const std::string& value) {
    body["min_force"] = value;
    std::vector<std::string> all;
    for (const Json& curve : Json::parse(server.ask("loci", body)->body)["loci"]["curves"])
      all.push_back(curve["factor"].dump());
    return all;
  };
  const std::string zeros(59, '0');
  EXPECT_EQ(polynomials("5" + zeros + "/1" + zeros + "0"), polynomials("0.5")) << "every digit is read";
}

/// The margins of `six_rus` take half a minute of algebra; what waits for its turn keeps its own limit.
TEST(Algebra, EndsWithItsDeadlineAndHoldsNobodyElse) {
  const RunningServer server(0.5);
  Json heavy = {{"text", example("six_rus.yaml")}, {"min_force", "5"}, {"client", "a"}};
  const auto begun = std::chrono::steady_clock::now();
  std::thread other([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    EXPECT_TRUE(server.ask("loci", {{"text", example("five_bar.yaml")}, {"client", "b"}}));
  });
  EXPECT_TRUE(server.ask("loci", heavy));
  other.join();
  constexpr std::chrono::seconds ample{15};  // of a busy machine
  EXPECT_LT(std::chrono::steady_clock::now() - begun, ample);
}

TEST(APort, ThatIsTakenIsRefused) {
  const RunningServer server;
  try {
    const Server second({.file = "", .text = "", .values = {}, .port = server.port(), .time_limit = 20});
    FAIL() << "two servers listen on one port";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("--port"), std::string::npos) << error.what();
  }
}

TEST(ATimeLimit, OfMoreThanACenturyIsNone) {
  const RunningServer server(1e12);
  const auto answer = server.ask("loci", {{"text", example("five_bar.yaml")}});
  EXPECT_EQ(Json::parse(answer->body)["loci"]["complete"], true);
}

TEST(TheNameOfAFile, HasAnEnd) {
  const RunningServer server;
  const Json body = {{"text", example("five_bar.yaml")}, {"file", std::string(5000, 'a')}};
  EXPECT_EQ(server.ask("model", body)->status, 400);
}

TEST(AHeadOfEvents, EndsWithoutThem) {
  const RunningServer server;
  const RawConnection connection(server.port());
  ASSERT_TRUE(connection.open());
  connection.send("HEAD " + server.path("api/progress?client=a") +
                  " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(server.port()) + "\r\n\r\nGET / HTTP/1.1\r\n\r\n");
  const std::string answer = connection.receive("400 Bad Request");
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 200")) << answer;
}

TEST(APose, ThatCannotBeIteratedIsRefused) {
  const RunningServer server;
  Json body = {{"text", example("gripper.yaml")}};
  body["at"] = Json::parse(server.ask("model", body)->body)["sample"];
  EXPECT_EQ(server.ask("pose", body)->status, 200);
  body["iterate"] = true;
  EXPECT_EQ(server.ask("pose", body)->status, 422);
}

/// With the coarsest tolerance no place has room by what the places along the loci promise.
TEST(AFit, EndsWithItsDeadline) {
  const RunningServer server(2);
  const Json body = {{"text", example("five_bar.yaml")},
                     {"task", "format: 1\nbox: {x: [-0.05, 0.1], y: [-0.25, -0.1]}\nmargin: 2e-05\n"},
                     {"fit", "nearest"},
                     {"tolerance", 0.1}};
  const auto answer = server.ask("verify", body);
  ASSERT_TRUE(answer);
  EXPECT_TRUE(answer->status == 200 || answer->status == 422) << answer->body;
}

}  // namespace
}  // namespace clearloci::workbench
