// Passes looks through cameras to what draws, and the pictures to the connections, without
// blocking. Includes Boost; private to server/.
#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <list>

#include <boost/asio/io_context.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/steady_timer.hpp>

#include "server/camera_views.h"
#include "server/http.h"

namespace understudy::server {

// The waiting looks of all connections. Woken by the bell of the views.
class ViewDesk {
 public:
  using Done = std::function<void(HttpReply)>;

  // `views` must outlive the desk. `patience` is the longest wait for a picture.
  ViewDesk(boost::asio::io_context* io, CameraViews* views, std::chrono::milliseconds patience);

  // Calls `done`, which must own what it needs, with the JPEG by the camera of that number or the
  // PNG of its depth, or 503 if the camera gives none this time or it does not come in time, 500 if
  // nothing draws.
  void Ask(std::size_t camera, bool depth, Done done);

 private:
  struct Asked {
    bool depth;
    std::future<services::Picture> picture;
    boost::asio::steady_timer timer;
    Done done;
  };

  void Listen();
  void Deliver();

  boost::asio::io_context* io_;
  CameraViews* views_;
  std::chrono::milliseconds patience_;
  boost::asio::posix::stream_descriptor bell_;
  std::list<Asked> asked_;
};

}  // namespace understudy::server
