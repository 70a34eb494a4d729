#include "run/video.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <exception>
#include <random>
#include <utility>

#include <spdlog/spdlog.h>
#include <sys/socket.h>
#include <sys/un.h>

#include "video/readers.h"

namespace understudy::run {
namespace {

using WallTime = std::chrono::steady_clock::time_point;

constexpr std::chrono::seconds kTally(10);  // over which kept frames are counted; assumed
constexpr std::chrono::seconds kRest(10);   // after frames could not be drawn; assumed
constexpr double kTimeFrames = 1000;        // time_frame is in ms; assumed
constexpr double kFew = 0.9;                // of the frames that are due; assumed

// A name that one process at a time can have in a network, without a file. Returns no descriptor if
// another has it.
UniqueFd Claim(const std::string& interface, int port) {
  UniqueFd claim(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  sockaddr_un name{};
  name.sun_family = AF_UNIX;
  const std::string text = "understudy/video/" + interface + "/" + std::to_string(port);
  // Behind a zero: of no folder, unix(7). An interface has 15 letters at most.
  const std::size_t length = std::min(text.size(), sizeof name.sun_path - 1);
  std::memcpy(name.sun_path + 1, text.data(), length);
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + length);
  if (::bind(claim.get(), reinterpret_cast<const sockaddr*>(&name), size) != 0) claim.reset();
  return claim;
}

}  // namespace

Video::Video(std::vector<robot::CameraSpec> cameras, const config::NetworkConfig& network,
             const bus::Participant* participant)
    : network_(network) {
  if (network.video == config::VideoSending::kOff) return;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const bool writes = participant != nullptr && !cameras[i].video_topic.empty();
    if (cameras[i].video_port == 0 && !writes) continue;
    Feed& feed = feeds_.emplace_back();
    feed.camera = i;
    feed.spec = std::move(cameras[i]);
    if (writes) {
      feed.topic.emplace(*participant, bus::Topic<unitree_go_msg_dds__Go2FrontVideoData_>{
                                           feed.spec.video_topic.c_str(),
                                           &unitree_go_msg_dds__Go2FrontVideoData__desc});
    }
  }
}

Video::Feed* Video::FeedOf(std::size_t camera) {
  const auto feed = std::ranges::find(feeds_, camera, &Feed::camera);
  return feed == feeds_.end() ? nullptr : &*feed;
}

bool Video::IsDue(std::size_t camera, double time) {
  Feed* const feed = FeedOf(camera);
  if (feed == nullptr) return false;
  if (!feed->on) {
    feed->next.reset();
    return false;
  }
  // A reset lets time begin anew.
  if (!feed->next || *feed->next > time + 2 / feed->spec.video_hz) feed->next = time;
  return time >= *feed->next;
}

void Video::Begin(std::size_t camera, double time) {
  Feed* const feed = FeedOf(camera);
  const double missed = std::floor((time - *feed->next) * feed->spec.video_hz);
  feed->missed += static_cast<std::uint64_t>(missed);
  *feed->next += (1 + missed) / feed->spec.video_hz;
}

void Video::Watch(WallTime now) {
  if (now < next_watch_) return;
  next_watch_ = now + kWatchPeriod;
  for (Feed& feed : feeds_) {
    feed.casts = Casts(&feed);
    feed.on = feed.casts || (feed.topic && feed.topic->has_readers());
    Tally(&feed, now);
  }
}

// Opens what it takes to send to the port, while that is wanted.
bool Video::Casts(Feed* feed) {
  const int port = feed->spec.video_port;
  const bool wanted = port != 0 && (network_.video == config::VideoSending::kAlways ||
                                    video::IsRead(network_.interface, port));
  if (!wanted) {
    feed->claim.reset();
    return false;
  }
  if (!feed->claim.valid()) feed->claim = Claim(network_.interface, port);
  if (!feed->claim.valid()) {
    Tell(feed, "another robot sends there");
    return false;
  }
  try {
    if (!feed->sender) feed->sender.emplace(network_.interface, port);
  } catch (const std::exception& error) {
    Tell(feed, error.what());
    return false;
  }
  if (!feed->packer) {
    std::random_device chance;  // RFC 3550; nothing that is simulated follows from it
    feed->packer.emplace(chance(), static_cast<std::uint16_t>(chance()));
  }
  return true;
}

void Video::Tell(Feed* feed, const std::string& why_not) {
  if (feed->why_not == why_not) return;
  feed->why_not = why_not;
  spdlog::warn("the camera {} sends no video to {}:{} on {}: {}", feed->spec.name, video::kGroup,
               feed->spec.video_port, network_.interface, why_not);
}

// Over periods in which frames were wanted all the time.
void Video::Tally(Feed* feed, WallTime now) {
  if (feed->on && feed->tally != WallTime{} && now - feed->tally < kTally) return;
  const bool whole = feed->on && feed->tally != WallTime{};
  const std::uint64_t sent = feed->sent - std::exchange(feed->sent_then, feed->sent);
  const std::uint64_t missed = feed->missed - std::exchange(feed->missed_then, feed->missed);
  feed->tally = feed->on ? now : WallTime{};
  const auto share = static_cast<double>(sent) / static_cast<double>(sent + missed);
  if (!whole || feed->told || !(share < kFew)) return;
  feed->told = true;
  spdlog::warn("the camera {} sends {:.1f} of {:.1f} frames a second: this computer draws no more",
               feed->spec.name, feed->spec.video_hz * share, feed->spec.video_hz);
}

void Video::Send(std::size_t camera, double time, std::span<const std::uint8_t> frame) {
  Feed* const feed = FeedOf(camera);
  if (feed->casts) {
    const auto ticks = static_cast<std::uint64_t>(std::llround(time * video::RtpPacker::kClockHz));
    feed->packer->Pack(frame, static_cast<std::uint32_t>(ticks),
                       [feed](std::span<const std::uint8_t> packet) {
                         if (!feed->sender->Send(packet)) ++feed->unsent;
                       });
  }
  const bool written = feed->topic && feed->topic->has_readers();
  if (written) Write(feed, time, frame);
  if (feed->casts || written) ++feed->sent;
}

void Video::Write(Feed* feed, double time, std::span<const std::uint8_t> frame) {
  const auto size = static_cast<std::uint32_t>(frame.size());
  unitree_go_msg_dds__Go2FrontVideoData_ message{};
  message.time_frame = static_cast<std::uint64_t>(std::llround(time * kTimeFrames));
  message.video720p = {._maximum = size,
                       ._length = size,
                       // Cyclone only reads it.
                       ._buffer = const_cast<std::uint8_t*>(frame.data()),
                       ._release = false};
  feed->topic->Write(message);
}

void Video::Rest(WallTime now) {
  next_watch_ = now + kRest;
  for (Feed& feed : feeds_) feed.on = false;
}

server::VideoCounts Video::counts(std::size_t camera) const {
  const auto feed = std::ranges::find(feeds_, camera, &Feed::camera);
  if (feed == feeds_.end()) return {};
  return {.sent = feed->sent, .missed = feed->missed, .unsent = feed->unsent};
}

}  // namespace understudy::run
