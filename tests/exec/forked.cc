#include "forked.h"

#include <array>
#include <csignal>
#include <exception>
#include <stdexcept>

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

namespace understudy::test {
namespace {

constexpr int kPatience_ms = 10000;

// One read; 0 at end of file, -1 when nothing came in time.
ssize_t ReadSome(int fd, char* buffer, std::size_t size) {
  pollfd wanted{.fd = fd, .events = POLLIN, .revents = 0};
  if (::poll(&wanted, 1, kPatience_ms) != 1) return -1;
  return ::read(fd, buffer, size);
}

}  // namespace

Pipe::Pipe() {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  out = UniqueFd(ends[0]);
  in = UniqueFd(ends[1]);
}

std::string ReadAll(int fd) {
  std::string text;
  std::array<char, 512> buffer{};
  for (;;) {
    const ssize_t got = ReadSome(fd, buffer.data(), buffer.size());
    if (got < 0) return text + "...timed out";
    if (got == 0) return text;
    text.append(buffer.data(), static_cast<std::size_t>(got));
  }
}

std::string ReadLine(int fd) {
  std::string line;
  for (char letter = 0;;) {
    const ssize_t got = ReadSome(fd, &letter, 1);
    if (got < 0) return line + "...timed out";
    if (got == 0 || letter == '\n') return line;
    line += letter;
  }
}

bool ReachesEnd(int fd) { return ReadAll(fd).find("...timed out") == std::string::npos; }

void WriteLine(int fd, const std::string& line) {
  const std::string text = line + "\n";
  if (::write(fd, text.data(), text.size()) != static_cast<ssize_t>(text.size())) {
    throw std::runtime_error("short write to a pipe");
  }
}

Forked::Forked(const std::function<std::string()>& body) {
  Pipe result;
  pid_ = ::fork();
  if (pid_ < 0) throw std::runtime_error("no fork");
  if (pid_ == 0) {
    ::alarm(20);
    result.out.reset();
    std::string text;
    try {
      text = body();
    } catch (const std::exception& error) {
      text = error.what();
    }
    WriteLine(result.in.get(), text);
    ::_exit(0);
  }
  out_ = std::move(result.out);
}

std::string Forked::Result() {
  std::string text = ReadAll(out_.get());
  int status = 0;
  ::waitpid(pid_, &status, 0);
  pid_ = -1;
  if (WIFSIGNALED(status)) return "signal " + std::to_string(WTERMSIG(status));
  if (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

void Forked::Kill() {
  if (pid_ < 0) return;
  ::kill(pid_, SIGKILL);
  ::waitpid(pid_, nullptr, 0);
  pid_ = -1;
}

Forked::~Forked() { Kill(); }

std::string InFork(const std::function<std::string()>& body) { return Forked(body).Result(); }

}  // namespace understudy::test
