// `clearloci view`: a server for one page in a browser of this machine.
//
// It listens on 127.0.0.1 alone and answers only below its token, /TOKEN/..., which a page of another origin cannot
// know; a Host or an Origin that is not its own is refused beside. It reads no file and writes none: the mechanism
// comes with the request. Whatever is asked wrongly is answered 4xx with {"error": one sentence}.
//
//     workbench::Server server({.file = "five_bar.yaml", .text = ...});
//     std::cout << server.address() << "\n";
//     server.run();   // until stop()
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace clearloci::workbench {

struct ServerOptions {
  std::string file, text;                                   ///< the model to begin with; both empty: none
  std::vector<std::pair<std::string, std::string>> values;  ///< of its parameters, put in by the page
  int port = 0;                                             ///< 0: any that is free
  double time_limit = 20;                                   ///< s an answer may take
};

class Server {
 public:
  /// Binds the port; throws InputError where it is taken.
  explicit Server(ServerOptions options);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  int port() const;
  const std::string& token() const;
  std::string address() const;  ///< "http://127.0.0.1:PORT/TOKEN/"

  void run();   ///< answers until it is stopped
  void stop();  ///< from another thread

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace clearloci::workbench
