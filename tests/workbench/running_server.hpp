// A server of the workbench that runs beside a test, and a caller that knows its token.
#pragma once

#include <httplib.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>

#include "tests/source_dir.hpp"
#include "workbench/server/server.hpp"

namespace clearloci::workbench {

inline std::string example(const std::string& name) {
  std::ifstream file(source_dir() + "/examples/" + name);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

class RunningServer {
 public:
  explicit RunningServer(double time_limit = 20)
      : RunningServer({.file = "five_bar.yaml",
                       .text = example("five_bar.yaml"),
                       .values = {},
                       .port = 0,
                       .time_limit = time_limit}) {}
  explicit RunningServer(ServerOptions options) : server_(std::move(options)), thread_([this] { server_.run(); }) {
    httplib::Client client("127.0.0.1", server_.port());
    while (!client.Get("/")) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  ~RunningServer() {
    server_.stop();
    thread_.join();
  }
  RunningServer(const RunningServer&) = delete;
  RunningServer& operator=(const RunningServer&) = delete;

  int port() const { return server_.port(); }
  std::string path(const std::string& below) const { return "/" + server_.token() + "/" + below; }
  httplib::Client client() const {
    httplib::Client client("127.0.0.1", server_.port());
    client.set_keep_alive(true);
    client.set_tcp_nodelay(true);
    client.set_read_timeout(60);
    return client;
  }

  httplib::Result ask(const std::string& question, const nlohmann::json& body) const {
    return client().Post(path("api/" + question), body.dump(), "application/json");
  }

 private:
  Server server_;
  std::thread thread_;
};

}  // namespace clearloci::workbench
