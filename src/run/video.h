// The video streams of a robot's cameras: when a frame is due, and how it is sent.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/unique_fd.h"
#include "bus/participant.h"
#include "bus/writer.h"
#include "config/config.h"
#include "idl/unitree_go.h"
#include "robot/robot_spec.h"
#include "server/camera_views.h"
#include "video/multicast_sender.h"
#include "video/rtp_packer.h"

namespace understudy::run {

// Each camera's frames go by RTP to 230.1.1.1 on the robot's interface, at its port, while a
// program reads them there, or always, as network.video says; and to its topic while that has a
// reader. In a network one robot sends to a port: the first whose stream is read. Frames that come
// too late are dropped and counted.
class Video {
 public:
  // `participant` has the topics; null: there are none.
  Video(std::vector<robot::CameraSpec> cameras, const config::NetworkConfig& network,
        const bus::Participant* participant);

  // Whether any stream may be on.
  bool possible() const { return !feeds_.empty(); }

  // Of the loop's thread; simulated time in s:

  // Returns whether a frame of the camera of that number is due.
  bool IsDue(std::size_t camera, double time);
  // The frame is begun.
  void Begin(std::size_t camera, double time);

  // Of the cameras' thread:

  // Finds out which streams are on, now and then, and tells once where frames are missed.
  void Watch(std::chrono::steady_clock::time_point now);
  // Sends a frame (H.264, Annex B) that shows that instant.
  void Send(std::size_t camera, double time, std::span<const std::uint8_t> frame);
  // There are no frames for a while, since nothing draws them.
  void Rest(std::chrono::steady_clock::time_point now);

  static constexpr std::chrono::milliseconds kWatchPeriod{500};

  // Of any thread.
  server::VideoCounts counts(std::size_t camera) const;

 private:
  struct Feed {
    std::size_t camera = 0;
    robot::CameraSpec spec;
    std::atomic<bool> on = false;  // frames are wanted
    std::atomic<std::uint64_t> sent = 0, missed = 0, unsent = 0;
    // Of the loop's thread:
    std::optional<double> next;  // s; nullopt while off
    // Of the cameras' thread:
    bool casts = false;  // to the port
    UniqueFd claim;      // valid while this robot alone sends there
    std::optional<video::MulticastSender> sender;
    std::optional<video::RtpPacker> packer;
    std::optional<bus::Writer<unitree_go_msg_dds__Go2FrontVideoData_>> topic;
    std::string why_not;                           // the last reason in the log
    bool told = false;                             // how many frames are kept
    std::uint64_t sent_then = 0, missed_then = 0;  // at the last tally
    std::chrono::steady_clock::time_point tally{};
  };

  Feed* FeedOf(std::size_t camera);
  bool Casts(Feed* feed);
  void Write(Feed* feed, double time, std::span<const std::uint8_t> frame);
  void Tell(Feed* feed, const std::string& why_not);
  void Tally(Feed* feed, std::chrono::steady_clock::time_point now);

  config::NetworkConfig network_;
  std::deque<Feed> feeds_;  // of the cameras that have a stream
  std::chrono::steady_clock::time_point next_watch_{};
};

}  // namespace understudy::run
