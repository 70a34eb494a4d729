// The panel's own files.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "server/http.h"

namespace understudy::server {

// Serves the plain files below a folder and nothing else: no hidden ones, none that a link leads to
// out of it. Of one thread.
class StaticFiles {
 public:
  // The folder need not exist.
  explicit StaticFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}

  // `path` is relative to the folder. 304 where the client has it already (If-None-Match).
  HttpReply Get(std::string_view path, std::string_view if_none_match);

 private:
  std::filesystem::path folder_;
  struct Sent {
    std::string tag;
    std::weak_ptr<const std::string> content;
  };
  // By file: once for all who read the same state of it, however slowly.
  std::map<std::string, Sent> sent_;
};

}  // namespace understudy::server
