// Writes an MP4 picture by picture, encoded by ffmpeg.
#pragma once

#include <filesystem>
#include <string>

#include <sys/types.h>

#include "base/unique_fd.h"
#include "viewer/arguments.h"
#include "viewer/canvas.h"

namespace understudy::viewer {

// H.264 in 4:2:0, which every player takes, so width and height have to be even. The file has
// another name until Finish().
class VideoFile {
 public:
  // Throws SetupError when there is no ffmpeg (with the package to install).
  VideoFile(std::filesystem::path file, const PictureSize& size, int fps);
  // Removes the file if it was not finished.
  ~VideoFile();
  VideoFile(const VideoFile&) = delete;
  VideoFile& operator=(const VideoFile&) = delete;

  // Waits while ffmpeg is behind. Throws SetupError with ffmpeg's words when it has given up.
  void Add(const Image& image);
  // The file is whole, under its name, when this returns. Throws as above; then there is none.
  void Finish();

 private:
  std::string Said() const;  // the first line that ffmpeg wrote to its standard error
  [[noreturn]] void Fail();
  int Wait();

  std::filesystem::path file_;
  std::filesystem::path part_;
  UniqueFd pictures_;  // ffmpeg's standard input
  UniqueFd words_;     // a file without a name: its standard error
  pid_t pid_ = -1;     // -1 once it was waited for
};

}  // namespace understudy::viewer
