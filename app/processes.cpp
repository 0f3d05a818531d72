#include "processes.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <map>
#include <vector>

#include "osculate/core/error.hpp"

namespace osculate::app {
namespace {

struct Process {
  pid_t id = 0;
  int pipe = -1;
  ProcessEnd end;
};

[[noreturn]] void work_and_exit(int pipe, const std::function<std::string(std::size_t)>& work,
                                std::size_t i) {
  const std::string said = work(i);
  std::fflush(nullptr);
  for (std::size_t sent = 0; sent < said.size();) {
    const ssize_t n = write(pipe, said.data() + sent, said.size() - sent);
    if (n < 0 && errno != EINTR) _exit(1);
    if (n > 0) sent += static_cast<std::size_t>(n);
  }
  _exit(0);
}

Process start(const std::function<std::string(std::size_t)>& work, std::size_t i) {
  int ends[2];
  std::fflush(nullptr);
  if (pipe(ends) != 0) throw core::InputError({}, std::string("no pipe: ") + std::strerror(errno));
  const pid_t id = fork();
  if (id < 0) throw core::InputError({}, std::string("no process: ") + std::strerror(errno));
  if (id == 0) {
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    setpgid(0, 0);  // what the terminal sends comes by way of its parent, once
    close(ends[0]);
    try {
      work_and_exit(ends[1], work, i);
    } catch (...) {
      _exit(1);
    }
  }
  close(ends[1]);
  return {id, ends[0], {}};
}

/// Reads what there is; returns whether the process has ended.
bool read_from(Process& process) {
  char buffer[65536];
  const ssize_t n = read(process.pipe, buffer, sizeof buffer);
  if (n > 0) process.end.said.append(buffer, static_cast<std::size_t>(n));
  if (n > 0 || (n < 0 && errno == EINTR)) return false;
  close(process.pipe);
  int status = 0;
  while (waitpid(process.id, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFSIGNALED(status))
    process.end.fault =
        fmt::format("signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)));
  else if (WEXITSTATUS(status) != 0)
    process.end.fault = "no answer";
  return true;
}

}  // namespace

void run_processes(std::size_t count, int jobs, const std::function<std::string(std::size_t)>& work,
                   const std::function<void(std::size_t, const ProcessEnd&)>& take,
                   const std::function<int()>& interrupts) {
  constexpr int often = 200;  // milliseconds: an interrupt may come just before it is waited for
  std::map<std::size_t, Process> running;
  std::size_t next = 0;
  for (int told = 0;;) {
    const int asked = interrupts ? interrupts() : 0;
    for (; told < asked; ++told)
      for (const auto& [i, process] : running) kill(process.id, SIGTERM);
    for (; asked == 0 && next < count && running.size() < static_cast<std::size_t>(jobs); ++next)
      running.emplace(next, start(work, next));
    if (running.empty()) return;
    std::vector<pollfd> waiting;
    std::vector<std::size_t> of;
    for (const auto& [i, process] : running) {
      waiting.push_back({process.pipe, POLLIN, 0});
      of.push_back(i);
    }
    if (poll(waiting.data(), waiting.size(), interrupts ? often : -1) < 0) continue;
    for (std::size_t k = 0; k < of.size(); ++k)
      if (waiting[k].revents != 0 && read_from(running.at(of[k]))) {
        const ProcessEnd end = std::move(running.at(of[k]).end);
        running.erase(of[k]);
        take(of[k], end);
      }
  }
}

}  // namespace osculate::app
