// The kinds of film: one row each, found by the ending of the file's name.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace understudy::viewer {

struct FilmFormat {
  std::string_view ending;
  std::string_view options;  // of ffmpeg, separated by spaces
};

// H.264 in 4:2:0 is what every player takes. The quality of both is *assumed* to please; WebP's at
// 60 keeps ten seconds of 480x270 below 1 MB. A GIF has a palette made of all its pictures.
inline constexpr FilmFormat kFilmFormats[] = {
    {".mp4", "-c:v libx264 -crf 20 -pix_fmt yuv420p -movflags +faststart -f mp4"},
    {".webp", "-c:v libwebp_anim -quality 60 -compression_level 6 -loop 0 -f webp"},
    {".gif",
     "-filter_complex [0:v]split[a][b];[a]palettegen[p];[b][p]paletteuse=dither=none -f gif"},
};

// The ending of `file` in lower case, with its dot.
inline std::string EndingOf(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return ending;
}

// The row for `file`, or null.
inline const FilmFormat* FindFilmFormat(const std::filesystem::path& file) {
  for (const FilmFormat& format : kFilmFormats) {
    if (format.ending == EndingOf(file)) return &format;
  }
  return nullptr;
}

}  // namespace understudy::viewer
