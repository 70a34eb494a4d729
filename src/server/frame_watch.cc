#include "server/frame_watch.h"

#include <algorithm>
#include <utility>

#include <boost/asio/buffer.hpp>

namespace understudy::server {

using boost::system::error_code;

FrameWatch::FrameWatch(Stream stream, Request request, const WatchFrames& wanted,
                       Connections* connections, Shared* shared)
    : request_(std::move(request)),
      parts_(wanted.parts),
      period_(std::chrono::duration_cast<Clock::duration>(
          std::chrono::duration<double>(1 / wanted.hz))),
      connections_(connections),
      shared_(shared),
      stream_(std::move(stream)),
      timer_(stream_.get_executor()) {}

void FrameWatch::Begin() {
  Limit(shared_->limits, &stream_);
  stream_.text(true);
  stream_.async_accept(request_, [self = Self()](const error_code& error) {
    if (error) return self->Leave();
    self->due_ = Clock::now();
    self->Listen();
    self->Next();
  });
}

void FrameWatch::Listen() {
  heard_.clear();
  stream_.async_read(heard_, [self = Self()](const error_code& error, std::size_t) {
    if (error) return self->Leave();
    self->Listen();
  });
}

void FrameWatch::Next() {
  timer_.expires_at(due_);
  timer_.async_wait([self = Self()](const error_code& error) {
    if (error) return;
    // One that has fallen behind goes on from now.
    self->due_ = std::max(self->due_ + self->period_, Clock::now());
    self->shared_->pump->Ask(self->parts_, self);
  });
}

void FrameWatch::OnFrame(ShownFrame* shown) {
  if (!stream_.is_open()) return;
  text_ = shown->Json(parts_);
  stream_.async_write(boost::asio::buffer(*text_),
                      [self = Self()](const error_code& error, std::size_t) {
                        self->text_.reset();
                        if (error) return self->Leave();
                        self->Next();
                      });
}

void FrameWatch::Leave() {
  timer_.cancel();
  HangUp(&stream_);
  connections_->Remove(this);
}

}  // namespace understudy::server
