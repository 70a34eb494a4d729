#include "base/log_line.h"

#include <cstdlib>
#include <exception>

#include <nlohmann/json.hpp>

#include "base/standard_error.h"

namespace understudy {
namespace {

bool speaks_json = false;  // set before any thread exists

void SayJson(std::string_view message) {
  WriteToStandardError(JsonLogLine(std::chrono::system_clock::now(), "error", message));
}

// Replaces the handler of the C++ library, which writes text.
[[noreturn]] void Terminate() {
  std::string why = "ended by a bug";
  try {
    if (const std::exception_ptr error = std::current_exception()) std::rethrow_exception(error);
  } catch (const std::exception& error) {
    why += std::string(": ") + error.what();
  } catch (...) {
    why += ": an unknown exception";
  }
  SayJson(why);
  std::abort();
}

}  // namespace

bool AsksForJson(int argc, const char* const* argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (word == "--") return false;
    if (word == "--json") return true;
  }
  return false;
}

void SpeakJson() {
  speaks_json = true;
  std::set_terminate(&Terminate);
}

bool SpeaksJson() { return speaks_json; }

std::string JsonLogLine(std::chrono::system_clock::time_point time, std::string_view level,
                        std::string_view message) {
  const nlohmann::json line = {
      {"time", std::chrono::duration<double>(time.time_since_epoch()).count()},
      {"level", level},
      {"message", message}};
  return line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

void SayError(std::string_view message) {
  if (speaks_json) return SayJson(message);
  WriteToStandardError("understudy: " + std::string(message) + "\n");
}

void SayErrorText(std::string_view text) {
  if (!speaks_json) {
    WriteToStandardError(text);
    return;
  }
  SayJson(text.substr(0, text.find_last_not_of('\n') + 1));
}

}  // namespace understudy
