#include "http_server.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <exception>
#include <string_view>

#include "osculate/core/error.hpp"

namespace osculate::app {
namespace {

constexpr std::size_t longest_request = 16384;

std::string_view reason_of(int status) {
  switch (status) {
    case 200:
      return "OK";
    case 400:
      return "Bad Request";
    case 403:
      return "Forbidden";
    case 404:
      return "Not Found";
    case 405:
      return "Method Not Allowed";
    default:
      return "Internal Server Error";
  }
}

/// What stands for `%41` and the like; a percent sign that begins nothing stands for itself.
std::string decoded(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto digit = [&](std::size_t at) {
      return at < text.size() && std::isxdigit(static_cast<unsigned char>(text[at])) != 0;
    };
    if (text[i] == '%' && digit(i + 1) && digit(i + 2)) {
      out += static_cast<char>(std::stoi(std::string(text.substr(i + 1, 2)), nullptr, 16));
      i += 2;
    } else {
      out += text[i];
    }
  }
  return out;
}

HttpRequest request_of(std::string_view target) {
  HttpRequest request;
  const std::size_t mark = std::min(target.find('?'), target.size());
  request.path = decoded(target.substr(0, mark));
  std::string_view rest = target.substr(std::min(mark + 1, target.size()));
  while (!rest.empty()) {
    const std::string_view one = rest.substr(0, rest.find('&'));
    const std::size_t equals = std::min(one.find('='), one.size());
    request.parameters[decoded(one.substr(0, equals))] =
        decoded(one.substr(std::min(equals + 1, one.size())));
    rest.remove_prefix(std::min(one.size() + 1, rest.size()));
  }
  return request;
}

/// The value of a header, without blanks around it; empty: there is none.
std::string header_of(std::string_view head, std::string_view name) {
  for (std::size_t at = head.find("\r\n"); at != std::string_view::npos;
       at = head.find("\r\n", at + 2)) {
    std::string_view line = head.substr(at + 2, head.find("\r\n", at + 2) - at - 2);
    if (line.size() <= name.size() || line[name.size()] != ':' ||
        !std::equal(name.begin(), name.end(), line.begin(), [](char a, char b) {
          return a == std::tolower(static_cast<unsigned char>(b));
        }))
      continue;
    line.remove_prefix(name.size() + 1);
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    return std::string(line.substr(0, line.find_last_not_of(" \t") + 1));
  }
  return {};
}

/// All of it, unless the client takes nothing for ten seconds, or `ending`.
void send_all(int connection, std::string_view bytes, const std::atomic<bool>& ending) {
  using namespace std::chrono_literals;
  constexpr int often = 100;  // milliseconds
  constexpr auto patience = 10s;
  auto last = std::chrono::steady_clock::now();
  while (!bytes.empty() && !ending && std::chrono::steady_clock::now() - last < patience) {
    pollfd waiting{connection, POLLOUT, 0};
    if (::poll(&waiting, 1, often) <= 0) continue;
    const ssize_t n = ::send(connection, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (n < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (n <= 0) return;
    bytes.remove_prefix(static_cast<std::size_t>(n));
    last = std::chrono::steady_clock::now();
  }
}

/// Up to the empty line behind the headers; empty: it did not come in time, or `ending`.
std::string head_from(int connection, const std::atomic<bool>& ending) {
  using namespace std::chrono_literals;
  constexpr int often = 100;  // milliseconds
  const auto end_of_patience = std::chrono::steady_clock::now() + 5s;
  std::string head;
  std::array<char, 4096> buffer{};
  while (std::chrono::steady_clock::now() < end_of_patience && !ending) {
    pollfd waiting{connection, POLLIN, 0};
    if (::poll(&waiting, 1, often) <= 0) continue;
    const ssize_t n = ::recv(connection, buffer.data(), buffer.size(), 0);
    if (n <= 0 || head.size() + static_cast<std::size_t>(n) > longest_request) return {};
    head.append(buffer.data(), static_cast<std::size_t>(n));
    if (const std::size_t end = head.find("\r\n\r\n"); end != std::string::npos)
      return head.substr(0, end);
  }
  return {};
}

/// Browsers leave the port out where it is that of HTTP.
bool is_this_machine(std::string_view host, int port) {
  constexpr int http = 80;
  for (const std::string_view name : {"127.0.0.1", "localhost"})
    if (host == fmt::format("{}:{}", name, port) || (port == http && host == name)) return true;
  return false;
}

HttpAnswer refused(int status, std::string text) { return {status, "text/plain", text + "\n"}; }

}  // namespace

HttpServer::HttpServer(int port, Answer answer) : answer_(std::move(answer)) {
  socket_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const int yes = 1;
  if (socket_ >= 0) ::setsockopt(socket_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  socklen_t size = sizeof address;
  auto* const any = reinterpret_cast<sockaddr*>(&address);
  if (socket_ < 0 || ::bind(socket_, any, size) != 0 || ::listen(socket_, SOMAXCONN) != 0 ||
      ::getsockname(socket_, any, &size) != 0) {
    const std::string reason = std::strerror(errno);
    if (socket_ >= 0) ::close(socket_);
    throw core::InputError({},
                           fmt::format("cannot listen at port {} of 127.0.0.1: {}", port, reason));
  }
  port_ = ntohs(address.sin_port);
  listener_ = std::thread([this] { listen(); });
}

HttpServer::~HttpServer() {
  using namespace std::chrono_literals;
  ending_ = true;
  listener_.join();
  ::close(socket_);
  while (open_ > 0) std::this_thread::sleep_for(1ms);
}

void HttpServer::listen() {
  using namespace std::chrono_literals;
  constexpr int often = 100, most = 64;  // milliseconds, connections
  while (!ending_) {
    pollfd waiting{socket_, POLLIN, 0};
    if (::poll(&waiting, 1, often) <= 0) continue;
    const int connection = ::accept4(socket_, nullptr, nullptr, SOCK_CLOEXEC);
    if (connection < 0) {  // with all files in use, say, it would fail again at once
      if (errno != EINTR && errno != ECONNABORTED) std::this_thread::sleep_for(100ms);
      continue;
    }
    if (open_ >= most) {
      ::close(connection);
      continue;
    }
    ++open_;
    try {
      std::thread([this, connection] {
        try {
          serve(connection);
        } catch (const std::exception&) {  // no memory for an answer: there is none
        }
        ::close(connection);
        --open_;
      }).detach();
    } catch (const std::exception&) {  // no thread is to be had, or no memory
      ::close(connection);
      --open_;
    }
  }
}

void HttpServer::serve(int connection) {
  const std::string head = head_from(connection, ending_);
  if (head.empty()) return;
  const std::string_view first = std::string_view(head).substr(0, head.find("\r\n"));
  const std::size_t method = first.find(' '), target = first.rfind(' ');
  HttpAnswer answer;
  if (method == std::string_view::npos || target <= method ||
      !first.substr(target + 1).starts_with("HTTP/1."))
    answer = refused(400, "no request of HTTP/1");
  else if (first.substr(0, method) != "GET")
    answer = refused(405, "only GET is answered");
  else if (!is_this_machine(header_of(head, "host"), port_))
    answer = refused(403, "only requests to 127.0.0.1 and localhost are answered");
  else
    try {
      const std::lock_guard<std::mutex> one_at_a_time(one_);
      answer = answer_(request_of(first.substr(method + 1, target - method - 1)));
    } catch (const std::exception& error) {
      answer = refused(500, error.what());
    }
  send_all(connection,
           fmt::format("HTTP/1.1 {} {}\r\nContent-Type: {}\r\nContent-Length: {}\r\n"
                       "Cache-Control: no-store\r\nX-Content-Type-Options: nosniff\r\n"
                       "Cross-Origin-Resource-Policy: same-origin\r\n{}Connection: close\r\n\r\n",
                       answer.status, reason_of(answer.status), answer.type, answer.body.size(),
                       answer.status == 405 ? "Allow: GET\r\n" : ""),
           ending_);
  send_all(connection, answer.body, ending_);
}

}  // namespace osculate::app
