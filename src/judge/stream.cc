#include "judge/stream.h"

#include <algorithm>

namespace understudy::judge {

void SlidingWindow::Add(const Piece& piece) {
  if (!begun_) next_ = piece.begin;
  begun_ = true;
  known_ = piece.end;
  waiting_.push_back(piece);
}

void SlidingWindow::Take(std::vector<Piece>* out) {
  const Time limit = known_ - to_;
  while (begun_ && next_ < limit) {
    // Pieces that come into the window and that leave it.
    for (; !waiting_.empty() && waiting_.front().begin <= next_ + to_; waiting_.pop_front()) {
      const Piece& piece = waiting_.front();
      inside_.push_back(piece);
      if (!piece.worth.known()) continue;
      while (!best_.empty() && Beats(piece.worth, best_.back().worth)) best_.pop_back();
      best_.push_back(piece);
    }
    while (!inside_.empty() && inside_.front().end <= next_ + from_) inside_.pop_front();
    while (!best_.empty() && best_.front().end <= next_ + from_) best_.pop_front();
    // The answer holds until the next one does either.
    Time end = limit;
    if (!waiting_.empty()) end = std::min(end, waiting_.front().begin - to_);
    if (!inside_.empty()) end = std::min(end, inside_.front().end - from_);
    out->push_back({next_, end, best_.empty() ? Worth{} : best_.front().worth});
    next_ = end;
  }
}

Stream::Stream(const Formula& formula) : formula_(formula) {
  for (const Formula& part : formula.parts) parts_.emplace_back(part);
  if (formula.op == Op::kAll || formula.op == Op::kAny) queues_.resize(parts_.size());
  if (formula.op == Op::kAlways || formula.op == Op::kEventually) {
    window_.emplace_back(formula.from, formula.to, formula.op == Op::kAlways);
  }
}

void Stream::Advance(Time begin, Time end, std::span<const double> signals,
                     std::vector<Piece>* out) {
  switch (formula_.op) {
    case Op::kLeaf: {
      const double signal = signals[formula_.leaf.signal];
      out->push_back({begin,
                      end,
                      {.margin = MarginOf(formula_.leaf, signal),
                       .at = begin,
                       .leaf = formula_.leaf.number,
                       .value = signal * formula_.leaf.scale}});
      return;
    }
    case Op::kNot: {
      const std::size_t from = out->size();
      parts_.front().Advance(begin, end, signals, out);
      for (std::size_t i = from; i < out->size(); ++i) {
        (*out)[i].worth.margin = -(*out)[i].worth.margin;
      }
      return;
    }
    case Op::kAll:
    case Op::kAny:
      for (std::size_t i = 0; i < parts_.size(); ++i) {
        scratch_.clear();
        parts_[i].Advance(begin, end, signals, &scratch_);
        queues_[i].insert(queues_[i].end(), scratch_.begin(), scratch_.end());
      }
      Join(out);
      return;
    case Op::kAlways:
    case Op::kEventually:
      scratch_.clear();
      parts_.front().Advance(begin, end, signals, &scratch_);
      for (const Piece& piece : scratch_) window_.front().Add(piece);
      window_.front().Take(out);
      return;
  }
}

// Cuts the pieces of all parts where one of them ends.
void Stream::Join(std::vector<Piece>* out) {
  while (std::ranges::none_of(queues_, &std::deque<Piece>::empty)) {
    Piece joint = queues_.front().front();
    for (const std::deque<Piece>& queue : queues_) {
      const Piece& piece = queue.front();
      joint.end = std::min(joint.end, piece.end);
      joint.worth = formula_.op == Op::kAll ? Least(joint.worth, piece.worth)
                                            : Most(joint.worth, piece.worth);
    }
    for (std::deque<Piece>& queue : queues_) {
      if (queue.front().end == joint.end) {
        queue.pop_front();
      } else {
        queue.front().begin = joint.end;
      }
    }
    out->push_back(joint);
  }
}

}  // namespace understudy::judge
