// The HTTP and WebSocket client. Only this file of the client includes Boost, which compiles
// slowly.
#include "client/client.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>

#include "base/errors.h"
#include "client/control_folder.h"
#include "client/listening_socket.h"

namespace understudy::client {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
using Protocol = asio::local::stream_protocol;
using boost::system::error_code;

constexpr std::uint64_t kLargestReply = 1 << 30;  // *assumed*, a model with meshes has some 10 MB

std::string Why(const error_code& error, std::chrono::milliseconds timeout) {
  if (error == beast::error::timeout) {
    return "did not answer within " + std::to_string(timeout.count()) + " ms";
  }
  return "broke off: " + error.message();
}

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = boost::beast::websocket;
using Protocol = asio::local::stream_protocol;
using boost::system::error_code;

constexpr std::size_t kLargestMessage = 16 << 20;  // *assumed*, a snapshot has some kB

}  // namespace

std::vector<RunningRobot> FindRobots() {
  const std::filesystem::path folder = ControlFolder();
  std::error_code error;
  if (!std::filesystem::exists(folder, error)) return {};
  CheckControlFolder(folder);

  std::vector<RunningRobot> robots;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::filesystem::path& path = entry->path();
    if (path.extension() != ".sock") continue;
    const SocketProbe probe = ProbeSocket(path);
    if (probe.state == SocketState::kStale) RemoveIfStale(path);
    if (probe.state != SocketState::kAlive) continue;
    robots.push_back({.name = path.stem(), .socket = path, .pid = probe.pid});
  }
  std::sort(robots.begin(), robots.end(),
            [](const RunningRobot& a, const RunningRobot& b) { return a.name < b.name; });
  return robots;
}

struct ControlConnection::Stream {
  asio::io_context io{1};
  beast::basic_stream<Protocol> stream{io};
  beast::flat_buffer buffer;
};

ControlConnection::ControlConnection(const std::filesystem::path& socket,
                                     std::chrono::milliseconds timeout)
    : socket_(socket), stream_(std::make_unique<Stream>()) {
  CheckSocketPath(socket);
  error_code connecting;
  stream_->stream.expires_after(timeout);
  stream_->stream.async_connect(Protocol::endpoint{socket.native()},
                                [&](const error_code& error) { connecting = error; });
  stream_->io.run();
  if (connecting) {
    throw ControlError("no robot answers at " + socket.string() + ": " + connecting.message());
  }
}

ControlConnection::~ControlConnection() = default;

ControlReply ControlConnection::Ask(const std::string& method, const std::string& path,
                                    const std::string& body, std::chrono::milliseconds timeout,
                                    bool last) {
  http::request<http::string_body> request;
  request.version(11);
  request.method_string(method);
  request.target(path);
  request.set(http::field::host, "localhost");
  request.keep_alive(!last);
  request.body() = body;
  if (!body.empty()) request.set(http::field::content_type, "application/json");
  request.prepare_payload();

  http::response_parser<http::string_body> response;
  response.body_limit(kLargestReply);
  error_code reading;
  const auto read = [&](const error_code& error, std::size_t) {
    reading = error;
    // A server that refuses a request may close before it has read all of it. Its reply can be read
    // nevertheless.
    if (error == beast::error::timeout) return;
    http::async_read(stream_->stream, stream_->buffer, response,
                     [&](const error_code& failed, std::size_t) { reading = failed; });
  };
  stream_->io.restart();
  stream_->stream.expires_after(timeout);
  http::async_write(stream_->stream, request, read);
  stream_->io.run();
  if (reading) throw ControlError("the robot at " + socket_.string() + " " + Why(reading, timeout));
  return {.status = response.get().result_int(), .body = std::move(response.get().body())};
}

ControlReply Call(const std::filesystem::path& socket, const std::string& method,
                  const std::string& path, const std::string& body,
                  std::chrono::milliseconds timeout) {
  return ControlConnection(socket, timeout).Ask(method, path, body, timeout, true);
}

class ControlStream::Impl {
 public:
  Impl(const std::filesystem::path& socket, const std::string& target,
       std::chrono::milliseconds timeout)
      : socket_(socket), timeout_(timeout), stream_(io_) {
    CheckSocketPath(socket);
    error_code failed;
    const auto done = [&](const error_code& error) { failed = error; };
    Lowest().expires_after(timeout_);
    Lowest().async_connect(Protocol::endpoint{socket.native()}, done);
    Run();
    if (failed) {
      throw ControlError("no robot answers at " + socket.string() + ": " + failed.message());
    }
    stream_.read_message_max(kLargestMessage);
    stream_.auto_fragment(false);
    stream_.text(true);
    websocket::response_type response;
    Lowest().expires_after(timeout_);
    stream_.async_handshake(response, "localhost", target, done);
    Run();
    if (failed) Refuse(failed, response.body());
  }

  std::string Next() {
    error_code failed;
    std::string message;
    auto buffer = asio::dynamic_buffer(message);
    Lowest().expires_after(timeout_);
    stream_.async_read(buffer, [&](const error_code& error, std::size_t) { failed = error; });
    Run();
    if (failed) Refuse(failed, "");
    return message;
  }

  void Send(const std::string& message) {
    error_code failed;
    Lowest().expires_after(timeout_);
    stream_.async_write(asio::buffer(message),
                        [&](const error_code& error, std::size_t) { failed = error; });
    Run();
    if (failed) Refuse(failed, "");
  }

 private:
  beast::basic_stream<Protocol>& Lowest() { return beast::get_lowest_layer(stream_); }

  // Runs the started operation until it is done or fails, at the latest when its timeout expires.
  void Run() {
    io_.restart();
    io_.run();
  }

  [[noreturn]] void Refuse(const error_code& error, const std::string& said) const {
    std::string why = "broke off: " + error.message();
    if (error == beast::error::timeout) {
      why = "did not answer within " + std::to_string(timeout_.count()) + " ms";
    }
    if (!said.empty()) why = "refused: " + said.substr(0, said.find_last_not_of('\n') + 1);
    throw ControlError("the robot at " + socket_.string() + " " + why);
  }

  std::filesystem::path socket_;
  std::chrono::milliseconds timeout_;
  asio::io_context io_{1};
  websocket::stream<beast::basic_stream<Protocol>, false> stream_;
};

ControlStream::ControlStream(const std::filesystem::path& socket, const std::string& target,
                             std::chrono::milliseconds timeout)
    : impl_(std::make_unique<Impl>(socket, target, timeout)) {}

ControlStream::~ControlStream() = default;
ControlStream::ControlStream(ControlStream&& other) noexcept = default;
ControlStream& ControlStream::operator=(ControlStream&& other) noexcept = default;

std::string ControlStream::Next() { return impl_->Next(); }

void ControlStream::Send(const std::string& message) { impl_->Send(message); }

}  // namespace understudy::client
