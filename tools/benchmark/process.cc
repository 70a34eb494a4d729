#include "process.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <ctime>
#include <fstream>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/errors.h"
#include "client/client.h"
#include "client/control_folder.h"

namespace understudy::bench {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kStartPatience(20'000);
constexpr milliseconds kReplyPatience(5'000);

nlohmann::json StatusAt(const std::filesystem::path& socket) {
  return nlohmann::json::parse(client::Call(socket, "GET", "/status", "", kReplyPatience).body);
}

pid_t Start(const std::vector<std::string>& arguments) {
  std::vector<char*> argv;
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.data()));
  argv.push_back(nullptr);
  const int nowhere = open("/dev/null", O_RDWR | O_CLOEXEC);
  const pid_t parent = getpid();
  const pid_t pid = fork();
  if (pid < 0) throw std::runtime_error(std::string("fork: ") + std::strerror(errno));
  if (pid == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(1);
    dup2(nowhere, STDIN_FILENO);
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
    execv(argv[0], argv.data());
    _exit(127);
  }
  close(nowhere);
  return pid;
}

std::vector<std::string> RunArguments(const std::string& understudy, const std::string& robot,
                                      const std::string& name,
                                      const std::vector<std::string>& options) {
  std::vector<std::string> arguments = {understudy, "run", robot, "--name", name};
  arguments.insert(arguments.end(), options.begin(), options.end());
  return arguments;
}

}  // namespace

double ThreadCpu() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

double CpuOfChildren() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

int Cores() {
  cpu_set_t set;
  CPU_ZERO(&set);
  return sched_getaffinity(0, sizeof(set), &set) == 0 ? CPU_COUNT(&set) : 1;
}

int RunToEnd(const std::vector<std::string>& arguments) {
  const pid_t pid = Start(arguments);
  int status = 0;
  while (waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

Process::Process(const std::vector<std::string>& arguments) : pid_(Start(arguments)) {}

Process::~Process() {
  kill(pid_, SIGTERM);
  Continue();
  waitpid(pid_, nullptr, 0);
}

void Process::Stop() const { kill(pid_, SIGSTOP); }

void Process::Continue() const { kill(pid_, SIGCONT); }

double Process::CpuOfFirstThread() const {
  const std::string pid = std::to_string(pid_);
  std::ifstream file("/proc/" + pid + "/task/" + pid + "/schedstat");
  double nanoseconds = 0;
  file >> nanoseconds;
  return nanoseconds * 1e-9;
}

double Megabytes(pid_t pid, const std::string& key) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/smaps_rollup");
  for (std::string word; file >> word;) {
    double kilobytes = 0;
    if (word == key && file >> kilobytes) return kilobytes / 1024;
  }
  return 0;
}

Daemon::Daemon(const std::string& understudy, const std::string& robot,
               const std::vector<std::string>& options, const std::string& name)
    : socket_(
          client::ControlSocket(client::DefaultName("bench") + (name.empty() ? "" : "-" + name))),
      process_(RunArguments(understudy, robot, client::DefaultName("bench"), options)) {}

void Daemon::AwaitReady() const {
  const auto until = std::chrono::steady_clock::now() + kStartPatience;
  while (std::chrono::steady_clock::now() < until) {
    try {
      if (StatusAt(socket_).at("ready").get<bool>()) return;
    } catch (const ControlError&) {  // it does not listen yet
    }
    std::this_thread::sleep_for(milliseconds(5));
  }
  throw std::runtime_error("the daemon did not become ready");
}

void Daemon::Ask(const std::string& path, const nlohmann::json& values) const {
  const client::ControlReply reply =
      client::Call(socket_, "POST", path, values.dump(), kReplyPatience);
  if (reply.status != 200) throw std::runtime_error(path + ": " + reply.body);
}

std::int64_t Daemon::Steps() const { return StatusAt(socket_).at("steps").get<std::int64_t>(); }

}  // namespace understudy::bench
