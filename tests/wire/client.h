// A client of a port, in the same process and domain.
#pragma once

#include <optional>

#include "bus/participant.h"
#include "bus/reader.h"
#include "bus/topic.h"
#include "tests/support/eventually.h"

namespace understudy::wire {

// The next message on `reader`, within a bound.
template <typename Msg>
std::optional<Msg> Next(bus::Reader<Msg>* reader) {
  std::optional<Msg> next;
  test::Eventually([&] {
    reader->Take([&](const Msg& message, bus::WriterHandle) { next = message; }, 1);
    return next.has_value();
  });
  return next;
}

}  // namespace understudy::wire
