// Programs that are measured from outside.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>
#include <sys/types.h>

namespace understudy::bench {

// Seconds of CPU that this thread has had.
double ThreadCpu();

// Seconds of CPU of the children that have ended, and of theirs.
double CpuOfChildren();

// On which this program may run.
int Cores();

// Runs a program silently to its end and returns its exit code; -1 if a signal ended it.
int RunToEnd(const std::vector<std::string>& arguments);

// Memory of a program in MB, by a key of its smaps_rollup: what is shared with other processes
// counts in proportion ("Pss:") or in full ("Rss:"). 0 if there is none.
double Megabytes(pid_t pid, const std::string& key);

// A child that is silent and ends with this object.
class Process {
 public:
  // Throws std::runtime_error when it cannot be started; a program that is not there shows as an
  // early end.
  explicit Process(const std::vector<std::string>& arguments);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  pid_t pid() const { return pid_; }
  // Takes the processor from it, or gives it back.
  void Stop() const;
  void Continue() const;
  // Seconds of CPU that the first thread has had.
  double CpuOfFirstThread() const;

 private:
  pid_t pid_;
};

// `understudy run ROBOT`, alone on lo in domain 0 of the network of this process.
class Daemon {
 public:
  // Requests go to the robot, or to the one of that name if `options` name others beside it.
  Daemon(const std::string& understudy, const std::string& robot,
         const std::vector<std::string>& options, const std::string& name = "");

  const Process& process() const { return process_; }
  const std::filesystem::path& socket() const { return socket_; }  // of its control
  // Waits until it says so. Throws std::runtime_error after 20 s.
  void AwaitReady() const;
  // A request by its path. Throws std::runtime_error where it is refused.
  void Ask(const std::string& path, const nlohmann::json& values) const;
  // Physics steps since start, as it tells by itself.
  std::int64_t Steps() const;

 private:
  std::filesystem::path socket_;
  Process process_;
};

}  // namespace understudy::bench
