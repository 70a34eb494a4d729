#include "terrain/image.h"

#include <array>
#include <charconv>
#include <csetjmp>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>

#include <png.h>

#include "base/errors.h"

namespace understudy::terrain {
namespace {

constexpr int kLeastSide = 2, kMostSide = 2000;    // pixels
constexpr std::uintmax_t kMostBytes = 64U << 20U;  // a plain PGM of 2000 x 2000 pixels has 24 MB

[[noreturn]] void Refuse(const std::filesystem::path& file, const std::string& what) {
  throw ModelError(file.string() + ": " + what);
}

void RequireSides(const std::filesystem::path& file, std::uint64_t width, std::uint64_t height) {
  const auto fits = [](std::uint64_t side) { return side >= kLeastSide && side <= kMostSide; };
  if (fits(width) && fits(height)) return;
  Refuse(file, "expected 2 to 2000 pixels on each side, got " + std::to_string(width) + " x " +
                   std::to_string(height));
}

// Reads a PNG from memory. libpng reports errors by longjmp, so functions that call it have no
// objects with destructors.
struct PngJob {
  std::jmp_buf back;
  std::array<char, 200> error{};
  const unsigned char* from = nullptr;
  std::size_t left = 0;
};

void OnPngError(png_structp png, png_const_charp message) {
  auto* job = static_cast<PngJob*>(png_get_error_ptr(png));
  std::strncpy(job->error.data(), message, job->error.size() - 1);
  std::longjmp(job->back, 1);
}
void OnPngWarning(png_structp, png_const_charp) {}

void OnPngRead(png_structp png, png_bytep bytes, std::size_t count) {
  auto* job = static_cast<PngJob*>(png_get_io_ptr(png));
  if (count > job->left) png_error(png, "cut short");
  std::memcpy(bytes, job->from, count);
  job->from += count;
  job->left -= count;
}

struct PngHead {
  png_uint_32 width = 0, height = 0;
  int depth = 0;
  int colour = 0;
};

bool ReadPngHead(PngJob* job, png_structp png, png_infop info, PngHead* head) {
  if (setjmp(job->back) != 0) return false;
  png_set_read_fn(png, job, OnPngRead);
  png_read_info(png, info);
  png_get_IHDR(png, info, &head->width, &head->height, &head->depth, &head->colour, nullptr,
               nullptr, nullptr);
  return true;
}

// `rows` has one pointer per row, to 2 bytes per pixel.
bool ReadPngRows(PngJob* job, png_structp png, int depth, unsigned char** rows) {
  if (setjmp(job->back) != 0) return false;
  if (depth < 8) png_set_expand_gray_1_2_4_to_8(png);
  if (depth < 16) png_set_expand_16(png);  // times 257: white stays white
  png_set_strip_alpha(png);
  png_read_image(png, rows);
  png_read_end(png, nullptr);
  return true;
}

GreyImage ReadPng(const std::filesystem::path& file, const std::string& bytes) {
  struct Handle {
    png_structp png = nullptr;
    png_infop info = nullptr;
    ~Handle() { png_destroy_read_struct(&png, &info, nullptr); }
  } handle;
  PngJob job;
  job.from = reinterpret_cast<const unsigned char*>(bytes.data());
  job.left = bytes.size();
  handle.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &job, OnPngError, OnPngWarning);
  handle.info = png_create_info_struct(handle.png);
  const auto damaged = [&] { Refuse(file, "not a sound PNG: " + std::string(job.error.data())); };

  PngHead head;
  if (!ReadPngHead(&job, handle.png, handle.info, &head)) damaged();
  RequireSides(file, head.width, head.height);
  if (head.colour != PNG_COLOR_TYPE_GRAY && head.colour != PNG_COLOR_TYPE_GRAY_ALPHA) {
    Refuse(file, "expected a grey image, got a coloured one");
  }
  std::vector<unsigned char> pixels(std::size_t{2} * head.width * head.height);
  std::vector<unsigned char*> rows(head.height);
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = &pixels[2 * head.width * i];
  if (!ReadPngRows(&job, handle.png, head.depth, rows.data())) damaged();

  GreyImage image{static_cast<int>(head.width), static_cast<int>(head.height), {}};
  image.grey.resize(pixels.size() / 2);
  for (std::size_t i = 0; i < image.grey.size(); ++i) {
    image.grey[i] = (256 * pixels[2 * i] + pixels[2 * i + 1]) / 65535.0;
  }
  return image;
}

// Reads the words of a PGM: its header, and the pixels of a plain one. Skips blanks and comments.
class PgmWords {
 public:
  explicit PgmWords(std::string_view text) : text_(text) {}

  // Returns the next number; nullopt at the end or for another word.
  std::optional<std::uint32_t> Next() {
    while (!text_.empty() && (IsBlank(text_[0]) || text_[0] == '#')) {
      if (text_[0] == '#') {
        text_.remove_prefix(std::min(text_.size(), text_.find('\n')));
      } else {
        text_.remove_prefix(1);
      }
    }
    std::uint32_t value = 0;
    const auto [end, error] = std::from_chars(text_.data(), text_.data() + text_.size(), value);
    if (error != std::errc()) return std::nullopt;
    text_.remove_prefix(static_cast<std::size_t>(end - text_.data()));
    return value;
  }
  // Returns the bytes after the single blank that follows the last number.
  std::string_view rest() const { return text_.substr(std::min<std::size_t>(1, text_.size())); }

 private:
  static bool IsBlank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
  std::string_view text_;
};

GreyImage ReadPgm(const std::filesystem::path& file, const std::string& bytes) {
  const bool plain = bytes[1] == '2';
  PgmWords words(std::string_view(bytes).substr(2));
  const auto width = words.Next(), height = words.Next(), white = words.Next();
  if (!width || !height || !white || *white < 1 || *white > 65535) {
    Refuse(file, "invalid PGM: expected width, height and a white of 1 to 65535");
  }
  RequireSides(file, *width, *height);
  GreyImage image{static_cast<int>(*width), static_cast<int>(*height), {}};
  image.grey.resize(std::size_t{*width} * *height);
  const std::size_t depth = *white < 256 ? 1 : 2;
  const std::string_view raw = words.rest();
  if (!plain && raw.size() < depth * image.grey.size()) Refuse(file, "invalid PGM: cut short");
  const auto byte = [&](std::size_t i) {
    return static_cast<std::uint32_t>(static_cast<unsigned char>(raw[i]));
  };
  for (std::size_t i = 0; i < image.grey.size(); ++i) {
    std::optional<std::uint32_t> value;
    if (plain) {
      value = words.Next();
    } else {
      value = depth == 1 ? byte(i) : 256 * byte(2 * i) + byte(2 * i + 1);
    }
    if (!value) Refuse(file, "invalid PGM: cut short");
    if (*value > *white) Refuse(file, "invalid PGM: a pixel exceeds the value of white");
    image.grey[i] = static_cast<double>(*value) / *white;
  }
  return image;
}

}  // namespace

GreyImage ReadGreyImage(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) Refuse(file, "no such file");
  if (std::filesystem::file_size(file, error) > kMostBytes) Refuse(file, "larger than 64 MiB");
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (bytes.starts_with("\x89PNG")) return ReadPng(file, bytes);
  if (bytes.starts_with("P2") || bytes.starts_with("P5")) return ReadPgm(file, bytes);
  Refuse(file, "expected a PNG or a PGM (P2 or P5)");
}

void WriteGreyPng(const std::filesystem::path& file, int width, int height,
                  const std::vector<std::uint16_t>& grey) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width);
  image.height = static_cast<png_uint_32>(height);
  image.format = PNG_FORMAT_LINEAR_Y;
  if (png_image_write_to_file(&image, file.c_str(), 0, grey.data(), 0, nullptr) == 0) {
    Refuse(file, std::string("cannot be written: ") + image.message);
  }
}

}  // namespace understudy::terrain
