#include "record/csv.h"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <optional>
#include <string>
#include <system_error>

#include <unistd.h>

#include "base/printed.h"

namespace understudy::record {
namespace {

std::string Cell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c == '\r' || c == '\n' ? ' ' : c;
  }
  return quoted + "\"";
}

std::string Heading(const RunColumn& column) {
  std::string text = column.name;
  if (column.kind == RunColumn::Kind::kBase) text = "base " + text;
  if (!column.quantity.empty()) text += " " + column.quantity;
  if (column.commanded) text += " commanded";
  if (!column.unit.empty()) text += " [" + column.unit + "]";
  return Cell(text);
}

// Writes the rows of one recording.
class TableRows final : public RunReader {
 public:
  // `name` stands in the first column; "" for none.
  TableRows(const RecordingReader& reader, const RunChoice& choice, double shift,
            const std::string& name, std::ostream* out)
      : RunReader(reader, choice),
        shift_(shift),
        name_(name.empty() ? "" : Cell(name) + ","),
        out_(*out),
        values_(columns().size()) {}

  void WriteHeader() {
    out_ << (name_.empty() ? "" : "recording,") << "time [s]";
    for (const RunColumn& column : columns()) out_ << ',' << Heading(column);
    out_ << ",events\r\n";
  }
  void WriteAll() {
    Read();
    Flush();
  }

 private:
  void Note(double at, double value, std::size_t column) override {
    Begin(at);
    values_[column] = value;
  }
  void NoteEvent(double at, const RecordedEvent& event) override {
    Begin(at);
    events_ += (events_.empty() ? "" : "; ") + event.kind + ": " + event.text;
  }

  void Begin(double at) {
    if (now_ && *now_ == at) return;
    Flush();
    now_ = at;
  }

  void Flush() {
    if (!now_) return;
    out_ << name_ << Printed("%.6f", *now_ + shift_);
    for (std::optional<double>& value : values_) {
      out_ << ',';
      if (value) out_ << Printed("%.9g", *value + 0.0);  // without the sign of -0
      value.reset();
    }
    out_ << ',' << Cell(events_) << "\r\n";
    events_.clear();
    now_.reset();
  }

  double shift_;  // s
  std::string name_;
  std::ostream& out_;
  std::optional<double> now_;                  // of the row, s
  std::vector<std::optional<double>> values_;  // by column
  std::string events_;
};

// What is asked for, on the second's clock.
RunChoice OfTheSameSlots(RunChoice choice, const RunReader& first, double shift) {
  choice.motors.clear();
  for (const RunMotor& motor : first.motors()) choice.motors.push_back(std::to_string(motor.slot));
  const bool ends = choice.to > 0;
  choice.from = std::max(0.0, choice.from - shift);
  choice.to -= ends ? shift : 0;
  if (ends && !(choice.to > choice.from)) {
    throw RecordError("--shift " + std::to_string(shift) + " leaves nothing in common");
  }
  return choice;
}

}  // namespace

void WriteCsv(const RecordingReader& first, const RecordingReader* second, double shift,
              const RunChoice& choice, const std::filesystem::path& file) {
  const std::filesystem::path part = file.string() + "." + std::to_string(::getpid()) + ".part";
  std::error_code ignored;
  try {
    std::ofstream out(part, std::ios::binary);
    if (!out) throw std::system_error(errno, std::generic_category());
    const std::string name = second == nullptr ? "" : first.path().filename().string();
    TableRows rows(first, choice, 0, name, &out);
    rows.WriteHeader();
    rows.WriteAll();
    if (second != nullptr) {
      TableRows(*second, OfTheSameSlots(choice, rows, shift), shift,
                second->path().filename().string(), &out)
          .WriteAll();
    }
    out.close();
    if (!out) throw std::system_error(errno, std::generic_category());
    std::filesystem::rename(part, file);
  } catch (const std::system_error& error) {
    std::filesystem::remove(part, ignored);
    throw RecordError(file.string() + ": cannot be written: " + error.code().message());
  } catch (...) {
    std::filesystem::remove(part, ignored);
    throw;
  }
}

}  // namespace understudy::record
