// Reads a recorded run as columns of numbers over time: for plots, for tables,
// and for finding where nothing moves.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "record/cdr_field.h"
#include "record/recording_reader.h"
#include "record/truth.h"

namespace understudy::record {

// What is to be read.
struct RunChoice {
  std::vector<std::string> motors{};   // joints, with or without _joint, or slots; empty: all
  std::vector<std::string> fields{};   // of motors: q, dq, tau, temperature; empty: q, tau
  std::vector<std::string> signals{};  // "rt/lowstate:imu_state.gyroscope[2]", with ROS or DDS
                                       // names of topics
  double from = 0, to = 0;             // s of simulated time; `to` 0: the recording's end
};

struct RunMotor {
  std::string name;  // without _joint; the slot's number where nobody names it
  int slot = 0;
};

// One quantity of a run.
struct RunColumn {
  enum class Kind { kBase, kMotor, kSignal };

  Kind kind = Kind::kBase;
  std::string name;      // "height"; of a motor "FR_calf"; of a signal as it was asked for
  std::string quantity;  // of a motor: "q"
  std::string unit;      // "" if unknown
  // Of motors: indices of field and motor in what was asked for, and whether it is commanded.
  std::size_t field = 0, motor = 0;
  bool commanded = false;
  // Where it stands: of motors and signals.
  std::string topic{};  // on the wire
  CdrField place{};
  // Larger values are skipped: kNoPosition and kNoVelocity of commands.
  double most = std::numeric_limits<double>::infinity();
};

// Columns of the base: its height, roll, pitch and yaw.
inline constexpr std::size_t kBaseColumns = 4;

class RunReader {
 public:
  // `reader` must outlive it. Throws RecordError for an unknown motor, field or signal, with the
  // nearest word, and for a span in which there is nothing.
  RunReader(const RecordingReader& reader, const RunChoice& choice);
  virtual ~RunReader() = default;
  RunReader(const RunReader&) = delete;
  RunReader& operator=(const RunReader&) = delete;

  double from() const { return from_; }  // s of simulated time
  double to() const { return to_; }
  // The base's, then measured and commanded values by field and motor, then the signals'.
  const std::vector<RunColumn>& columns() const { return columns_; }
  const std::vector<RunMotor>& motors() const { return motors_; }
  const std::vector<std::string>& fields() const { return fields_; }
  // The metadata "understudy"; "" for what is not there.
  std::string About(const std::string& key) const;

 protected:
  // Reads the span and calls the two below, in the order of the file.
  void Read();

  // Gets every number of a column, at its time [s]; it is finite.
  virtual void Note(double at, double value, std::size_t column) = 0;
  virtual void NoteEvent(double at, const RecordedEvent& event) = 0;

  const RecordingReader& reader() const { return reader_; }

 private:
  void FindMotors(std::vector<RunMotor>* known);
  void AskForMotors(const RunChoice& choice);
  void AskForSignals(const RunChoice& choice);
  void Ask(std::size_t field, std::size_t motor, bool commanded, std::string_view topic,
           std::string path);
  void NoteTruth(double at, const Truth& truth, const BaseAddress& base);
  void Tell(double at, double value, std::size_t column);

  const RecordingReader& reader_;
  StringMap about_;
  std::uint64_t beginning_ = 0;                            // log time of simulated time 0
  std::map<std::string, std::string, std::less<>> types_;  // by topic on the wire
  double from_ = 0, to_ = 0;
  std::vector<RunMotor> motors_;
  std::vector<std::string> fields_;
  std::vector<RunColumn> columns_;
};

// When something moves in a recording [s of simulated time]: from the first to the last movement
// of base and joints by more than kStill, command to a joint by as much, or event after the begin
// that pictures show.
struct BusySpan {
  double from = 0, to = 0;
  double end = 0;     // of the recording
  bool never = true;  // nothing moves
};
// *Assumed*: more than a robot sways that is kept standing. m of height, degrees of attitude, rad
// of joints.
struct Still {
  double height = 0.01, attitude = 1, q = 0.02;
};
inline constexpr Still kStill;
BusySpan BusySpanOf(const RecordingReader& reader);

}  // namespace understudy::record
