#include "identify/samples.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <optional>
#include <system_error>
#include <utility>

#include <Eigen/QR>

#include "base/errors.h"
#include "base/nearest_word.h"
#include "record/cdr_field.h"
#include "record/player.h"
#include "wire/robot_topics.h"

namespace understudy::identify {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr double kReach = 0.01;         // s on either side of a state, for its rate; *assumed*
constexpr std::size_t kLeastReach = 3;  // states on either side
constexpr std::size_t kMostStates = 2'000'000;  // over an hour at 500 Hz
constexpr std::size_t kMostColumns = 1000;

Eigen::Index At(std::size_t i) { return static_cast<Eigen::Index>(i); }

std::string WithoutJoint(std::string name) {
  if (name.ends_with("_joint")) name.erase(name.size() - 6);
  return name;
}

void PutStates(const std::vector<std::vector<double>>& rows, std::size_t motors, Samples* samples) {
  samples->q.resize(At(motors), At(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t j = 0; j < motors; ++j) samples->q(At(j), At(i)) = rows[i][j];
  }
}

// Where a command's fields are in a slot of LowCmd.
struct CommandPlaces {
  record::CdrField mode, q, dq, tau, kp, kd;
};

CommandPlaces PlacesOf(const std::string& type, int slot) {
  const auto field = [&](const char* name) {
    return record::FindField(type, "motor_cmd[" + std::to_string(slot) + "]." + name);
  };
  return {.mode = field("mode"),
          .q = field("q"),
          .dq = field("dq"),
          .tau = field("tau"),
          .kp = field("kp"),
          .kd = field("kd")};
}

double Number(const record::CdrField& field, const record::McapMessage& message) {
  const std::optional<double> value = record::ReadField(field, message.data);
  return value && std::isfinite(*value) ? *value : kUnknown;
}

robot::MotorCommand CommandOf(const CommandPlaces& at, const record::McapMessage& message) {
  const auto number = [&](const record::CdrField& field) {
    const double value = Number(field, message);
    return std::isnan(value) ? 0.0 : value;
  };
  return {.enabled = number(at.mode) != 0,
          .q = number(at.q),
          .dq = number(at.dq),
          .tau = number(at.tau),
          .kp = number(at.kp),
          .kd = number(at.kd)};
}

double Median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::vector<std::string> Cells(std::string line) {
  if (!line.empty() && line.back() == '\r') line.pop_back();
  std::vector<std::string> cells;
  for (std::size_t begin = 0; begin <= line.size() && cells.size() < kMostColumns;) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    cells.push_back(line.substr(begin, end - begin));
    begin = end + 1;
  }
  return cells;
}

// A column of a CSV: a field of a motor's command, its angle, the time, or of no use.
struct Column {
  double robot::MotorCommand::*command = nullptr;
  bool angle = false, time = false, of_all = false;
  std::size_t motor = 0;
};

struct CommandWord {
  const char* word;
  double robot::MotorCommand::*field;
};
constexpr CommandWord kCommandWords[] = {{"q_des", &robot::MotorCommand::q},
                                         {"dq_des", &robot::MotorCommand::dq},
                                         {"kp", &robot::MotorCommand::kp},
                                         {"kd", &robot::MotorCommand::kd},
                                         {"tau_ff", &robot::MotorCommand::tau}};

Column ColumnOf(const std::string& header, const robot::RobotSpec& spec) {
  if (header == "time") return {.time = true};
  const std::size_t dot = header.rfind('.');
  const std::string word = dot == std::string::npos ? header : header.substr(dot + 1);
  Column column{.angle = word == "q", .of_all = dot == std::string::npos};
  for (const CommandWord& one : kCommandWords) {
    if (word == one.word) column.command = one.field;
  }
  if (column.of_all) {
    if (word != "kp" && word != "kd") return {};
    return column;
  }
  const std::string joint = WithoutJoint(header.substr(0, dot));
  for (std::size_t i = 0; i < spec.motors.size(); ++i) {
    column.motor = i;
    if (WithoutJoint(spec.motors[i].joint) == joint) return column;
  }
  return {};
}

// The first and the last of the states that tell where the joints were at one and how fast.
std::pair<std::size_t, std::size_t> Around(const std::vector<double>& times, std::size_t state) {
  const double t = times[state];
  std::size_t from = state, to = state;
  while (from > 0 && (state - from < kLeastReach || t - times[from - 1] <= kReach)) --from;
  while (to + 1 < times.size() && (to - state < kLeastReach || times[to + 1] - t <= kReach)) ++to;
  return {from, to};
}

}  // namespace

Samples ReadRecording(const record::RecordingReader& reader, const robot::RobotSpec& spec) {
  const std::string file = reader.path().string();
  Samples samples{.file = file};
  std::vector<record::CdrField> angles;
  std::optional<record::CdrField> tick;
  std::vector<CommandPlaces> places;
  std::vector<std::vector<double>> rows;
  std::vector<double> behind;  // s from tick to log time
  const std::uint64_t begin = reader.contents().first_time;
  const std::string family = spec.family == robot::WireFamily::kHg ? "unitree_hg" : "unitree_go";
  reader.ReadMessages([&](const record::McapChannel& channel, const record::McapMessage& message) {
    const record::McapSchema* schema = reader.SchemaOf(channel);
    const std::string topic = record::TopicOnWire(channel);
    if (schema == nullptr || (topic != wire::kLowStateName && topic != wire::kLowCmdName))
      return true;
    if (!schema->name.starts_with(family)) {
      throw RecordError(file + ": " + topic + " is of " + schema->name + ", but a " + spec.name +
                        " has " + family);
    }
    const double at =
        1e-9 * static_cast<double>(message.log_time - std::min(begin, message.log_time));
    if (topic == wire::kLowCmdName) {
      if (places.empty()) {
        for (const auto& motor : spec.motors) places.push_back(PlacesOf(schema->name, motor.slot));
      }
      robot::RobotCommand command;
      for (const CommandPlaces& place : places) command.motors.push_back(CommandOf(place, message));
      samples.command_times.push_back(at);
      samples.commands.push_back(std::move(command));
      return samples.commands.size() < kMostStates;
    }
    if (!tick) {
      tick = record::FindField(schema->name, "tick");
      for (const auto& motor : spec.motors) {
        angles.push_back(
            record::FindField(schema->name, "motor_state[" + std::to_string(motor.slot) + "].q"));
      }
    }
    const double own = 1e-3 * Number(*tick, message);
    if (std::isnan(own) || (!samples.times.empty() && own <= samples.times.back())) return true;
    std::vector<double> row;
    for (const record::CdrField& field : angles) row.push_back(Number(field, message));
    samples.times.push_back(own);
    behind.push_back(at - own);
    rows.push_back(std::move(row));
    return rows.size() < kMostStates;
  });
  if (rows.empty()) throw RecordError(file + ": has no messages of rt/lowstate");
  if (samples.commands.empty()) {
    throw RecordError(file +
                      ": has no messages of rt/lowcmd, so nothing says what moved the joints");
  }
  const double shift = Median(behind);
  for (double& time : samples.command_times) time -= shift;
  PutStates(rows, spec.motors.size(), &samples);
  return samples;
}

Samples ReadCsv(std::istream& text, const std::string& name, const robot::RobotSpec& spec) {
  Samples samples{.file = name};
  std::string line;
  std::getline(text, line);
  std::vector<Column> columns;
  bool timed = false, angles = false, commands = false;
  for (const std::string& header : Cells(line)) {
    columns.push_back(ColumnOf(header, spec));
    timed = timed || columns.back().time;
    angles = angles || columns.back().angle;
    commands = commands || columns.back().command != nullptr;
  }
  if (!timed || !angles || !commands) {
    throw RecordError(
        name + ":1: expected columns time, JOINT.q and JOINT.q_des, .kp, .kd of joints such as " +
        WithoutJoint(spec.motors.front().joint));
  }
  std::vector<std::vector<double>> rows;
  for (std::size_t number = 2; std::getline(text, line) && rows.size() < kMostStates; ++number) {
    const auto fail = [&](const std::string& what) {
      throw RecordError(name + ":" + std::to_string(number) + ": " + what);
    };
    const std::vector<std::string> cells = Cells(line);
    if (cells.size() != columns.size()) {
      fail("expected " + std::to_string(columns.size()) + " cells, got " +
           std::to_string(cells.size()));
    }
    double time = kUnknown;
    std::vector<double> row(spec.motors.size(), kUnknown);
    robot::RobotCommand command{
        .motors = std::vector<robot::MotorCommand>(spec.motors.size(), {.enabled = true})};
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const Column& column = columns[i];
      if (!column.time && !column.angle && column.command == nullptr) continue;
      if (cells[i].empty() && !column.time) continue;
      double value = 0;
      const char* end = cells[i].data() + cells[i].size();
      const auto [rest, error] = std::from_chars(cells[i].data(), end, value);
      if (error != std::errc() || rest != end || !std::isfinite(value)) {
        fail("expected a number, got '" + cells[i].substr(0, 40) + "'");
      }
      if (column.time) time = value;
      if (column.angle) row[column.motor] = value;
      if (column.command == nullptr) continue;
      if (!column.of_all) command.motors[column.motor].*column.command = value;
      for (auto& motor : command.motors) {
        if (column.of_all) motor.*column.command = value;
      }
    }
    if (!samples.times.empty() && time <= samples.times.back()) fail("the time does not grow");
    samples.times.push_back(time);
    rows.push_back(std::move(row));
    samples.command_times.push_back(time);
    samples.commands.push_back(std::move(command));
  }
  if (rows.empty()) throw RecordError(name + ": has no rows");
  PutStates(rows, spec.motors.size(), &samples);
  return samples;
}

Samples ReadSamples(const std::filesystem::path& file, const robot::RobotSpec& spec) {
  if (file.extension() != ".csv") return ReadRecording(*record::OpenRecording(file), spec);
  std::error_code error;
  if (std::filesystem::exists(file, error) && !std::filesystem::is_regular_file(file, error)) {
    throw RecordError(file.string() + ": is not a file");
  }
  std::ifstream text(file, std::ios::binary);
  if (!text) throw RecordError(file.string() + ": cannot be read");
  return ReadCsv(text, file.string(), spec);
}

robot::RobotCommand MeanCommand(const Samples& samples, double from, double to,
                                std::size_t* cursor) {
  constexpr double kSameInstant = 1e-7;  // s
  const std::vector<double>& times = samples.command_times;
  while (*cursor + 1 < times.size() && times[*cursor + 1] <= from + kSameInstant) ++*cursor;
  const robot::RobotCommand& first = samples.commands[*cursor];
  const std::size_t next = *cursor + 1;
  if (next >= times.size() || times[next] >= to - kSameInstant) return first;
  // Some of the next one. Where they differ by more than numbers, the longer one.
  const robot::RobotCommand& second = samples.commands[next];
  const double share = (to - times[next]) / (to - from);
  robot::RobotCommand mean = share > 0.5 ? second : first;
  for (std::size_t i = 0; i < mean.motors.size(); ++i) {
    const robot::MotorCommand &a = first.motors[i], &b = second.motors[i];
    const auto marked = [](const robot::MotorCommand& one) {
      return !one.enabled || one.q == robot::kNoPosition || one.dq == robot::kNoVelocity;
    };
    if (marked(a) || marked(b)) continue;
    for (const CommandWord& word : kCommandWords) {
      mean.motors[i].*word.field = a.*word.field + share * (b.*word.field - a.*word.field);
    }
  }
  return mean;
}

bool IsAmongStates(const Samples& samples, std::size_t state) {
  const auto [from, to] = Around(samples.times, state);
  // Those around it reach as far as they are to where there is one more beyond them.
  if (from == 0 || to + 1 == samples.times.size()) return false;
  for (std::size_t i = from; i <= to + 1; ++i) {
    if (samples.times[i] - samples.times[i - 1] > kLongestPause) return false;
  }
  return true;
}

JointState StateAt(const Samples& samples, std::size_t state, double timestep) {
  const std::vector<double>& times = samples.times;
  const double t = times[state];
  const auto [from, to] = Around(times, state);
  const Eigen::Index count = At(to - from + 1);
  Eigen::MatrixXd powers(count, 4);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double x = (times[from + static_cast<std::size_t>(i)] - t) / kReach;
    powers.row(i) << 1, x, x * x, x * x * x;
  }
  const Eigen::MatrixXd angles = samples.q.middleCols(At(from), count).transpose();
  const Eigen::MatrixXd cubics = powers.householderQr().solve(angles);
  const double x = -timestep / 2 / kReach;
  JointState found;
  for (Eigen::Index i = 0; i < angles.cols(); ++i) {
    found.q.push_back(cubics(0, i));
    found.dq.push_back((cubics(1, i) + x * (2 * cubics(2, i) + 3 * x * cubics(3, i))) / kReach);
  }
  return found;
}

}  // namespace understudy::identify
