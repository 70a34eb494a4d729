#include "run/cameras.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <utility>

#include <poll.h>
#include <spdlog/spdlog.h>

namespace understudy::run {

using services::Picture;

Cameras::Cameras(const emulator::World& world, std::size_t robot, std::filesystem::path program,
                 std::filesystem::path control_socket, const config::NetworkConfig& network,
                 const bus::Participant* participant, bool holds_steps)
    : robot_(robot),
      cameras_(world.robot(robot).spec().cameras),
      program_(std::move(program)),
      control_socket_(std::move(control_socket)),
      holds_steps_(holds_steps),
      open_(cameras_.size()),
      begun_(cameras_.size()),
      looked_(cameras_.size()),
      jobs_(1, {.faults = {}, .state = world.MakeSnapshot(robot)}),
      video_(cameras_, network, participant) {
  if (cameras_.empty()) return;
  thread_ = std::jthread([this](const std::stop_token& stop) { Work(stop); });
}

Cameras::~Cameras() {
  thread_.request_stop();
  bell_.Ring();
  const std::lock_guard lock(mutex_);
  if (process_) process_->Interrupt();
}

Cameras::Order Cameras::Begin(std::string_view service) noexcept {
  const auto found = std::ranges::find(cameras_, service, &robot::CameraSpec::service);
  if (found == cameras_.end()) return 0;
  Order& open = open_[static_cast<std::size_t>(found - cameras_.begin())];
  if (open == 0) open = ++last_;
  return open;
}

std::future<Picture> Cameras::Look(std::size_t camera, bool depth) {
  const std::lock_guard lock(waiting_mutex_);
  // Counted once it waits, so that the job of its number finds it.
  waiting_.push_back(
      {.camera = camera, .look = looked_[camera] + 1, .depth = depth, .picture = {}});
  ++looked_[camera];
  return waiting_.back().picture.get_future();
}

void Cameras::Pop() noexcept {
  pictures_.Pop();
  busy_ = false;
}

std::optional<ExitCode> Cameras::After(const Cycle& cycle) {
  for (std::size_t i = 0; i < open_.size() && !busy_; ++i) {
    const std::size_t camera = (turn_ + i) % open_.size();
    const bool asked = open_[camera] != 0 || looked_[camera] != begun_[camera];
    const bool due = video_.IsDue(camera, cycle.world.time());
    if (!asked && !due) continue;
    Job* const job = jobs_.Claim();
    if (job == nullptr) break;
    Fill(camera, due, cycle.world, job);
    jobs_.Commit();
    bell_.Ring();
    busy_ = true;
    turn_ = camera + 1;
  }
  return {};
}

void Cameras::Fill(std::size_t camera, bool due, const emulator::World& world, Job* job) {
  const std::uint64_t looks = looked_[camera];
  job->jpeg = open_[camera] != 0 || looks != begun_[camera];
  job->frame = due;
  if (due) video_.Begin(camera, world.time());
  job->order = open_[camera] != 0 ? std::exchange(open_[camera], 0) : ++last_;
  job->looks = begun_[camera] = looks;
  job->camera = camera;
  job->faults = world.robot(robot_).faults().effects().cameras[camera];
  job->state.parts = CameraProcess::kParts;
  world.Show(&job->state);
}

void Cameras::Work(const std::stop_token& stop) {
  pollfd wakes{.fd = bell_.fd(), .events = POLLIN, .revents = 0};
  const int patience = video_.possible() ? static_cast<int>(Video::kWatchPeriod.count()) : -1;
  while (!stop.stop_requested()) {
    video_.Watch(std::chrono::steady_clock::now());
    ::poll(&wakes, 1, patience);
    bell_.Answer();
    const Job* const job = jobs_.Front();
    if (job == nullptr) continue;
    Picture picture = Make(*job, stop);
    Show(*job, picture);
    jobs_.Pop();
    *pictures_.Claim() = std::move(picture);
    pictures_.Commit();
  }
  const std::lock_guard lock(mutex_);
  process_.reset();
}

void Cameras::Show(const Job& job, const Picture& picture) {
  const std::lock_guard lock(waiting_mutex_);
  const std::size_t shown = std::erase_if(waiting_, [&](Waiting& waiting) {
    if (waiting.camera != job.camera || waiting.look > job.looks) return false;
    waiting.picture.set_value(picture);
    return true;
  });
  if (shown > 0) news_.Ring();
}

bool Cameras::LooksForDepth(const Job& job) {
  const std::lock_guard lock(waiting_mutex_);
  return std::ranges::any_of(waiting_, [&](const Waiting& waiting) {
    return waiting.camera == job.camera && waiting.look <= job.looks && waiting.depth;
  });
}

Picture Cameras::Make(const Job& job, const std::stop_token& stop) {
  using enum Picture::Outcome;
  if (job.faults.lost) return {.order = job.order, .outcome = kLost};
  try {
    CameraProcess::Drawn drawn = Draw(job, stop);
    const auto kept = [](std::vector<std::uint8_t>& bytes) {
      return std::make_shared<const std::vector<std::uint8_t>>(std::move(bytes));
    };
    Picture picture{.order = job.order, .outcome = kDrawn, .jpeg = kept(drawn.jpeg)};
    if (!drawn.depth.empty()) picture.depth = kept(drawn.depth);
    return picture;
  } catch (const std::exception& error) {
    const std::lock_guard lock(mutex_);
    process_.reset();
    video_.Rest(std::chrono::steady_clock::now());
    if (!stop.stop_requested() && why_not_ != error.what()) {
      why_not_ = error.what();
      spdlog::warn("the cameras give no pictures: {}", why_not_);
    }
    return {.order = job.order, .outcome = kFailed};
  }
}

CameraProcess::Drawn Cameras::Draw(const Job& job, const std::stop_token& stop) {
  if (!process_) {
    const std::lock_guard lock(mutex_);
    if (!stop.stop_requested()) process_.emplace(program_, control_socket_);
  }
  CameraProcess::Drawn drawn = process_.value().Draw(cameras_[job.camera],
                                                     {.jpeg = job.jpeg,
                                                      .frame = job.frame,
                                                      .depth = LooksForDepth(job),
                                                      .again = job.faults.frozen,
                                                      .light = job.faults.light,
                                                      .noise = job.faults.noise},
                                                     job.state);
  if (job.frame) video_.Send(job.camera, job.state.time, drawn.frame);
  return drawn;
}

}  // namespace understudy::run
