// Writes a film picture by picture, encoded by ffmpeg.
#pragma once

#include <filesystem>
#include <string>

#include <sys/types.h>

#include "base/unique_fd.h"
#include "viewer/arguments.h"
#include "viewer/canvas.h"

namespace understudy::viewer {

// Width and height must be even, as for H.264 in 4:2:0. The file has a temporary name until
// Finish().
class VideoFile {
 public:
  // `file` has the extension of a row of kFilmFormats. Throws SetupError if it does not, or, with
  // the package to install, if there is no ffmpeg.
  VideoFile(std::filesystem::path file, const PictureSize& size, int fps);
  // Removes the file if it was not finished.
  ~VideoFile();
  VideoFile(const VideoFile&) = delete;
  VideoFile& operator=(const VideoFile&) = delete;

  // Adds a picture; waits while ffmpeg is behind. Throws SetupError with ffmpeg's message if it has
  // failed.
  void Add(const Image& image);
  // Completes the file and gives it its name. Throws as above; then there is no file.
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
