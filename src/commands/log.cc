#include "commands/log.h"

#include <memory>

#include <spdlog/async.h>
#include <spdlog/fmt/fmt.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include "base/log_line.h"
#include "base/standard_error.h"

namespace understudy::commands {
namespace {

class JsonFormatter final : public spdlog::formatter {
 public:
  void format(const spdlog::details::log_msg& message, spdlog::memory_buf_t& out) override {
    const auto level = spdlog::level::to_string_view(message.level);
    const std::string text = JsonLogLine(message.time, {level.data(), level.size()},
                                         {message.payload.data(), message.payload.size()});
    out.append(text.data(), text.data() + text.size());
  }
  std::unique_ptr<spdlog::formatter> clone() const override {
    return std::make_unique<JsonFormatter>();
  }
};

// Writes to standard error, in colour on a terminal. Lines that cannot be written are lost; their
// number is logged when writing works again.
class StandardErrorSink final : public spdlog::sinks::base_sink<std::mutex> {
 public:
  // `queue` counts the lines that it has dropped.
  explicit StandardErrorSink(std::weak_ptr<spdlog::details::thread_pool> queue)
      : queue_(std::move(queue)) {}

 protected:
  void sink_it_(const spdlog::details::log_msg& message) override {
    if (const auto queue = queue_.lock()) {
      unwritten_ += queue->overrun_counter() - dropped_;
      dropped_ = queue->overrun_counter();
    }
    if (unwritten_ > 0) {
      const std::string text = fmt::format("{} lines of the log could not be written", unwritten_);
      if (Write({"", spdlog::level::warn, text})) unwritten_ = 0;
    }
    if (!Write(message)) ++unwritten_;
  }
  void flush_() override {}

 private:
  bool Write(const spdlog::details::log_msg& message) {
    spdlog::memory_buf_t line;
    formatter_->format(message, line);
    std::string text(line.data(), line.size());
    if (terminal_ && message.color_range_end > message.color_range_start) {
      text.insert(message.color_range_end, "\033[m");
      text.insert(message.color_range_start, Color(message.level));
    }
    return WriteToStandardError(text);
  }

  static const char* Color(spdlog::level::level_enum level) {
    switch (level) {
      case spdlog::level::warn:
        return "\033[33m\033[1m";
      case spdlog::level::err:
      case spdlog::level::critical:
        return "\033[31m\033[1m";
      default:
        return "\033[32m";
    }
  }

  std::weak_ptr<spdlog::details::thread_pool> queue_;
  bool terminal_ = isatty(STDERR_FILENO) == 1;
  std::size_t dropped_ = 0;    // count of the queue at the last line
  std::size_t unwritten_ = 0;  // lines lost and not yet reported
};

}  // namespace

void StartLog(const LogOptions& options) {
  constexpr std::size_t kQueue = 1024;
  spdlog::init_thread_pool(kQueue, 1);
  auto logger = std::make_shared<spdlog::async_logger>(
      "understudy", std::make_shared<StandardErrorSink>(spdlog::thread_pool()),
      spdlog::thread_pool(), spdlog::async_overflow_policy::overrun_oldest);
  if (options.json) {
    logger->set_formatter(std::make_unique<JsonFormatter>());
  } else {
    // On a terminal each log line first clears the status line.
    logger->set_pattern(std::string(options.status_line ? "\r\033[K" : "") +
                        "[%H:%M:%S.%e] %^%l%$: %v");
  }
  logger->set_level(spdlog::level::from_str(options.level));
  spdlog::set_default_logger(std::move(logger));
}

void StopLog() { spdlog::shutdown(); }

}  // namespace understudy::commands
