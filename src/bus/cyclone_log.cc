#include "bus/cyclone_log.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <mutex>
#include <system_error>
#include <utility>

#include <dds/dds.h>

namespace understudy::bus {
namespace {

constexpr std::size_t kMostKinds = 16;
// Cyclone 0.10.2 logs "data(application, vendor 1.16): 110e77a:c13dcf8d:8542de61:103 #2:
// deserialization TOPIC/TYPE failed (why)", with the GUID of the writer in four words.
constexpr std::string_view kUndecoded = "deserialization ";

// Removes the digits, also hexadecimal ones: the rest is the same for lines of one kind.
std::string KindOf(std::string_view line) {
  std::string kind;
  for (const char letter : line) {
    if (std::isxdigit(static_cast<unsigned char>(letter)) == 0) kind += letter;
  }
  return kind;
}

// Returns the GUID before "#" in the beginning of such a line; zeros if there is none.
UndecodedSamples::Writer WriterIn(std::string_view line) {
  UndecodedSamples::Writer writer{};
  const std::size_t end = line.rfind(" #");
  const std::size_t begin = line.rfind(' ', end == 0 ? end : end - 1);
  if (end == std::string_view::npos || begin == std::string_view::npos) return writer;
  std::array<std::uint32_t, 4> words{};  // "110a1c3:77e8a4e0:3:2"
  const char* at = line.data() + begin + 1;
  const char* const last = line.data() + end;
  for (std::uint32_t& word : words) {
    const auto [next, error] = std::from_chars(at, last, word, 16);
    if (error != std::errc()) return writer;
    at = std::min(next + 1, last);
  }
  for (std::size_t i = 0; i < writer.size(); ++i) {
    writer[i] = static_cast<std::uint8_t>(words[i / 4] >> (24 - 8 * (i % 4)));
  }
  return writer;
}

class CycloneLog {
 public:
  CycloneLog() { dds_set_log_sink(&Keep, this); }

  std::vector<CycloneNotice> Take() {
    const std::lock_guard lock(mutex_);
    std::vector<CycloneNotice> notices;
    for (Kind& kind : kinds_) notices.push_back(std::move(kind.notice));
    kinds_.clear();
    return notices;
  }

  const UndecodedSamples& Undecoded(std::string_view topic) {
    const std::lock_guard lock(mutex_);
    return undecoded_[std::string(topic)];
  }
  std::map<UndecodedSamples::Writer, std::uint64_t> ByWriter(std::string_view topic) {
    const std::lock_guard lock(mutex_);
    return undecoded_[std::string(topic)].of;
  }

 private:
  struct Kind {
    std::string name;
    CycloneNotice notice;
  };

  static void Keep(void* self, const dds_log_data_t* data) {
    std::string_view line(data->message);
    while (!line.empty() && line.back() == '\n') line.remove_suffix(1);
    static_cast<CycloneLog*>(self)->Add(line);
  }

  void Add(std::string_view line) {
    const std::lock_guard lock(mutex_);
    CountUndecoded(line);
    std::string name = KindOf(line);
    auto kind = std::ranges::find(kinds_, name, &Kind::name);
    if (kind == kinds_.end() && kinds_.size() >= kMostKinds) {
      name.clear();
      kind = std::ranges::find(kinds_, name, &Kind::name);
    }
    const std::uint64_t before = kind == kinds_.end() ? 0 : kind->notice.count;
    if (kind != kinds_.end()) kinds_.erase(kind);
    kinds_.push_back({.name = name, .notice = {.line = std::string(line), .count = before + 1}});
  }

  // Counts only topics that this process reads.
  void CountUndecoded(std::string_view line) {
    const std::size_t at = line.find(kUndecoded);
    if (at == std::string_view::npos) return;
    const UndecodedSamples::Writer writer = WriterIn(line.substr(0, at));
    line.remove_prefix(at + kUndecoded.size());
    // A topic's name may have slashes, a type's name has none.
    const std::string_view topic = line.substr(0, line.substr(0, line.find(" failed")).rfind('/'));
    const auto counted = undecoded_.find(topic);
    if (counted == undecoded_.end()) return;
    ++counted->second.of[writer];
    ++counted->second.all;
  }

  std::mutex mutex_;
  std::vector<Kind> kinds_;  // by their last line
  std::map<std::string, UndecodedSamples, std::less<>> undecoded_;
};

// Never destroyed, as Cyclone's threads may log until the process ends.
CycloneLog& Log() {
  static CycloneLog* const log = new CycloneLog;
  return *log;
}

}  // namespace

std::vector<CycloneNotice> TakeCycloneNotices() { return Log().Take(); }

const UndecodedSamples& UndecodedOf(std::string_view topic) { return Log().Undecoded(topic); }

std::map<UndecodedSamples::Writer, std::uint64_t> UndecodedByWriter(std::string_view topic) {
  return Log().ByWriter(topic);
}

}  // namespace understudy::bus
