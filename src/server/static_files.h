// Serves the files of the panel.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "server/http.h"

namespace understudy::server {

// Serves regular files below a folder, except hidden ones and those that a link leads to outside of
// it. For one thread.
class StaticFiles {
 public:
  // The folder may not exist.
  explicit StaticFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}

  // `path` is relative to the folder. Replies 304 if the client has the file already
  // (If-None-Match).
  HttpReply Get(std::string_view path, std::string_view if_none_match);

 private:
  std::filesystem::path folder_;
  struct Sent {
    std::string tag;
    std::weak_ptr<const std::string> content;
  };
  // By file: one copy for all replies that are being sent.
  std::map<std::string, Sent> sent_;
};

}  // namespace understudy::server
