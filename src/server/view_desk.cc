#include "server/view_desk.h"

#include <iterator>
#include <string>
#include <utility>

#include <unistd.h>

namespace understudy::server {
namespace {

using boost::system::error_code;
using services::Picture;

HttpReply ReplyOf(const Picture& picture, bool depth) {
  const services::PictureBytes& bytes = depth ? picture.depth : picture.jpeg;
  switch (picture.outcome) {
    case Picture::Outcome::kDrawn:
      return {.body = std::string(bytes->begin(), bytes->end()),
              .type = depth ? "image/png" : "image/jpeg"};
    case Picture::Outcome::kLost:
      return ErrorReply(503, "the camera gives no picture this time, by its fault");
    case Picture::Outcome::kFailed:
      break;
  }
  return ErrorReply(500, "nothing here draws pictures: the robot's log says what is missing");
}

}  // namespace

ViewDesk::ViewDesk(boost::asio::io_context* io, CameraViews* views,
                   std::chrono::milliseconds patience)
    : io_(io), views_(views), patience_(patience), bell_(*io, ::dup(views->news().fd())) {
  Listen();
}

void ViewDesk::Ask(std::size_t camera, bool depth, Done done) {
  asked_.push_back({depth, views_->Look(camera, depth), boost::asio::steady_timer(*io_, patience_),
                    std::move(done)});
  const auto asked = std::prev(asked_.end());
  asked->timer.async_wait([this, asked](const error_code& error) {
    if (error) return;
    const Done late = std::move(asked->done);
    asked_.erase(asked);
    late(ErrorReply(503, "no picture came in time"));
  });
}

void ViewDesk::Listen() {
  bell_.async_wait(boost::asio::posix::stream_descriptor::wait_read,
                   [this](const error_code& error) {
                     if (error) return;
                     views_->news().Answer();
                     Deliver();
                     Listen();
                   });
}

void ViewDesk::Deliver() {
  std::list<Asked> drawn;
  for (auto asked = asked_.begin(); asked != asked_.end();) {
    const auto next = std::next(asked);
    if (asked->picture.wait_for(std::chrono::seconds{0}) == std::future_status::ready) {
      drawn.splice(drawn.end(), asked_, asked);
    }
    asked = next;
  }
  for (Asked& asked : drawn) {
    asked.timer.cancel();
    asked.done(ReplyOf(asked.picture.get(), asked.depth));
  }
}

}  // namespace understudy::server
