#pragma once
#include <atomic>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>

namespace osculate::app {

/// What was asked for: `/state.json?from=3` has the path `/state.json` and one parameter.
struct HttpRequest {
  std::string path;
  std::map<std::string, std::string> parameters;
};

struct HttpAnswer {
  int status = 200;
  std::string type = "text/plain; charset=utf-8";
  std::string body;
};

/// Answers GET requests of programs of this machine: it listens at 127.0.0.1 alone, and answers
/// none that was sent to a name of another machine (a page of the network whose name has been
/// given this address). One request a connection, at most 64 at a time.
///
/// Why no library: docs/decisions/087-view.md
/// Tested by  tests/system/test_view.py
class HttpServer {
 public:
  using Answer = std::function<HttpAnswer(const HttpRequest&)>;
  /// Listens at the port, 0: at any that is free; requests are answered one after the other.
  ///
  /// Errors     core::InputError: the port is taken, or may not be listened at
  HttpServer(int port, Answer answer);
  /// Ends within a moment: answers that clients have not taken yet are cut off.
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;
  [[nodiscard]] int port() const { return port_; }

 private:
  void listen();
  void serve(int connection);
  Answer answer_;
  int socket_ = -1, port_ = 0;
  std::atomic<bool> ending_{false};
  std::atomic<int> open_{0};
  std::mutex one_;
  std::thread listener_;
};

}  // namespace osculate::app
