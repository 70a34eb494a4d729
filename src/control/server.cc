// The only file of the server that sees Boost, which takes long to compile.
#include "control/server.h"

#include <cerrno>
#include <csignal>
#include <functional>
#include <future>
#include <optional>
#include <system_error>
#include <thread>
#include <unordered_map>
#include <utility>
#include <variant>

#include <boost/asio/io_context.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <fcntl.h>
#include <unistd.h>

#include "control/control_error.h"
#include "control/listening_socket.h"
#include "control/routes.h"

namespace understudy {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
using Protocol = asio::local::stream_protocol;
using boost::system::error_code;
using std::chrono::steady_clock;

// How often a waiting session looks for its answer: well above a tick, well below a person's
// notice.
constexpr std::chrono::milliseconds kAnswerPoll{2};
// After a failed accept (no descriptors left), before the next.
constexpr std::chrono::milliseconds kAcceptPause{100};

std::string_view View(beast::string_view text) { return {text.data(), text.size()}; }

http::response<http::string_body> ResponseOf(const HttpReply& reply, bool keep_alive) {
  http::response<http::string_body> response(http::int_to_status(reply.status), 11);
  response.set(http::field::content_type, "application/json");
  response.set(http::field::cache_control, "no-store");
  if (!reply.allow.empty()) response.set(http::field::allow, reply.allow);
  response.keep_alive(keep_alive);
  response.body() = reply.body;
  response.prepare_payload();
  return response;
}

// The reply to a request that broke off with `error`; nullopt where nobody is left to read one.
std::optional<HttpReply> ReplyToBroken(const error_code& error, const ServerLimits& limits) {
  static const auto& kHttp = http::make_error_code(http::error::bad_method).category();
  if (error == http::error::end_of_stream || error.category() != kHttp) return std::nullopt;
  if (error == http::error::body_limit) {
    return ErrorReply(413,
                      "the body has more than " + std::to_string(limits.body_bytes) + " bytes");
  }
  if (error == http::error::header_limit || error == http::error::buffer_overflow) {
    return ErrorReply(431,
                      "the header has more than " + std::to_string(limits.header_bytes) + " bytes");
  }
  return ErrorReply(400, "not an HTTP request: " + error.message());
}

// A thread on which no signal handler runs: those belong to the main thread.
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

class Session;

// What all sessions of a server share. Outlives them.
struct Shared {
  RobotIdentity identity;
  const StatusBoard* board;
  Inbox* inbox;
  ServerLimits limits;
  std::function<void(Session*)> done;  // destroys a session
};

// One connection: read a request, perhaps wait for its answer, write the reply, again. There is one
// pending operation at any time, and whichever finds that there is nothing more to do calls
// Shared::done.
class Session {
 public:
  Session(Protocol::socket socket, const Shared& shared)
      : shared_(shared),
        stream_(std::move(socket)),
        // Room for a header beside the first part of a body.
        buffer_(shared.limits.header_bytes + 4096),
        answer_timer_(stream_.get_executor()) {}

  void Read() {
    parser_.emplace();
    parser_->header_limit(static_cast<std::uint32_t>(shared_.limits.header_bytes));
    parser_->body_limit(shared_.limits.body_bytes);
    stream_.expires_after(shared_.limits.idle);
    http::async_read(stream_, buffer_, *parser_,
                     [this](const error_code& error, std::size_t) { OnRead(error); });
  }

 private:
  void OnRead(const error_code& error) {
    if (error) {
      const std::optional<HttpReply> reply = ReplyToBroken(error, shared_.limits);
      if (!reply) return shared_.done(this);
      return Write(*reply, false);
    }
    const auto& request = parser_->get();
    const auto routed = Route({.method = View(request.method_string()),
                               .target = View(request.target()),
                               .body = request.body()},
                              shared_.identity, *shared_.board);
    if (const auto* reply = std::get_if<HttpReply>(&routed)) return Write(*reply);
    answer_until_ = steady_clock::now() + shared_.limits.patience;
    answer_ = shared_.inbox->Put(std::get<Order>(routed), answer_until_);
    if (!answer_) return Write(ErrorReply(503, "the robot is busy: too many orders wait"));
    AwaitAnswer();
  }

  void AwaitAnswer() {
    answer_timer_.expires_after(kAnswerPoll);
    answer_timer_.async_wait([this](const error_code&) {
      if (answer_->wait_for(std::chrono::seconds{0}) == std::future_status::ready) {
        return Write(AnswerReply(answer_->get()));
      }
      // Ten polls of grace: the tick may have begun on the order just before its time was up.
      if (steady_clock::now() < answer_until_ + 10 * kAnswerPoll) return AwaitAnswer();
      Write(ErrorReply(503, "the robot did not come to the order in time; it is withdrawn"));
    });
  }

  void Write(const HttpReply& reply) { Write(reply, parser_->get().keep_alive()); }

  void Write(const HttpReply& reply, bool keep_alive) {
    response_ = ResponseOf(reply, keep_alive);
    stream_.expires_after(shared_.limits.idle);
    http::async_write(stream_, response_, [this](const error_code& error, std::size_t) {
      if (error || !response_.keep_alive()) return shared_.done(this);
      Read();
    });
  }

  const Shared& shared_;
  beast::basic_stream<Protocol> stream_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::string_body>> parser_;
  http::response<http::string_body> response_;
  asio::steady_timer answer_timer_;
  std::optional<std::future<Answer>> answer_;
  steady_clock::time_point answer_until_;
};

}  // namespace

class ControlServer::Loop {
 public:
  Loop(const std::filesystem::path& path, Shared shared)
      : shared_(std::move(shared)), listening_(path), acceptor_(io_), accept_timer_(io_) {
    shared_.done = [this](Session* session) { sessions_.erase(session); };
    const int fd = ::fcntl(listening_.fd(), F_DUPFD_CLOEXEC, 0);
    if (fd < 0) {
      throw SocketError("control socket " + path.string() + ": " +
                        std::generic_category().message(errno));
    }
    acceptor_.assign(Protocol{}, fd);
    Accept();
    thread_ = StartWithoutSignals([this] { io_.run(); });
  }

  ~Loop() {
    io_.stop();
    thread_.join();
  }

  Loop(const Loop&) = delete;
  Loop& operator=(const Loop&) = delete;

  const std::filesystem::path& path() const { return listening_.path(); }

 private:
  void Accept() {
    acceptor_.async_accept([this](const error_code& error, Protocol::socket socket) {
      if (error) {
        accept_timer_.expires_after(kAcceptPause);
        accept_timer_.async_wait([this](const error_code&) { Accept(); });
        return;
      }
      if (sessions_.size() < shared_.limits.connections) {
        Begin(std::move(socket));
      } else {
        TurnAway(&socket);
      }
      Accept();
    });
  }

  void Begin(Protocol::socket socket) {
    auto session = std::make_unique<Session>(std::move(socket), shared_);
    Session* const key = session.get();
    sessions_.emplace(key, std::move(session));
    key->Read();
  }

  // Says why, as far as that goes without waiting.
  static void TurnAway(Protocol::socket* socket) {
    error_code ignored;
    socket->non_blocking(true, ignored);
    http::response<http::string_body> response =
        ResponseOf(ErrorReply(503, "too many clients are connected"), false);
    http::write(*socket, response, ignored);
  }

  Shared shared_;
  ListeningSocket listening_;
  asio::io_context io_{1};
  Protocol::acceptor acceptor_;
  asio::steady_timer accept_timer_;
  std::unordered_map<Session*, std::unique_ptr<Session>> sessions_;
  std::thread thread_;
};

ControlServer::ControlServer(const std::filesystem::path& socket, const std::string& robot,
                             const StatusBoard* board, Inbox* inbox, const ServerLimits& limits,
                             Draws draws)
    : loop_(std::make_unique<Loop>(socket, Shared{.identity = {.robot = robot,
                                                               .version = UNDERSTUDY_VERSION,
                                                               .pid = ::getpid(),
                                                               .draws = std::move(draws)},
                                                  .board = board,
                                                  .inbox = inbox,
                                                  .limits = limits,
                                                  .done = {}})) {}

ControlServer::~ControlServer() = default;

const std::filesystem::path& ControlServer::socket() const { return loop_->path(); }

}  // namespace understudy
