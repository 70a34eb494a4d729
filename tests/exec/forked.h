// Runs tests that change the whole process in a forked one, with pipes to it.
#pragma once

#include <functional>
#include <string>

#include "base/unique_fd.h"

namespace understudy::test {

struct Pipe {
  Pipe();  // both ends close on exec
  UniqueFd out;
  UniqueFd in;
};

// Bytes until end of file, or until 10 s have brought nothing: then "...timed out" is appended.
std::string ReadAll(int fd);
// The same for one line, without its end.
std::string ReadLine(int fd);
// True once nobody holds the other end any more; false after 10 s.
bool ReachesEnd(int fd);
void WriteLine(int fd, const std::string& line);

// Runs `body` in a forked process and gives what it returned, the text of what it threw, or
// "signal n". An alarm ends a body that takes 20 s.
std::string InFork(const std::function<std::string()>& body);

// The same for a process that goes on beside the test; the destructor kills and reaps it.
class Forked {
 public:
  explicit Forked(const std::function<std::string()>& body);
  Forked(const Forked&) = delete;
  Forked& operator=(const Forked&) = delete;
  ~Forked();

  std::string Result();  // waits for the end; once
  void Kill();           // SIGKILL, and waits

 private:
  UniqueFd out_;
  int pid_ = -1;
};

}  // namespace understudy::test
