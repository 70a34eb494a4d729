// A WebSocket on which requests come. Sees Boost; for the server's own files only.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include <boost/beast/http.hpp>

#include "server/connection.h"
#include "server/web_socket.h"

namespace understudy::server {

// Each message {"crane.lower": {"by": 0.1}, "id": text or number} is a request with its values, and
// answered in its turn by {"id": the same, "status": n} with the fields of the POST's reply. The
// next is not read before.
class RequestLine : public Connection {
 public:
  using Handshake = boost::beast::http::request<boost::beast::http::string_body>;

  RequestLine(Stream stream, Handshake handshake, Connections* connections, Shared* shared);

  void Begin() override;
  void OnFrame(ShownFrame*) override {}

 private:
  std::shared_ptr<RequestLine> Self() {
    return std::static_pointer_cast<RequestLine>(shared_from_this());
  }
  void Read();
  void Answer(std::string_view message);
  void Write(std::string text);
  void Leave();

  Handshake handshake_;
  Connections* connections_;
  Shared* shared_;
  WebSocket stream_;
  boost::beast::flat_buffer buffer_;
  std::string text_;  // being sent
};

}  // namespace understudy::server
