#include "python/batch.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

namespace understudy::python {
namespace {

// Appends the values that a robot has now, in the order of Columns.
class Row {
 public:
  Row(std::vector<Column>* columns, std::size_t robot) : columns_(columns), robot_(robot) {}

  template <typename Values>
  void Add(const Values& values) {
    Column& column = (*columns_)[next_++];
    float* to = column.values.data() + robot_ * column.width;
    for (const double value : values) *to++ = static_cast<float>(value);
  }
  void Add(const Eigen::Quaterniond& q) { Add(std::array{q.w(), q.x(), q.y(), q.z()}); }
  template <typename Field>
  void Add(const std::vector<robot::MotorReading>& motors, Field robot::MotorReading::*field) {
    Column& column = (*columns_)[next_++];
    float* to = column.values.data() + robot_ * column.width;
    for (const robot::MotorReading& motor : motors) *to++ = static_cast<float>(motor.*field);
  }

 private:
  std::vector<Column>* columns_;
  std::size_t robot_;
  std::size_t next_ = 0;
};

std::vector<Column> Columns(const robot::RobotSpec& spec, std::size_t count) {
  const std::size_t motors = spec.motors.size(), feet = spec.feet.size();
  std::vector<Column> columns = {
      {"q", "rad", false, motors},
      {"dq", "rad/s", false, motors},
      {"tau_est", "N·m of the motors, before joint friction", false, motors},
      {"quaternion", "of the inertial unit in the world: w, x, y, z", false, 4},
      {"gyroscope", "rad/s in the unit's axes", false, 3},
      {"accelerometer", "m/s² in the unit's axes", false, 3},
      {"foot_force", "N as read", false, feet},
      {"position", "m, of the base in the world", true, 3},
      {"velocity", "m/s, of the base in the world's axes", true, 3},
      {"attitude", "of the base in the world: w, x, y, z; 0 for a fixed base", true, 4},
      {"turning_rate", "rad/s, of the base in its own axes; 0 for a fixed base", true, 3},
      {"torque", "N·m at the joints", true, motors},
      {"contact_force", "N on the feet", true, feet},
      {"tilt", "rad between the base's up and the world's", true, 1}};
  for (Column& column : columns) column.values.resize(column.width * count);
  return columns;
}

}  // namespace

Batch::Batch(const config::Layers& layers, std::size_t count, std::size_t threads, int seed)
    : threads_(std::max<std::size_t>(1, threads)) {
  constexpr std::size_t kMost = std::numeric_limits<int>::max();
  if (count == 0) throw std::invalid_argument("Batch: expected at least one robot, got 0");
  if (seed < 0 || count > kMost - static_cast<std::size_t>(seed)) {
    throw std::invalid_argument("Batch: expected seeds of 0 to 2147483647");
  }
  worlds_.resize(count);
  worlds_[0] = std::make_shared<PythonWorld>(layers);  // what is wrong is wrong with all of them
  if (worlds_[0]->simulation().world().robot_count() != 1) {
    throw std::invalid_argument("Batch: expected one robot a world");
  }
  const assembly::Simulation& first = worlds_[0]->simulation();
  OverThreads(count - 1,
              [&](std::size_t i) { worlds_[i + 1] = std::make_shared<PythonWorld>(first); });
  columns_ = Columns(robot(0).spec(), count);
  std::vector<std::size_t> all(count);
  std::vector<int> seeds(count);
  for (std::size_t i = 0; i < count; ++i) {
    all[i] = i;
    seeds[i] = seed + static_cast<int>(i);
  }
  Begin(all, seeds);
}

void Batch::Command(std::span<const robot::MotorCommand> motors) {
  const std::size_t width = motors.size() / worlds_.size();
  for (std::size_t i = 0; i < worlds_.size(); ++i) {
    const auto own = motors.subspan(i * width, width);
    worlds_[i]->port(0).Give(robot::kLowCmdTopic, {.motors = {own.begin(), own.end()}});
  }
}

void Batch::Step(double seconds) {
  OverThreads(worlds_.size(), [&](std::size_t i) {
    worlds_[i]->simulation().Step(worlds_[i]->StepsOf(seconds));
    Read(i);
  });
}

void Batch::Begin(std::span<const std::size_t> robots, std::span<const int> seeds,
                  std::span<const assembly::Place> at) {
  OverThreads(robots.size(), [&](std::size_t i) {
    std::vector<assembly::Place> own;
    if (!at.empty()) own.push_back(at[i]);
    worlds_[robots[i]]->Begin(seeds[i], own);
    worlds_[robots[i]]->simulation().Step();
    Read(robots[i]);
  });
}

void Batch::OverThreads(std::size_t count, const std::function<void(std::size_t)>& act) const {
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::exception_ptr thrown;
  const auto work = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        act(i);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (thrown == nullptr) thrown = std::current_exception();
      }
    }
  };
  {
    std::vector<std::jthread> others;
    for (std::size_t i = 1; i < std::min(threads_, count); ++i) others.emplace_back(work);
    work();
  }
  if (thrown != nullptr) std::rethrow_exception(thrown);
}

void Batch::Read(std::size_t i) {
  const PythonRobot one = robot(i);
  const robot::RobotState& state = one.lowstate();
  const physics::RobotBody& body = one.body();
  Row row(&columns_, i);
  row.Add(state.motors, &robot::MotorReading::q);
  row.Add(state.motors, &robot::MotorReading::dq);
  row.Add(state.motors, &robot::MotorReading::tau);
  row.Add(state.imu.R_WI);
  row.Add(state.imu.w_WI_I);
  row.Add(state.imu.f_WI_I);
  row.Add(state.foot_force);
  row.Add(body.base().p_WB);
  row.Add(body.base().v_WB_W);
  const std::span<const double> position = body.base_position(), velocity = body.base_velocity();
  row.Add(position.empty() ? position : position.subspan(3, 4));
  row.Add(velocity.empty() ? velocity : velocity.subspan(3, 3));
  row.Add(one.part().torque());
  std::vector<double> force(one.spec().feet.size());
  body.FootForces(force);
  row.Add(force);
  row.Add(std::array{body.tilt()});
}

}  // namespace understudy::python
