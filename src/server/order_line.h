// A WebSocket on which orders come. Sees Boost; for the server's own files only.
#ifndef UNDERSTUDY_SERVER_ORDER_LINE_H_
#define UNDERSTUDY_SERVER_ORDER_LINE_H_

#include <memory>
#include <string>
#include <string_view>

#include <boost/beast/http.hpp>

#include "server/guest.h"
#include "server/order_wait.h"
#include "server/web_socket.h"

namespace understudy::server {

// Each message {"path": "/push", "body": {...}, "id": any} is taken as that POST, and answered in
// its turn by {"id": any, "status": n} with the fields of the POST's reply. The next is not read
// before.
class OrderLine : public Guest {
 public:
  using Request = boost::beast::http::request<boost::beast::http::string_body>;

  OrderLine(Stream stream, Request request, Door* door, Shared* shared);

  void Begin() override;
  void OnFrame(ShownFrame*) override {}

 private:
  std::shared_ptr<OrderLine> Self() {
    return std::static_pointer_cast<OrderLine>(shared_from_this());
  }
  void Read();
  void Answer(std::string_view message);
  void Write(std::string text);
  void Leave();

  Request request_;
  Door* door_;
  Shared* shared_;
  WebSocket stream_;
  boost::beast::flat_buffer buffer_;
  OrderWait order_;
  std::string text_;  // being sent
};

}  // namespace understudy::server

#endif  // UNDERSTUDY_SERVER_ORDER_LINE_H_
