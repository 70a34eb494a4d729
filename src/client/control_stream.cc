#include "client/control_stream.h"

#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>

#include "base/errors.h"
#include "client/control_folder.h"

namespace understudy::client {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = boost::beast::websocket;
using Protocol = asio::local::stream_protocol;
using boost::system::error_code;

constexpr std::size_t kLargestMessage = 16 << 20;  // *assumed*, a frame has some kB

}  // namespace

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

  // Until what was begun is done, or has run out of time, which is set before, and failed.
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
