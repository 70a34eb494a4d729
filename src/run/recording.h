// Records a run, or parts of it.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <semaphore>
#include <string>
#include <thread>

#include "assembly/sight_model.h"
#include "bus/participant.h"
#include "config/config.h"
#include "emulator/world.h"
#include "perception/nearest_obstacle.h"
#include "record/recorder.h"
#include "robot/randomization.h"
#include "run/loop.h"

namespace understudy::run {

inline constexpr std::int64_t kHeardEvery = 100;

struct RecordingOptions {
  std::filesystem::path file;  // empty: no recording
  bool overwrite = false;
  std::optional<std::uint64_t> start{};  // as RecordingHead has it
  // Messages of programs come later than they say, by what the program thinks. It is caught up with
  // in every step then, so that each is recorded in the step in which it came.
  bool late_messages = false;
  bool obstacles = false;  // has the distance of the nearest one
  // Hears what is written; may be null. A run as fast as possible waits for it every kHeardEvery
  // steps, so that what it knows then depends on nothing but the run.
  record::Audience* audience = nullptr;
};

// Returns the file of a robot's recording: of several robots walk.mcap is walk_NAME.mcap.
std::filesystem::path RecordingOf(std::filesystem::path file, const config::Config& config,
                                  std::size_t robot);

// The recording of a robot's run: of all of it if it is given a file, and, but for one with an
// audience, of any part of it that requests ask for. Files are opened and finished in a thread of
// its own.
class Recording final : public Attachment {
 public:
  // Of a robot by its number in the world. Call it after ports and services have opened their
  // topics. `config` is that of the run; `world` has made no step yet. All must outlive the
  // recording. Throws RecordError and BusError.
  Recording(const RecordingOptions& options, std::size_t robot, const bus::Participant& participant,
            const config::Config& config, const robot::Draws& draws,
            std::shared_ptr<const assembly::SightModel> sight, emulator::World* world);
  // Offers the damage sheet once more, and takes what is left. The loop has ended.
  ~Recording() override;
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;

  // A run as fast as possible does not run away from its recorder.
  bool AllowsStep() const override;

  // Offers the state after a tick and carries out what requests have asked for.
  std::optional<ExitCode> After(const Cycle& cycle) override;

  // Whether a recording has begun or ended in the last cycle. The request is answered in the next
  // one, so post the status before.
  bool turned() const { return turned_; }

  emulator::RecordingStatus status() const;

 private:
  // What the thread does next: it starts a recording, or finishes one.
  struct Job {
    std::filesystem::path file{};
    bool overwrite = false;
    record::Links links = record::Links::kFollowed;
    std::int64_t first_step = 0;
    config::Config config{};                       // in effect when it is started
    std::unique_ptr<record::Recorder> recorder{};  // that is to be finished, or was started
    std::string why{};                             // it could not be started, if not ""
  };
  enum class Turn : std::uint8_t { kNobodys, kThreads, kTicks };

  config::Config ConfigInEffect() const;
  std::unique_ptr<record::Recorder> Start(const Job& job) const;
  void Offer();
  bool TakeTurn();
  void Begin(const emulator::RecordingOrder& order);
  void End();
  void Work(const std::stop_token& stop);
  void OfferDamage();

  const config::RobotConfig& robot() const { return config_.robots[robot_]; }

  std::size_t robot_;
  const bus::Participant& participant_;
  const config::Config& config_;
  std::shared_ptr<const assembly::SightModel> sight_;
  emulator::World& world_;
  bool late_messages_;
  record::Audience* audience_;
  record::RecordingHead head_;  // but for configuration and model
  record::Moment moment_;
  std::vector<float> cells_;  // of the robot's pads
  std::optional<perception::NearestObstacle> obstacles_;
  std::int64_t every_;           // steps from one LowState to the next
  std::int64_t sheet_every_;     // steps from one damage sheet to the next
  std::int64_t sheet_step_ = 0;  // of the last one
  std::unique_ptr<record::Recorder> recorder_;
  std::filesystem::path file_;  // that is being written
  bool turned_ = false;
  Job job_;  // belongs to the one whose turn it is
  std::atomic<Turn> turn_{Turn::kNobodys};
  std::counting_semaphore<> wake_{0};
  std::jthread thread_;  // last: it uses all of the above
};

}  // namespace understudy::run
