#include "policy/tensors.h"

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <limits>
#include <optional>
#include <system_error>
#include <utility>

#include <nlohmann/json.hpp>

#include "base/errors.h"

namespace understudy::policy {
namespace {

using nlohmann::json;

static_assert(std::endian::native == std::endian::little, "tensors are little-endian");

constexpr std::size_t kLengthBytes = 8;
constexpr std::size_t kLongestHeader = std::size_t{1} << 20;  // bytes
constexpr std::size_t kLargestFile = std::size_t{256} << 20;
constexpr std::size_t kMostDimensions = 8;
constexpr std::size_t kLongestShown = 64;

// A name from the file, for an error line.
std::string Shown(const std::string& text) {
  std::string shown = text.substr(0, kLongestShown);
  for (char& c : shown) {
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = '.';
  }
  return shown;
}

std::optional<std::vector<std::size_t>> Sizes(const json& value, std::size_t most) {
  if (!value.is_array() || value.size() > most) return std::nullopt;
  std::vector<std::size_t> sizes;
  for (const json& size : value) {
    if (!size.is_number_unsigned()) return std::nullopt;
    sizes.push_back(size.get<std::size_t>());
  }
  return sizes;
}

// The bytes that float32 values of that shape take; nullopt if the number overflows.
std::optional<std::size_t> BytesOf(const std::vector<std::size_t>& shape) {
  std::size_t bytes = sizeof(float);
  for (const std::size_t size : shape) {
    if (size != 0 && bytes > std::numeric_limits<std::size_t>::max() / size) return std::nullopt;
    bytes *= size;
  }
  return bytes;
}

Tensor ParseTensor(const json& entry, std::string_view data, const std::string& where) {
  if (!entry.is_object() || !entry.contains("dtype") || !entry.contains("shape") ||
      !entry.contains("data_offsets")) {
    throw ConfigError(where + "expected dtype, shape and data_offsets");
  }
  if (entry["dtype"] != "F32") {
    const std::string type =
        entry["dtype"].is_string() ? Shown(entry["dtype"].get<std::string>()) : "no text";
    throw ConfigError(where + "dtype: expected F32, got " + type);
  }
  const auto shape = Sizes(entry["shape"], kMostDimensions);
  const auto offsets = Sizes(entry["data_offsets"], 2);
  if (!shape) throw ConfigError(where + "shape: expected at most 8 whole numbers");
  if (!offsets || offsets->size() != 2 || (*offsets)[0] > (*offsets)[1] ||
      (*offsets)[1] > data.size()) {
    throw ConfigError(where + "data_offsets: expected [begin, end] within the " +
                      std::to_string(data.size()) + " bytes of data");
  }
  const std::size_t bytes = (*offsets)[1] - (*offsets)[0];
  if (BytesOf(*shape) != bytes) {
    throw ConfigError(where + "shape: does not fit its " + std::to_string(bytes) +
                      " bytes of float32");
  }
  Tensor tensor{.shape = *shape, .values = std::vector<float>(bytes / sizeof(float))};
  if (bytes > 0) std::memcpy(tensor.values.data(), data.data() + (*offsets)[0], bytes);
  return tensor;
}

}  // namespace

TensorFile ParseTensors(std::string_view bytes, const std::string& name) {
  if (bytes.size() < kLengthBytes) {
    throw ConfigError(name + ": expected a safetensors file, got " + std::to_string(bytes.size()) +
                      " bytes");
  }
  std::uint64_t length = 0;
  std::memcpy(&length, bytes.data(), kLengthBytes);
  bytes.remove_prefix(kLengthBytes);
  if (length > bytes.size() || length > kLongestHeader) {
    throw ConfigError(name + ": expected a safetensors file: its header would have " +
                      std::to_string(length) + " bytes");
  }
  const std::string_view text = bytes.substr(0, length);
  const std::string_view data = bytes.substr(length);
  const json header = json::parse(text.begin(), text.end(), nullptr, /*allow_exceptions=*/false);
  if (!header.is_object()) {
    throw ConfigError(name + ": expected a safetensors file: its header is no JSON object");
  }
  TensorFile file;
  std::size_t total = 0;
  for (const auto& [key, entry] : header.items()) {
    const std::string where = name + ": " + Shown(key) + ": ";
    if (Shown(key) != key) {
      throw ConfigError(where + "expected a name of at most 64 letters without control characters");
    }
    if (key == "__metadata__") {
      if (!entry.is_object()) throw ConfigError(where + "expected an object of texts");
      for (const auto& [word, value] : entry.items()) {
        if (!value.is_string()) throw ConfigError(where + Shown(word) + ": expected a text");
        file.metadata[word] = value.get<std::string>();
      }
      continue;
    }
    Tensor tensor = ParseTensor(entry, data, where);
    total += tensor.values.size() * sizeof(float);
    if (total > data.size()) throw ConfigError(where + "data_offsets: tensors overlap");
    file.tensors.emplace(key, std::move(tensor));
  }
  return file;
}

TensorFile ReadTensors(const std::filesystem::path& file) {
  std::error_code error;
  const std::uintmax_t size =
      std::filesystem::is_regular_file(file, error) ? std::filesystem::file_size(file, error) : 0;
  std::ifstream stream(file, std::ios::binary);
  if (size == 0 || error || !stream) {
    throw ConfigError(file.string() + ": expected a file of weights: no such file, or it is empty");
  }
  if (size > kLargestFile) {
    throw ConfigError(file.string() + ": expected at most 256 MiB, got " + std::to_string(size) +
                      " bytes");
  }
  std::string bytes(size, '\0');
  if (!stream.read(bytes.data(), static_cast<std::streamsize>(size))) {
    throw ConfigError(file.string() + ": cannot be read");
  }
  return ParseTensors(bytes, file.string());
}

}  // namespace understudy::policy
