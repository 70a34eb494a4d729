// The only file of the client that sees Boost, which takes long to compile.
#include "client/client.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>

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

struct Connection::Stream {
  asio::io_context io{1};
  beast::basic_stream<Protocol> stream{io};
  beast::flat_buffer buffer;
};

Connection::Connection(const std::filesystem::path& socket, std::chrono::milliseconds timeout)
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

Connection::~Connection() = default;

ControlReply Connection::Ask(const std::string& method, const std::string& path,
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
    // A server that turns a request away may hang up before it has taken all of it: what it said
    // is there to be read all the same.
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
  return Connection(socket, timeout).Ask(method, path, body, timeout, true);
}

}  // namespace understudy::client
