// The newest requests that were carried out and left no other trace.
#ifndef UNDERSTUDY_EMULATOR_REQUEST_NOTES_H_
#define UNDERSTUDY_EMULATOR_REQUEST_NOTES_H_

#include <array>
#include <cstdint>

#include "emulator/request.h"

namespace understudy::emulator {

struct RequestNote {
  double time = 0;  // simulated s
  Request request{};
};

// By number: that of the n-th request, from 0, lies at n % size.
struct RequestNotes {
  std::uint64_t count = 0;  // since start
  std::array<RequestNote, 8> newest{};

  void Add(const RequestNote& note) { newest[count++ % newest.size()] = note; }
  // The number of the oldest that is kept.
  std::uint64_t oldest() const { return count - (count < newest.size() ? count : newest.size()); }
  const RequestNote& operator[](std::uint64_t number) const {
    return newest[number % newest.size()];
  }
};

}  // namespace understudy::emulator

#endif  // UNDERSTUDY_EMULATOR_REQUEST_NOTES_H_
