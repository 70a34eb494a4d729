#include "perception.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include <mujoco/mujoco.h>

#include "assembly/simulation.h"
#include "config/data_dir.h"
#include "config/load.h"
#include "perception/lidar.h"
#include "perception/ray_caster.h"
#include "process.h"

namespace understudy::bench {
namespace {

// Rays as a lidar casts them: half circles down from the base.
std::vector<perception::Ray> RaysFrom(const Eigen::Vector3d& origin) {
  std::vector<perception::Ray> rays;
  for (int i = 0; i < 12 * 120; ++i) {
    const double up = M_PI * (i % 120 + 0.5) / 120, around = 0.38 * (i / 120);
    rays.push_back(
        {origin,
         {std::cos(up) * std::cos(around), std::cos(up) * std::sin(around), -std::sin(up)}});
  }
  return rays;
}

double Slowly(const mjModel& model, const mjData& data, const perception::Ray& ray) {
  int geom = -1;
  return mj_ray(&model, &data, ray.origin.data(), ray.direction.data(), nullptr, 1, -1, &geom
#if mjVERSION_HEADER >= 350
                ,
                nullptr
#endif
  );
}

// Microseconds of CPU per call, of `count` calls.
template <class Call>
double Microseconds(std::int64_t count, Call call) {
  const double start = ThreadCpu();
  for (std::int64_t i = 0; i < count; ++i) call(i);
  return 1e6 * (ThreadCpu() - start) / static_cast<double>(count);
}

// A make, the robot that carries it, and the share of a core that it may take.
struct Device {
  const char* make;
  const char* robot;
  double most;
};
constexpr Device kDevices[] = {{"L1", "go2", 0.01}, {"L2", "go2", 0.02}, {"Mid-360", "g1", 0.06}};

std::vector<Figure> Measure(const std::string& place, const Device& device,
                            const config::Config& config, int clouds) {
  assembly::Simulation simulation(config);
  simulation.Step(2000);
  const physics::MujocoWorld& physics = simulation.world().physics();
  const mjModel& model = physics.model();
  const mjData& data = physics.data();
  perception::RayCaster scene(model, data);
  const robot::RobotSpec& spec = simulation.config().robots[0].spec;
  const int body = physics.robot().Body(spec.lidar.body.empty() ? spec.base_body : spec.lidar.body);
  const auto rays = RaysFrom(physics.robot().base().p_WB + Eigen::Vector3d(0.3, 0, -0.15));
  const auto ray = [&rays](std::int64_t i) -> const auto& {
    return rays[static_cast<std::size_t>(i) % rays.size()];
  };
  double sum = 0;
  const auto count = static_cast<std::int64_t>(rays.size());
  const double fast =
      Microseconds(clouds * count, [&](std::int64_t i) { sum += scene.Cast(ray(i)).geom; });
  const double slow =
      Microseconds(count, [&](std::int64_t i) { sum += Slowly(model, data, ray(i)); });
  perception::Lidar lidar(spec.lidar, {}, body, model, data, scene, physics.timestep());
  const auto steps =
      static_cast<std::int64_t>(clouds / lidar.law().cloud_hz() / physics.timestep());
  const double step = Microseconds(steps, [&](std::int64_t i) {
    scene.Follow(i, data);
    sum += lidar.Sense(i, data, scene) ? 1 : 0;
  });
  if (!std::isfinite(sum)) return {};
  const std::string share = std::string(device.make) + ", share of a core, " + place;
  std::vector<Figure> figures{
      {device.robot, share, "", step * 1e-6 / physics.timestep(), device.most, Wanted::kAtMost}};
  if (device.make != std::string("L2")) {  // its rays are the L1's
    figures.push_back({device.robot, "ray, " + place, "us", fast, 0.5, Wanted::kAtMost});
    figures.push_back({device.robot, "the same by mj_ray, " + place, "us", slow});
  }
  return figures;
}

}  // namespace

std::vector<Figure> MeasurePerception(int clouds) {
  const std::filesystem::path data = config::DataDir();
  const std::vector<std::string> terrain = {
      "scene=row",
      "terrain.patches=[{kind: flat}, {kind: rough}, {kind: boxes}, {kind: obstacles}, "
      "{kind: stairs_up}]"};
  std::vector<Figure> figures;
  for (const Device& device : kDevices) {
    for (const bool flat : {true, false}) {
      std::vector<std::string> sets = flat ? std::vector<std::string>() : terrain;
      sets.push_back(std::string("robot.lidar.make=") + device.make);
      const config::Config config = config::LoadConfig({.robot = device.robot, .sets = sets}, data);
      for (Figure& figure : Measure(flat ? "flat" : "terrain", device, config, clouds)) {
        figures.push_back(std::move(figure));
      }
    }
  }
  return figures;
}

}  // namespace understudy::bench
