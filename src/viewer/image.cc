#include "viewer/image.h"

#include <system_error>

#include <png.h>
#include <unistd.h>

#include "base/errors.h"

namespace understudy::viewer {

Image Halve(const Image& big) {
  Image half{.width = big.width / 2, .height = big.height / 2, .rgb = {}};
  half.rgb.resize(3 * static_cast<std::size_t>(half.width) * static_cast<std::size_t>(half.height));
  const std::size_t stride = 3 * static_cast<std::size_t>(big.width);
  std::uint8_t* out = half.rgb.data();
  for (int row = 0; row < half.height; ++row) {
    const std::uint8_t* in = big.rgb.data() + 2 * static_cast<std::size_t>(row) * stride;
    for (int column = 0; column < half.width; ++column, in += 6) {
      for (int c = 0; c < 3; ++c) {
        const int sum = in[c] + in[c + 3] + in[stride + static_cast<std::size_t>(c)] +
                        in[stride + static_cast<std::size_t>(c) + 3];
        *out++ = static_cast<std::uint8_t>((sum + 2) / 4);
      }
    }
  }
  return half;
}

void WritePng(const Image& image, const std::filesystem::path& file) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = PNG_FORMAT_RGB;
  const std::string part = file.string() + "." + std::to_string(::getpid()) + ".part";
  std::error_code error;
  if (png_image_write_to_file(&png, part.c_str(), 0, image.rgb.data(), 0, nullptr) == 0) {
    std::filesystem::remove(part, error);
    throw SetupError("cannot write " + file.string() + ": " + png.message);
  }
  std::filesystem::rename(part, file, error);
  if (!error) return;
  std::error_code ignored;
  std::filesystem::remove(part, ignored);
  throw SetupError("cannot write " + file.string() + ": " + error.message());
}

void CheckWritable(const std::filesystem::path& file, bool overwrite) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) {
    throw SetupError(file.string() + " is a folder; name a file in it");
  }
  if (!overwrite && std::filesystem::exists(file, ignored)) {
    throw SetupError(file.string() +
                     " is there already; name another file, or replace it with --overwrite");
  }
  const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
  if (!std::filesystem::is_directory(folder, ignored)) {
    throw SetupError("cannot write " + file.string() + ": no folder " + folder.string());
  }
  if (::access(folder.c_str(), W_OK) != 0) {
    throw SetupError("cannot write " + file.string() + ": no right to write in " + folder.string());
  }
}

}  // namespace understudy::viewer
