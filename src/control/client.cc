// The only file of the client that sees Boost, which takes long to compile.
#include "control/client.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>

#include "control/control_error.h"
#include "control/control_folder.h"
#include "control/listening_socket.h"

namespace understudy {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
using Protocol = asio::local::stream_protocol;
using boost::system::error_code;

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

ControlReply Call(const std::filesystem::path& socket, const std::string& method,
                  const std::string& path, const std::string& body,
                  std::chrono::milliseconds timeout) {
  CheckSocketPath(socket);
  http::request<http::string_body> request;
  request.version(11);
  request.method_string(method);
  request.target(path);
  request.set(http::field::host, "localhost");
  request.keep_alive(false);
  request.body() = body;
  if (!body.empty()) request.set(http::field::content_type, "application/json");
  request.prepare_payload();

  asio::io_context io{1};
  beast::basic_stream<Protocol> stream(io);
  beast::flat_buffer buffer;
  http::response<http::string_body> response;
  error_code connecting;
  error_code reading;

  stream.expires_after(timeout);
  const auto read = [&](const error_code& error, std::size_t) {
    reading = error;
    // A server that turns a request away may hang up before it has taken all of it: what it said
    // is there to be read all the same.
    if (error == beast::error::timeout) return;
    http::async_read(stream, buffer, response,
                     [&](const error_code& failed, std::size_t) { reading = failed; });
  };
  stream.async_connect(Protocol::endpoint{socket.native()}, [&](const error_code& error) {
    connecting = error;
    if (!error) http::async_write(stream, request, read);
  });
  io.run();

  if (connecting) {
    throw ControlError("no robot answers at " + socket.string() + ": " + connecting.message());
  }
  if (reading) throw ControlError("the robot at " + socket.string() + " " + Why(reading, timeout));
  return {.status = response.result_int(), .body = std::move(response.body())};
}

}  // namespace understudy
