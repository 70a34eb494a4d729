#include "server/server.h"

#include <cerrno>
#include <csignal>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

#include <boost/asio/basic_socket_acceptor.hpp>
#include <boost/asio/generic/stream_protocol.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

#include "base/errors.h"
#include "client/listening_socket.h"
#include "server/access.h"
#include "server/connection.h"
#include "server/request_desk.h"
#include "server/session.h"
#include "server/snapshot_pump.h"
#include "server/view_desk.h"

namespace understudy::server {
namespace {

namespace asio = boost::asio;
using Protocol = asio::generic::stream_protocol;
using boost::system::error_code;

// After a failed accept (no descriptors left), before the next.
constexpr std::chrono::milliseconds kAcceptPause{100};

// Starts a thread with signals blocked, so that handlers run in the main thread.
template <class Function>
std::thread StartWithoutSignals(Function function) {
  sigset_t all;
  sigset_t before;
  sigfillset(&all);
  ::pthread_sigmask(SIG_SETMASK, &all, &before);
  std::thread thread(std::move(function));
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  return thread;
}

// Accepts the clients of one listening socket.
class Acceptor {
 public:
  // `fd` is a listening socket and not owned; `family` is its address family.
  Acceptor(asio::io_context* io, int fd, int family, const AccessRules* access, Shared* shared)
      : shared_(shared),
        connections_(access, shared->limits.connections),
        acceptor_(*io),
        timer_(*io) {
    const int own = ::fcntl(fd, F_DUPFD_CLOEXEC, 0);
    if (own < 0) {
      throw SocketError("control socket: " + std::generic_category().message(errno));
    }
    acceptor_.assign(Protocol(family, 0), own);
    Accept();
  }

 private:
  void Accept() {
    acceptor_.async_accept([this](const error_code& error, Protocol::socket socket) {
      if (error) {
        timer_.expires_after(kAcceptPause);
        timer_.async_wait([this](const error_code&) { Accept(); });
        return;
      }
      if (connections_.MakeRoom()) {
        connections_.Add(std::make_shared<Session>(std::move(socket), &connections_, shared_));
      } else {
        Session::RefuseBusy(&socket);
      }
      Accept();
    });
  }

  Shared* shared_;
  Connections connections_;
  asio::basic_socket_acceptor<Protocol> acceptor_;
  asio::steady_timer timer_;
};

}  // namespace

class ControlServer::Loop {
 public:
  Loop(const std::filesystem::path& path, Plane plane, const ServerLimits& limits,
       const PanelSocket* panel)
      : shared_{.plane = std::move(plane), .limits = limits}, listening_(path) {
    shared_.plane.identity.version = UNDERSTUDY_VERSION;
    shared_.plane.identity.pid = ::getpid();
    if (shared_.plane.snapshots != nullptr) {
      shared_.pump = &pump_.emplace(&io_, shared_.plane.snapshots);
    }
    if (shared_.plane.inbox != nullptr) {
      shared_.desk = &desk_.emplace(&io_, shared_.plane.inbox, limits.patience);
    }
    if (shared_.plane.views != nullptr) {
      shared_.views = &views_.emplace(&io_, shared_.plane.views, limits.picture);
    }
    unix_.emplace(&io_, listening_.fd(), AF_UNIX, nullptr, &shared_);
    if (panel != nullptr) {
      access_ = {.token = panel->token(), .address = panel->address()};
      shared_.plane.url = panel->url();
      tcp_.emplace(&io_, panel->fd(), panel->family(), &access_, &shared_);
    }
    url_ = shared_.plane.url;
    ReadEvents();
    thread_ = StartWithoutSignals([this] { io_.run(); });
  }

  ~Loop() {
    io_.stop();
    thread_.join();
  }

  Loop(const Loop&) = delete;
  Loop& operator=(const Loop&) = delete;

  const std::filesystem::path& path() const { return listening_.path(); }
  const std::string& url() const { return url_; }

 private:
  void ReadEvents() {
    shared_.plane.events.Update();
    shared_.plane.sight.Rest();
    events_timer_.expires_after(kEventsEvery);
    events_timer_.async_wait([this](const error_code& error) {
      if (!error) ReadEvents();
    });
  }

  Shared shared_;
  AccessRules access_;
  std::string url_;
  client::ListeningSocket listening_;
  asio::io_context io_{1};
  asio::steady_timer events_timer_{io_};
  std::optional<SnapshotPump> pump_;
  std::optional<RequestDesk> desk_;
  std::optional<ViewDesk> views_;
  std::optional<Acceptor> unix_;
  std::optional<Acceptor> tcp_;
  std::thread thread_;
};

ControlServer::ControlServer(const std::filesystem::path& socket, Plane plane,
                             const ServerLimits& limits, const PanelSocket* panel)
    : loop_(std::make_unique<Loop>(socket, std::move(plane), limits, panel)) {}

ControlServer::~ControlServer() = default;

const std::filesystem::path& ControlServer::socket() const { return loop_->path(); }

const std::string& ControlServer::url() const { return loop_->url(); }

}  // namespace understudy::server
