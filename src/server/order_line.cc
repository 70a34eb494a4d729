#include "server/order_line.h"

#include <exception>
#include <utility>

#include <boost/asio/buffer.hpp>
#include <nlohmann/json.hpp>

#include "server/routes.h"

namespace understudy::server {
namespace {

using boost::system::error_code;
using nlohmann::ordered_json;

std::string TextOf(const ordered_json& id, const HttpReply& reply) {
  ordered_json answer{{"id", id}, {"status", reply.status}};
  const ordered_json body = ordered_json::parse(reply.content(), nullptr, false);
  if (body.is_object()) answer.update(body);
  return answer.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

// Dumping recurses, and a client chooses how deep: no order has more than this.
bool IsShallow(std::string_view text) {
  constexpr int kDeepest = 16;
  int depth = 0;
  for (const char c : text) {
    if (c == '[' || c == '{') ++depth;
    if (c == ']' || c == '}') --depth;
    if (depth > kDeepest) return false;
  }
  return true;
}

}  // namespace

OrderLine::OrderLine(Stream stream, Request request, Door* door, Shared* shared)
    : request_(std::move(request)),
      door_(door),
      shared_(shared),
      stream_(std::move(stream)),
      order_(stream_.get_executor(), shared->plane.inbox, shared->limits.patience) {}

void OrderLine::Begin() {
  Limit(shared_->limits, &stream_);
  stream_.text(true);
  stream_.async_accept(request_, [self = Self()](const error_code& error) {
    if (error) return self->Leave();
    self->Read();
  });
}

void OrderLine::Read() {
  buffer_.clear();
  stream_.async_read(buffer_, [self = Self()](const error_code& error, std::size_t) {
    if (error) return self->Leave();
    const auto bytes = self->buffer_.cdata();
    try {
      self->Answer({static_cast<const char*>(bytes.data()), bytes.size()});
    } catch (const std::exception& failure) {  // no memory for it
      self->Write(TextOf(nullptr, ErrorReply(500, failure.what())));
    }
  });
}

void OrderLine::Answer(std::string_view message) {
  const ordered_json said =
      IsShallow(message) ? ordered_json::parse(message, nullptr, false) : ordered_json();
  const auto path = said.is_object() ? said.find("path") : said.end();
  if (!said.is_object() || path == said.end() || !path->is_string()) {
    return Write(TextOf(nullptr, ErrorReply(400, R"(expected {"path": "/...", "body": {...}})")));
  }
  const auto found = said.find("id");
  const ordered_json id = found == said.end() ? ordered_json() : *found;
  const auto body = said.find("body");
  const std::string text = body == said.end()
                               ? "{}"
                               : body->dump(-1, ' ', false, ordered_json::error_handler_t::replace);
  const Routed routed =
      Route({.method = "POST", .target = path->get_ref<const std::string&>(), .body = text},
            shared_->plane);
  if (const auto* order = std::get_if<emulator::Order>(&routed)) {
    return order_.Begin(
        *order, [self = Self(), id](const HttpReply& reply) { self->Write(TextOf(id, reply)); });
  }
  const auto* reply = std::get_if<HttpReply>(&routed);
  Write(TextOf(id, reply != nullptr ? *reply : ErrorReply(400, "expected the path of an order")));
}

void OrderLine::Write(std::string text) {
  text_ = std::move(text);
  stream_.async_write(boost::asio::buffer(text_),
                      [self = Self()](const error_code& error, std::size_t) {
                        if (error) return self->Leave();
                        self->Read();
                      });
}

void OrderLine::Leave() {
  HangUp(&stream_);
  door_->Dismiss(this);
}

}  // namespace understudy::server
