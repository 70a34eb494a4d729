// Evaluates a formula while its signals come.
#pragma once

#include <deque>
#include <span>
#include <vector>

#include "judge/formula.h"

namespace understudy::judge {

// A stretch of time, `end` excluded, in which a formula has one worth.
struct Piece {
  Time begin = 0, end = 0;
  Worth worth{};
};

// The least or the most of what lies from `from` to `to` after each instant, both inclusive.
class SlidingWindow {
 public:
  SlidingWindow(Time from, Time to, bool least) : from_(from), to_(to), least_(least) {}

  // Adds the next piece, which begins where the last one ended.
  void Add(const Piece& piece);
  // Appends the pieces that are known by now.
  void Take(std::vector<Piece>* out);

 private:
  bool Beats(const Worth& a, const Worth& b) const {
    return least_ ? IsLess(a.margin, b.margin) : IsLess(b.margin, a.margin);
  }

  Time from_, to_;
  bool least_;
  bool begun_ = false;
  Time next_ = 0;              // instant from which nothing has been given
  Time known_ = 0;             // end of the last piece
  std::deque<Piece> waiting_;  // begin after the window
  std::deque<Piece> inside_;   // in the window
  std::deque<Piece> best_;     // those of `inside_` that can still be the answer, the best first
};

// The signals keep their values between samples. Every instant gets its worth as soon as all that
// the formula looks ahead to has come; how the samples were handed over makes no difference.
class Stream {
 public:
  // `formula` must outlive the stream.
  explicit Stream(const Formula& formula);

  // The signals have these values from `begin` on, until `end`, where the next call begins. Appends
  // what has become known, in order and without gaps.
  void Advance(Time begin, Time end, std::span<const double> signals, std::vector<Piece>* out);

 private:
  void Join(std::vector<Piece>* out);

  const Formula& formula_;
  std::vector<Stream> parts_;
  std::vector<std::deque<Piece>> queues_;  // of the parts of kAll and kAny
  std::vector<SlidingWindow> window_;      // one, of kAlways and kEventually
  std::vector<Piece> scratch_;
};

}  // namespace understudy::judge
