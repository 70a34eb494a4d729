#include "server/static_files.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

namespace understudy::server {
namespace {

constexpr std::uintmax_t kLargest = 32 << 20;  // *assumed*, several times all the panel's files

// The panel may run only its own scripts and contact only its robot, against injected content.
constexpr char kPolicy[] =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; "
    "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

std::string TypeOf(const std::filesystem::path& file) {
  static const std::map<std::string, std::string> kTypes{
      {".html", "text/html; charset=utf-8"},
      {".css", "text/css; charset=utf-8"},
      {".js", "text/javascript; charset=utf-8"},
      {".mjs", "text/javascript; charset=utf-8"},
      {".json", "application/json"},
      {".map", "application/json"},
      {".webmanifest", "application/manifest+json"},
      {".svg", "image/svg+xml"},
      {".png", "image/png"},
      {".ico", "image/x-icon"},
      {".woff2", "font/woff2"},
      {".wasm", "application/wasm"},
      {".txt", "text/plain; charset=utf-8"},
      {".md", "text/plain; charset=utf-8"},
  };
  const auto type = kTypes.find(file.extension().string());
  return type == kTypes.end() ? "application/octet-stream" : type->second;
}

// Accepts words of plain letters between slashes, none empty, none with a leading dot.
bool IsPlain(std::string_view path) {
  char before = '/';
  for (const char c : path) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (!letter && c != '/' && c != '.' && c != '-' && c != '_') return false;
    if (before == '/' && (c == '/' || c == '.')) return false;
    before = c;
  }
  return before != '/';
}

bool IsBelow(const std::filesystem::path& file, const std::filesystem::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first ==
         folder.end();
}

HttpReply NoFile(std::string_view path) {
  return ErrorReply(404, "the panel has no file " + std::string{path.substr(0, 64)});
}

}  // namespace

HttpReply StaticFiles::Get(std::string_view path, std::string_view if_none_match) {
  if (!IsPlain(path)) return NoFile(path);
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::canonical(folder_, error);
  if (error) return ErrorReply(404, "this installation has no panel");
  const std::filesystem::path file = std::filesystem::canonical(folder / path, error);
  if (error || !IsBelow(file, folder) || !std::filesystem::is_regular_file(file, error)) {
    return NoFile(path);
  }
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  const auto written = std::filesystem::last_write_time(file, error);
  if (error || size > kLargest) return NoFile(path);

  const std::string tag =
      "\"" + std::to_string(written.time_since_epoch().count()) + "-" + std::to_string(size) + "\"";
  HttpReply reply{.type = TypeOf(file),
                  .fields = {{"ETag", tag},
                             {"Cache-Control", "no-cache"},
                             {"Content-Security-Policy", kPolicy},
                             {"X-Content-Type-Options", "nosniff"},
                             {"Referrer-Policy", "no-referrer"},
                             {"Cross-Origin-Resource-Policy", "same-origin"}}};
  if (if_none_match == tag) {
    reply.status = 304;
    return reply;
  }
  Sent& sent = sent_[file.string()];
  if (sent.tag == tag) reply.shared = sent.content.lock();
  if (!reply.shared) {
    std::ifstream in(file, std::ios::binary);
    if (!in) return NoFile(path);
    reply.shared = std::make_shared<const std::string>(std::istreambuf_iterator<char>(in),
                                                       std::istreambuf_iterator<char>());
    sent = {.tag = tag, .content = reply.shared};
  }
  return reply;
}

}  // namespace understudy::server
