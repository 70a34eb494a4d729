#include "server/recordings.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstring>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <system_error>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>
#include <unistd.h>

#include "base/errors.h"
#include "base/unique_fd.h"
#include "record/mcap_format.h"
#include "record/truth_reader.h"

namespace understudy::server {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr double kMostPoseHz = 60;  // poses a second; *assumed*, as many as screens show

// How long a list looks into files; *assumed*: no longer than others may wait.
constexpr std::chrono::milliseconds kLooking{50};

constexpr double kRounding = 1e-6;  // s, far less than a step

bool IsName(std::string_view name) {
  constexpr std::string_view kEnding = ".mcap";
  constexpr std::size_t kLongestName = 128;
  return name.size() > kEnding.size() && name.size() <= kLongestName && name.ends_with(kEnding) &&
         name.front() != '.' && std::ranges::all_of(name, [](char c) {
           return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                  c == '.' || c == '-' || c == '_';
         });
}

// How a file ends: as a finished one does, and with a summary. Another one would have to be read
// from its beginning, and it may be long.
struct FileEnd {
  bool finished = false, summary = false;
};

FileEnd EndOf(const fs::path& file) {
  // O_NONBLOCK: a pipe that has taken the file's place must not keep the control plane waiting.
  const UniqueFd fd(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
  struct stat about {};
  std::array<char, record::kMcapFooter + record::kMcapMagic.size()> end{};
  if (!fd.valid() || ::fstat(fd.get(), &about) != 0 || !S_ISREG(about.st_mode) ||
      ::pread(fd.get(), end.data(), end.size(), about.st_size - static_cast<off_t>(end.size())) !=
          static_cast<ssize_t>(end.size())) {
    return {};
  }
  std::uint64_t summary = 0;  // where it begins
  std::memcpy(&summary, end.data(), sizeof summary);
  return {.finished = std::memcmp(end.data() + record::kMcapFooter, record::kMcapMagic.data(),
                                  record::kMcapMagic.size()) == 0,
          .summary = summary != 0};
}

std::string NotFinished(const fs::path& file) {
  return file.filename().string() +
         " is not finished: it is being written, or its writer was killed; `mcap recover` makes it "
         "whole";
}

double SecondsSince1970(fs::file_time_type time) {
  const auto wall = std::chrono::file_clock::to_sys(time);
  return std::chrono::duration<double>(wall.time_since_epoch()).count();
}

// nullopt if there is none, NaN if it is no number.
std::optional<double> NumberOf(const HttpRequest& request, std::string_view name) {
  const auto text = QueryValue(request, name);
  if (!text) return std::nullopt;
  double number = 0;
  const char* const end = text->data() + text->size();
  const bool read = std::from_chars(text->data(), end, number).ptr == end && !text->empty();
  return read && std::isfinite(number) ? number : std::nan("");
}

// With a float's precision, whose digits are half the text.
ordered_json Floats(std::span<const double> values) {
  ordered_json list = ordered_json::array();
  for (const double value : values) list.push_back(static_cast<float>(value));
  return list;
}

struct Poses {
  double from = 0, to = 0, hz = 30;
};

// Why the query is none of poses; "" if it is.
std::string ReadQuery(const HttpRequest& request, Poses* poses) {
  poses->from = NumberOf(request, "from").value_or(std::nan(""));
  poses->to = NumberOf(request, "to").value_or(std::nan(""));
  poses->hz = NumberOf(request, "hz").value_or(poses->hz);
  if (!(poses->from >= 0 && poses->to >= poses->from &&
        poses->to - poses->from <= Recordings::kLongest)) {
    return "from, to: expected two ascending numbers of s from 0 on, at most 10 apart";
  }
  if (!(poses->hz >= 1 && poses->hz <= kMostPoseHz)) return "hz: expected a number from 1 to 60";
  return "";
}

}  // namespace

std::string RefusedOverTcp(const emulator::Request& request) {
  if (request.row->name != "record.start" || request.file().empty() || IsName(request.file())) {
    return "";
  }
  return "file: over the network expected the name of an .mcap file, without a folder";
}

std::string Recordings::WhyNotPlayed(const fs::path& file) const {
  const FileEnd end = EndOf(file);
  if (!end.finished) return NotFinished(file);
  if (!end.summary) return "";
  try {
    return OtherRobot(file, record::McapReader(file));
  } catch (const SetupError& refused) {
    return refused.what();
  }
}

std::string Recordings::OtherRobot(const fs::path& file, const record::McapReader& reader) const {
  const auto& metadata = reader.contents().metadata;
  const auto about = metadata.find("understudy");
  const std::string robot =
      about == metadata.end() || !about->second.contains("robot") ? "" : about->second.at("robot");
  if (robot == robot_) return "";
  return file.filename().string() + " is of the robot '" + robot.substr(0, 32) + "', and this is " +
         robot_;
}

HttpReply Recordings::List() {
  struct Found {
    double written = 0;  // s since 1970
    std::string name;
    std::uintmax_t bytes = 0;
  };
  std::vector<Found> found;
  std::error_code error;
  if (!folder_.empty()) {
    for (fs::directory_iterator it(folder_, error), end; !error && it != end; it.increment(error)) {
      const std::string name = it->path().filename().string();
      std::error_code gone;
      if (!IsName(name) || it->symlink_status(gone).type() != fs::file_type::regular) continue;
      const auto bytes = it->file_size(gone);
      const auto written = it->last_write_time(gone);
      if (gone) continue;
      found.push_back({SecondsSince1970(written), name, bytes});
    }
  }
  std::ranges::stable_sort(found, std::greater<>(), &Found::written);
  if (found.size() > kMost) found.resize(kMost);
  std::map<std::string, Seen> seen;  // what is gone is forgotten
  ordered_json recordings = ordered_json::array();
  const auto enough = std::chrono::steady_clock::now() + kLooking;
  for (const Found& file : found) {
    ordered_json told{{"name", file.name}, {"bytes", file.bytes}, {"written", file.written}};
    const auto known = seen_.find(file.name);
    if (known != seen_.end() && known->second.written == file.written &&
        known->second.bytes == file.bytes) {
      seen.insert(seen_.extract(known));
    } else if (std::chrono::steady_clock::now() < enough) {
      seen[file.name] = {.written = file.written,
                         .bytes = file.bytes,
                         .why_not = WhyNotPlayed(folder_ / file.name)};
    }
    const auto now = seen.find(file.name);
    if (now != seen.end() && !now->second.why_not.empty()) told["why_not"] = now->second.why_not;
    recordings.push_back(std::move(told));
  }
  seen_ = std::move(seen);
  return {.body = JsonText({{"folder", folder_.string()}, {"recordings", recordings}}) + "\n"};
}

HttpReply Recordings::Show(const HttpRequest& request, std::string_view name) const {
  const fs::path file = folder_ / name;
  std::error_code error;
  if (folder_.empty() || !IsName(name) ||
      fs::symlink_status(file, error).type() != fs::file_type::regular) {
    return ErrorReply(404, "no recording " + std::string{name.substr(0, 64)});
  }
  const bool with_poses = QueryValue(request, "from") || QueryValue(request, "to");
  Poses asked;
  if (const std::string why = with_poses ? ReadQuery(request, &asked) : ""; !why.empty()) {
    return ErrorReply(400, why);
  }
  if (!EndOf(file).finished) return ErrorReply(409, NotFinished(file));
  try {
    const record::TruthReader truth(file);
    if (const std::string why = OtherRobot(file, truth.reader()); !why.empty())
      return ErrorReply(409, why);
    ordered_json told{{"from", truth.whole().from}, {"to", truth.whole().to}};
    if (!with_poses) return {.body = JsonText(told) + "\n"};
    if (scene_ == nullptr) return ErrorReply(404, "there is no scene");
    ordered_json times = ordered_json::array(), bodies = ordered_json::array();
    ordered_json positions = ordered_json::array(), torques = ordered_json::array(),
                 feet = ordered_json::array(), tensions = ordered_json::array();
    double next = asked.from;
    truth.Read({.from = asked.from, .to = asked.to}, scene_->positions(),
               [&](const record::Truth& state) {
                 if (state.time < next - kRounding) return true;
                 times.push_back(state.time);
                 ordered_json poses = ordered_json::array();
                 for (const auto& pose : scene_->Poses(state.qpos)) poses.push_back(Floats(pose));
                 bodies.push_back(std::move(poses));
                 positions.push_back(Floats(state.qpos));
                 torques.push_back(Floats(state.tau));
                 feet.push_back(Floats(state.foot_force));
                 tensions.push_back(static_cast<float>(state.crane_tension));
                 next = std::max(next, state.time - 0.5 / asked.hz) + 1 / asked.hz;
                 return true;
               });
    told["times"] = std::move(times);
    told["bodies"] = std::move(bodies);
    told["qpos"] = std::move(positions);
    told["tau"] = std::move(torques);
    told["feet"] = std::move(feet);
    told["crane_tension"] = std::move(tensions);
    return {.body = JsonText(told) + "\n"};
  } catch (const SetupError& refused) {
    return ErrorReply(409, refused.what());
  }
}

}  // namespace understudy::server
