#include "run/camera_process.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <optional>
#include <system_error>

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/wait.h>

#include "base/errors.h"
#include "exec/socket_message.h"
#include "server/snapshot_json.h"

namespace understudy::run {
namespace {

// *Assumed*: a driver that takes longer hangs. The first picture takes a second.
constexpr timeval kMostWait{.tv_sec = 30, .tv_usec = 0};

std::string OrderText(const robot::CameraSpec& camera, const CameraProcess::Wanted& wanted) {
  return nlohmann::json{{"camera", camera.name},     {"width", camera.width},
                        {"height", camera.height},   {"focal", camera.focal},
                        {"centre", camera.centre},   {"distortion", camera.distortion},
                        {"quality", camera.quality}, {"video_hz", camera.video_hz},
                        {"range", camera.depth},     {"baseline", camera.baseline},
                        {"jpeg", wanted.jpeg},       {"frame", wanted.frame},
                        {"depth", wanted.depth},     {"again", wanted.again},
                        {"light", wanted.light},     {"noise", wanted.noise}}
      .dump();
}

// Behind the "+": the lengths of JPEG and depth in four bytes each, the JPEG, the depth, the frame.
CameraProcess::Drawn ReadDrawn(const std::string& reply) {
  std::array<std::uint32_t, 2> lengths{};
  constexpr std::size_t kHead = 1 + sizeof lengths;
  if (reply.size() >= kHead) std::memcpy(lengths.data(), reply.data() + 1, sizeof lengths);
  if (reply.size() < kHead || reply.size() - kHead < std::uint64_t{lengths[0]} + lengths[1]) {
    throw SetupError("the program that draws is of another version");
  }
  const auto jpeg = reply.begin() + kHead, depth = jpeg + lengths[0], frame = depth + lengths[1];
  return {.jpeg = {jpeg, depth}, .depth = {depth, frame}, .frame = {frame, reply.end()}};
}

}  // namespace

CameraProcess::CameraProcess(const std::filesystem::path& program,
                             const std::filesystem::path& control_socket) {
  const auto fail = [&](int error) {
    throw SetupError(program.string() +
                     " cannot be run: " + std::generic_category().message(error) +
                     (error == ENOENT ? "; it is built where libglfw3-dev, libegl-dev, "
                                        "libturbojpeg0-dev and libx264-dev are"
                                      : ""));
  };
  std::array<int, 2> ends{-1, -1};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) fail(errno);
  socket_ = UniqueFd(ends[0]);
  const UniqueFd its(ends[1]);
  ::setsockopt(socket_.get(), SOL_SOCKET, SO_RCVTIMEO, &kMostWait, sizeof kMostWait);

  std::string file = program.string(), command = "camera", where = control_socket.string();
  std::array<char*, 4> arguments{file.data(), command.data(), where.data(), nullptr};
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, its.get(), STDIN_FILENO);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  // Without our signals: Ctrl-C reaches only us, and we then end it.
  sigset_t none, all;
  sigemptyset(&none);
  sigfillset(&all);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setsigdefault(&attributes, &all);
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setflags(&attributes,
                           POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
  const int error =
      ::posix_spawn(&pid_, file.c_str(), &files, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  if (error != 0) fail(error);
}

CameraProcess::~CameraProcess() {
  ::kill(pid_, SIGKILL);
  while (::waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

CameraProcess::Drawn CameraProcess::Draw(const robot::CameraSpec& camera, const Wanted& wanted,
                                         const emulator::Snapshot& state) {
  const bool sent = exec::SendMessage(socket_.get(), OrderText(camera, wanted)) &&
                    exec::SendMessage(socket_.get(), server::SnapshotJson(state, kParts));
  const std::optional<std::string> reply =
      sent ? exec::ReceiveMessage(socket_.get()) : std::nullopt;
  if (!reply || reply->empty()) throw SetupError("the program that draws has ended or hangs");
  if (reply->front() != '+') throw SetupError(reply->substr(1));
  return ReadDrawn(*reply);
}

void CameraProcess::Interrupt() const { ::shutdown(socket_.get(), SHUT_RDWR); }

}  // namespace understudy::run
