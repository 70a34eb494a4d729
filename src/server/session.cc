#include "server/session.h"

#include <exception>
#include <utility>

#include <boost/beast/websocket/rfc6455.hpp>

#include "server/recordings.h"
#include "server/request_desk.h"
#include "server/view_desk.h"
#include "server/web_sockets.h"

namespace understudy::server {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
using boost::system::error_code;
using Response = http::response<http::span_body<const char>>;

std::string_view View(beast::string_view text) { return {text.data(), text.size()}; }

// Of `reply`, whose content it points to.
Response ResponseOf(const HttpReply& reply, bool keep_alive) {
  Response response(http::int_to_status(reply.status), 11);
  response.set(http::field::content_type, reply.type);
  response.set(http::field::cache_control, "no-store");
  if (!reply.allow.empty()) response.set(http::field::allow, reply.allow);
  for (const auto& [name, value] : reply.fields) response.set(name, value);
  response.keep_alive(keep_alive);
  response.body() = {reply.content().data(), reply.content().size()};
  response.prepare_payload();
  return response;
}

HttpRequest RequestOf(const http::request<http::string_body>& request) {
  return {.method = request.method() == http::verb::head ? "GET" : View(request.method_string()),
          .target = View(request.target()),
          .body = request.body(),
          .host = request.count(http::field::host) == 1 ? View(request[http::field::host]) : "",
          .origin = View(request[http::field::origin]),
          .authorization = View(request[http::field::authorization]),
          .if_none_match = View(request[http::field::if_none_match]),
          .upgrade = beast::websocket::is_upgrade(request)};
}

// Returns the reply to a request that failed with `error`; nullopt if the client has gone.
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

}  // namespace

Session::Session(asio::generic::stream_protocol::socket socket, Connections* connections,
                 Shared* shared)
    : connections_(connections),
      shared_(shared),
      stream_(std::move(socket)),
      // Room for a header beside the first part of a body.
      buffer_(shared->limits.header_bytes + 4096),
      snapshot_timer_(stream_.get_executor()) {}

void Session::RefuseBusy(asio::generic::stream_protocol::socket* socket) {
  error_code ignored;
  socket->non_blocking(true, ignored);
  const HttpReply reply = ErrorReply(503, "too many clients are connected");
  Response response = ResponseOf(reply, false);
  http::write(*socket, response, ignored);
}

void Session::Read() {
  parser_.emplace();
  parser_->header_limit(static_cast<std::uint32_t>(shared_->limits.header_bytes));
  parser_->body_limit(shared_->limits.body_bytes);
  stream_.expires_after(shared_->limits.idle);
  known_ = false;
  connections_->Wait(this);
  http::async_read(stream_, buffer_, *parser_,
                   [self = Self()](const error_code& error, std::size_t) { self->OnRead(error); });
}

void Session::OnRead(const error_code& error) {
  if (!stream_.socket().is_open()) return Leave();  // gave way, or was too slow
  connections_->Work(this);
  if (error) {
    std::optional<HttpReply> reply = ReplyToBroken(error, shared_->limits);
    if (!reply) return Leave();
    broken_ = true;
    return Write(std::move(*reply), false);
  }
  const HttpRequest request = RequestOf(parser_->get());
  const AccessRules* access = connections_->access();
  known_ = access == nullptr || HasToken(request, *access);
  if (access != nullptr) {
    if (auto refusal = RefusalOf(request, *access)) return Write(std::move(*refusal), false);
  }
  try {
    Answer(request);
  } catch (const std::exception& failure) {  // out of memory
    Write(ErrorReply(500, failure.what()), false);
  }
}

void Session::Answer(const HttpRequest& request) {
  Routed routed = Route(request, shared_->plane);
  if (auto* reply = std::get_if<HttpReply>(&routed)) return Write(std::move(*reply));
  if (const auto* wanted = std::get_if<FromSnapshot>(&routed)) return AwaitSnapshot(*wanted);
  if (const auto* wanted = std::get_if<FromCamera>(&routed)) {
    // Drawing may take longer than a client may be silent.
    stream_.expires_never();
    return shared_->views->Ask(wanted->camera, wanted->depth,
                               [self = Self()](HttpReply reply) { self->Write(std::move(reply)); });
  }
  if (const auto* asked = std::get_if<emulator::Request>(&routed)) {
    if (const std::string why = RefusedOverTcp(*asked);
        connections_->access() != nullptr && !why.empty()) {
      return Write(ErrorReply(403, why));
    }
    return shared_->desk->Ask(*asked,
                              [self = Self()](const HttpReply& reply) { self->Write(reply); });
  }
  Upgrade(routed);
}

void Session::AwaitSnapshot(const FromSnapshot& wanted) {
  snapshot_ = wanted;
  snapshot_timer_.expires_after(shared_->limits.patience);
  snapshot_timer_.async_wait([self = Self()](const error_code& error) {
    if (error || !self->snapshot_) return;
    self->snapshot_.reset();
    self->Write(ErrorReply(503, "the robot did not come to it in time"));
  });
  shared_->pump->Ask(wanted.parts, Self());
}

void Session::OnSnapshot(ShownSnapshot* shown) {
  if (!snapshot_) return;  // timed out before
  const FromSnapshot wanted = *snapshot_;
  snapshot_.reset();
  snapshot_timer_.cancel();
  Write(wanted.reply(shown->snapshot(), wanted.parts, shared_->plane));
}

void Session::Upgrade(const Routed& routed) {
  if (!known_ && connections_->crowded()) {
    return Write(ErrorReply(503, "too many clients without the token watch"), false);
  }
  const std::shared_ptr<Session> self = Self();  // its list releases it here
  stream_.expires_never();
  Leave();
  auto socket =
      MakeWebSocket(std::move(stream_), parser_->release(), routed, connections_, shared_);
  known_ ? connections_->Add(std::move(socket)) : connections_->AddStranger(std::move(socket));
}

void Session::Write(HttpReply reply) { Write(std::move(reply), parser_->get().keep_alive()); }

void Session::Write(HttpReply reply, bool keep_alive) {
  reply_ = std::move(reply);
  response_ = ResponseOf(reply_, keep_alive);
  // The same header as for GET, with the length of the omitted body.
  if (parser_ && parser_->get().method() == http::verb::head) response_.body() = {};
  stream_.expires_after(shared_->limits.idle);
  if (!known_) connections_->Wait(this);
  http::async_write(stream_, response_, [self = Self()](const error_code& error, std::size_t) {
    self->reply_ = {};
    if (error) return self->Leave();
    if (self->response_.keep_alive()) return self->Read();
    if (!self->broken_) return self->Leave();
    error_code ignored;
    self->stream_.socket().shutdown(asio::socket_base::shutdown_send, ignored);
    self->stream_.expires_after(self->shared_->limits.idle);
    self->Forget();
  });
}

// A client that is still sending reads our reply only afterwards, and never if we close first.
void Session::Forget() {
  buffer_.clear();
  stream_.async_read_some(buffer_.prepare(buffer_.max_size()),
                          [self = Self()](const error_code& error, std::size_t) {
                            if (error) return self->Leave();
                            self->Forget();
                          });
}

}  // namespace understudy::server
