#include "mjcf/mesh_builder.h"

#include <algorithm>
#include <cmath>
#include <system_error>
#include <utility>

#include "base/errors.h"
#include "base/files.h"
#include "base/printed.h"

namespace understudy::mjcf {
namespace {

constexpr std::uintmax_t kMostMeshBytes = 256U << 20U;
constexpr std::size_t kMostMeshTriangles = 4'000'000;
constexpr double kFarthestCorner = 1e6;  // of the file's unit

bool IsBlank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

}  // namespace

void MeshBuilder::Add(const std::optional<Rgba>& rgba, const MeshPoint& a, const MeshPoint& b,
                      const MeshPoint& c) {
  if (++triangles_ > kMostMeshTriangles)
    throw ModelError(file_ + ": more than 4 million triangles");
  std::vector<float>& corners = parts_[rgba];
  for (const MeshPoint* const point : {&a, &b, &c}) {
    for (const double x : *point) {
      if (!(std::abs(x) <= kFarthestCorner)) {
        throw ModelError(file_ + ": a corner at " + Printed("%g", x) +
                         "; expected none beyond 1e6 from the origin");
      }
      corners.push_back(static_cast<float>(x));
    }
  }
}

std::vector<MeshPart> MeshBuilder::Take() {
  if (parts_.empty()) throw ModelError(file_ + ": expected triangles");
  std::vector<MeshPart> parts;
  for (auto& [rgba, corners] : parts_) parts.push_back({rgba, std::move(corners)});
  return parts;
}

std::string MeshBytes(const std::filesystem::path& file) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error) throw ModelError(file.string() + ": " + error.message());
  if (size > kMostMeshBytes)
    throw ModelError(file.string() + ": expected a file of at most 256 MiB");
  std::string bytes = FileText(file);
  if (bytes.empty() && size > 0) throw ModelError(file.string() + ": cannot be read");
  return bytes;
}

bool MeshText::NextLine() {
  if (rest_.empty()) return false;
  const std::size_t end = std::min(rest_.find('\n'), rest_.size());
  line_ = rest_.substr(0, end);
  rest_.remove_prefix(std::min(end + 1, rest_.size()));
  ++number_;
  return true;
}

std::string_view MeshText::Word() {
  const char* const begin = std::ranges::find_if_not(line_, IsBlank);
  const char* const end = std::find_if(begin, line_.end(), IsBlank);
  line_ = {end, line_.end()};
  return {begin, end};
}

std::string_view MeshText::AnyWord() {
  for (;;) {
    const std::string_view word = Word();
    if (!word.empty() || !NextLine()) return word;
  }
}

double MeshText::NumberOf(std::string_view word) const {
  double number = 0;
  const auto [end, error] = std::from_chars(word.begin(), word.end(), number);
  if (error != std::errc() || end != word.end() || !std::isfinite(number)) {
    Fail("expected a number" +
         (word.empty() ? "" : ", not '" + Printable(std::string(word)) + "'"));
  }
  return number;
}

long MeshText::WholeOf(std::string_view word) const {
  long number = 0;
  const auto [end, error] = std::from_chars(word.begin(), word.end(), number);
  if (error != std::errc() || end != word.end()) {
    Fail("expected a whole number, not '" + Printable(std::string(word)) + "'");
  }
  return number;
}

void MeshText::Fail(const std::string& what) const {
  throw ModelError(file_ + ":" + std::to_string(number_) + ": " + what);
}

Rgba MeanColour(const Rgba& a, const Rgba& b, const Rgba& c) {
  Rgba mean{};
  for (std::size_t i = 0; i < mean.size(); ++i) {
    mean[i] = std::round((a[i] + b[i] + c[i]) / 3 * 8) / 8;
  }
  return mean;
}

}  // namespace understudy::mjcf
