#include "server/request_desk.h"

#include <utility>
#include <vector>

#include <boost/asio/buffer.hpp>
#include <unistd.h>

#include "server/routes.h"

namespace understudy::server {

using boost::system::error_code;

RequestDesk::RequestDesk(boost::asio::io_context* io, emulator::Inbox* inbox,
                         std::chrono::milliseconds patience)
    : io_(io), inbox_(inbox), patience_(patience), bell_(*io, ::dup(inbox->bell())) {
  Listen();
}

void RequestDesk::Ask(const emulator::Request& request, Done done) {
  auto put = inbox_->Put(request);
  if (!put) return done(ErrorReply(503, "the robot is busy: too many requests wait"));
  const std::uint64_t number = put->number;
  Asked& asked =
      asked_
          .emplace(number, Asked{std::move(put->answer), boost::asio::steady_timer(*io_, patience_),
                                 std::move(done)})
          .first->second;
  asked.timer.async_wait([this, number](const error_code& error) {
    // If the tick has taken it meanwhile, its answer is there or comes.
    if (error || !inbox_->Withdraw(number)) return;
    asked_.extract(number).mapped().done(
        ErrorReply(503, "the robot did not come to the request in time; it is withdrawn"));
  });
}

void RequestDesk::Listen() {
  bell_.async_read_some(boost::asio::buffer(&rings_, sizeof rings_),
                        [this](const error_code& error, std::size_t) {
                          if (error) return;
                          Deliver();
                          Listen();
                        });
}

void RequestDesk::Deliver() {
  std::vector<Asked> answered;
  for (auto item = asked_.begin(); item != asked_.end();) {
    Asked& asked = item->second;
    if (asked.answer.wait_for(std::chrono::seconds{0}) == std::future_status::ready) {
      answered.push_back(std::move(asked));
      item = asked_.erase(item);
    } else {
      ++item;
    }
  }
  for (Asked& asked : answered) asked.done(AnswerReply(asked.answer.get()));
}

}  // namespace understudy::server
