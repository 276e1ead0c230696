// The server answers its own page alone, and what it answers is what the library says.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>

#include "clearloci/export.hpp"
#include "clearloci/pose.hpp"
#include "tests/workbench/running_server.hpp"

namespace clearloci::workbench {
namespace {

using Json = nlohmann::json;

Json five_bar() { return {{"text", example("five_bar.yaml")}, {"client", "test"}}; }

class TheServer : public testing::Test {
 protected:
  static void SetUpTestSuite() { server = std::make_unique<RunningServer>(); }
  static void TearDownTestSuite() { server.reset(); }
  static std::unique_ptr<RunningServer> server;
};
std::unique_ptr<RunningServer> TheServer::server;

TEST_F(TheServer, GivesThePageBelowItsTokenAlone) {
  httplib::Client client = server->client();
  const auto page = client.Get(server->path(""));
  EXPECT_EQ(page->status, 200);
  EXPECT_NE(page->body.find("app.js"), std::string::npos);
  EXPECT_NE(page->get_header_value("Content-Security-Policy").find("default-src 'none'"), std::string::npos);
  EXPECT_EQ(client.Get(server->path("app.js"))->get_header_value("Content-Type"), "text/javascript; charset=utf-8");
  for (const char* path : {"/", "/index.html", "/0123456789abcdef0123456789abcdef/", "/api/start"})
    EXPECT_EQ(client.Get(path)->status, 403) << path;
}

TEST(AServerWithoutAModel, BeginsWithTheExamplesAlone) {
  const RunningServer server(ServerOptions{});
  const auto start = Json::parse(server.client().Get(server.path("api/start"))->body);
  EXPECT_EQ(start["text"], "");
  EXPECT_EQ(start["file"], "");
  // What the gallery shows is there.
  for (const char* name : {"five_bar.yaml", "four_bar.yaml", "gough_stewart.yaml", "delta.yaml"})
    EXPECT_TRUE(std::any_of(start["examples"].begin(), start["examples"].end(), [&](const Json& one) {
      return one["name"] == name;
    })) << name;
}

TEST_F(TheServer, SaysWhereADrawingIsWrong) {
  const std::string drawing =
      "format: 1\ndrawn: {A: [0, 0], B: [1, 0], C: [2, 1]}\nlinks:\n  AB: {points: [A, B]}\n  BC: {points: [B, C]}\n"
      "joints:\n  A: {revolute: [ground, AB], at: A, actuated: true}\n  B: {revolute: [AB, BC], at: B}\n"
      "end_effector: {link: BC, at: C}\n";
  const auto answer = Json::parse(server->ask("loci", {{"text", drawing}, {"file", "sketch.yaml"}})->body);
  EXPECT_EQ(answer["line"], 5);
  EXPECT_NE(std::string(answer["error"]).find("link BC moves freely"), std::string::npos) << answer;
}

TEST_F(TheServer, AnswersNoOtherOriginAndNoOtherName) {
  httplib::Client client = server->client();
  const std::string port = std::to_string(server->port());
  const auto status = [&](const httplib::Headers& headers) {
    return client.Post(server->path("api/model"), headers, five_bar().dump(), "application/json")->status;
  };
  EXPECT_EQ(status({{"Origin", "http://127.0.0.1:" + port}}), 200);
  EXPECT_EQ(status({{"Host", "localhost:" + port}, {"Origin", "http://localhost:" + port}}), 200);
  for (const char* origin : {"http://example.org", "null", "https://127.0.0.1", "http://127.0.0.1", "file://"})
    EXPECT_EQ(status({{"Origin", origin}}), 403) << origin;
  EXPECT_EQ(status({{"Origin", "https://127.0.0.1:" + port}}), 403);
  EXPECT_EQ(status({{"Origin", "http://127.0.0.1:" + port + ".example.org"}}), 403);
  for (const std::string host : {"example.org", "127.0.0.1", "127.0.0.1.example.org"})
    EXPECT_EQ(status({{"Host", host}}), 403) << host;
  // Without a preflight another origin's page can send nothing but plain texts and forms.
  EXPECT_EQ(client.Post(server->path("api/model"), five_bar().dump(), "text/plain")->status, 415);
  EXPECT_EQ(client.Options(server->path("api/model"))->status, 405);
}

TEST_F(TheServer, ListensOnThisMachineAlone) {
  httplib::Client elsewhere("127.0.0.2", server->port());
  EXPECT_FALSE(elsewhere.Get("/"));
}

/// The example with another length.
Json longer_five_bar(const std::string& length) {
  Json body = five_bar();
  std::string text = body["text"];
  const std::string written = "L: 0.5 ";
  text.replace(text.find(written), written.size(), "L: " + length + " ");
  body["text"] = text;
  body["parts"] = body["quiet"] = true;
  return body;
}

TEST_F(TheServer, AnswersFirstWhereTheLociGoAndThenWhatIsProven) {
  const auto asked = server->ask("loci", longer_five_bar("0.5"));
  EXPECT_EQ(asked->get_header_value("Content-Type"), "application/json") << "there is nothing to begin with";
  Json body = longer_five_bar("0.51");
  body["last"] = Json::parse(asked->body)["name"];
  const auto answer = server->ask("loci", body);
  ASSERT_EQ(answer->status, 200);
  EXPECT_EQ(answer->get_header_value("Content-Type"), "application/x-ndjson");
  const std::size_t end = answer->body.find('\n');
  ASSERT_NE(end, std::string::npos);
  const Json first = Json::parse(answer->body.substr(0, end))["carried"],
             rest = Json::parse(answer->body.substr(end + 1));
  EXPECT_FALSE(first["loci"]["complete"]);
  EXPECT_TRUE(rest["loci"]["complete"]);
  EXPECT_FALSE(first["curve_groups"].empty());
  EXPECT_LE(first["seconds"], rest["seconds"]);
  EXPECT_NE(first["name"], rest["name"]);
  ASSERT_EQ(first["loci"]["curves"].size(), Json::parse(asked->body)["loci"]["curves"].size());
  for (const Json& curve : first["loci"]["curves"]) {
    EXPECT_FALSE(curve["certified"]);
    EXPECT_FALSE(curve["arcs"].empty()) << curve["id"];
  }
  const Json expected = Json::parse(to_json(trace_loci(Model::parse(std::string(body["text"])))));
  ASSERT_EQ(rest["loci"]["curves"].size(), expected["curves"].size());
  for (std::size_t k = 0; k < expected["curves"].size(); ++k)
    EXPECT_EQ(rest["loci"]["curves"][k]["implicit"], expected["curves"][k]["implicit"]);
}

TEST_F(TheServer, SendsTheFirstPartAheadOfTheRest) {
  Json body = longer_five_bar("0.5");
  const Json last = Json::parse(server->ask("loci", body)->body);
  body = longer_five_bar("0.505");
  body["last"] = last["name"];
  std::vector<std::string> received;
  httplib::Request request;
  request.method = "POST";
  request.path = server->path("api/loci");
  request.set_header("Content-Type", "application/json");
  request.body = body.dump();
  request.content_receiver = [&](const char* data, std::size_t length, std::uint64_t, std::uint64_t) {
    received.emplace_back(data, length);
    return true;
  };
  httplib::Client client = server->client();
  ASSERT_EQ(client.send(request)->status, 200);
  ASSERT_GE(received.size(), 2u) << "in chunks";
  // The connection is as good as new.
  EXPECT_EQ(client.Post(server->path("api/model"), five_bar().dump(), "application/json")->status, 200);
}

TEST_F(TheServer, BeginsWithNothingThatItDoesNotKnow) {
  for (const char* last : {"", "0", "999999", "nonsense"}) {
    Json body = longer_five_bar("0.49");
    body["last"] = last;
    const auto answer = server->ask("loci", body);
    EXPECT_EQ(answer->get_header_value("Content-Type"), "application/json") << last;
    EXPECT_TRUE(Json::parse(answer->body)["loci"]["complete"]);
  }
  // Another mechanism's loci are carried nowhere.
  Json body = longer_five_bar("0.5");
  const Json name = Json::parse(server->ask("loci", body)->body)["name"];
  body["text"] = example("four_bar.yaml");
  body["last"] = name;
  const auto answer = server->ask("loci", body);
  EXPECT_EQ(answer->status, 200);
  const Json rest = Json::parse(answer->body.substr(answer->body.find('\n') + 1));
  EXPECT_EQ(rest["loci"]["coordinates"].size(), 1u);
}

TEST_F(TheServer, SaysOfLociWhatTheLibrarySays) {
  const auto answer = Json::parse(server->ask("loci", five_bar())->body);
  const Json expected = Json::parse(to_json(trace_loci(Model::parse(example("five_bar.yaml")))));
  ASSERT_EQ(answer["loci"]["curves"].size(), expected["curves"].size());
  for (std::size_t k = 0; k < expected["curves"].size(); ++k)
    for (const char* key : {"id", "kind", "vanishing", "implicit", "closed_form", "certified"})
      EXPECT_EQ(answer["loci"]["curves"][k][key], expected["curves"][k][key]) << key;
  EXPECT_FALSE(answer["curve_groups"].empty());
}

TEST_F(TheServer, SolvesPosesAndSketchesThem) {
  Json question = five_bar();
  question["at"] = {0.25, -0.7};
  const auto answer = Json::parse(server->ask("pose", question)->body);
  const Pose pose = solve_pose(Model::parse(example("five_bar.yaml")), {0.25, -0.7});
  EXPECT_DOUBLE_EQ(answer["determinant"], pose.determinant);
  EXPECT_EQ(answer["sketch"]["links"].size(), 4U);
  question["at"] = {5, 5};
  EXPECT_EQ(Json::parse(server->ask("pose", question)->body)["unreachable"], "B1");
}

TEST_F(TheServer, SaysWhatIsWrongInTheWordsOfTheCommandLine) {
  Json question = five_bar();
  std::string text = question["text"];
  text.replace(text.find("L: 0.5"), 6, "L: 0,5");
  question["text"] = text;
  question["file"] = "five_bar.yaml";
  const auto answer = server->ask("loci", question);
  EXPECT_EQ(answer->status, 422);
  const Json said = Json::parse(answer->body);
  try {
    Model::parse(text, "five_bar.yaml");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(said["error"], error.what());
    EXPECT_EQ(said["line"], error.position().line);
  }
}

TEST_F(TheServer, ImportsOtherProgramsFiles) {
  const auto file = [](const std::string& name) { return example("../tests/mechanism/import/files/" + name); };
  Json question = {{"text", file("pmks/address.txt")}, {"client", "test"}, {"clearance", "30 um"}};
  const Json found = Json::parse(server->ask("import", question)->body);
  EXPECT_EQ(found["source"], "PMKS+");
  EXPECT_NE(found["text"].get<std::string>().find("clearance: {radial: 30 um}"), std::string::npos);
  EXPECT_FALSE(found["notes"].empty());
  // Their text is asked what a mechanism file is asked.
  question.erase("clearance");
  EXPECT_FALSE(Json::parse(server->ask("loci", question)->body)["loci"]["isolated_points"].empty());
  // A URDF needs the file of its loops.
  question = {{"text", file("urdf/four_bar.urdf")}, {"client", "test"}, {"file", "four_bar.urdf"}};
  const Json open = Json::parse(server->ask("import", question)->body);
  question["side"] = file("urdf/four_bar.yaml");
  question["side_file"] = "four_bar.yaml";
  const Json closed = Json::parse(server->ask("import", question)->body);
  EXPECT_NE(open["text"], closed["text"]);
  EXPECT_NE(closed["text"].get<std::string>().find("loop_end"), std::string::npos);
  question = {{"text", file("linkage/curved_slot.linkage2")}, {"client", "test"}, {"file", "curved_slot.linkage2"}};
  const auto refused = server->ask("import", question);
  EXPECT_EQ(refused->status, 422);
  EXPECT_EQ(Json::parse(refused->body)["line"], 4);
}

TEST_F(TheServer, VerifiesTasksAndExportsWhatIsAskedFor) {
  Json question = five_bar();
  question["task"] = example("tasks/pick_and_place.yaml");
  EXPECT_EQ(Json::parse(server->ask("verify", question)->body)["verdict"], "verified");
  question["what"] = "loci";
  question["format"] = "dxf";
  const Json files = Json::parse(server->ask("export", question)->body)["files"];
  ASSERT_EQ(files.size(), 1U);
  EXPECT_EQ(files[0]["name"], "loci.dxf");
  question["format"] = "gpx";
  EXPECT_EQ(server->ask("export", question)->status, 422);
}

TEST_F(TheServer, VerifiesTasksOverAnglesToo) {
  Json question = {{"text", example("four_bar.yaml")}, {"client", "test"}};
  question["task"] = "format: 1\nbox: {theta: [250 deg, 280 deg]}\n";
  const Json verified = Json::parse(server->ask("verify", question)->body);
  EXPECT_EQ(verified["verdict"], "verified");
  EXPECT_GT(verified["angle_margin"], 0);
  question["fit"] = "smallest";
  EXPECT_EQ(server->ask("verify", question)->status, 400);
  question["fit"] = "largest";
  EXPECT_GT(Json::parse(server->ask("verify", question)->body)["scale"], 1);
  question.erase("fit");
  question["task"] = "format: 1\nbox: {theta: [10 deg, 40 deg]}\n";
  question["what"] = "verification";
  question["format"] = "json";
  const Json files = Json::parse(server->ask("export", question)->body)["files"];
  ASSERT_EQ(files.size(), 1U);
  EXPECT_EQ(files[0]["name"], "verify.json");
}

TEST(TheTimeLimit, IsKept) {
  const RunningServer server(0.001);
  const auto answer = server.ask("zones", {{"text", example("five_bar_weights.yaml")}});
  EXPECT_EQ(answer->status, 422);
  EXPECT_NE(answer->body.find("time limit"), std::string::npos);
}

/// Of many that ask the same question at once the newest is answered; the others hear that they were abandoned.
TEST(ANewerRequest, AbandonsTheOlder) {
  const RunningServer server;
  std::atomic<int> answered = 0, abandoned = 0;
  std::vector<std::thread> callers;
  for (int i = 0; i < 6; ++i) {
    callers.emplace_back([&] {
      const auto answer = server.ask("loci", {{"text", example("three_rrr.yaml")}, {"client", "one"}});
      if (answer && answer->status == 200) ++answered;
      if (answer && answer->status == 409) ++abandoned;
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  for (std::thread& caller : callers) caller.join();
  EXPECT_EQ(answered + abandoned, 6);
  EXPECT_GE(answered, 1);
  EXPECT_GE(abandoned, 1);
  EXPECT_EQ(server.ask("loci", {{"text", example("five_bar.yaml")}, {"client", "one"}})->status, 200);
}

}  // namespace
}  // namespace clearloci::workbench
