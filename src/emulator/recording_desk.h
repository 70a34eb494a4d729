// Passes requests to start and to end a recording on to the recorder.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "base/result.h"
#include "emulator/inbox.h"
#include "emulator/request.h"

namespace understudy::emulator {

struct RecordingOrder {
  bool starts = false;  // else it ends the recording
  bool overwrite = false;
  std::array<char, kLongestText + 1> file{};  // "" leaves the name to the one who records
};

// For the thread of the tick: requests leave an order, which the caller of World::Tick takes,
// carries out for as long as it needs, and reports as done.
class RecordingDesk {
 public:
  // Orders are taken from now on; before, they are refused. `recording`: whether one is on.
  void Open(bool recording) {
    open_ = true;
    recording_ = recording;
  }

  // Leave an order, or return why not.
  Answer Start(std::string_view file, bool overwrite) {
    if (Answer able = Able(); !able) return able;
    if (recording_) return Error{"a recording is on already; record.stop ends it"};
    order_ = {.starts = true, .overwrite = overwrite};
    file.substr(0, kLongestText).copy(order_->file.data(), kLongestText);
    return {};
  }
  Answer Stop() {
    if (Answer able = Able(); !able) return able;
    if (!recording_) return Error{"no recording is on; record.start begins one"};
    order_.emplace();
    return {};
  }
  // Keeps the reply to the request that left the order until it is done.
  void Keep(Reply reply) { reply_.emplace(std::move(reply)); }

  // Returns the order that is not done, null if there is none.
  const RecordingOrder* order() const { return order_ ? &*order_ : nullptr; }
  // The order is done, or failed. `recording`: whether one is on now.
  void Done(bool recording, Answer answer) {
    recording_ = recording;
    order_.reset();
    answer_.emplace(std::move(answer));
  }
  // Gives the answer to an order that is done: a tick later, when the status shows it.
  void GiveAnswer() {
    if (!answer_) return;
    if (reply_) reply_->Give(*std::move(answer_));
    reply_.reset();
    answer_.reset();
  }

 private:
  Answer Able() const {
    if (!open_) return Error{"this run starts and ends its recording by itself"};
    if (order_) return Error{"a recording is being started or ended"};
    return {};
  }

  bool open_ = false;
  bool recording_ = false;
  std::optional<RecordingOrder> order_;
  std::optional<Reply> reply_;
  std::optional<Answer> answer_;  // of an order that is done
};

}  // namespace understudy::emulator
