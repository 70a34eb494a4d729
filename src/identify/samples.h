// Joint states and joint commands of a recording, for fitting a robot's figures.
#pragma once

#include <filesystem>
#include <istream>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "record/recording_reader.h"
#include "robot/robot_spec.h"
#include "robot/robot_values.h"

namespace understudy::identify {

inline constexpr double kLongestPause = 0.05;  // s between two states that belong together

// The angles of joints, and the commands to the body's motors. Times are s of one clock, ascending.
struct Samples {
  std::string file{};
  std::vector<double> times{};  // of the states
  Eigen::MatrixXd q{};          // rad, a row per motor, a column per state; NaN: not said
  std::vector<double> command_times{};
  std::vector<robot::RobotCommand> commands{};
};

// Reads rt/lowstate and rt/lowcmd. The robot's own clock, `tick`, says when a state was; a command
// is of when it was recorded, by that clock. Throws RecordError where either is missing or of
// another family than the robot's.
Samples ReadRecording(const record::RecordingReader& reader, const robot::RobotSpec& spec);

// Reads comma-separated values: a header, then a row per instant. Columns are `time` [s] and, by
// joint with or without "_joint", NAME.q [rad] and the command NAME.q_des [rad], NAME.dq_des
// [rad/s], NAME.kp, NAME.kd, NAME.tau_ff [N·m]; `kp` and `kd` alone are of all joints. A command
// without a column is 0; others are skipped. An empty cell of q says nothing. Throws RecordError
// with the line that is wrong.
Samples ReadCsv(std::istream& text, const std::string& name, const robot::RobotSpec& spec);

// Reads a file of either form: by its name a CSV, else a recording (record::OpenRecording).
Samples ReadSamples(const std::filesystem::path& file, const robot::RobotSpec& spec);

// Returns what is commanded on average from `from` to `to` [s]: each command holds until the next.
// Before the first it is the first. The time advances with `cursor`, which starts at 0.
robot::RobotCommand MeanCommand(const Samples& samples, double from, double to,
                                std::size_t* cursor);

// Returns angles [rad] at a state and rates [rad/s] half a `timestep` [s] before it, where the
// rates of a simulation by such steps belong: a step moves the angles by the rates at its end. They
// are those of cubics through some 10 ms of angles on either side, since rates as robots tell them
// are noisier. NaN where the angles are not said.
struct JointState {
  std::vector<double> q, dq;
};
// Whether the states on either side of one reach far enough for that, without a pause of more than
// 50 ms: the rate of a cubic at its end is many times as uncertain as in its middle.
bool IsAmongStates(const Samples& samples, std::size_t state);
JointState StateAt(const Samples& samples, std::size_t state, double timestep);

}  // namespace understudy::identify
