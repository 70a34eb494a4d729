#include "commands/log.h"

#include <memory>

#include <nlohmann/json.hpp>
#include <spdlog/async.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

namespace understudy::commands {
namespace {

class JsonFormatter final : public spdlog::formatter {
 public:
  void format(const spdlog::details::log_msg& message, spdlog::memory_buf_t& out) override {
    const auto level = spdlog::level::to_string_view(message.level);
    const auto since = message.time.time_since_epoch();
    const nlohmann::json line = {
        {"time", std::chrono::duration<double>(since).count()},
        {"level", std::string(level.data(), level.size())},
        {"message", std::string(message.payload.data(), message.payload.size())}};
    const std::string text =
        line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
    out.append(text.data(), text.data() + text.size());
  }
  std::unique_ptr<spdlog::formatter> clone() const override {
    return std::make_unique<JsonFormatter>();
  }
};

}  // namespace

void StartLog(const LogOptions& options) {
  constexpr std::size_t kQueue = 1024;
  spdlog::init_thread_pool(kQueue, 1);
  auto logger = spdlog::create_async_nb<spdlog::sinks::stderr_color_sink_mt>("understudy");
  if (options.json) {
    logger->set_formatter(std::make_unique<JsonFormatter>());
  } else {
    // On a terminal each line first clears the status line it lands on.
    logger->set_pattern(std::string(options.status_line ? "\r\033[K" : "") +
                        "[%H:%M:%S.%e] %^%l%$: %v");
  }
  logger->set_level(spdlog::level::from_str(options.level));
  spdlog::set_default_logger(std::move(logger));
}

void StopLog() { spdlog::shutdown(); }

}  // namespace understudy::commands
