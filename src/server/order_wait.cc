#include "server/order_wait.h"

#include <utility>

#include "server/routes.h"

namespace understudy::server {
namespace {

using std::chrono::steady_clock;

// How often it looks: well above a tick, well below a person's notice.
constexpr std::chrono::milliseconds kLook{2};

}  // namespace

void OrderWait::Begin(const emulator::Order& order, Done done) {
  until_ = steady_clock::now() + patience_;
  answer_ = inbox_->Put(order, until_);
  if (!answer_) return done(ErrorReply(503, "the robot is busy: too many orders wait"));
  Look(std::move(done));
}

void OrderWait::Look(Done done) {
  timer_.expires_after(kLook);
  timer_.async_wait([this, done = std::move(done)](const boost::system::error_code&) mutable {
    if (answer_->wait_for(std::chrono::seconds{0}) == std::future_status::ready) {
      return done(AnswerReply(answer_->get()));
    }
    // Ten looks of grace: the tick may have begun on the order just before its time was up.
    if (steady_clock::now() < until_ + 10 * kLook) return Look(std::move(done));
    done(ErrorReply(503, "the robot did not come to the order in time; it is withdrawn"));
  });
}

}  // namespace understudy::server
