#include "server/event_watch.h"

#include <algorithm>
#include <utility>

#include <boost/asio/buffer.hpp>
#include <nlohmann/json.hpp>

namespace understudy::server {

using boost::system::error_code;

EventWatch::EventWatch(Stream stream, Request request, Connections* connections, Shared* shared)
    : request_(std::move(request)),
      connections_(connections),
      shared_(shared),
      stream_(std::move(stream)),
      timer_(stream_.get_executor()) {}

void EventWatch::Begin() {
  Limit(shared_->limits, &stream_);
  stream_.text(true);
  stream_.async_accept(request_, [self = Self()](const error_code& error) {
    if (error) return self->Leave();
    self->Listen();
    self->Next();
  });
}

void EventWatch::Listen() {
  heard_.clear();
  stream_.async_read(heard_, [self = Self()](const error_code& error, std::size_t) {
    if (error) return self->Leave();
    self->Listen();
  });
}

// A client too slow for the history goes on with the oldest that is kept.
void EventWatch::Next() {
  const auto& newest = shared_->plane.events.newest();
  const auto event = std::ranges::find_if(
      newest, [this](const KnownEvent& known) { return known.number >= next_; });
  if (event == newest.end()) {
    timer_.expires_after(kEventsEvery);
    timer_.async_wait([self = Self()](const error_code& error) {
      if (!error) self->Next();
    });
    return;
  }
  next_ = event->number + 1;
  text_ = EventJson(*event).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  stream_.async_write(boost::asio::buffer(text_),
                      [self = Self()](const error_code& error, std::size_t) {
                        if (error) return self->Leave();
                        self->Next();
                      });
}

void EventWatch::Leave() {
  timer_.cancel();
  HangUp(&stream_);
  connections_->Remove(this);
}

}  // namespace understudy::server
