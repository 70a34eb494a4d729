// The cameras of a robot of a run: pictures for its services, drawn beside the tick.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "base/bell.h"
#include "base/spsc_ring.h"
#include "emulator/snapshot.h"
#include "emulator/world.h"
#include "robot/fault.h"
#include "robot/robot_spec.h"
#include "run/camera_process.h"
#include "run/loop.h"
#include "run/video.h"
#include "server/camera_views.h"
#include "services/picture_source.h"

namespace understudy::run {

// One picture is drawn at a time, of the state after the cycle in which its turn comes; cameras
// take turns. What is ordered meanwhile, and a frame of its video that is due, share the next
// picture of a camera. The loop hands over a copy of the state and never waits, but on a clock of
// programs: there no step is made until the picture is drawn, which takes real time. A thread waits
// for the process that draws, which is started for the first picture and kept. Nothing is drawn
// that nobody wants.
class Cameras final : public Attachment,
                      public services::PictureSource,
                      public server::CameraViews {
 public:
  // Of the robot of that number. `program` is understudy-view. `world` must outlive this.
  // `network` is where videos are sent, `participant` as for Video. `holds_steps`: until a picture
  // is drawn.
  Cameras(const emulator::World& world, std::size_t robot, std::filesystem::path program,
          std::filesystem::path control_socket, const config::NetworkConfig& network,
          const bus::Participant* participant, bool holds_steps = false);
  ~Cameras() override;

  Order Begin(std::string_view service) noexcept override;
  const services::Picture* Front() const noexcept override { return pictures_.Front(); }
  void Pop() noexcept override;
  bool AllowsStep() const override { return !holds_steps_ || !busy_ || Front() != nullptr; }
  std::optional<ExitCode> After(const Cycle& cycle) override;
  std::span<const robot::CameraSpec> cameras() const noexcept override { return cameras_; }
  std::future<services::Picture> Look(std::size_t camera, bool depth) override;
  const Bell& news() const noexcept override { return news_; }
  server::VideoCounts video(std::size_t camera) const noexcept override {
    return video_.counts(camera);
  }

 private:
  struct Job {
    Order order = 0;
    std::size_t camera = 0;
    std::uint64_t looks = 0;           // that wait for it: of its camera, up to this number
    bool jpeg = false, frame = false;  // what is made of it
    robot::CameraEffects faults;
    emulator::Snapshot state;
  };

  struct Waiting {
    std::size_t camera = 0;
    std::uint64_t look = 0;
    bool depth = false;
    std::promise<services::Picture> picture;
  };

  void Work(const std::stop_token& stop);
  void Show(const Job& job, const services::Picture& picture);
  bool LooksForDepth(const Job& job);
  services::Picture Make(const Job& job, const std::stop_token& stop);
  CameraProcess::Drawn Draw(const Job& job, const std::stop_token& stop);
  void Fill(std::size_t camera, bool due, const emulator::World& world, Job* job);

  std::size_t robot_;
  std::vector<robot::CameraSpec> cameras_;
  std::filesystem::path program_, control_socket_;
  bool holds_steps_;

  // Of the loop's thread:
  std::vector<Order> open_;  // by camera: the order that waits for its turn, 0 for none
  Order last_ = 0;
  std::size_t turn_ = 0;              // the camera that is next
  bool busy_ = false;                 // a job is under way
  std::vector<std::uint64_t> begun_;  // by camera: the last look that a job was begun for

  // Of all:
  std::vector<std::atomic<std::uint64_t>> looked_;  // by camera: the last look
  Bell news_;

  SpscRing<Job> jobs_;
  SpscRing<services::Picture> pictures_{1};
  Bell bell_;

  std::mutex waiting_mutex_;  // of observers and the thread
  std::vector<Waiting> waiting_;

  // Of the thread:
  std::mutex mutex_;  // over the existence of process_; that thread and the destructor
  std::optional<CameraProcess> process_;
  std::string why_not_;  // the last reason in the log
  Video video_;
  std::jthread thread_;  // last: it uses all of the above
};

}  // namespace understudy::run
