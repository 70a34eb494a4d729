// Helpers for the tests of the control plane.
#pragma once

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>

#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/un.h>
#include <unistd.h>

#include "emulator/inbox.h"
#include "emulator/snapshot_mailbox.h"
#include "tests/support/eventually.h"
#include "tests/support/temporary_folder.h"

namespace understudy::test {

// An upper bound, even on slow machines, for operations that should be immediate.
inline constexpr std::chrono::seconds kBound{10};

// Sets, or with nullopt unsets, an environment variable until the end of the scope.
class ScopedEnv {
 public:
  ScopedEnv(const char* name, const std::optional<std::string>& value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before;
    Set(value);
  }
  ~ScopedEnv() { Set(before_); }
  ScopedEnv(const ScopedEnv&) = delete;
  ScopedEnv& operator=(const ScopedEnv&) = delete;

 private:
  void Set(const std::optional<std::string>& value) {
    value ? ::setenv(name_, value->c_str(), 1) : ::unsetenv(name_);
  }

  const char* name_;
  std::optional<std::string> before_;
};

// A plain Unix or TCP socket, for clients that misbehave.
class RawSocket {
 public:
  explicit RawSocket(int family = AF_UNIX) : fd_(::socket(family, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    const timeval bound{.tv_sec = kBound.count(), .tv_usec = 0};
    ::setsockopt(fd_, SOL_SOCKET, SO_RCVTIMEO, &bound, sizeof bound);
    ::setsockopt(fd_, SOL_SOCKET, SO_SNDTIMEO, &bound, sizeof bound);
  }
  explicit RawSocket(const std::filesystem::path& peer) : RawSocket() {
    const sockaddr_un address = AddressOf(peer);
    if (::connect(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
      throw std::runtime_error("connect");
    }
  }
  static std::unique_ptr<RawSocket> ToPort(int port) {
    auto socket = std::make_unique<RawSocket>(AF_INET);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (::connect(socket->fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
      throw std::runtime_error("connect");
    }
    return socket;
  }
  ~RawSocket() { Close(); }
  RawSocket(const RawSocket&) = delete;
  RawSocket& operator=(const RawSocket&) = delete;

  void Close() {
    if (fd_ >= 0) ::close(fd_);
    fd_ = -1;
  }
  bool Bind(const std::filesystem::path& path) const {
    const sockaddr_un address = AddressOf(path);
    return ::bind(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  }
  bool Listen() const { return ::listen(fd_, 1) == 0; }
  void Send(std::string_view bytes) const {
    while (!bytes.empty()) {
      const ssize_t sent = ::send(fd_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (sent <= 0) return;  // the other side has heard enough
      bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
  }
  // Says that nothing more comes.
  void HangUp() const { ::shutdown(fd_, SHUT_WR); }
  // Whether somebody is there to take it.
  bool Sends(std::string_view bytes) const {
    return ::send(fd_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT) >= 0;
  }
  // Until `end` has come in, or the other side hangs up.
  std::string Receive(std::string_view end) const {
    std::string text;
    char bytes[4096];
    while (text.find(end) == std::string::npos) {
      const ssize_t got = ::recv(fd_, bytes, sizeof bytes, 0);
      if (got < 0 && errno == EINTR) continue;  // libFuzzer's clock
      // A reset: it hung up without having read all that was sent.
      if (got == 0 || (got < 0 && errno == ECONNRESET)) break;
      if (got < 0) throw std::runtime_error("recv");
      text.append(bytes, static_cast<std::size_t>(got));
    }
    return text;
  }
  // Until the other side hangs up.
  std::string ReceiveAll() const { return Receive("\x01nobody says this\x02"); }

 private:
  static sockaddr_un AddressOf(const std::filesystem::path& path) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path.native().copy(address.sun_path, sizeof(address.sun_path) - 1);
    return address;
  }

  int fd_;
};

// What a process that was killed leaves behind.
inline void LeaveStaleSocket(const std::filesystem::path& path) {
  const RawSocket socket;
  if (!socket.Bind(path) || !socket.Listen()) throw std::runtime_error("bind");
}

// Drains an inbox about every millisecond, as a robot does.
class Ticking {
 public:
  Ticking(emulator::Inbox* inbox,
          std::function<emulator::Answer(const emulator::Request&)> carry_out)
      : thread_([this, inbox, carry_out = std::move(carry_out)] {
          while (!stop_) {
            inbox->Drain([&](emulator::Request* request, emulator::Reply*) {
              return std::optional(carry_out(*request));
            });
            std::this_thread::sleep_for(std::chrono::milliseconds{1});
          }
        }) {}
  ~Ticking() {
    stop_ = true;
    thread_.join();
  }
  Ticking(const Ticking&) = delete;
  Ticking& operator=(const Ticking&) = delete;

 private:
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

// Shows the snapshot that is wanted about every millisecond, as a robot does.
class Showing {
 public:
  explicit Showing(emulator::SnapshotMailbox* snapshots)
      : thread_([this, snapshots] {
          for (; !stop_; std::this_thread::sleep_for(std::chrono::milliseconds{1})) {
            emulator::Snapshot* snapshot = snapshots->Wanted();
            if (snapshot == nullptr) continue;
            snapshot->step = ++shown_;
            snapshots->Post();
          }
        }) {}
  ~Showing() {
    stop_ = true;
    thread_.join();
  }
  std::int64_t shown() const { return shown_; }
  Showing(const Showing&) = delete;
  Showing& operator=(const Showing&) = delete;

 private:
  std::atomic<bool> stop_ = false;
  std::atomic<std::int64_t> shown_ = 0;
  std::thread thread_;
};

}  // namespace understudy::test
