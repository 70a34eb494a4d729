#include "rehearse/lidar_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include <mujoco/mujoco.h>

#include "base/errors.h"
#include "base/printed.h"
#include "mjcf/compile.h"
#include "mjcf/eigen_views.h"
#include "mjcf/mujoco_handles.h"
#include "record/lidar_messages.h"
#include "record/player.h"
#include "record/svg_plot.h"
#include "record/truth_reader.h"
#include "robot/rotations.h"

namespace understudy::rehearse {
namespace {

constexpr char kModelName[] = "model.mjb";
// The clouds in the lidar's own frame; a robot has one of them.
constexpr std::array<std::string_view, 2> kCloudNames = {"rt/utlidar/cloud",
                                                         "rt/utlidar/cloud_livox_mid360"};
// All *assumed*: what shows a room and still the instant.
constexpr double kSpan = 1;               // s
constexpr std::size_t kEnough = 20'000;   // points
constexpr double kReach = 4;              // m from the robot to the picture's edge
constexpr double kCell = 0.05;            // m
constexpr int kCells = 160, kPixels = 2;  // along each side; of a cell
constexpr double kLowest = 0.02;          // share of points that may lie below the ground
// m over the ground: the least height of each class but the first.
constexpr std::array<double, 5> kBands = {0.1, 0.25, 0.5, 1.0, 1.8};

int BodyOf(const mjModel& model, const std::string& name) {
  const int body = mj_name2id(&model, mjOBJ_BODY, name.c_str());
  if (body >= 0) return body;
  throw ModelError("the recorded model has no body '" + name + "'");
}

// Places of bodies at the instants of a recording.
class Poses {
 public:
  explicit Poses(const record::TruthReader& truth) : truth_(truth) {
    const std::vector<std::byte> bytes = truth.reader().ReadAttachment(kModelName);
    model_ = mjcf::ReadBinaryModel({reinterpret_cast<const char*>(bytes.data()), bytes.size()},
                                   truth.reader().path().string() + ", " + kModelName);
    data_ = mjcf::MakeDataWithoutContacts(*model_);
  }

  const mjModel& model() const { return *model_; }

  // Returns the pose in the world as of `at` [s] or the last state before.
  Eigen::Isometry3d At(int body, double at) {
    const auto nq = static_cast<std::size_t>(model_->nq);
    truth_.Read({.from = at - record::TruthReader::kLookBack, .to = at + 1e-6}, nq,
                [&](record::Truth truth) {
                  std::ranges::copy(truth.qpos, data_->qpos);
                  return true;
                });
    mj_kinematics(model_.get(), data_.get());
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = mjcf::RotationView(data_->xmat + 9 * body);
    pose.translation() = mjcf::Vector(data_->xpos + 3 * body);
    return pose;
  }

 private:
  const record::TruthReader& truth_;
  mjcf::ModelHandle model_;
  mjcf::DataHandle data_;
};

struct Cloud {
  double at = 0;  // s
  std::vector<Eigen::Vector3f> points{};
};

// In order of time.
std::vector<Cloud> CloudsBefore(const record::TruthReader& truth, double at) {
  const record::RecordingReader& reader = truth.reader();
  const std::uint64_t end = truth.LogTime(at), from = truth.LogTime(std::max(0.0, at - kSpan));
  std::vector<Cloud> clouds;
  reader.ReadMessages(
      from, end, [&](const record::McapChannel& channel, const record::McapMessage& message) {
        if (std::ranges::find(kCloudNames, record::TopicOnWire(channel)) == kCloudNames.end()) {
          return true;
        }
        clouds.push_back({.at = at - 1e-9 * static_cast<double>(end - message.log_time),
                          .points = record::ReadPointCloud(message.data)});
        return true;
      });
  std::size_t points = 0, first = clouds.size();
  while (first > 0 && points < kEnough) points += clouds[--first].points.size();
  clouds.erase(clouds.begin(), clouds.begin() + static_cast<std::ptrdiff_t>(first));
  return clouds;
}

// Where the ground is, as most lidars see it: the lowest points but for a few.
float GroundOf(const LidarView& points) {
  std::vector<float> heights;
  for (const Eigen::Vector3f& p : points) heights.push_back(p.z());
  const auto at =
      heights.begin() + static_cast<std::ptrdiff_t>(kLowest * static_cast<double>(heights.size()));
  std::ranges::nth_element(heights, at);
  return *at;
}

std::string Ring(double radius) {
  const double middle = kCells * kPixels / 2.0, pixels = radius / kCell * kPixels;
  const std::string at = record::Pixels(middle);
  return "<circle class=\"ring\" cx=\"" + at + "\" cy=\"" + at + "\" r=\"" +
         record::Pixels(pixels) + "\"/>" +
         record::TextAt(middle + 3, middle - pixels - 2, "metres", Printed("%.0f m", radius));
}

}  // namespace

LidarView ReadLidarView(const std::filesystem::path& recording, const robot::RobotSpec& spec,
                        double at) {
  const record::TruthReader truth(recording);
  const std::vector<Cloud> clouds = CloudsBefore(truth, at);
  LidarView view;
  if (clouds.empty()) return view;
  Poses poses(truth);
  const int base = BodyOf(poses.model(), spec.base_body);
  const int body = spec.lidar.body.empty() ? base : BodyOf(poses.model(), spec.lidar.body);
  Eigen::Isometry3d T_WB = poses.At(base, at);
  const double yaw = std::atan2(T_WB.linear()(1, 0), T_WB.linear()(0, 0));
  T_WB.linear() = robot::FromRollPitchYaw({0, 0, yaw});
  Eigen::Isometry3d T_CL = Eigen::Isometry3d::Identity();  // the lidar in what carries it
  T_CL.linear() = robot::FromRollPitchYaw(spec.lidar.rpy);
  T_CL.translation() = spec.lidar.pos;
  for (const Cloud& cloud : clouds) {
    const Eigen::Isometry3d T_BL = T_WB.inverse() * poses.At(body, cloud.at) * T_CL;
    for (const Eigen::Vector3f& p : cloud.points) {
      view.emplace_back((T_BL * p.cast<double>()).cast<float>());
    }
  }
  return view;
}

std::string DrawLidarView(const LidarView& points) {
  std::array<std::array<float, kCells>, kCells> highest;  // by row from ahead, column from the left
  for (auto& row : highest) row.fill(-HUGE_VALF);
  const float ground = points.empty() ? 0 : GroundOf(points);
  for (const Eigen::Vector3f& p : points) {
    const double row = (kReach - p.x()) / kCell, column = (kReach - p.y()) / kCell;
    if (!(row >= 0 && row < kCells && column >= 0 && column < kCells)) continue;
    float& height = highest[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
    height = std::max(height, p.z() - ground);
  }
  std::array<std::string, kBands.size() + 1> paths;
  for (std::size_t row = 0; row < kCells; ++row) {
    for (std::size_t column = 0; column < kCells; ++column) {
      const float height = highest[row][column];
      if (height == -HUGE_VALF) continue;
      const auto band = std::ranges::upper_bound(kBands, height) - kBands.begin();
      paths[static_cast<std::size_t>(band)] += "M" + std::to_string(column * kPixels) + " " +
                                               std::to_string(row * kPixels + kPixels / 2) + "h" +
                                               std::to_string(kPixels);
    }
  }
  const std::string side = std::to_string(kCells * kPixels);
  std::string svg = "<svg class=\"above\" viewBox=\"0 0 " + side + " " + side + "\" width=\"" +
                    side + "\" height=\"" + side + "\">";
  for (double radius = 1; radius < kReach; ++radius) svg += Ring(radius);
  for (std::size_t band = 0; band < paths.size(); ++band) {
    if (paths[band].empty()) continue;
    svg += "<path class=\"height" + std::to_string(band) + "\" d=\"" + paths[band] + "\"/>";
  }
  const int middle = kCells * kPixels / 2;
  svg += Printed("<path class=\"robot\" d=\"M%d %dl5 14l-5 -4l-5 4z\"/></svg>", middle, middle - 7);
  return svg;
}

}  // namespace understudy::rehearse
