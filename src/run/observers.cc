#include "run/observers.h"

#include <filesystem>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "config/data_dir.h"
#include "exec/companion_file.h"
#include "mjcf/join.h"
#include "services/robot_services.h"

namespace understudy::run {
namespace {

// Where record.start puts what it is given no folder for; "" if that is gone.
std::filesystem::path RecordingFolder() {
  std::error_code gone;
  return std::filesystem::current_path(gone);
}

RecordingOptions OptionsOf(const RunOptions& options, const config::Config& config,
                           std::size_t robot) {
  RecordingOptions own = options.recording;
  own.file = RecordingOf(own.file, config, robot);
  if (!options.audiences.empty()) own.audience = options.audiences[robot];
  if (!options.obstacles.empty()) own.obstacles = options.obstacles[robot];
  return own;
}

}  // namespace

Observers::Observers(const RunOptions& options, const config::Config& config,
                     const robot::Draws& draws,
                     const std::shared_ptr<const assembly::SightModel>& sight, const Guest& guest,
                     emulator::Inbox* inbox, emulator::World* world)
    : snapshots_(*world, guest.index()),
      scene_([sight] { return sight->Get(); }),
      cameras_(*world, guest.index(), exec::CompanionFile("understudy-view"),
               options.access[guest.index()].socket, guest.robot().network, &guest.participant(),
               options.programs != nullptr),
      control_(options.access[guest.index()].socket,
               MakePlane(options, config, draws, guest, inbox, world), server::ServerLimits{},
               options.access[guest.index()].panel),
      recording_(OptionsOf(options, config, guest.index()), guest.index(), guest.participant(),
                 config, draws, sight, world),
      poster_(guest.index(), &board_, &recording_) {}

server::Plane Observers::MakePlane(const RunOptions& options, const config::Config& config,
                                   const robot::Draws& draws, const Guest& guest,
                                   emulator::Inbox* inbox, emulator::World* world) {
  const config::RobotConfig& robot = guest.robot();
  const bool alone = config.robots.size() == 1;
  std::vector<server::RobotPanel> robots;
  for (std::size_t i = 0; i < config.robots.size() && !alone; ++i) {
    const server::PanelSocket* panel = options.access[i].panel;
    robots.push_back({.name = config.robots[i].name, .url = panel == nullptr ? "" : panel->url()});
  }
  return {.identity = {.robot = robot.spec.name,
                       .name = alone ? "" : robot.name,
                       .log = options.log.string(),
                       .draws = draws},
          .robot = guest.index(),
          .board = &board_,
          .inbox = inbox,
          .snapshots = snapshots_.mailbox(),
          .views = &cameras_,
          .events = server::EventHistory(&world->events(), guest.index()),
          .scene = server::SceneFiles(&scene_, &robot.spec, config.PrefixOf(robot)),
          .bus = server::BusView(&guest.participant()),
          .sight = server::Sight(&guest.participant(),
                                 mjcf::WithPrefix(config.PrefixOf(robot), robot.spec)),
          .recordings = server::Recordings(RecordingFolder(), &scene_, robot.spec.name),
          .services = services::ServicesOf(robot.spec.apis),
          .files = server::StaticFiles(config::PanelDir()),
          .openapi = config::OpenApiFile(),
          .robots = std::move(robots)};
}

}  // namespace understudy::run
