#include "server/request_line.h"

#include <exception>
#include <utility>

#include <boost/asio/buffer.hpp>
#include <nlohmann/json.hpp>

#include "server/request_desk.h"
#include "server/routes.h"

namespace understudy::server {
namespace {

using boost::system::error_code;
using nlohmann::json;
using nlohmann::ordered_json;

std::string TextOf(const ordered_json& id, const HttpReply& reply) {
  ordered_json answer{{"id", id}, {"status", reply.status}};
  answer.update(ordered_json::parse(reply.content()));
  return answer.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

// The request of a message, and in `id` what its answer is to be known by. Never recurses: a client
// chooses how deep a message is.
Result<emulator::Request> ReadMessage(std::string_view message, ordered_json* id) {
  const json said = json::parse(message, nullptr, false);
  const Error form{R"(expected {"NAME": {...}, "id": text or number})"};
  if (!said.is_object() || said.empty() || said.size() > 2) return form;
  const json* values = nullptr;
  std::string name;
  for (const auto& item : said.items()) {
    if (item.key() == "id") {
      if (item.value().is_structured()) return form;
      *id = item.value();
    } else if (values == nullptr) {
      name = item.key();
      values = &item.value();
    } else {
      return form;
    }
  }
  return values != nullptr ? emulator::ReadRequest(name, *values) : form;
}

}  // namespace

RequestLine::RequestLine(Stream stream, Handshake handshake, Connections* connections,
                         Shared* shared)
    : handshake_(std::move(handshake)),
      connections_(connections),
      shared_(shared),
      stream_(std::move(stream)) {}

void RequestLine::Begin() {
  Limit(shared_->limits, &stream_);
  stream_.text(true);
  stream_.async_accept(handshake_, [self = Self()](const error_code& error) {
    if (error) return self->Leave();
    self->Read();
  });
}

void RequestLine::Read() {
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

void RequestLine::Answer(std::string_view message) {
  ordered_json id;
  const auto request = ReadMessage(message, &id);
  if (!request) return Write(TextOf(id, ErrorReply(400, request.why())));
  shared_->desk->Ask(
      *request, [self = Self(), id](const HttpReply& reply) { self->Write(TextOf(id, reply)); });
}

void RequestLine::Write(std::string text) {
  text_ = std::move(text);
  stream_.async_write(boost::asio::buffer(text_),
                      [self = Self()](const error_code& error, std::size_t) {
                        if (error) return self->Leave();
                        self->Read();
                      });
}

void RequestLine::Leave() {
  HangUp(&stream_);
  connections_->Remove(this);
}

}  // namespace understudy::server
